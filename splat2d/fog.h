// fog.h - density and alpha: what a piece of fog hides, and what a splat would hide if it were one.
#ifndef SPLATLAB_SPLAT2D_FOG_H
#define SPLATLAB_SPLAT2D_FOG_H

// alpha = 1 - exp(-sigma delta) of a piece of constant density sigma (1 / length) and length delta >= 0 (Max 1995; Mildenhall
// et al. 2020, eq. 3), and back (alpha < 1, delta > 0). Exact for small alphas too: 1 - exp(-x) would lose all digits that x
// has below the last one of 1.
double fog_alpha(double sigma, double delta);
double fog_sigma(double alpha, double delta);

// The same in single precision, and how it must not be written: for tables of what that costs.
float fog_alpha_float(float sigma, float delta);
float fog_alpha_float_naive(float sigma, float delta); // 1 - exp(-sigma delta)

// A splat has alpha' = o g. A true fog of Gaussian density, of opacity o through its centre, has the optical depth
// -ln(1 - o) g where its density has fallen to g, so alpha' = 1 - (1 - o)^g. The second minus the first, 0 <= o < 1:
double splat_fog_gap(double opacity, double g);
double splat_fog_gap_largest(double opacity, double *g); // over all g in [0, 1]; *g: where

#endif
