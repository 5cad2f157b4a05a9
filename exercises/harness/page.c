// page.c - escape codes, and words that fit.
#include "exercises/harness/page.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

enum { COLUMNS_DEFAULT = 100, COLUMNS_MIN = 40 };

Page page_for(int fd, FILE *out) {
    Page page = {.out = out, .columns = COLUMNS_DEFAULT};
    const char *none = getenv("NO_COLOR"), *kind = getenv("TERM"), *columns = getenv("COLUMNS");
    struct winsize size = {0};
    bool is_terminal = isatty(fd);
    page.has_colour = is_terminal && !(none && none[0]) && kind && strcmp(kind, "dumb") != 0;
    if (is_terminal && ioctl(fd, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
        page.columns = size.ws_col, page.rows = size.ws_row;
    else if (columns && atoi(columns) > 0)
        page.columns = atoi(columns);
    if (page.columns < COLUMNS_MIN) page.columns = COLUMNS_MIN;
    return page;
}

void page_colour(const Page *page, PageColour colour) {
    static const char *const CODES[] = {"\033[0m", "\033[32m", "\033[31m", "\033[1m"};
    if (page->has_colour) fputs(CODES[colour], page->out);
}

// Columns that the text takes: UTF-8's continuation bytes take none.
static int width_of(const char *text, size_t bytes) {
    int width = 0;
    for (size_t i = 0; i < bytes; i++) width += ((unsigned char)text[i] & 0xc0) != 0x80;
    return width;
}

void page_wrap(const Page *page, int column, int indent, const char *text) {
    int blanks = 0; // before the next word; none are left at the end of a line
    bool is_first = true;
    while (*text) {
        size_t length = strcspn(text, " \n");
        int width = width_of(text, length);
        if (length > 0 && !is_first && column + blanks + width > page->columns) {
            fprintf(page->out, "\n%*s", indent, "");
            column = indent;
            blanks = 0;
        }
        if (length > 0) {
            fprintf(page->out, "%*s%.*s", blanks, "", (int)length, text);
            column += blanks + width;
            blanks = 0;
            is_first = false;
        }
        text += length;
        if (*text) blanks++, text++;
    }
    fputc('\n', page->out);
}

void page_paragraph(const Page *page, const char *label, PageColour colour, const char *format, ...) {
    char *text = NULL;
    size_t size;
    va_list args;
    va_start(args, format);
    FILE *stream = open_memstream(&text, &size);
    if (stream) {
        vfprintf(stream, format, args);
        fclose(stream);
    }
    va_end(args);
    fprintf(page->out, "  %-*s", PAGE_LABEL - 2, label);
    if (colour != PAGE_PLAIN) page_colour(page, colour);
    page_wrap(page, PAGE_LABEL, PAGE_LABEL, text ? text : "");
    if (colour != PAGE_PLAIN) page_colour(page, PAGE_PLAIN);
    free(text);
}

// Headings, code, tables and lists keep their lines.
static bool is_prose(const char *line) { return *line && !strchr(" #|-\n", *line); }

void page_markdown(const Page *page, const char *text) {
    while (*text) {
        size_t length = strcspn(text, "\n");
        if (is_prose(text)) // and what follows on
            while (text[length] && is_prose(text + length + 1)) length += 1 + strcspn(text + length + 1, "\n");
        char *part = strndup(text, length);
        page_wrap(page, 0, 0, part);
        free(part);
        text += length + (text[length] == '\n');
    }
}
