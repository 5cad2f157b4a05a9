#include "splat3d/kd_tree.h"

#include "lab/base/mem.h"
#include "lab/base/parallel.h"

#include <assert.h>

// Total order along an axis: coordinate, then index, so that the tree does not depend on how the sort works.
static int before(const double *xyz, int axis, int a, int b) {
    double xa = xyz[3 * (size_t)a + axis], xb = xyz[3 * (size_t)b + axis];
    return xa < xb || (xa == xb && a < b);
}

static int widest_axis(const KdTree *tree, int begin, int end) {
    double low[3], high[3];
    for (int a = 0; a < 3; a++) low[a] = high[a] = tree->xyz[3 * (size_t)tree->order[begin] + a];
    for (int i = begin + 1; i < end; i++)
        for (int a = 0; a < 3; a++) {
            double x = tree->xyz[3 * (size_t)tree->order[i] + a];
            if (x < low[a]) low[a] = x;
            if (x > high[a]) high[a] = x;
        }
    int axis = 0;
    for (int a = 1; a < 3; a++)
        if (high[a] - low[a] > high[axis] - low[axis]) axis = a;
    return axis;
}

// Quickselect: puts the element of rank `middle` in its place, smaller ones before it, larger ones behind.
static void select_middle(KdTree *tree, int axis, int begin, int end, int middle) {
    int *order = tree->order;
    while (end - begin > 1) {
        int pivot = order[begin + (end - begin) / 2], i = begin, j = end - 1;
        while (i <= j) {
            while (before(tree->xyz, axis, order[i], pivot)) i++;
            while (before(tree->xyz, axis, pivot, order[j])) j--;
            if (i <= j) {
                int swap = order[i];
                order[i++] = order[j];
                order[j--] = swap;
            }
        }
        if (middle <= j)
            end = j + 1;
        else if (middle >= i)
            begin = i;
        else
            return;
    }
}

static void build(KdTree *tree, int begin, int end) {
    while (end - begin > 1) {
        int middle = begin + (end - begin) / 2, axis = widest_axis(tree, begin, end);
        select_middle(tree, axis, begin, end, middle);
        tree->axis[middle] = (signed char)axis;
        build(tree, begin, middle);
        begin = middle + 1;
    }
}

KdTree kd_tree_create(const double *xyz, int count) {
    KdTree tree = {.count = count, .xyz = xyz};
    tree.order = mem_alloc((size_t)count, sizeof *tree.order);
    tree.axis = mem_alloc((size_t)count, sizeof *tree.axis);
    for (int i = 0; i < count; i++) tree.order[i] = i;
    build(&tree, 0, count);
    return tree;
}

void kd_tree_destroy(KdTree *tree) {
    mem_free(tree->order);
    mem_free(tree->axis);
    *tree = (KdTree){0};
}

typedef struct {
    const KdTree *tree;
    const double *query;
    int self, wanted, found;
    double *distance2; // the found ones, ascending
} Search;

static void consider(Search *s, int point) {
    if (point == s->self) return;
    double d2 = 0;
    for (int a = 0; a < 3; a++) {
        double d = s->tree->xyz[3 * (size_t)point + a] - s->query[a];
        d2 += d * d;
    }
    if (s->found == s->wanted && d2 >= s->distance2[s->found - 1]) return;
    int at = s->found < s->wanted ? s->found++ : s->found - 1;
    for (; at > 0 && s->distance2[at - 1] > d2; at--) s->distance2[at] = s->distance2[at - 1];
    s->distance2[at] = d2;
}

static void search(Search *s, int begin, int end) {
    if (begin >= end) return;
    int middle = begin + (end - begin) / 2, point = s->tree->order[middle];
    consider(s, point);
    if (end - begin == 1) return;
    int axis = s->tree->axis[middle];
    double offset = s->query[axis] - s->tree->xyz[3 * (size_t)point + axis];
    if (offset < 0)
        search(s, begin, middle);
    else
        search(s, middle + 1, end);
    // Equal is far enough, too: only a nearer point would count, and a heap of points at one place is not searched through.
    if (s->found == s->wanted && offset * offset >= s->distance2[s->found - 1]) return;
    if (offset < 0)
        search(s, middle + 1, end);
    else
        search(s, begin, middle);
}

int kd_tree_nearest(const KdTree *tree, const double query[3], int self, int k, double *distance2) {
    assert(k >= 1 && k <= KD_NEIGHBOURS_MAX);
    Search s = {.tree = tree, .query = query, .self = self, .wanted = k, .distance2 = distance2};
    search(&s, 0, tree->count);
    return s.found;
}

enum { POINTS_PER_TASK = 1024 };

typedef struct {
    const KdTree *tree;
    int k;
    double *mean_distance2;
} MeanTask;

static void mean_distance2_of_range(void *context, int task_index) {
    MeanTask *task = context;
    int begin = task_index * POINTS_PER_TASK, end = begin + POINTS_PER_TASK;
    if (end > task->tree->count) end = task->tree->count;
    for (int i = begin; i < end; i++) {
        double d2[KD_NEIGHBOURS_MAX], sum = 0;
        int found = kd_tree_nearest(task->tree, task->tree->xyz + 3 * (size_t)i, i, task->k, d2);
        for (int n = 0; n < found; n++) sum += d2[n];
        task->mean_distance2[i] = found ? sum / found : 0;
    }
}

void kd_tree_mean_distance2(const KdTree *tree, int k, double *mean_distance2) {
    MeanTask task = {tree, k, mean_distance2};
    parallel_for((tree->count + POINTS_PER_TASK - 1) / POINTS_PER_TASK, mean_distance2_of_range, &task);
}
