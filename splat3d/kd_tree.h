// kd_tree.h - nearest neighbours among points: how large a splat should begin is how far its neighbours are.
//
// A balanced tree in one array (Bentley 1975): the median of each range by the widest axis stands in its middle.
#ifndef SPLATLAB_SPLAT3D_KD_TREE_H
#define SPLATLAB_SPLAT3D_KD_TREE_H

enum { KD_NEIGHBOURS_MAX = 16 };

typedef struct {
    int count;
    const double *xyz; // (count, 3), borrowed
    int *order;        // (count) point indices in tree order
    signed char *axis; // (count) split axis of the node that stands there
} KdTree;

KdTree kd_tree_create(const double *xyz, int count); // xyz must live as long as the tree
void kd_tree_destroy(KdTree *tree);

// Squared distances to the k nearest points other than point `self` itself (-1: none is left out), nearest first; k <= KD_NEIGHBOURS_MAX.
// Points at the same place count. Returns how many there are (fewer than k in small clouds).
int kd_tree_nearest(const KdTree *tree, const double query[3], int self, int k, double *distance2);

// For every point the mean squared distance to its (up to) k nearest others; 0 where there is no other. On all cores.
void kd_tree_mean_distance2(const KdTree *tree, int k, double *mean_distance2);

#endif
