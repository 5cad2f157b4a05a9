// nearest.h - the name that a person probably meant, for "unknown option --iteration; did you mean --iterations?".
#ifndef SPLATLAB_LAB_BASE_NEAREST_H
#define SPLATLAB_LAB_BASE_NEAREST_H

// How many single-character edits (insert, delete, replace, swap of neighbours) lead from a to b, ignoring case; 1 when b goes
// on where a non-empty a ends ("iter", "iterations").
int nearest_distance(const char *a, const char *b);

// The plausible ones among `count` names, nearest first, the earlier one first where they are as near: their indices go to
// best[0..max-1], how many to the return value. Plausible: at most a third of the characters (rounded up) are edited.
int nearest_find(const char *text, const char *const *names, int count, int *best, int max);

#endif
