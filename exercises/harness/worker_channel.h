// worker_channel.h - the worker's end of the socket to the judge (wire.h).
#ifndef SPLATLAB_EXERCISES_HARNESS_WORKER_CHANNEL_H
#define SPLATLAB_EXERCISES_HARNESS_WORKER_CHANNEL_H

#include "exercises/harness/wire.h"

#include <stddef.h>

// All `size` bytes. Ends the process when the judge is gone.
void channel_receive(void *data, size_t size);

// The head, and `count` numbers behind it. Ends the process when the judge is gone.
void channel_answer(const WireAnswer *head, const double *numbers, size_t count);

#endif
