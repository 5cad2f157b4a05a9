// fit_trace.h - how a fit went: loss, PSNR and number of blobs by step, and their curves.
#ifndef SPLATLAB_LAB_APP_FIT_TRACE_H
#define SPLATLAB_LAB_APP_FIT_TRACE_H

#include "lab/app/gui.h"

enum { FIT_TRACE_POINTS = 1024 };

typedef enum { FIT_LOSS, FIT_PSNR, FIT_BLOBS, FIT_CURVE_COUNT } FitCurve;

typedef struct {
    int count;
    int step[FIT_TRACE_POINTS];
    double value[FIT_CURVE_COUNT][FIT_TRACE_POINTS];
} FitTrace;

// Later steps follow. When there is no room, every second point is dropped: the curve keeps its whole length.
void fit_trace_add(FitTrace *trace, int step, const double value[FIT_CURVE_COUNT]);

// One curve with its axes and its name, in the panel that is open. total: the steps at the right edge.
void fit_trace_plot(const FitTrace *trace, FitCurve curve, int total, GuiRect place);

#endif
