// palette.h - the colours of the windows: a dark room with few, quiet hues, so that the picture is what shines.
#ifndef SPLATLAB_LAB_APP_PALETTE_H
#define SPLATLAB_LAB_APP_PALETTE_H

#include "lab/app/gui.h"

static const GuiColour INK = 0xe8eaf0ff;         // text
static const GuiColour INK_QUIET = 0x98a1b5ff;   // labels, units
static const GuiColour INK_FAINT = 0x5a6276ff;   // axes, what does not count
static const GuiColour PANEL = 0x161a23ff;       // behind controls
static const GuiColour PANEL_DEEP = 0x10131aff;  // behind tables and plots
static const GuiColour CARD = 0x1d222eff;        // a group on a panel
static const GuiColour LINE = 0x2c3242ff;        // rules, frames
static const GuiColour ACCENT = 0x7aa2f7ff;      // what is active
static const GuiColour ACCENT_WARM = 0xf2b84bff; // what the hall should look at: questions, probes
static const GuiColour GOOD = 0x5fd6a0ff;        // valid
static const GuiColour BAD = 0xff6b6bff;         // invalid

static inline GuiColour colour_of(const double rgb[3], double alpha) {
    const double values[4] = {rgb[0], rgb[1], rgb[2], alpha};
    GuiColour colour = 0;
    for (int c = 0; c < 4; c++) {
        double clipped = values[c] > 0 ? values[c] < 1 ? values[c] : 1 : 0; // NaN is 0
        colour = colour << 8 | (GuiColour)(255 * clipped + 0.5);
    }
    return colour;
}

static inline GuiColour faded(GuiColour colour, double alpha) {
    return (colour & 0xffffff00u) | (GuiColour)((colour & 255) * alpha + 0.5);
}

#endif
