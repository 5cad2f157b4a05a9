#include "splat3d/background.h"

#include "lab/base/fail.h"

#include <stdio.h>
#include <string.h>

bool background_parse(const char *text, float rgb[3], bool *is_random) {
    float r, g, b;
    char rest;
    *is_random = strcmp(text, "random") == 0;
    if (strcmp(text, "white") == 0)
        r = g = b = 1;
    else if (*is_random || strcmp(text, "black") == 0)
        r = g = b = 0;
    else if (sscanf(text, "%f,%f,%f%c", &r, &g, &b, &rest) != 3 ||
             !(r >= 0 && r <= 1 && g >= 0 && g <= 1 && b >= 0 && b <= 1))
        return fail_usage("background '%s': want black, white, random, or r,g,b with numbers in 0..1 (as 0.5,0.5,0.5)",
                          text);
    rgb[0] = r, rgb[1] = g, rgb[2] = b;
    return true;
}
