// Built top down with the surface area heuristic over 16 bins (Wald, "On fast construction of SAH-based bounding volume
// hierarchies", RT 2007), four children a node (Dammertz, Hanika and Keller, "Shallow bounding volume hierarchies", EGSR 2008); walked
// nearest child first.
#include "splat3d/ray_bvh.h"

#include "lab/base/mem.h"

#include <float.h>

enum {
    LANES = 4, // children of a node and triangles of a leaf: what one vector instruction works on
    BINS = 16,
    DEEP = 40, // from here on the build halves, so that no walk overruns its stack
    STACK = 200,
};

// The loops over LANES below are written so that the compiler turns each into a few vector instructions.
struct RayNode {
    float bound[2][3][LANES]; // low and high corner of the children's boxes; an empty place has low > high
    int child[LANES];         // a node; or ~leaf
};

// Up to LANES triangles. Möller and Trumbore's test wants one corner and two edges; unused places have no extent.
struct RayLeaf {
    float corner[3][LANES], edge1[3][LANES], edge2[3][LANES];
    int index[LANES]; // in the mesh
};

typedef struct {
    float low[3], high[3];
} Box;

static const Box EMPTY = {{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}};

static void box_add(Box *box, const Box *other) {
    for (int k = 0; k < 3; k++) {
        if (other->low[k] < box->low[k]) box->low[k] = other->low[k];
        if (other->high[k] > box->high[k]) box->high[k] = other->high[k];
    }
}

static double box_area(const Box *box) {
    double x = box->high[0] - box->low[0], y = box->high[1] - box->low[1], z = box->high[2] - box->low[2];
    return x < 0 ? 0 : x * y + y * z + z * x;
}

// What the build works on: one box and one centre for each triangle, and the order being made.
typedef struct {
    const RayMesh *mesh;
    Box *box;      // (T)
    float *centre; // (T,3)
    int *order;    // (T)
    RayBvh *bvh;
} Build;

// Triangles order[first .. first + count) and their box.
typedef struct {
    int first, count;
    Box box;
} Range;

static int bin_of(const Build *b, int triangle, int axis, const Box *centres) {
    float extent = centres->high[axis] - centres->low[axis];
    int bin = (int)((float)BINS * (b->centre[3 * triangle + axis] - centres->low[axis]) / extent);
    return bin < BINS ? bin : BINS - 1;
}

// The cheapest plane between two bins along the axis: triangles in bins <= *split go left. Returns area-weighted cost.
static double best_split(const Build *b, int first, int count, int axis, const Box *centres, int *split) {
    Box box[BINS];
    int number[BINS] = {0};
    for (int k = 0; k < BINS; k++) box[k] = EMPTY;
    for (int i = first; i < first + count; i++) {
        int bin = bin_of(b, b->order[i], axis, centres);
        number[bin]++;
        box_add(&box[bin], &b->box[b->order[i]]);
    }
    double right_cost[BINS];
    Box sum = EMPTY;
    for (int k = BINS - 1, n = 0; k > 0; k--) {
        box_add(&sum, &box[k]);
        n += number[k];
        right_cost[k] = n * box_area(&sum);
    }
    double best = DBL_MAX;
    sum = EMPTY;
    for (int k = 0, n = 0; k < BINS - 1; k++) {
        box_add(&sum, &box[k]);
        n += number[k];
        double cost = n * box_area(&sum) + right_cost[k + 1];
        if (n > 0 && n < count && cost < best) best = cost, *split = k;
    }
    return best;
}

// Puts the triangles of the left side first; returns how many they are.
static int partition(Build *b, int first, int count, int depth) {
    Box centres = EMPTY;
    for (int i = first; i < first + count; i++) {
        Box point;
        for (int k = 0; k < 3; k++) point.low[k] = point.high[k] = b->centre[3 * b->order[i] + k];
        box_add(&centres, &point);
    }
    int axis = -1, split = 0;
    double best = DBL_MAX;
    for (int k = 0, s = 0; k < 3; k++) {
        if (!(centres.high[k] > centres.low[k])) continue;
        double cost = best_split(b, first, count, k, &centres, &s);
        if (cost < best) best = cost, axis = k, split = s;
    }
    if (axis < 0 || depth >= DEEP) return count / 2; // all centres in one place, or peeled off too few at a time
    int left = first;
    for (int i = first; i < first + count; i++) {
        int t = b->order[i];
        if (bin_of(b, t, axis, &centres) > split) continue;
        b->order[i] = b->order[left];
        b->order[left++] = t;
    }
    return left - first;
}

static Range range_of(const Build *b, int first, int count) {
    Range r = {first, count, EMPTY};
    for (int i = first; i < first + count; i++) box_add(&r.box, &b->box[b->order[i]]);
    return r;
}

static int build_leaf(Build *b, const Range *range) {
    RayLeaf *leaf = &b->bvh->leaves[b->bvh->leaf_count];
    for (int i = 0; i < range->count; i++) {
        leaf->index[i] = b->order[range->first + i];
        const int *corner = b->mesh->corner + 3 * leaf->index[i];
        const float *p = b->mesh->position + 3 * corner[0], *q = b->mesh->position + 3 * corner[1],
                    *r = b->mesh->position + 3 * corner[2];
        for (int k = 0; k < 3; k++)
            leaf->corner[k][i] = p[k], leaf->edge1[k][i] = q[k] - p[k], leaf->edge2[k][i] = r[k] - p[k];
    }
    return ~b->bvh->leaf_count++;
}

// Splits the range in two, then the larger part again, until there is one for each lane or none is left to split.
static int build_node(Build *b, Range range, int depth) {
    Range part[LANES] = {range};
    int parts = 1;
    while (parts < LANES) {
        int widest = -1;
        for (int i = 0; i < parts; i++)
            if (part[i].count > LANES && (widest < 0 || box_area(&part[i].box) > box_area(&part[widest].box)))
                widest = i;
        if (widest < 0) break;
        Range whole = part[widest];
        int left = partition(b, whole.first, whole.count, depth);
        part[widest] = range_of(b, whole.first, left);
        part[parts++] = range_of(b, whole.first + left, whole.count - left);
    }
    int node = b->bvh->node_count++;
    for (int i = 0; i < LANES; i++) {
        const Box *box = i < parts ? &part[i].box : &EMPTY;
        RayNode *n = &b->bvh->nodes[node];
        for (int k = 0; k < 3; k++) n->bound[0][k][i] = box->low[k], n->bound[1][k][i] = box->high[k];
        if (i < parts)
            n->child[i] = part[i].count > LANES ? build_node(b, part[i], depth + 1) : build_leaf(b, &part[i]);
    }
    return node;
}

RayBvh ray_bvh_build(const RayMesh *mesh) {
    size_t count = (size_t)mesh->triangle_count;
    RayBvh bvh = {.nodes = mem_alloc(count + 1, sizeof(RayNode)), .leaves = mem_alloc(count, sizeof(RayLeaf))};
    Build build = {mesh, mem_alloc(count, sizeof(Box)), mem_alloc(3 * count, sizeof(float)),
                   mem_alloc(count, sizeof(int)), &bvh};
    for (int i = 0; i < mesh->triangle_count; i++) {
        Box *box = &build.box[i];
        *box = EMPTY;
        for (int c = 0; c < 3; c++) {
            Box point;
            const float *p = mesh->position + 3 * mesh->corner[3 * i + c];
            for (int k = 0; k < 3; k++) point.low[k] = point.high[k] = p[k];
            box_add(box, &point);
        }
        for (int k = 0; k < 3; k++) build.centre[3 * i + k] = 0.5f * (box->low[k] + box->high[k]);
        build.order[i] = i;
    }
    if (count > 0) build_node(&build, range_of(&build, 0, mesh->triangle_count), 0);
    mem_free(build.box);
    mem_free(build.centre);
    mem_free(build.order);
    bvh.nodes = mem_resize(bvh.nodes, count + 1, (size_t)bvh.node_count, sizeof(RayNode));
    bvh.leaves = mem_resize(bvh.leaves, count, (size_t)bvh.leaf_count, sizeof(RayLeaf));
    return bvh;
}

void ray_bvh_destroy(RayBvh *bvh) {
    mem_free(bvh->nodes);
    mem_free(bvh->leaves);
    *bvh = (RayBvh){0};
}

// A ray as the walk wants it.
typedef struct {
    float origin[3], direction[3], inverse[3];
    int entry[3]; // which of a box's two sides the ray meets first: 0 low, 1 high
    float far;
} Walk;

static Walk walk_begin(const Ray *ray) {
    double o[3] = {ray->origin.x, ray->origin.y, ray->origin.z};
    double d[3] = {ray->direction.x, ray->direction.y, ray->direction.z};
    Walk w;
    for (int k = 0; k < 3; k++) {
        w.origin[k] = (float)o[k];
        w.direction[k] = (float)d[k];
        w.inverse[k] = (float)(1 / (fabs(d[k]) > 1e-12 ? d[k] : 1e-12));
        w.entry[k] = w.inverse[k] < 0;
    }
    w.far = (float)fmin(ray->far, FLT_MAX);
    return w;
}

// Cuts the ray's way through each of the four boxes, near..far, to what lies between the box's two sides across one axis.
static inline void cut_axis(const Walk *w, const RayNode *n, int axis, float near[LANES], float far[LANES]) {
    const float *in = n->bound[w->entry[axis]][axis], *out = n->bound[1 - w->entry[axis]][axis];
    const float origin = w->origin[axis], inverse = w->inverse[axis],
                more = inverse * 1.000001f; // never lose a flat box
    for (int i = 0; i < LANES; i++) {
        float a = (in[i] - origin) * inverse, b = (out[i] - origin) * more;
        near[i] = near[i] > a ? near[i] : a;
        far[i] = far[i] < b ? far[i] : b;
    }
}

// Möller and Trumbore, "Fast, minimum storage ray/triangle intersection" (1997), for the four triangles of a leaf. The small slack closes the
// seams between neighbours.
static inline bool hit_leaf(Walk *w, const RayLeaf *t, RayHit *hit) {
    const float slack = 1e-5f, dx = w->direction[0], dy = w->direction[1], dz = w->direction[2];
    float u[LANES], v[LANES], distance[LANES];
    int inside[LANES];
    for (int i = 0; i < LANES; i++) {
        float px = dy * t->edge2[2][i] - dz * t->edge2[1][i], py = dz * t->edge2[0][i] - dx * t->edge2[2][i],
              pz = dx * t->edge2[1][i] - dy * t->edge2[0][i];
        float determinant = t->edge1[0][i] * px + t->edge1[1][i] * py + t->edge1[2][i] * pz, inverse = 1 / determinant;
        float sx = w->origin[0] - t->corner[0][i], sy = w->origin[1] - t->corner[1][i],
              sz = w->origin[2] - t->corner[2][i];
        float qx = sy * t->edge1[2][i] - sz * t->edge1[1][i], qy = sz * t->edge1[0][i] - sx * t->edge1[2][i],
              qz = sx * t->edge1[1][i] - sy * t->edge1[0][i];
        u[i] = (sx * px + sy * py + sz * pz) * inverse;
        v[i] = (dx * qx + dy * qy + dz * qz) * inverse;
        distance[i] = (t->edge2[0][i] * qx + t->edge2[1][i] * qy + t->edge2[2][i] * qz) * inverse;
    }
    for (int i = 0; i < LANES; i++) // a triangle without extent has NaN here and fails every comparison
        inside[i] = (distance[i] > 0) & (distance[i] < w->far) & (u[i] >= -slack) & (v[i] >= -slack) &
                    (u[i] + v[i] <= 1 + slack);
    if (!(inside[0] | inside[1] | inside[2] | inside[3])) return false;
    for (int i = 0; i < LANES; i++) {
        if (!inside[i] || distance[i] >= w->far) continue;
        w->far = distance[i];
        *hit = (RayHit){t->index[i], distance[i], u[i], v[i]};
    }
    return true;
}

typedef struct {
    int child;
    float near;
} Visit;

// Puts the children that the ray meets on the stack, the nearest on top.
static inline int push_children(const Walk *w, const RayNode *n, Visit *stack, int depth) {
    float near[LANES], far[LANES];
    for (int i = 0; i < LANES; i++) near[i] = 0, far[i] = w->far;
    cut_axis(w, n, 0, near, far);
    cut_axis(w, n, 1, near, far);
    cut_axis(w, n, 2, near, far); // the ray misses a box with near > far
    int base = depth;
    for (int i = 0; i < LANES; i++) {
        if (!(near[i] <= far[i])) continue;
        int place = depth++;
        for (; place > base && stack[place - 1].near < near[i]; place--) stack[place] = stack[place - 1];
        stack[place] = (Visit){n->child[i], near[i]};
    }
    return depth;
}

// Walks the tree; with `any`, stops at the first hit found.
static bool walk(const RayBvh *bvh, Walk *w, bool any, RayHit *hit) {
    Visit stack[STACK];
    int depth = 0;
    bool found = false;
    if (bvh->node_count > 0) stack[depth++] = (Visit){0, 0};
    while (depth > 0) {
        Visit visit = stack[--depth];
        if (visit.near > w->far) continue;
        if (visit.child >= 0) {
            depth = push_children(w, &bvh->nodes[visit.child], stack, depth);
        } else if (hit_leaf(w, &bvh->leaves[~visit.child], hit)) {
            found = true;
            if (any) return true;
        }
    }
    return found;
}

bool ray_bvh_nearest(const RayBvh *bvh, const Ray *ray, RayHit *hit) {
    Walk w = walk_begin(ray);
    return walk(bvh, &w, false, hit);
}

bool ray_bvh_blocked(const RayBvh *bvh, const Ray *ray) {
    Walk w = walk_begin(ray);
    RayHit hit;
    return walk(bvh, &w, true, &hit);
}
