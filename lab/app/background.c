// background.c - parsing of background colours.
#include "lab/app/background.h"

#include "lab/base/fail.h"

#include <stdlib.h>
#include <string.h>

static void set(float rgb[3], float value) { rgb[0] = rgb[1] = rgb[2] = value; }

// "r,g,b", nothing before, between or behind.
static bool parse_numbers(const char *text, float rgb[3]) {
    float parsed[3];
    for (int c = 0; c < 3; c++) {
        char *end;
        parsed[c] = strtof(text, &end);
        if (end == text || *end != (c < 2 ? ',' : 0)) return false;
        if (!(parsed[c] >= 0 && parsed[c] <= 1)) return false;
        text = end + 1;
    }
    memcpy(rgb, parsed, sizeof parsed);
    return true;
}

bool background_parse(const char *text, float rgb[3], bool *is_random) {
    if (is_random) *is_random = false;
    if (strcmp(text, "random") == 0 && is_random) {
        *is_random = true;
        set(rgb, 0);
        return true;
    }
    if (strcmp(text, "white") == 0 || strcmp(text, "black") == 0) {
        set(rgb, text[0] == 'w' ? 1 : 0);
        return true;
    }
    if (parse_numbers(text, rgb)) return true;
    return fail_usage("--background %s: want white, black%s or three numbers from 0 to 1 such as 0.5,0.5,0.5", text,
                      is_random ? ", random" : "");
}
