// reference_covariance.c - the shape of one splat, and its gradients.
//
// Kerbl et al. 2023, eq. 6, and appendix A for the gradients:
//
//     (1) Sigma = M M^T     (2) M_ik = R_ik s_k     (3) s_k = exp(log_scale_k)     (4) R = R(q / |q|)
//
// With rows m_x, m_y, m_z of M, an entry of Sigma is a product of two rows, Sigma_xy = m_x . m_y, and so it goes all
// the way back: the stored xy moves m_x by m_y and m_y by m_x, the stored xx moves m_x by 2 m_x.
#include "splat3d/reference.h"

static double quaternion_length(const double q[4]) {
    return sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
}

// A quaternion of length 0 names no rotation: it gives NaN, and the splat counts as not visible.
Mat3 reference_rotation_forward(const double quat[4]) {
    double length = quaternion_length(quat);
    double w = quat[0] / length, x = quat[1] / length, y = quat[2] / length, z = quat[3] / length;
    return (Mat3){{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), //
                   2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), //
                   2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
}

// Below, `unit` is q / |q|. First the gradient by unit, term by term from the matrix above. Then through the
// normalisation: d unit / d q = (I - unit unit^T) / |q|; longer or shorter along itself does not turn anything.
void reference_rotation_backward(const double quat[4], const Mat3 *d_rotation, double d_quat[4]) {
    double length = quaternion_length(quat);
    double w = quat[0] / length, x = quat[1] / length, y = quat[2] / length, z = quat[3] / length;
    const double *d = d_rotation->m;
    double d_unit[4] = {
        2 * (x * (d[7] - d[5]) + y * (d[2] - d[6]) + z * (d[3] - d[1])),
        2 * (w * (d[7] - d[5]) + y * (d[1] + d[3]) + z * (d[2] + d[6]) - 2 * x * (d[4] + d[8])),
        2 * (w * (d[2] - d[6]) + x * (d[1] + d[3]) + z * (d[5] + d[7]) - 2 * y * (d[0] + d[8])),
        2 * (w * (d[3] - d[1]) + x * (d[2] + d[6]) + y * (d[5] + d[7]) - 2 * z * (d[0] + d[4])),
    };
    double along = w * d_unit[0] + x * d_unit[1] + y * d_unit[2] + z * d_unit[3];
    for (int k = 0; k < 4; k++) d_quat[k] += (d_unit[k] - along * quat[k] / length) / length;
}

// Rows of M = R S: Sigma is what a unit ball becomes that is stretched by S and turned by R.
static void stretched_rotation(const Mat3 *rotation, const double log_scale[3], Vec3 m[3]) {
    Vec3 scale = vec3(exp(log_scale[0]), exp(log_scale[1]), exp(log_scale[2]));
    for (int i = 0; i < 3; i++) {
        const double *row = rotation->m + 3 * i;
        m[i] = vec3_mul(vec3(row[0], row[1], row[2]), scale);
    }
}

Sym3 reference_covariance_forward(const double log_scale[3], const double quat[4]) {
    Mat3 rotation = reference_rotation_forward(quat);
    Vec3 m[3];
    stretched_rotation(&rotation, log_scale, m);
    return (Sym3){
        .xx = vec3_dot(m[0], m[0]),
        .xy = vec3_dot(m[0], m[1]),
        .xz = vec3_dot(m[0], m[2]),
        .yy = vec3_dot(m[1], m[1]),
        .yz = vec3_dot(m[1], m[2]),
        .zz = vec3_dot(m[2], m[2]),
    };
}

// a u + b v + c w
static Vec3 combine(double a, Vec3 u, double b, Vec3 v, double c, Vec3 w) {
    return vec3_add(vec3_add(vec3_scale(u, a), vec3_scale(v, b)), vec3_scale(w, c));
}

void reference_covariance_backward(const double log_scale[3], const double quat[4], Sym3 d_covariance,
                                   double d_log_scale[3], double d_quat[4]) {
    Mat3 rotation = reference_rotation_forward(quat);
    Vec3 m[3];
    stretched_rotation(&rotation, log_scale, m);

    Sym3 d = d_covariance; // back through (1)
    Vec3 d_m[3] = {
        combine(2 * d.xx, m[0], d.xy, m[1], d.xz, m[2]),
        combine(d.xy, m[0], 2 * d.yy, m[1], d.yz, m[2]),
        combine(d.xz, m[0], d.yz, m[1], 2 * d.zz, m[2]),
    };

    // (2), (3): d M_ik / d log_scale_k = M_ik, d M_ik / d R_ik = s_k
    Vec3 scale = vec3(exp(log_scale[0]), exp(log_scale[1]), exp(log_scale[2]));
    Mat3 d_rotation;
    for (int i = 0; i < 3; i++) {
        Vec3 d_scale = vec3_mul(d_m[i], m[i]), d_row = vec3_mul(d_m[i], scale);
        d_log_scale[0] += d_scale.x, d_log_scale[1] += d_scale.y, d_log_scale[2] += d_scale.z;
        d_rotation.m[3 * i] = d_row.x, d_rotation.m[3 * i + 1] = d_row.y, d_rotation.m[3 * i + 2] = d_row.z;
    }
    reference_rotation_backward(quat, &d_rotation, d_quat); // (4)
}
