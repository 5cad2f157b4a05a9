// background.h - what stands behind the splats, as a person writes it: "white", "black", "random" or "r,g,b".
#ifndef SPLATLAB_SPLAT3D_BACKGROUND_H
#define SPLATLAB_SPLAT3D_BACKGROUND_H

#include <stdbool.h>

// rgb: 0..1 each; black where it is random. Fails (fail_usage) on anything else.
bool background_parse(const char *text, float rgb[3], bool *is_random);

#endif
