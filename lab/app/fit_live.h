// fit_live.h - a fit in a window, as it happens: photograph, picture, blobs, error, and how loss and PSNR go.
#ifndef SPLATLAB_LAB_APP_FIT_LIVE_H
#define SPLATLAB_LAB_APP_FIT_LIVE_H

#include "lab/app/fit_job.h"
#include "lab/app/window_options.h"

#include <stdbool.h>

// The window owns the loop and calls fit_job_step(). The result is saved as soon as the last step is done; when the window
// is closed before that, or on Ctrl-C, what there is is saved. The steps are those of a run without a window, so are the files.
bool fit_live(FitJob *job, const WindowOptions *options);

#endif
