// cross_term_once.c - M5: dx dy counts once: K stores one number for both off-diagonal entries, so d^T K d has it
// twice.
#define mahal2 solution_mahal2
#include "exercises/solutions/conic.c"
#undef mahal2

REAL mahal2(const REAL K[3], REAL dx, REAL dy) { return K[0] * dx * dx + K[1] * dx * dy + K[2] * dy * dy; }
