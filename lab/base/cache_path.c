#include "lab/base/cache_path.h"

#include "lab/base/mem.h"

#include <stdlib.h>

char *cache_path(const char *what) {
    const char *cache = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    if (cache && cache[0] == '/') return mem_format("%s/splatlab/%s", cache, what);
    if (home && home[0] == '/') return mem_format("%s/.cache/splatlab/%s", home, what);
    return NULL;
}
