// page.h - text for a person: labelled paragraphs, wrapped where the terminal ends, in colour where it has some.
#ifndef SPLATLAB_EXERCISES_HARNESS_PAGE_H
#define SPLATLAB_EXERCISES_HARNESS_PAGE_H

#include <stdbool.h>
#include <stdio.h>

typedef enum { PAGE_PLAIN, PAGE_GOOD, PAGE_BAD, PAGE_STRONG } PageColour;

typedef struct {
    FILE *out;
    bool has_colour;
    int columns, rows; // of the terminal; 100 and 0 (without end) where there is none
} Page;

// fd: where `out` ends up. Colours need a terminal that is not dumb, and no NO_COLOR in the environment.
Page page_for(int fd, FILE *out);

// Switches the colour on, and PAGE_PLAIN off.
void page_colour(const Page *page, PageColour colour);

enum { PAGE_LABEL = 13 }; // where text behind a label begins

// "  label      text", the text broken at blanks; further lines begin under its first.
void page_paragraph(const Page *page, const char *label, PageColour colour, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

// The same, with further lines indented by that much, beginning in the column where the line is now.
void page_wrap(const Page *page, int column, int indent, const char *text);

// A page of Markdown as it is, with its paragraphs broken anew: lines that follow each other are one.
void page_markdown(const Page *page, const char *text);

#endif
