// clock.h - elapsed time, for progress and metrics; results never depend on it.
#ifndef SPLATLAB_LAB_BASE_CLOCK_H
#define SPLATLAB_LAB_BASE_CLOCK_H

// Seconds since an arbitrary start, monotonic.
double clock_seconds(void);

#endif
