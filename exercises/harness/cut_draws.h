// cut_draws.h - the normal numbers that everybody draws in exercise 11, as the judge counts them.
#ifndef SPLATLAB_EXERCISES_HARNESS_CUT_DRAWS_H
#define SPLATLAB_EXERCISES_HARNESS_CUT_DRAWS_H

typedef struct {
    double mean2;  // |mean of z|^2
    double spread; // the mean of |z - mean|^2
} CutDraws;

// Of the first n draws z of draw_normals() (exercises/exercise.h) with |z| <= EWA_CUT; n >= 1. A rotation of all of them
// changes neither number.
CutDraws cut_draws(unsigned long seed, int n);

#endif
