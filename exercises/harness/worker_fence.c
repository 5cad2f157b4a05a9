// worker_fence.c - a filter of system calls: those on a list fail with EPERM, all others go through.
#include "exercises/harness/worker_fence.h"

#include <assert.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#if defined __x86_64__
#define ARCHITECTURE AUDIT_ARCH_X86_64
#elif defined __aarch64__
#define ARCHITECTURE AUDIT_ARCH_AARCH64
#endif

// Refused whatever their arguments are.
static const int REFUSED[] = {
#ifdef __x86_64__
    SYS_fork,
    SYS_vfork,
    SYS_creat,
    SYS_unlink,
    SYS_rename,
    SYS_rmdir,
    SYS_mkdir,
    SYS_link,
    SYS_symlink,
    SYS_chmod,
    SYS_mknod,
#endif
    SYS_execve,
    SYS_execveat,
    SYS_ptrace,
    SYS_process_vm_readv,
    SYS_process_vm_writev,
    SYS_rt_sigqueueinfo,
    SYS_rt_tgsigqueueinfo,
    SYS_setpgid,
    SYS_setsid,
    SYS_socket,
    SYS_connect,
    SYS_bind,
    SYS_unlinkat,
    SYS_renameat,
    SYS_renameat2,
    SYS_mkdirat,
    SYS_linkat,
    SYS_symlinkat,
    SYS_fchmodat,
    SYS_truncate,
    SYS_mknodat,
    SYS_mount,
    SYS_chroot,
    SYS_prlimit64,
    SYS_setrlimit,
    SYS_pidfd_open,
    SYS_pidfd_send_signal,
    SYS_openat2,
    SYS_io_uring_setup,
    SYS_bpf,
    SYS_unshare,
    SYS_setns};
enum { REFUSED_COUNT = sizeof REFUSED / sizeof *REFUSED, STEPS_MAX = 2 * REFUSED_COUNT + 64 };

#ifdef ARCHITECTURE

typedef struct {
    struct sock_filter steps[STEPS_MAX];
    unsigned short count;
} Program;

static void add(Program *p, struct sock_filter step) {
    assert(p->count < STEPS_MAX);
    p->steps[p->count++] = step;
}

#define NUMBER_AT      offsetof(struct seccomp_data, nr)
#define ARGUMENT_AT(k) (offsetof(struct seccomp_data, args) + 8 * (k)) // its lower half
#define REFUSE         (SECCOMP_RET_ERRNO | EPERM)

static void add_load(Program *p, size_t at) {
    add(p, (struct sock_filter)BPF_STMT(BPF_LD | BPF_W | BPF_ABS, (uint32_t)at));
}
static void add_end(Program *p, uint32_t verdict) { add(p, (struct sock_filter)BPF_STMT(BPF_RET | BPF_K, verdict)); }
// Goes on with the next `yes` steps left out, or the next `no`.
static void add_equal(Program *p, uint32_t value, uint8_t yes, uint8_t no) {
    add(p, (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, yes, no));
}
static void add_any_bit(Program *p, uint32_t bits, uint8_t yes, uint8_t no) {
    add(p, (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, bits, yes, no));
}

// A call that is allowed only where argument k is that (a signal to oneself).
static void add_only_to(Program *p, int number, int k, uint32_t value) {
    add_load(p, NUMBER_AT);
    add_equal(p, (uint32_t)number, 0, 4);
    add_load(p, ARGUMENT_AT(k));
    add_equal(p, value, 1, 0);
    add_end(p, REFUSE);
    add_end(p, SECCOMP_RET_ALLOW);
}

// A call that is refused where argument k has one of these bits (or, inverted, where it has none).
static void add_bits(Program *p, int number, int k, uint32_t bits, bool refused_without) {
    add_load(p, NUMBER_AT);
    add_equal(p, (uint32_t)number, 0, 4);
    add_load(p, ARGUMENT_AT(k));
    add_any_bit(p, bits, refused_without ? 1 : 0, refused_without ? 0 : 1);
    add_end(p, REFUSE);
    add_end(p, SECCOMP_RET_ALLOW);
}

bool worker_fence_raise(void) {
    Program p = {0};
    const uint32_t writes = O_WRONLY | O_RDWR | O_CREAT | O_TRUNC | O_APPEND;
    add_load(&p, offsetof(struct seccomp_data, arch));
    add_equal(&p, ARCHITECTURE, 1, 0);
    add_end(&p, REFUSE);
    add_only_to(&p, SYS_kill, 0, (uint32_t)getpid());
    add_only_to(&p, SYS_tgkill, 0, (uint32_t)getpid());
    add_bits(&p, SYS_openat, 2, writes, false);
#ifdef SYS_open
    add_bits(&p, SYS_open, 1, writes, false);
#endif
    add_bits(&p, SYS_clone, 0, CLONE_THREAD, true); // threads, but no processes
    add_load(&p, NUMBER_AT);
    for (int i = 0; i < REFUSED_COUNT; i++) {
        add_equal(&p, (uint32_t)REFUSED[i], 0, 1);
        add_end(&p, REFUSE);
    }
    add_equal(&p, SYS_tkill, 0, 1);
    add_end(&p, REFUSE);
    add_equal(&p, SYS_clone3, 0, 1); // its flags lie in memory, which a filter cannot see; glibc then takes clone()
    add_end(&p, SECCOMP_RET_ERRNO | ENOSYS);
#ifdef __x86_64__
    add(&p, (struct sock_filter)BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, 0x40000000u, 0, 1)); // the x32 numbers
    add_end(&p, REFUSE);
#endif
    add_end(&p, SECCOMP_RET_ALLOW);
    struct sock_fprog filter = {p.count, p.steps};
    return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) == 0;
}

#else

bool worker_fence_raise(void) { return false; }

#endif
