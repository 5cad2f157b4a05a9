#include "lab/gpu/opencl.h"

#include "lab/base/fail.h"

#define ERROR_NAME(code)                                                                                               \
    case code:                                                                                                         \
        return #code

const char *opencl_error_name(cl_int code) {
    switch (code) {
        ERROR_NAME(CL_SUCCESS);
        ERROR_NAME(CL_DEVICE_NOT_FOUND);
        ERROR_NAME(CL_DEVICE_NOT_AVAILABLE);
        ERROR_NAME(CL_COMPILER_NOT_AVAILABLE);
        ERROR_NAME(CL_MEM_OBJECT_ALLOCATION_FAILURE);
        ERROR_NAME(CL_OUT_OF_RESOURCES);
        ERROR_NAME(CL_OUT_OF_HOST_MEMORY);
        ERROR_NAME(CL_PROFILING_INFO_NOT_AVAILABLE);
        ERROR_NAME(CL_MEM_COPY_OVERLAP);
        ERROR_NAME(CL_BUILD_PROGRAM_FAILURE);
        ERROR_NAME(CL_MAP_FAILURE);
        ERROR_NAME(CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST);
        ERROR_NAME(CL_LINK_PROGRAM_FAILURE);
        ERROR_NAME(CL_INVALID_VALUE);
        ERROR_NAME(CL_INVALID_DEVICE_TYPE);
        ERROR_NAME(CL_INVALID_PLATFORM);
        ERROR_NAME(CL_INVALID_DEVICE);
        ERROR_NAME(CL_INVALID_CONTEXT);
        ERROR_NAME(CL_INVALID_QUEUE_PROPERTIES);
        ERROR_NAME(CL_INVALID_COMMAND_QUEUE);
        ERROR_NAME(CL_INVALID_MEM_OBJECT);
        ERROR_NAME(CL_INVALID_BINARY);
        ERROR_NAME(CL_INVALID_BUILD_OPTIONS);
        ERROR_NAME(CL_INVALID_PROGRAM);
        ERROR_NAME(CL_INVALID_PROGRAM_EXECUTABLE);
        ERROR_NAME(CL_INVALID_KERNEL_NAME);
        ERROR_NAME(CL_INVALID_KERNEL_DEFINITION);
        ERROR_NAME(CL_INVALID_KERNEL);
        ERROR_NAME(CL_INVALID_ARG_INDEX);
        ERROR_NAME(CL_INVALID_ARG_VALUE);
        ERROR_NAME(CL_INVALID_ARG_SIZE);
        ERROR_NAME(CL_INVALID_KERNEL_ARGS);
        ERROR_NAME(CL_INVALID_WORK_DIMENSION);
        ERROR_NAME(CL_INVALID_WORK_GROUP_SIZE);
        ERROR_NAME(CL_INVALID_WORK_ITEM_SIZE);
        ERROR_NAME(CL_INVALID_GLOBAL_OFFSET);
        ERROR_NAME(CL_INVALID_EVENT_WAIT_LIST);
        ERROR_NAME(CL_INVALID_EVENT);
        ERROR_NAME(CL_INVALID_OPERATION);
        ERROR_NAME(CL_INVALID_BUFFER_SIZE);
        ERROR_NAME(CL_INVALID_GLOBAL_WORK_SIZE);
    case -1001:
        return "CL_PLATFORM_NOT_FOUND_KHR"; // the ICD loader's, cl_ext.h
    default:
        return "unknown error";
    }
}

bool opencl_ok(cl_int code, const char *call, const char *what, const Gpu *gpu) {
    if (code == CL_SUCCESS) return true;
    return fail("%s failed for %s%s%s: %s (%d)", call, what, gpu ? " on " : "", gpu ? gpu->info.name : "",
                opencl_error_name(code), code);
}
