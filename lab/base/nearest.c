// nearest.c - edit distance with swaps (optimal string alignment) by dynamic programming over three rows.
#include "lab/base/nearest.h"

#include <ctype.h>
#include <stdbool.h>
#include <string.h>
#include <strings.h>

enum { LENGTH_MAX = 128 }; // of names that are compared; longer ones are nothing that a person mistyped

static int least(int a, int b) { return a < b ? a : b; }

static bool same(char a, char b) { return tolower((unsigned char)a) == tolower((unsigned char)b); }

int nearest_distance(const char *a, const char *b) {
    int rows = (int)strnlen(a, LENGTH_MAX), columns = (int)strnlen(b, LENGTH_MAX);
    if (rows > 0 && columns > rows && strncasecmp(a, b, (size_t)rows) == 0) return 1;
    int cost[3][LENGTH_MAX + 1]; // rows i - 2, i - 1 and i, each at index i mod 3: edits from a[0..i) to b[0..j)
    for (int j = 0; j <= columns; j++) cost[0][j] = j;
    for (int i = 1; i <= rows; i++) {
        int *now = cost[i % 3], *one = cost[(i + 2) % 3], *two = cost[(i + 1) % 3];
        now[0] = i;
        for (int j = 1; j <= columns; j++) {
            int replaced = one[j - 1] + !same(a[i - 1], b[j - 1]);
            now[j] = least(replaced, least(one[j], now[j - 1]) + 1);
            if (i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1]))
                now[j] = least(now[j], two[j - 2] + 1);
        }
    }
    return cost[rows % 3][columns];
}

int nearest_find(const char *text, const char *const *names, int count, int *best, int max) {
    int found = 0;
    int limit = ((int)strlen(text) + 2) / 3;
    for (int distance = 0; distance <= limit; distance++)
        for (int i = 0; i < count && found < max; i++)
            if (nearest_distance(text, names[i]) == distance) best[found++] = i;
    return found;
}
