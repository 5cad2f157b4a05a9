// quadrature.h - the light along one ray through a fog, summed as NeRF does it: density to alpha, weights, colour.
//
// A fog of density sigma(t) (1 / length) and colour c(t) between t = 0 and t = 1 shows, over a black background,
//     C = integral T(t) sigma(t) c(t) dt,   T(t) = exp(-integral_0^t sigma).
// Cut into n segments of length delta with sigma and c taken at their middles, this is the sum of compositing.h with
//     alpha_i = 1 - exp(-sigma_i delta)      (Max 1995; Mildenhall et al. 2020, eq. 3)
// exactly so where sigma and c are constant in each segment; else the error falls with 1 / n^2.
#ifndef SPLATLAB_SPLAT2D_QUADRATURE_H
#define SPLATLAB_SPLAT2D_QUADRATURE_H

// alpha of a segment of length delta >= 0, and back (alpha < 1, delta > 0). Exact for small alphas too: 1 - exp(-x) would
// lose all digits that x has below the last one of 1.
double quadrature_alpha(double sigma, double delta);
double quadrature_sigma(double alpha, double delta);

// The same in single precision, and how it must not be written: for tables of what that costs.
float quadrature_alpha_float(float sigma, float delta);
float quadrature_alpha_float_naive(float sigma, float delta); // 1 - exp(-sigma delta)

// How a segment's alpha is made of sigma delta. LINEAR is the first term of the series: it exceeds 1 in thick fog, and its
// error falls with 1 / n only.
typedef enum { QUADRATURE_EXPONENTIAL, QUADRATURE_LINEAR, QUADRATURE_RULE_COUNT } QuadratureRule;

// A fog with a bump of density, the colour of which changes along the ray: what the lesson measures on. `density` is its
// optical depth, the integral of sigma from 0 to 1; about 2 for a thick one.
typedef struct {
    double density;
} Fog;

double fog_sigma(const Fog *fog, double t);
void fog_rgb(double t, double rgb[3]);
double fog_transmittance(const Fog *fog, double t); // T(t) in closed form

// Colour of the ray with n >= 1 segments. weights: (n) of T_i alpha_i, or NULL. Returns T behind the last one.
double quadrature_render(const Fog *fog, QuadratureRule rule, int n, double rgb[3], double *weights);

// A splat has alpha' = o g. A true fog of Gaussian density, of opacity o through its centre, has the optical depth
// -ln(1 - o) g where its density has fallen to g, so alpha' = 1 - (1 - o)^g. The second minus the first, 0 <= o < 1:
double splat_fog_gap(double opacity, double g);
double splat_fog_gap_largest(double opacity, double *g); // over all g in [0, 1]; *g: where
#endif
