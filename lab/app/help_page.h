// help_page.h - the overlay of F1: what the mouse and the keyboard do in a window, on one page.
#ifndef SPLATLAB_LAB_APP_HELP_PAGE_H
#define SPLATLAB_LAB_APP_HELP_PAGE_H

#include <stdbool.h>

typedef struct {
    const char *keys, *does;
} HelpLine;

// Draws it while *shown. F1 shows it; F1, Escape or a click end it.
void help_page(bool *shown, const HelpLine *lines, int count);

#endif
