// reference.h - the whole forward and backward pass in readable double-precision C: the lesson and the oracle.
//
// Every stage is a function of one splat or one pixel, in the order in which a picture comes about:
//   reference_covariance.c  Sigma from log-scale and quaternion
//   reference_project.c     one splat onto the screen: mean, EWA covariance, conic, reach
//   reference_sh.c          its colour from spherical harmonics and the viewing direction
//   reference_blend.c       depth order, tiles, compositing
//   reference.c             the whole picture, and the filler of the Rasterizer table
// x_backward() is the twin of x_forward(): it takes the same inputs and the gradient d_y of a loss by each output y,
// and *adds* the gradient by each input to what d_x holds. The gradient of a symmetric matrix is by its stored
// numbers. The kernels are written independently of this: the records are shared, the formulas are not.
#ifndef SPLATLAB_SPLAT3D_REFERENCE_H
#define SPLATLAB_SPLAT3D_REFERENCE_H

#include "lab/base/vec.h"
#include "splat2d/covariance.h"
#include "splat3d/rasterizer.h"

#include <stddef.h>

// ---- the model in double: finite differences need it (reference_model.c) ----

typedef struct {
    int count, sh_degree;
    double *field[FIELD_COUNT]; // (N, width); NULL above sh_degree
} GaussiansD;

GaussiansD gaussiansd_create(int count, int sh_degree); // zeroed
GaussiansD gaussiansd_from(const Gaussians *g);
Gaussians gaussiansd_to_float(const GaussiansD *g);
void gaussiansd_destroy(GaussiansD *g); // accepts a zeroed or destroyed one

// The numbers of splat i in one field.
static inline double *gaussiansd_at(const GaussiansD *g, GaussianFieldId id, int i) {
    return g->field[id] + (size_t)i * GAUSSIAN_FIELDS[id].width;
}

// ---- the shape of one splat (reference_covariance.c) ----

typedef struct {
    double xx, xy, xz, yy, yz, zz;
} Sym3; // a symmetric 3x3 matrix

// R(q / |q|), q = w x y z of any length > 0.
Mat3 reference_rotation_forward(const double quat[4]);
void reference_rotation_backward(const double quat[4], const Mat3 *d_rotation, double d_quat[4]);

// Sigma = R S S^T R^T with S = diag(exp(log_scale)), world units^2.
Sym3 reference_covariance_forward(const double log_scale[3], const double quat[4]);
void reference_covariance_backward(const double log_scale[3], const double quat[4], Sym3 d_covariance,
                                   double d_log_scale[3], double d_quat[4]);

// ---- one splat on the screen (reference_project.c) ----

typedef struct {
    bool visible; // in front of the near plane, with extent, and on the picture; all else is 0 when not
    double mean_px[2];
    double depth;       // camera z
    Sym2 covariance;    // Sigma' with the low-pass, px^2
    Sym2 conic;         // its inverse
    double reach_px[2]; // half size of the box outside of which alpha < ALPHA_MIN
    double opacity;     // after the sigmoid
    double rgb[3];      // RENDER_COLOUR: SH colour + 0.5, clamped at 0 from below; RENDER_DEPTH: depth, 1, 0
} Splat2;

typedef struct {
    double mean_px[2];
    Sym2 conic;
    double opacity;
    double rgb[3];
} Splat2Gradient;

// The EWA projection of a shape alone: J W covariance W^T J^T without the low-pass, px^2. mean_cam: in camera axes, z > 0;
// covariance: in the world.
Sym2 reference_ewa_forward(const Camera *camera, Vec3 mean_cam, Sym3 covariance);
void reference_ewa_backward(const Camera *camera, Vec3 mean_cam, Sym3 covariance, Sym2 d_projected, Vec3 *d_mean_cam,
                            Sym3 *d_covariance);

void reference_project_forward(const GaussiansD *g, int i, const Camera *camera, const RenderSettings *settings,
                               Splat2 *splat);
// Adds to d_model's numbers of splat i; nothing when the splat is not visible.
void reference_project_backward(const GaussiansD *g, int i, const Camera *camera, const RenderSettings *settings,
                                const Splat2Gradient *d_splat, GaussiansD *d_model);

// ---- its colour (reference_sh.c) ----

// The real SH basis of degree 0..3 in direction d (unit length): (degree + 1)^2 numbers. jacobian[k]: derivative of
// basis[k] by d as three free numbers (the step along d itself is for the caller to take out).
void reference_sh_basis(int degree, const double d[3], double basis[SH_COEFFICIENTS_MAX]);
void reference_sh_basis_jacobian(int degree, const double d[3], double jacobian[SH_COEFFICIENTS_MAX][3]);

// Colour of splat i as the camera sees it. Backward adds to the SH fields, and to the mean, which turns the direction.
void reference_colour_forward(const GaussiansD *g, int i, const Camera *camera, const RenderSettings *settings,
                              double rgb[3]);
void reference_colour_backward(const GaussiansD *g, int i, const Camera *camera, const RenderSettings *settings,
                               const double d_rgb[3], GaussiansD *d_model);

// ---- the picture (reference_blend.c, reference.c) ----

typedef struct {
    int width, height;
    double *rgb;           // (H, W, 3), owned
    double *transmittance; // (H, W), owned: T_end
} PictureD;

PictureD pictured_create(int width, int height);
void pictured_destroy(PictureD *p);

// Blends the visible ones of `count` splats into the picture (its size is given, all its values are written). Order: by
// depth, then by index. The kernels sort by the depth as a float; of two splats whose depths round to the same float,
// they may take the other one first.
void reference_blend_forward(const Splat2 *splats, int count, const RenderSettings *settings, PictureD *picture);
// d_rgb: (H, W, 3); d_splats: (count).
void reference_blend_backward(const Splat2 *splats, int count, const RenderSettings *settings, int width, int height,
                              const double *d_rgb, Splat2Gradient *d_splats);

// The whole way. The picture and d_model are created, owned by the caller; d_rgb: (H, W, 3).
void reference_render_forward(const GaussiansD *g, const Camera *camera, const RenderSettings *settings,
                              PictureD *picture);
void reference_render_backward(const GaussiansD *g, const Camera *camera, const RenderSettings *settings,
                               const double *d_rgb, GaussiansD *d_model);

// A Rasterizer that renders by this reference.
Rasterizer *reference_rasterizer_create(void);

#endif
