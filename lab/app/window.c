// window.c - GLFW for the window, a handful of OpenGL calls for pictures; controls are drawn by gui.h.
#define GL_GLEXT_PROTOTYPES
#include "lab/app/window.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"

#include <GLFW/glfw3.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { KEY_EVENTS_MAX = 1024, MODIFIERS = GLFW_MOD_SHIFT | GLFW_MOD_CONTROL };

struct Window {
    GLFWwindow *handle;
    struct {
        int key, modifiers;
    } keys[KEY_EVENTS_MAX]; // went down in the last poll
    int key_count;
    bool was_press;  // one of them was no repetition
    double density;  // that was asked for; 0: the display's
    int windowed[4]; // x, y, width, height to return to from full screen
};

static char glfw_error[256]; // what GLFW said last

static void note_error(int code, const char *text) {
    (void)code;
    strncpy(glfw_error, text, sizeof glfw_error - 1);
}

static bool fail_no_display(void) {
    bool has_display = getenv("DISPLAY") || getenv("WAYLAND_DISPLAY");
    if (!has_display)
        return fail("there is no display to open a window on (DISPLAY is not set); run it under xvfb-run, or use "
                    "--headless where the command has it");
    return fail(
        "cannot open a window on display %s: %s; is a display running there? Else run it under xvfb-run, or use "
        "--headless where the command has it",
        getenv("DISPLAY") ? getenv("DISPLAY") : getenv("WAYLAND_DISPLAY"), glfw_error);
}

static void note_key(GLFWwindow *handle, int key, int scancode, int action, int modifiers) {
    Window *window = glfwGetWindowUserPointer(handle);
    (void)scancode;
    if (action == GLFW_RELEASE || window->key_count == KEY_EVENTS_MAX) return;
    window->was_press = window->was_press || action == GLFW_PRESS;
    window->keys[window->key_count].key = key;
    window->keys[window->key_count++].modifiers = modifiers & MODIFIERS;
}

// Where the screen is smaller than what was asked for, the window is, too.
static void fit_screen(int *width, int *height) {
    int x, y, most_width, most_height;
    GLFWmonitor *monitor = glfwGetPrimaryMonitor();
    if (!monitor) return;
    glfwGetMonitorWorkarea(monitor, &x, &y, &most_width, &most_height);
    if (most_width > 0 && *width > most_width) *width = most_width;
    if (most_height > 0 && *height > most_height) *height = most_height;
}

// What the display says, in quarters: 100 dots per inch are no reason to blur a line.
static double quarters(float scale) { return fmax(1, round(4 * (double)scale) / 4); }

// How many of the window system's units a point will have, before there is a window. X11 and Windows count px; others count
// points of their own, of which each is as many px as the display says.
static double unit_of_system(double density) {
    float x = 1, y = 1;
    GLFWmonitor *monitor = glfwGetPrimaryMonitor();
    if (monitor) glfwGetMonitorContentScale(monitor, &x, &y);
    if (!(density > 0)) density = quarters(x);
#if defined(__APPLE__)
    return density / quarters(x);
#else
    return getenv("WAYLAND_DISPLAY") && !getenv("DISPLAY") ? density / quarters(x) : density;
#endif
}

Window *window_create(const char *title, int width, int height, double density) {
    glfwSetErrorCallback(note_error);
    if (!glfwInit()) {
        fail_no_display();
        return NULL;
    }
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_ALPHA_BITS, 0);
    double unit = unit_of_system(density);
    width = (int)(width * unit), height = (int)(height * unit);
    fit_screen(&width, &height);
    GLFWwindow *handle = glfwCreateWindow(width, height, title, NULL, NULL);
    if (!handle) {
        fail("cannot open a window with OpenGL 3.3: %s; is a driver installed (Debian: libgl1-mesa-dri)?", glfw_error);
        glfwTerminate();
        return NULL;
    }
    glfwMakeContextCurrent(handle);
    glfwSwapInterval(1);
    Window *window = mem_alloc(1, sizeof *window);
    window->handle = handle;
    window->density = density;
    glfwSetWindowUserPointer(handle, window);
    glfwSetKeyCallback(handle, note_key);
    return window;
}

void window_destroy(Window *window) {
    if (!window) return;
    glfwDestroyWindow(window->handle);
    glfwTerminate();
    mem_free(window);
}

GLFWwindow *window_handle(const Window *window) { return window->handle; }

bool window_is_closing(const Window *window) { return glfwWindowShouldClose(window->handle); }

double window_density(const Window *window) {
    float x, y;
    if (window->density > 0) return window->density;
    glfwGetWindowContentScale(window->handle, &x, &y);
    return quarters(x);
}

double window_unit(const Window *window) {
    int width, height, width_px, height_px;
    glfwGetWindowSize(window->handle, &width, &height);
    glfwGetFramebufferSize(window->handle, &width_px, &height_px);
    return width_px > 0 ? window_density(window) * width / width_px : 1;
}

void window_size(const Window *window, int *width, int *height) {
    int width_px, height_px;
    glfwGetFramebufferSize(window->handle, &width_px, &height_px);
    *width = (int)(width_px / window_density(window));
    *height = (int)(height_px / window_density(window));
}

void window_poll(Window *window, double wait_s) {
    window->key_count = 0;
    window->was_press = false;
    if (wait_s > 0)
        glfwWaitEventsTimeout(wait_s);
    else
        glfwPollEvents();
}

bool window_key_pressed(const Window *window) { return window->was_press; }

int window_key_count(const Window *window, int key, int modifiers) {
    int count = 0;
    for (int i = 0; i < window->key_count; i++)
        count += window->keys[i].key == key && window->keys[i].modifiers == modifiers;
    return count;
}

void window_toggle_full_screen(Window *window) {
    int *w = window->windowed;
    if (glfwGetWindowMonitor(window->handle)) {
        glfwSetWindowMonitor(window->handle, NULL, w[0], w[1], w[2], w[3], GLFW_DONT_CARE);
        return;
    }
    GLFWmonitor *monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode *mode = monitor ? glfwGetVideoMode(monitor) : NULL;
    if (!mode) return;
    glfwGetWindowPos(window->handle, &w[0], &w[1]);
    glfwGetWindowSize(window->handle, &w[2], &w[3]);
    glfwSetWindowMonitor(window->handle, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void window_begin(Window *window, const float rgb[3]) {
    int width, height;
    glfwGetFramebufferSize(window->handle, &width, &height);
    glViewport(0, 0, width, height);
    glClearColor(rgb[0], rgb[1], rgb[2], 1);
    glClear(GL_COLOR_BUFFER_BIT);
}

void window_show(Window *window) { glfwSwapBuffers(window->handle); }

// OpenGL's rows begin at the bottom.
bool window_read(const Window *window, Image8 *image) {
    int width, height;
    glfwGetFramebufferSize(window->handle, &width, &height);
    if (width < 1 || height < 1) return fail("the window has no pixels to take a picture of; is it minimised?");
    Image8 read = image8_create(width, height, 3);
    *image = image8_create(width, height, 3);
    glReadBuffer(GL_BACK);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, read.bytes);
    size_t row = (size_t)width * 3;
    for (int y = 0; y < height; y++) memcpy(image->bytes + y * row, read.bytes + (height - 1 - y) * row, row);
    image8_destroy(&read);
    return true;
}

unsigned window_texture_create(Window *window) {
    (void)window;
    unsigned texture = 0;
    glGenTextures(1, &texture);
    return texture;
}

void window_texture_fill(Window *window, unsigned texture, const Image8 *image, bool smooth) {
    (void)window;
    GLenum format = image->channels == 4 ? GL_RGBA : GL_RGB;
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, smooth ? GL_LINEAR : GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, image->width, image->height, 0, format, GL_UNSIGNED_BYTE, image->bytes);
}
