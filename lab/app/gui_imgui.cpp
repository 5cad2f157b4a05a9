// gui_imgui.cpp - gui.h by Dear ImGui 1.86 with its GLFW and OpenGL 3 back ends; headless by paint.h.
extern "C" {
#include "lab/app/window.h"
#include "lab/base/mem.h"
}
#include "lab/app/font_files.h"
#include "lab/app/gui.h"
#include "lab/app/paint.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <cfloat>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

namespace {

struct Place {
    std::string label;
    GuiRect rect;
};

struct State {
    Window *window = nullptr;
    double scale = 1, wanted_scale = 1;
    double density = 1, wanted_density = 1;
    ImFont *fonts[GUI_STYLE_COUNT] = {};
    unsigned textures[GUI_PICTURE_COUNT] = {}; // of the window
    Image8 pictures[GUI_PICTURE_COUNT] = {};   // headless
    bool smooth[GUI_PICTURE_COUNT] = {};
    Image8 atlas = {};         // the glyphs, headless
    std::vector<Place> places; // of this frame
};
State gui;

float f32(double value) { return static_cast<float>(value); }

constexpr double BODY_PX = 18; // at scale 1

struct FontFile {
    const char *name;
    double size; // times BODY_PX
};
const FontFile FONT_FILES[GUI_STYLE_COUNT] = {{"DejaVuSans.ttf", 1},     {"DejaVuSans-Bold.ttf", 1},
                                              {"DejaVuSans.ttf", 1.5},   {"DejaVuSans.ttf", 0.84},
                                              {"DejaVuSansMono.ttf", 1}, {"DejaVuSansMono.ttf", 0.84}};
// Latin, Greek, sub- and superscripts, punctuation with primes, arrows, mathematical signs, simple shapes.
const ImWchar GLYPHS[] = {0x20,   0xff,   0x1d40, 0x1d40, 0x370,  0x3ff,  0x2010, 0x2040, 0x2070, 0x209f,
                          0x2190, 0x21ff, 0x2200, 0x22ff, 0x25a0, 0x25ff, 0x2713, 0x2717, 0};

// What an atlas's font measures in points: its glyphs are drawn for px.
float font_size(const ImFont *font) { return font->FontSize * font->Scale; }

// The glyphs of all styles at the wanted size. Without the font files there is the library's own font, which has no Greek.
void load_fonts() {
    ImFontAtlas *atlas = ImGui::GetIO().Fonts;
    gui.scale = gui.wanted_scale;
    gui.density = gui.wanted_density;
    atlas->Clear();
    for (int style = 0; style < GUI_STYLE_COUNT; style++) {
        float size = std::round(f32(BODY_PX * FONT_FILES[style].size * gui.scale * gui.density));
        char *path = font_file_find(FONT_FILES[style].name);
        ImFontConfig own;
        own.SizePixels = size;
        gui.fonts[style] = path ? atlas->AddFontFromFileTTF(path, size, nullptr, GLYPHS) : atlas->AddFontDefault(&own);
        mem_free(path);
        gui.fonts[style]->Scale = f32(1 / gui.density);
    }
    atlas->Build();
    if (gui.window) {
        ImGui_ImplOpenGL3_DestroyFontsTexture();
        ImGui_ImplOpenGL3_CreateFontsTexture();
        return;
    }
    unsigned char *rgba;
    int width, height;
    atlas->GetTexDataAsRGBA32(&rgba, &width, &height);
    image8_destroy(&gui.atlas);
    gui.atlas = image8_create(width, height, 4);
    memcpy(gui.atlas.bytes, rgba, static_cast<size_t>(width) * height * 4);
    atlas->SetTexID(&gui.atlas);
}

ImU32 packed(GuiColour c) { return IM_COL32(c >> 24, c >> 16 & 255, c >> 8 & 255, c & 255); }
ImVec4 vec4(GuiColour c) { return ImGui::ColorConvertU32ToFloat4(packed(c)); }
ImVec2 vec2(double x, double y) { return ImVec2(f32(x), f32(y)); }

void set_style() {
    ImGuiStyle fresh;
    ImGui::StyleColorsDark(&fresh);
    fresh.WindowRounding = fresh.ChildRounding = 0;
    fresh.WindowBorderSize = fresh.ChildBorderSize = 0;
    fresh.FrameRounding = fresh.PopupRounding = 5;
    fresh.GrabRounding = 3;
    fresh.FramePadding = ImVec2(9, 5);
    fresh.ItemSpacing = ImVec2(8, 7);
    fresh.GrabMinSize = 6; // the number must stay readable behind it
    fresh.ScrollbarSize = 11;
    const struct {
        ImGuiCol_ slot;
        GuiColour colour;
    } colours[] = {
        {ImGuiCol_Text, 0xe8eaf0ff},
        {ImGuiCol_TextDisabled, 0x8b93a5ff},
        {ImGuiCol_FrameBg, 0x262b38ff},
        {ImGuiCol_FrameBgHovered, 0x2f3546ff},
        {ImGuiCol_FrameBgActive, 0x363d50ff},
        {ImGuiCol_SliderGrab, 0x4a6cc4ff},
        {ImGuiCol_SliderGrabActive, 0x6c8fe6ff},
        {ImGuiCol_Button, 0x2a3040ff},
        {ImGuiCol_ButtonHovered, 0x3a4258ff},
        {ImGuiCol_ButtonActive, 0x4a5470ff},
        {ImGuiCol_CheckMark, 0x7aa2f7ff},
        {ImGuiCol_Separator, 0x2c3242ff},
        {ImGuiCol_PopupBg, 0x1c202bfa},
        {ImGuiCol_Border, 0x3a4258ff},
        {ImGuiCol_ScrollbarBg, 0x00000000},
        {ImGuiCol_ScrollbarGrab, 0x3a4258ff},
    };
    for (auto &c : colours) fresh.Colors[c.slot] = vec4(c.colour);
    fresh.ScaleAllSizes(f32(gui.scale));
    ImGui::GetStyle() = fresh;
}

void note_place(const char *label) {
    ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    gui.places.push_back({label, {low.x, low.y, high.x - low.x, high.y - low.y}});
}

std::string printed(const char *format, va_list values) {
    char text[1024];
    vsnprintf(text, sizeof text, format, values);
    return text;
}

ImDrawList *canvas() { return ImGui::GetWindowDrawList(); }

} // namespace

// ---- life ----

void gui_open(Window *window) {
    gui = State();
    gui.window = window;
    ImGui::CreateContext();
    ImGuiIO &io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    // A draw list may outgrow 16-bit indices: OpenGL 3.3 and gui_frame_paint() both take an offset to its vertices.
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    if (window) {
        ImGui_ImplGlfw_InitForOpenGL(window_handle(window), true);
        ImGui_ImplOpenGL3_Init("#version 330 core");
        for (unsigned &texture : gui.textures) texture = window_texture_create(window);
    }
    load_fonts();
    set_style();
}

void gui_close(void) {
    if (!ImGui::GetCurrentContext()) return;
    if (gui.window) {
        ImGui_ImplOpenGL3_Shutdown();
        ImGui_ImplGlfw_Shutdown();
    }
    ImGui::DestroyContext();
    for (Image8 &picture : gui.pictures) image8_destroy(&picture);
    image8_destroy(&gui.atlas);
    gui = State();
}

void gui_set_scale(double scale, double density) { gui.wanted_scale = scale, gui.wanted_density = density; }
double gui_density(void) { return gui.density; }

// ---- a frame ----

void gui_frame_begin(int width, int height) {
    if (gui.wanted_scale != gui.scale || gui.wanted_density != gui.density) {
        load_fonts();
        set_style();
    }
    ImGuiIO &io = ImGui::GetIO();
    if (gui.window) {
        ImGui_ImplOpenGL3_NewFrame();
        ImGui_ImplGlfw_NewFrame();
        // The library counts as the window system does; a point of ours is `unit` of its units.
        double unit = window_unit(gui.window);
        io.DisplayFramebufferScale = vec2(gui.density, gui.density);
        if (ImGui::IsMousePosValid(&io.MousePos)) io.MousePos = vec2(io.MousePos.x / unit, io.MousePos.y / unit);
    } else {
        io.DeltaTime = 1.0f / 60;
    }
    io.DisplaySize = vec2(width, height);
    gui.places.clear();
    ImGui::NewFrame();
    ImGui::PushFont(gui.fonts[GUI_BODY]);
}

void gui_frame_end(void) {
    ImGui::PopFont();
    ImGui::Render();
    if (gui.window) ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

static std::vector<PaintVertex> in_px(const ImDrawList *list) {
    auto points = reinterpret_cast<const PaintVertex *>(list->VtxBuffer.Data);
    std::vector<PaintVertex> vertices(points, points + list->VtxBuffer.Size);
    for (PaintVertex &v : vertices) v.x *= f32(gui.density), v.y *= f32(gui.density);
    return vertices;
}

void gui_frame_paint(Image8 *to) {
    static_assert(sizeof(ImDrawVert) == sizeof(PaintVertex), "same vertex");
    static_assert(sizeof(ImDrawIdx) == sizeof(uint16_t), "same index");
    const ImDrawData *data = ImGui::GetDrawData();
    for (int i = 0; i < data->CmdListsCount; i++) {
        const ImDrawList *list = data->CmdLists[i];
        const std::vector<PaintVertex> vertices = in_px(list);
        for (const ImDrawCmd &command : list->CmdBuffer) {
            auto px = [](float points) { return static_cast<int>(points * gui.density); };
            const ImVec4 &r = command.ClipRect;
            const int clip[4] = {px(r.x), px(r.y), px(r.z), px(r.w)};
            const Image8 *image = static_cast<const Image8 *>(command.GetTexID());
            bool is_picture = image >= gui.pictures && image < gui.pictures + GUI_PICTURE_COUNT;
            PaintTexture texture = {image, is_picture ? gui.smooth[image - gui.pictures] : true};
            paint_triangles(to, clip, texture, vertices.data() + command.VtxOffset,
                            list->IdxBuffer.Data + command.IdxOffset, static_cast<int>(command.ElemCount));
        }
    }
}

GuiRect gui_screen(void) {
    ImVec2 size = ImGui::GetIO().DisplaySize;
    return {0, 0, size.x, size.y};
}

double gui_em(void) { return font_size(gui.fonts[GUI_BODY]); }

// ---- mouse and keys ----

GuiMouse gui_mouse(void) {
    const ImGuiIO &io = ImGui::GetIO();
    GuiMouse mouse = {};
    bool known = ImGui::IsMousePosValid();
    mouse.x = known ? io.MousePos.x : -1e6;
    mouse.y = known ? io.MousePos.y : -1e6;
    mouse.moved_x = io.MouseDelta.x;
    mouse.moved_y = io.MouseDelta.y;
    mouse.wheel = io.MouseWheel;
    for (int b = 0; b < GUI_BUTTON_COUNT; b++) {
        mouse.down[b] = io.MouseDown[b];
        mouse.pressed[b] = ImGui::IsMouseClicked(b);
        mouse.released[b] = ImGui::IsMouseReleased(b);
    }
    return mouse;
}

int gui_key(int key, int modifiers) {
    if (!gui.window || ImGui::GetIO().WantTextInput) return 0;
    return window_key_count(gui.window, key, modifiers);
}

bool gui_key_pressed(void) { return gui.window && window_key_pressed(gui.window); }
bool gui_ctrl(void) { return ImGui::GetIO().KeyCtrl; }
bool gui_shift(void) { return ImGui::GetIO().KeyShift; }

bool gui_is_holding(void) {
    const ImGuiIO &io = ImGui::GetIO();
    for (bool down : io.MouseDown)
        if (down) return true;
    for (bool down : io.KeysDown)
        if (down) return true;
    return ImGui::IsAnyItemActive();
}

// ---- where controls go ----

static void begin_window(const char *name, GuiRect place, GuiColour background, double padding, int flags) {
    ImGui::SetNextWindowPos(vec2(place.x, place.y));
    ImGui::SetNextWindowSize(vec2(place.width, place.height));
    ImGui::PushStyleColor(ImGuiCol_WindowBg, vec4(background));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, vec2(padding * gui_em(), padding * gui_em()));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
    ImGui::Begin(name, nullptr,
                 flags | ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse |
                     ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav);
    ImGui::PopStyleVar(2);
    ImGui::PopStyleColor();
}

// The flag also puts it below all windows without it.
void gui_panel_begin(const char *name, GuiRect place, GuiColour background, double padding) {
    begin_window(name, place, background, padding, ImGuiWindowFlags_NoBringToFrontOnFocus);
}

void gui_overlay_begin(const char *name, GuiRect place, GuiColour background, double padding, bool takes_mouse) {
    begin_window(name, place, background, padding, takes_mouse ? 0 : ImGuiWindowFlags_NoInputs);
}

void gui_panel_end(void) { ImGui::End(); }
double gui_width_left(void) { return ImGui::GetContentRegionAvail().x; }

GuiRect gui_take(double width, double height) {
    ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::Dummy(vec2(width, height));
    return {at.x, at.y, width, height};
}

void gui_same_line(double gap_em) { ImGui::SameLine(0, f32(gap_em * gui_em())); }
void gui_gap(double ems) { ImGui::Dummy(vec2(0, ems * gui_em())); }
void gui_rule(void) { ImGui::Separator(); }

// ---- controls ----

void gui_text(GuiStyle style, GuiColour colour, const char *format, ...) {
    va_list values;
    va_start(values, format);
    std::string text = printed(format, values);
    va_end(values);
    ImGui::PushFont(gui.fonts[style]);
    ImGui::PushStyleColor(ImGuiCol_Text, vec4(colour));
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
    ImGui::PopFont();
}

void gui_paragraph(GuiStyle style, GuiColour colour, const char *text) {
    ImGui::PushTextWrapPos(0);
    gui_text(style, colour, "%s", text);
    ImGui::PopTextWrapPos();
}

// The label stands left, the control takes the rest of the line. Returns the control's own name.
static std::string label_left(const char *label) {
    double start = ImGui::GetCursorPosX();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(label);
    ImGui::SameLine(f32(start + 5.4 * gui_em()));
    ImGui::SetNextItemWidth(-FLT_MIN);
    return std::string("##") + label;
}

bool gui_slider(const char *label, double *value, double low, double high, const char *format, bool logarithmic) {
    std::string id = label_left(label);
    double before = *value;
    ImGuiSliderFlags flags = ImGuiSliderFlags_NoRoundToFormat | (logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
    ImGui::SliderScalar(id.c_str(), ImGuiDataType_Double, value, &low, &high, format, flags);
    note_place(label);
    if (!std::isfinite(*value)) *value = before; // typed
    return *value != before;
}

bool gui_switch(const char *label, bool *value) {
    bool changed = ImGui::Checkbox(label, value);
    note_place(label);
    return changed;
}

bool gui_button(const char *label, double width) {
    bool pressed = ImGui::Button(label, vec2(width, 0));
    note_place(label);
    return pressed;
}

bool gui_choice(const char *label, int *value, const char *const *names, int count) {
    bool changed = false;
    float gap = f32(0.25 * gui_em());
    float width = (ImGui::GetContentRegionAvail().x - gap * f32(count - 1)) / f32(count);
    ImGui::PushID(label);
    for (int i = 0; i < count; i++) {
        if (i) ImGui::SameLine(0, gap);
        bool chosen = *value == i;
        ImGui::PushStyleColor(ImGuiCol_Button, vec4(chosen ? 0x3d59a1ff : 0x222735ff));
        ImGui::PushStyleColor(ImGuiCol_Text, vec4(chosen ? 0xffffffff : 0xaab2c5ff));
        if (ImGui::Button(names[i], ImVec2(width, 0)) && !chosen) *value = i, changed = true;
        ImGui::PopStyleColor(2);
        note_place(names[i]);
    }
    ImGui::PopID();
    return changed;
}

bool gui_colour(const char *label, double rgb[3]) {
    float value[3] = {f32(rgb[0]), f32(rgb[1]), f32(rgb[2])};
    bool changed = ImGui::ColorEdit3(label_left(label).c_str(), value);
    note_place(label);
    for (int c = 0; changed && c < 3; c++) rgb[c] = std::fmin(1, std::fmax(0, static_cast<double>(value[c])));
    return changed;
}

bool gui_text_field(const char *label, char *text, int size) {
    ImGui::SetNextItemWidth(-FLT_MIN);
    bool changed = ImGui::InputText((std::string("##") + label).c_str(), text, static_cast<size_t>(size));
    note_place(label);
    return changed;
}

void gui_hint(const char *text) {
    if (!ImGui::IsItemHovered()) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(f32(22 * gui_em()));
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

GuiArea gui_area(const char *name, double width, double height) {
    ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton(name, vec2(std::fmax(1, width), std::fmax(1, height)),
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                               ImGuiButtonFlags_MouseButtonMiddle);
    note_place(name);
    return {{at.x, at.y, width, height}, ImGui::IsItemHovered(), ImGui::IsItemActive()};
}

bool gui_place(int i, const char **label, GuiRect *place) {
    if (i < 0 || i >= static_cast<int>(gui.places.size())) return false;
    *label = gui.places[static_cast<size_t>(i)].label.c_str();
    const GuiRect &r = gui.places[static_cast<size_t>(i)].rect;
    double unit = gui.window ? window_unit(gui.window) : gui.density;
    *place = {r.x * unit, r.y * unit, r.width * unit, r.height * unit};
    return true;
}

// ---- drawing ----

void gui_draw_line(double x0, double y0, double x1, double y1, GuiColour colour, double width) {
    canvas()->AddLine(vec2(x0, y0), vec2(x1, y1), packed(colour), f32(width));
}

static std::vector<ImVec2> points_of(const double *xy, int count) {
    std::vector<ImVec2> points;
    for (int i = 0; i < count; i++) points.push_back(vec2(xy[2 * i], xy[2 * i + 1]));
    return points;
}

void gui_draw_curve(const double *xy, int count, bool closed, GuiColour colour, double width) {
    std::vector<ImVec2> points = points_of(xy, count);
    canvas()->AddPolyline(points.data(), count, packed(colour), closed ? ImDrawFlags_Closed : 0, f32(width));
}

void gui_draw_shape(const double *xy, int count, GuiColour colour) {
    std::vector<ImVec2> points = points_of(xy, count);
    canvas()->AddConvexPolyFilled(points.data(), count, packed(colour));
}

void gui_draw_rect(GuiRect r, GuiColour colour, double radius) {
    canvas()->AddRectFilled(vec2(r.x, r.y), vec2(r.x + r.width, r.y + r.height), packed(colour), f32(radius));
}

void gui_draw_frame(GuiRect r, GuiColour colour, double radius, double width) {
    canvas()->AddRect(vec2(r.x, r.y), vec2(r.x + r.width, r.y + r.height), packed(colour), f32(radius), 0, f32(width));
}

void gui_draw_disc(double x, double y, double radius, GuiColour colour) {
    canvas()->AddCircleFilled(vec2(x, y), f32(radius), packed(colour));
}

void gui_draw_ring(double x, double y, double radius, GuiColour colour, double width) {
    canvas()->AddCircle(vec2(x, y), f32(radius), packed(colour), 0, f32(width));
}

void gui_draw_text(GuiStyle style, double x, double y, GuiColour colour, const char *format, ...) {
    va_list values;
    va_start(values, format);
    std::string text = printed(format, values);
    va_end(values);
    ImFont *font = gui.fonts[style];
    canvas()->AddText(font, font_size(font), vec2(std::round(x), std::round(y)), packed(colour), text.c_str());
}

double gui_text_width(GuiStyle style, const char *text) {
    ImFont *font = gui.fonts[style];
    return font->CalcTextSizeA(font_size(font), FLT_MAX, 0, text).x;
}
double gui_text_height(GuiStyle style) { return font_size(gui.fonts[style]); }

void gui_picture_fill(int picture, const Image8 *image, bool smooth) {
    gui.smooth[picture] = smooth;
    if (gui.window) {
        window_texture_fill(gui.window, gui.textures[picture], image, smooth);
        return;
    }
    Image8 &kept = gui.pictures[picture];
    image8_destroy(&kept);
    kept = image8_create(image->width, image->height, image->channels);
    memcpy(kept.bytes, image->bytes, static_cast<size_t>(image->width) * image->height * image->channels);
}

void gui_draw_picture(int picture, GuiRect r) {
    ImTextureID id = gui.window ? reinterpret_cast<ImTextureID>(static_cast<intptr_t>(gui.textures[picture]))
                                : static_cast<ImTextureID>(&gui.pictures[picture]);
    canvas()->AddImage(id, vec2(r.x, r.y), vec2(r.x + r.width, r.y + r.height));
}
