// kernel_layer.cl - what stands before the kernels of an exercise: number type, the mark of what is not written yet, and
// work-items in another order.
//
// REAL is float or double. Each call is made three times: work-items ascending, descending and shuffled, groups likewise.
// The order comes as the launch's offset (1, 2, 3), which a kernel does not get to see. A kernel whose result depends on the
// order reads or writes what belongs to another work-item.
#ifdef cl_khr_fp64
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif
#pragma OPENCL FP_CONTRACT OFF

// Stands in a kernel that is not written yet. Delete the line when you begin.
#define NOT_STARTED

size_t exercise_shuffled(size_t i, size_t n, size_t order) {
    if (order == 2) return n - 1 - i;
    if (order == 3) return (i * (n % 37 ? 37 : 41) + 11) % n; // 37 and 41 divide no usual number of work-items
    return i;
}

size_t exercise_local_id(uint d) { return exercise_shuffled(get_local_id(d), get_local_size(d), get_global_offset(0)); }

size_t exercise_group_id(uint d) { return exercise_shuffled(get_group_id(d), get_num_groups(d), get_global_offset(0)); }

size_t exercise_global_id(uint d) { return exercise_group_id(d) * get_local_size(d) + exercise_local_id(d); }

#define get_local_id         exercise_local_id
#define get_group_id         exercise_group_id
#define get_global_id        exercise_global_id
#define get_global_offset(d) ((size_t)0)
