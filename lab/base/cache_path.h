// cache_path.h - where the program keeps what it can make again at any time.
#ifndef SPLATLAB_LAB_BASE_CACHE_PATH_H
#define SPLATLAB_LAB_BASE_CACHE_PATH_H

// "$XDG_CACHE_HOME/splatlab/WHAT" or "~/.cache/splatlab/WHAT" (XDG Base Directory Specification: a relative path does not count); NULL
// where neither is known. Owned by the caller; nothing is made.
char *cache_path(const char *what);

#endif
