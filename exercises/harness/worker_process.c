// worker_process.c - posix_spawn, a socket, a pipe, poll().
#include "exercises/harness/worker_process.h"

#include "exercises/harness/wire.h"
#include "lab/base/clock.h"
#include "lab/base/fail.h"
#include "lab/base/mem.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

extern char **environ;

bool worker_program_find(bool for_kernels, char **path) {
    const char *name = for_kernels ? "splatlab-kernel-worker" : "splatlab-worker", *set = getenv("SPLATLAB_WORKERS");
    char program[4096];
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    program[length > 0 ? length : 0] = 0;
    char *slash = strrchr(program, '/');
    if (slash) *slash = 0;
    char *folders[] = {mem_text(set ? set : ""), mem_text(program), mem_format("%s/build/release", program),
                       mem_text(SPLATLAB_INSTALLED_KERNELS "/../../../libexec/splatlab")};
    enum { FOLDERS = sizeof folders / sizeof *folders };
    *path = NULL;
    for (int i = 0; i < FOLDERS && !*path; i++) {
        char *place = mem_format("%s/%s", folders[i], name);
        if (folders[i][0] && access(place, X_OK) == 0) *path = mem_text(place);
        mem_free(place);
    }
    if (!*path)
        fail("cannot find the program %s in %s, %s or %s; run make, or set SPLATLAB_WORKERS to its folder", name,
             folders[1], folders[2], folders[3]);
    for (int i = 0; i < FOLDERS; i++) mem_free(folders[i]);
    return *path != NULL;
}

static void close_all(const int *fds, int count) {
    for (int i = 0; i < count; i++)
        if (fds[i] >= 0) close(fds[i]);
}

// argv[0] with the far ends of socket and pipe; a process group of its own, so that what it starts ends with it.
static int spawn(const char *const *argv, int socket_end, int output_end, pid_t *pid) {
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, output_end, 1);
    posix_spawn_file_actions_adddup2(&actions, output_end, 2);
    posix_spawn_file_actions_adddup2(&actions, socket_end, WIRE_FD);
    int error = posix_spawnp(pid, argv[0], &actions, &attributes, (char *const *)argv, environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    return error;
}

// The same file at a number above those that the worker gets, so that no dup2() in the child hits another.
static int raised(int fd) {
    int high = fcntl(fd, F_DUPFD_CLOEXEC, WIRE_FD + 1);
    close(fd);
    return high;
}

bool worker_process_start(WorkerProcess *worker, const char *const *argv) {
    int sockets[2], pipes[2];
    *worker = (WorkerProcess){0};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets) < 0)
        return fail("cannot make a socket: %s", strerror(errno));
    if (pipe2(pipes, O_CLOEXEC) < 0) {
        close_all(sockets, 2);
        return fail("cannot make a pipe: %s", strerror(errno));
    }
    int fds[] = {raised(sockets[0]), raised(sockets[1]), raised(pipes[0]), raised(pipes[1])};
    int error = EMFILE;
    if (fds[0] >= 0 && fds[1] >= 0 && fds[2] >= 0 && fds[3] >= 0) error = spawn(argv, fds[1], fds[3], &worker->pid);
    close_all((int[]){fds[1], fds[3]}, 2);
    if (error) {
        close_all((int[]){fds[0], fds[2]}, 2);
        worker->pid = 0;
        return fail("cannot start %s: %s", argv[0], strerror(error));
    }
    fcntl(fds[0], F_SETFL, O_NONBLOCK);
    fcntl(fds[2], F_SETFL, O_NONBLOCK);
    worker->socket = fds[0];
    worker->output = fds[2];
    return true;
}

// Takes what lies in the pipe; false when it is too much.
static bool read_output(WorkerProcess *worker) {
    char buffer[4096];
    ssize_t got;
    while (worker->printed_bytes <= WORKER_PRINTED_MAX && (got = read(worker->output, buffer, sizeof buffer)) > 0) {
        for (ssize_t i = 0; i < got; i++, worker->printed_bytes++)
            if (worker->printed_bytes < WORKER_PRINTED_KEPT)
                worker->printed[worker->printed_bytes] = buffer[i] ? buffer[i] : '?';
    }
    return worker->printed_bytes <= WORKER_PRINTED_MAX;
}

int worker_process_stop(WorkerProcess *worker) {
    int status = 0;
    if (!worker->pid) return 0;
    // One that has ended by itself keeps its own status.
    if (waitpid(worker->pid, &status, WNOHANG) != worker->pid) {
        kill(-worker->pid, SIGKILL);
        kill(worker->pid, SIGKILL);
        while (waitpid(worker->pid, &status, 0) < 0 && errno == EINTR) continue;
    } else {
        kill(-worker->pid, SIGKILL); // what it has started
    }
    read_output(worker);
    close(worker->socket);
    if (worker->output >= 0) close(worker->output);
    worker->pid = 0;
    return status;
}

static const double HARD_FACTOR = 3, RETRY_S = 0.1;

// Processor time of the worker, all its threads; endless where it cannot be asked for.
static double cpu_seconds(const WorkerProcess *worker) {
    clockid_t clock;
    struct timespec used;
    if (clock_getcpuclockid(worker->pid, &clock) != 0 || clock_gettime(clock, &used) != 0) return INFINITY;
    return (double)used.tv_sec + 1e-9 * (double)used.tv_nsec;
}

void worker_process_grant(WorkerProcess *worker, double seconds) {
    worker->until_s = clock_seconds() + seconds;
    worker->hard_until_s = worker->until_s + (HARD_FACTOR - 1) * seconds;
    worker->cpu_until_s = cpu_seconds(worker) + seconds;
}

// Seconds to wait before the next look; 0: its time is over.
static double seconds_left(const WorkerProcess *worker) {
    double now_s = clock_seconds();
    if (now_s < worker->until_s) return worker->until_s - now_s;
    return now_s < worker->hard_until_s && cpu_seconds(worker) < worker->cpu_until_s ? RETRY_S : 0;
}

// The far end is closed: poll() would come back at once each time.
static void close_output(WorkerProcess *worker) {
    close(worker->output);
    worker->output = -1;
}

// Waits until the socket is ready for `events`, or something is wrong.
static Heard wait_for(WorkerProcess *worker, short events) {
    for (;;) {
        double left_s = seconds_left(worker);
        if (left_s <= 0) return HEARD_TIMEOUT;
        struct pollfd fds[] = {{worker->socket, events, 0}, {worker->output, POLLIN, 0}};
        if (poll(fds, 2, (int)(left_s * 1000) + 1) < 0 && errno != EINTR) return HEARD_END;
        if (fds[1].revents & POLLIN && !read_output(worker)) return HEARD_FLOOD;
        if (fds[1].revents && !(fds[1].revents & POLLIN)) close_output(worker);
        if (fds[0].revents) return HEARD;
    }
}

Heard worker_process_send(WorkerProcess *worker, const void *data, size_t size) {
    for (size_t done = 0; done < size;) {
        ssize_t sent = send(worker->socket, (const char *)data + done, size - done, MSG_NOSIGNAL);
        if (sent > 0)
            done += (size_t)sent;
        else if (errno != EAGAIN && errno != EINTR)
            return HEARD_END;
        else {
            Heard heard = wait_for(worker, POLLOUT);
            if (heard != HEARD) return heard;
        }
    }
    return HEARD;
}

Heard worker_process_receive(WorkerProcess *worker, void *data, size_t size) {
    for (size_t done = 0; done < size;) {
        ssize_t got = recv(worker->socket, (char *)data + done, size - done, 0);
        if (got > 0)
            done += (size_t)got;
        else if (got == 0 || (errno != EAGAIN && errno != EINTR))
            return HEARD_END;
        else {
            Heard heard = wait_for(worker, POLLIN);
            if (heard != HEARD) return heard;
        }
    }
    return HEARD;
}
