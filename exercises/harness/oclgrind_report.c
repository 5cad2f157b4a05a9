// oclgrind_report.c - a report begins with what was seen; "Global(x,y,z)" and "At line N ... of FILE" follow.
#include "exercises/harness/oclgrind_report.h"

#include <string.h>

typedef struct {
    char what[160], items[2][24], place[120];
    int item_count;
} Report;

// "Read-write data race at global memory address 0x2000" loses the address.
static void take_what(Report *r, const char *line) {
    snprintf(r->what, sizeof r->what, "%.150s", line);
    char *address = strstr(r->what, " at global memory address");
    if (!address) address = strstr(r->what, " at local memory address");
    if (address) *address = 0;
}

static void take_line(Report *r, const char *line) {
    const char *item = strstr(line, "Global("), *at = strstr(line, "At line ");
    if (!r->what[0])
        take_what(r, line);
    else if (item && (r->item_count == 0 || (r->item_count == 1 && strstr(line, "Second entity"))))
        snprintf(r->items[r->item_count++], sizeof *r->items, "%.*s)", (int)strcspn(item + 6, ")"), item + 6);
    else if (at && !r->place[0]) {
        int number = 0;
        const char *slash = strrchr(at, '/'), *of = strstr(at, " of ");
        const char *file = slash ? slash + 1 : of ? of + 4 : "";
        sscanf(at + 8, "%d", &number);
        snprintf(r->place, sizeof r->place, ", line %d of %.80s", number, file);
        r->place[strcspn(r->place, ":\n")] = 0;
    }
}

bool oclgrind_report_read(FILE *log, char *text, size_t size) {
    Report r = {0};
    char line[512];
    clearerr(log);
    while (fgets(line, sizeof line, log)) {
        line[strcspn(line, "\n")] = 0;
        const char *from = line + strspn(line, " \t");
        if (*from) take_line(&r, from);
    }
    const char *several = r.item_count == 2 ? "s " : " ";
    snprintf(text, size, "%s%s%s%s%s%s%s", r.what, r.item_count ? ", work-item" : "", r.item_count ? several : "",
             r.items[0], r.item_count == 2 ? " and " : "", r.items[1], r.place);
    return r.what[0] != 0;
}
