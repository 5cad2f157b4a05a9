#include "splat3d/ray_noise.h"

#include <stddef.h>

// The finaliser of MurmurHash3 (Appleby, public domain) over a linear mix of the inputs.
uint32_t noise_hash(int x, int y, int z, uint32_t seed) {
    uint32_t h =
        (uint32_t)x * 0x9E3779B1u ^ (uint32_t)y * 0x85EBCA77u ^ (uint32_t)z * 0xC2B2AE3Du ^ (seed + 1) * 0x27D4EB2Fu;
    h ^= h >> 16;
    h *= 0x85EBCA6Bu;
    h ^= h >> 13;
    h *= 0xC2B2AE35u;
    return h ^ h >> 16;
}

double noise_cell(int x, int y, int z, uint32_t seed) { return noise_hash(x, y, z, seed) * (1.0 / 4294967296.0); }

static int wrap(int i, int period) {
    if (period <= 0) return i;
    int r = i % period;
    return r < 0 ? r + period : r;
}

// Dot product of one of the 12 edge directions of a cube with (x, y, z).
static double gradient_dot(uint32_t hash, double x, double y, double z) {
    uint32_t h = hash % 12;
    double a = h < 8 ? x : y, b = h < 4 ? y : z;
    return (h & 1 ? -a : a) + (h & 2 ? -b : b);
}

static double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

static double mix(double a, double b, double t) { return a + (b - a) * t; }

double noise_gradient(Vec3 p, int period, uint32_t seed) {
    double fx = floor(p.x), fy = floor(p.y), fz = floor(p.z);
    double x = p.x - fx, y = p.y - fy, z = p.z - fz;
    int x0 = wrap((int)fx, period), x1 = wrap((int)fx + 1, period);
    int y0 = wrap((int)fy, period), y1 = wrap((int)fy + 1, period);
    int z0 = (int)fz;
    double u = fade(x), v = fade(y), sum[2] = {0, 0};
    for (int k = 0; k < (z > 0 ? 2 : 1); k++) {
        double dz = z - k;
        double a = gradient_dot(noise_hash(x0, y0, z0 + k, seed), x, y, dz);
        double b = gradient_dot(noise_hash(x1, y0, z0 + k, seed), x - 1, y, dz);
        double c = gradient_dot(noise_hash(x0, y1, z0 + k, seed), x, y - 1, dz);
        double d = gradient_dot(noise_hash(x1, y1, z0 + k, seed), x - 1, y - 1, dz);
        sum[k] = mix(mix(a, b, u), mix(c, d, u), v);
    }
    return mix(sum[0], sum[1], fade(z));
}

double noise_fbm(Vec3 p, int period, int octaves, uint32_t seed) {
    double sum = 0, strength = 0.6;
    for (int i = 0; i < octaves; i++) {
        sum += strength * noise_gradient(p, period, seed + (uint32_t)i);
        p = vec3_scale(p, 2);
        period *= 2;
        strength *= 0.5;
    }
    return sum;
}

double noise_cells(double x, double y, int period, uint32_t seed, double *gap, uint32_t *id) {
    int cx = (int)floor(x), cy = (int)floor(y);
    double nearest = 1e9, second = 1e9;
    for (int j = cy - 1; j <= cy + 1; j++)
        for (int i = cx - 1; i <= cx + 1; i++) {
            uint32_t h = noise_hash(wrap(i, period), wrap(j, period), 0, seed);
            double px = i + 0.15 + 0.7 * (h & 0xFFFF) / 65536.0, py = j + 0.15 + 0.7 * (h >> 16) / 65536.0;
            double d = sqrt((px - x) * (px - x) + (py - y) * (py - y));
            if (d < nearest) {
                second = nearest;
                nearest = d;
                if (id) *id = h;
            } else if (d < second) {
                second = d;
            }
        }
    if (gap) *gap = second - nearest;
    return nearest;
}

double noise_step(double low, double high, double x) {
    double t = (x - low) / (high - low);
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return t * t * (3 - 2 * t);
}
