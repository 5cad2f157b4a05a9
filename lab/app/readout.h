// readout.h - a line of a panel: what it is on the left, its value at the right edge.
#ifndef SPLATLAB_LAB_APP_READOUT_H
#define SPLATLAB_LAB_APP_READOUT_H

#include "lab/app/gui.h"

void readout(const char *label, GuiColour colour, const char *format, ...) __attribute__((format(printf, 3, 4)));

#endif
