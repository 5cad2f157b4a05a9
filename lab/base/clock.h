// clock.h - elapsed time, for progress and metrics; results never depend on it.
#ifndef SPLATLAB_LAB_BASE_CLOCK_H
#define SPLATLAB_LAB_BASE_CLOCK_H

// Seconds since an arbitrary start, monotonic.
double clock_seconds(void);

// Seconds that all threads of this process have spent on a core; what other programs take does not count.
double clock_cpu_seconds(void);

// Seconds since this process was started, the loading of its libraries included; to 0.01 s. 0 where the system does not tell.
double clock_process_age_seconds(void);

#endif
