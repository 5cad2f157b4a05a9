// background.h - the colour behind the splats, as a person writes it: white, black, random or r,g,b.
#ifndef SPLATLAB_LAB_APP_BACKGROUND_H
#define SPLATLAB_LAB_APP_BACKGROUND_H

#include <stdbool.h>

// "white", "black", "random" or three numbers "r,g,b" in [0, 1]. After "random" *is_random is true and rgb black; with
// is_random NULL "random" is refused (a picture that is shown has one background). Fails (fail_usage) with the text.
bool background_parse(const char *text, float rgb[3], bool *is_random);

#endif
