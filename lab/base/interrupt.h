// interrupt.h - Ctrl-C as a question that a loop may ask: finish the step, save, and leave cleanly.
#ifndef SPLATLAB_LAB_BASE_INTERRUPT_H
#define SPLATLAB_LAB_BASE_INTERRUPT_H

#include <stdbool.h>

// From now on SIGINT and SIGTERM are only noted; a second SIGINT ends the program at once (exit code 130).
void interrupt_install(void);

// Has one arrived since interrupt_install()?
bool interrupt_requested(void);

#endif
