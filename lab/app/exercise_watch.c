// exercise_watch.c - `splatlab exercise watch`: one screen, drawn anew at each save; keys go on, back and ask for help.
#include "lab/app/exercise_options.h"

#include "exercises/harness/pictures.h"
#include "exercises/harness/report.h"
#include "exercises/harness/standing.h"
#include "lab/app/command_line.h"
#include "lab/base/fail.h"
#include "lab/base/interrupt.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/inotify.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

extern char **environ;

enum { SETTLE_MS = 40, LOOK_MS = 500 }; // after a save; between two looks whether Ctrl-C was pressed

typedef struct {
    const char *root;
    const ExerciseOptions *options;
    int index; // of the exercise, in EXERCISES
    bool is_terminal, has_keys, is_passed;
    struct termios before; // of the terminal
    int notices, folder;   // inotify, and its watch
    pid_t pictures;        // the window that shows them, 0: none
} Watch;

// ---- the terminal ----

// Only while a key is awaited: so a program that is ended at another time leaves the terminal as it was.
static void terminal_keys(const Watch *w, bool by_key) {
    struct termios now = w->before;
    if (!w->is_terminal) return;
    if (by_key) {
        now.c_lflag &= ~(tcflag_t)(ICANON | ECHO);
        now.c_cc[VMIN] = 1;
        now.c_cc[VTIME] = 0;
    }
    tcsetattr(STDIN_FILENO, TCSADRAIN, &now);
}

// A text of more lines than the terminal has loses its end, not its beginning.
static void print_cut(const Page *page, const char *text, int lines) {
    for (int n = 1; *text; n++) {
        size_t length = strcspn(text, "\n");
        bool is_last = page->rows > 0 && n == lines && strchr(text + length, '\n') && text[length + 1];
        if (is_last) {
            printf("... more in a larger window\n");
            return;
        }
        printf("%.*s\n", (int)length, text);
        text += length + (text[length] == '\n');
    }
}

static void print_keys(const Watch *w, const Page *page) {
    const Exercise *e = EXERCISES[w->index];
    if (!w->is_terminal) return;
    page_colour(page, PAGE_STRONG);
    printf("[h]int [n]ext [p]revious [r]un [s]how [q]uit");
    page_colour(page, PAGE_PLAIN);
    printf("  watching %02d_%s", e->number, e->name);
    fflush(stdout);
}

static void clear(const Watch *w) {
    if (w->is_terminal) fputs("\033[H\033[2J", stdout);
}

// ---- runs ----

static void draw(const Watch *w, const Verdict *v) {
    Page page = page_for(STDOUT_FILENO, stdout), sheet = page;
    char *text = NULL;
    size_t size;
    sheet.out = open_memstream(&text, &size);
    if (sheet.out) {
        report_text(w->root, v, &sheet);
        if (v->passed && w->index + 1 < EXERCISE_COUNT)
            page_paragraph(&sheet, "next", PAGE_STRONG, "key n: E%02d, %s", EXERCISES[w->index + 1]->number,
                           EXERCISES[w->index + 1]->title);
        fclose(sheet.out);
    }
    clear(w);
    print_cut(&page, text ? text : "", page.rows - 2);
    free(text);
    print_keys(w, &page);
    fflush(stdout);
}

static bool run(Watch *w) {
    Verdict *v = mem_alloc(1, sizeof *v);
    if (w->is_terminal) printf("\r\033[Krunning ...");
    fflush(stdout);
    bool good = exercise_judge(w->root, EXERCISES[w->index], w->options, v);
    w->is_passed = good && v->passed;
    if (good) draw(w, v);
    verdict_free(v);
    mem_free(v);
    return good;
}

// ---- saves ----

// Editors write in place, or write another file and rename it: both end in one of these.
static bool follow(Watch *w) {
    char *page = exercise_path(w->root, EXERCISES[w->index], "");
    if (w->folder >= 0) inotify_rm_watch(w->notices, w->folder);
    bool good = exercise_lay_out(w->root, EXERCISES[w->index]);
    if (good) {
        w->folder = inotify_add_watch(w->notices, page, IN_CLOSE_WRITE | IN_MOVED_TO);
        good = w->folder >= 0 || fail("cannot watch the folder %s: %s", page, strerror(errno));
    }
    mem_free(page);
    return good;
}

// Takes what inotify has to tell; is the person's file among it?
static bool is_saved(const Watch *w) {
    char notes[4096] __attribute__((aligned(__alignof__(struct inotify_event))));
    char *name = exercise_file_name(EXERCISES[w->index]);
    bool found = false;
    ssize_t size;
    while ((size = read(w->notices, notes, sizeof notes)) > 0)
        for (char *at = notes; at < notes + size;) {
            const struct inotify_event *note = (const struct inotify_event *)at;
            found |= note->wd == w->folder && note->len > 0 && strcmp(note->name, name) == 0;
            at += sizeof *note + note->len;
        }
    mem_free(name);
    return found;
}

// ---- keys ----

static bool go(Watch *w, int step) {
    int to = w->index + step;
    if (to < 0 || to >= EXERCISE_COUNT) {
        if (w->is_terminal) printf("\r\033[Kthis is the %s exercise", step < 0 ? "first" : "last");
        fflush(stdout);
        return true;
    }
    w->index = to;
    return follow(w) && run(w);
}

static bool hint(const Watch *w) {
    Page page = page_for(STDOUT_FILENO, stdout);
    clear(w);
    if (exercise_hint(w->root, EXERCISES[w->index], w->options) != 0) return false;
    print_keys(w, &page);
    fflush(stdout);
    return true;
}

// In a program of their own, so that watching goes on.
static void show(Watch *w) {
    char number[16];
    const Exercise *e = EXERCISES[w->index];
    char *picture = pictures_path(w->root, e, PICTURE_YOURS);
    bool has_display = getenv("DISPLAY") || getenv("WAYLAND_DISPLAY");
    if (!file_exists(picture)) {
        printf("\r\033[Kno picture: this exercise has had no wrong answer that has one");
    } else if (!has_display) {
        printf("\r\033[Kno display; the pictures: %s and beside it", picture);
    } else if (w->pictures == 0 || waitpid(w->pictures, NULL, WNOHANG) == w->pictures) {
        snprintf(number, sizeof number, "%d", e->number);
        const char *argv[] = {"splatlab", "exercise", "show", number, NULL};
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_adddup2(&actions, 1, 2);
        if (posix_spawn(&w->pictures, "/proc/self/exe", &actions, NULL, (char *const *)argv, environ) != 0)
            w->pictures = 0;
        posix_spawn_file_actions_destroy(&actions);
    }
    fflush(stdout);
    mem_free(picture);
}

// *ends: the person wants to leave.
static bool take_key(Watch *w, char key, bool *ends) {
    switch (key) {
    case 'q':
    case 'Q':
    case 4: // Ctrl-D
        *ends = true;
        return true;
    case 'n':
        return go(w, 1);
    case 'p':
        return go(w, -1);
    case 'r':
        return run(w);
    case 'h':
        return hint(w);
    case 's':
        show(w);
        return true;
    case ' ':
    case '\n':
        return w->is_passed && w->index + 1 < EXERCISE_COUNT ? go(w, 1) : true;
    default:
        return true;
    }
}

// ---- the loop ----

static bool wait_and_answer(Watch *w, bool *ends) {
    struct pollfd fds[] = {{w->notices, POLLIN, 0}, {w->has_keys ? STDIN_FILENO : -1, POLLIN, 0}};
    terminal_keys(w, true);
    int ready = poll(fds, 2, LOOK_MS);
    char key = 0;
    bool has_key = ready > 0 && fds[1].revents && read(STDIN_FILENO, &key, 1) == 1;
    terminal_keys(w, false);
    if (ready <= 0) return true;
    if (fds[1].revents && !has_key) w->has_keys = false; // the end of the input
    if (has_key && !take_key(w, key, ends)) return false;
    if (!fds[0].revents) return true;
    usleep(SETTLE_MS * 1000); // an editor may write more than once
    return !is_saved(w) || run(w);
}

static bool watch(Watch *w) {
    bool ends = false, good = follow(w) && run(w);
    while (good && !ends && !interrupt_requested()) good = wait_and_answer(w, &ends);
    if (w->is_terminal) putchar('\n');
    return good;
}

// The first that is not solved, or the last.
static bool first_open(const char *root, int *index) {
    Standing standings[EXERCISE_COUNT];
    if (!standing_load(root, standings)) return false;
    *index = 0;
    while (*index + 1 < EXERCISE_COUNT && standings[*index].solved) ++*index;
    return true;
}

int exercise_watch(const char *root, const Exercise *e, const ExerciseOptions *o) {
    Watch w = {.root = root, .options = o, .has_keys = true, .folder = -1};
    if (e)
        w.index = exercise_index(e);
    else if (!first_open(root, &w.index))
        return command_failed();
    w.notices = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    if (w.notices < 0) {
        fail("cannot watch for saves: %s", strerror(errno));
        return command_failed();
    }
    w.is_terminal = isatty(STDIN_FILENO) && isatty(STDOUT_FILENO) && tcgetattr(STDIN_FILENO, &w.before) == 0;
    interrupt_install();
    bool good = watch(&w);
    close(w.notices);
    return good ? 0 : command_failed();
}
