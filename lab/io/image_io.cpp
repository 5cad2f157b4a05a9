// image_io.cpp - the only file that knows OpenImageIO.
extern "C" {
#include "lab/io/image_io.h"
#include "lab/base/fail.h"
#include "lab/base/image.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "lab/io/png_check.h"
}

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <memory>
#include <string>
#include <vector>

// How alpha is kept. We hold it straight. OpenImageIO by itself multiplies colour by alpha when it reads a PNG, which at
// 8 bit destroys the colour of nearly transparent pixels; "oiio:UnassociatedAlpha" asks it to leave the numbers alone.
// EXR is premultiplied by definition: there the colour is divided on reading and multiplied on writing, in float.

namespace {

constexpr int side_max = 65535;        // px
constexpr long pixels_max = 1L << 28;  // a header that claims more is taken for damaged
constexpr int jpeg_quality = 95;       // of 100
constexpr int orientation_upright = 1; // EXIF: 1 upright .. 8; from 5 on width and height are swapped

std::string one_line(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == '.')) text.pop_back();
    for (char &c : text)
        if (c == '\n') c = ' ';
    return text.empty() ? "the file is damaged" : text;
}

struct Source {
    std::unique_ptr<OIIO::ImageInput> input;
    OIIO::ImageSpec spec;
    int width, height;  // as stored
    int colours;        // channels of colour to use: 1 or 3
    int alpha;          // index of the alpha channel in the file, or -1
    bool premultiplied; // colour is multiplied by alpha
    int orientation;    // EXIF, 1..8
};

bool open_source(const char *path, Source &source) {
    static const bool single_threaded = OIIO::attribute("threads", 1); // images are decoded in parallel, one a thread
    (void)single_threaded;
    if (!file_exists(path)) return fail("cannot read image %s: no such file; is the path right?", path);
    if (file_is_folder(path)) return fail("cannot read image %s: it is a folder", path);
    if (!png_check(path)) return false;
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    source.input = OIIO::ImageInput::open(path, &config);
    if (!source.input)
        return fail("cannot read image %s: %s; is it a complete picture?", path, one_line(OIIO::geterror()).c_str());
    const OIIO::ImageSpec &spec = source.spec = source.input->spec();
    if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1 || spec.width > side_max ||
        spec.height > side_max || (long)spec.width * spec.height > pixels_max)
        return fail(
            "cannot read image %s: its header says %d x %d x %d pixels of %d channels; at most %ld pixels are read",
            path, spec.width, spec.height, spec.depth, spec.nchannels, pixels_max);
    source.width = spec.width;
    source.height = spec.height;
    source.alpha = spec.alpha_channel < spec.nchannels ? spec.alpha_channel : -1;
    source.colours = spec.nchannels >= 3 && source.alpha != 1 ? 3 : 1;
    source.premultiplied = source.alpha >= 0 && !spec.get_int_attribute("oiio:UnassociatedAlpha", 0);
    source.orientation = spec.get_int_attribute("Orientation", orientation_upright);
    if (source.orientation < 1 || source.orientation > 8) source.orientation = orientation_upright;
    return true;
}

bool is_swapped(const Source &source) { return source.orientation >= 5; }
int upright_width(const Source &source) { return is_swapped(source) ? source.height : source.width; }
int upright_height(const Source &source) { return is_swapped(source) ? source.width : source.height; }

// The pixel of the upright picture at which stored pixel (x, y) belongs; w, h: size as stored.
size_t upright_index(int orientation, int x, int y, int w, int h) {
    size_t width = orientation >= 5 ? (size_t)h : (size_t)w;
    int mirrored_x = w - 1 - x, mirrored_y = h - 1 - y;
    int u = x, v = y;
    switch (orientation) {
    case 2:
        u = mirrored_x;
        break; // mirrored left to right
    case 3:
        u = mirrored_x, v = mirrored_y;
        break; // half a turn
    case 4:
        v = mirrored_y;
        break; // mirrored top to bottom
    case 5:
        u = y, v = x;
        break; // transposed
    case 6:
        u = mirrored_y, v = x;
        break; // to be turned clockwise
    case 7:
        u = mirrored_y, v = mirrored_x;
        break; // transposed at the other diagonal
    case 8:
        u = y, v = mirrored_x;
        break; // to be turned counter-clockwise
    default:
        break;
    }
    return (size_t)v * width + (size_t)u;
}

template <typename T> bool read_pixels(const char *path, Source &source, OIIO::TypeDesc type, std::vector<T> &pixels) {
    int channels = source.spec.nchannels;
    pixels.resize((size_t)source.width * source.height * channels);
    bool ok = source.input->read_image(0, 0, 0, channels, type, pixels.data());
    std::string reason = source.input->geterror();
    // JPEG and TIFF that were cut off are filled up and reported as a mere warning. Stray bytes between the parts of a
    // JPEG, which some cameras leave, are harmless.
    if (!ok || (!reason.empty() && reason.find("extraneous bytes") == std::string::npos))
        return fail("cannot read image %s: %s; is the file complete?", path, one_line(reason).c_str());
    return true;
}

// Picks colour and alpha, repeats grey to `colours`, and turns the picture upright. out: (pixels, channels).
template <typename T> void arrange(const Source &source, const std::vector<T> &pixels, int colours, T *out) {
    int channels = colours + (source.alpha >= 0);
    size_t stored = 0;
    for (int y = 0; y < source.height; y++)
        for (int x = 0; x < source.width; x++, stored++) {
            const T *from = &pixels[stored * source.spec.nchannels];
            T *to = out + upright_index(source.orientation, x, y, source.width, source.height) * channels;
            for (int c = 0; c < colours; c++) to[c] = from[source.colours == 1 ? 0 : c];
            if (source.alpha >= 0) to[colours] = from[source.alpha];
        }
}

void divide_by_alpha(ImageF &image) {
    size_t count = (size_t)image.width * image.height;
    for (size_t i = 0; i < count; i++) {
        float *pixel = image.values + 4 * i;
        if (pixel[3] > 0)
            for (int c = 0; c < 3; c++) pixel[c] /= pixel[3];
    }
}

// colours: 3 to repeat grey. Alpha comes out straight.
bool load_float(const char *path, Source &source, int colours, ImageF *image) {
    std::vector<float> pixels;
    if (!read_pixels(path, source, OIIO::TypeDesc::FLOAT, pixels)) return false;
    *image = imagef_create(upright_width(source), upright_height(source), colours + (source.alpha >= 0));
    arrange(source, pixels, colours, image->values);
    if (source.premultiplied) divide_by_alpha(*image);
    return true;
}

bool load_bytes(const char *path, Source &source, Image8 *image) {
    if (source.premultiplied) { // divide in float, or the colour of nearly transparent pixels is lost
        ImageF floats;
        if (!load_float(path, source, 3, &floats)) return false;
        *image = image8_from_float(&floats);
        imagef_destroy(&floats);
        return true;
    }
    std::vector<uint8_t> pixels;
    if (!read_pixels(path, source, OIIO::TypeDesc::UINT8, pixels)) return false;
    *image = image8_create(upright_width(source), upright_height(source), 3 + (source.alpha >= 0));
    arrange(source, pixels, 3, image->bytes);
    return true;
}

bool measure(const Source &source, int *width, int *height, int *channels) {
    *width = upright_width(source);
    *height = upright_height(source);
    *channels = source.alpha >= 0 ? 4 : 3;
    return true;
}

bool is_jpeg(const char *path) { return file_has_ending(path, ".jpg") || file_has_ending(path, ".jpeg"); }
bool is_byte_format(const char *path) { return file_has_ending(path, ".png") || is_jpeg(path); }
bool is_exr(const char *path) { return file_has_ending(path, ".exr"); }
bool is_float_format(const char *path) {
    return is_exr(path) || file_has_ending(path, ".tif") || file_has_ending(path, ".tiff");
}

// The file is made in memory and written by file_write(): the image libraries overlook a full disk (PNG) or end the
// program (JPEG).
bool save(const char *path, int width, int height, int channels, OIIO::TypeDesc type, const void *pixels) {
    if (channels == 4 && is_jpeg(path))
        return fail("cannot write image %s: JPEG has no alpha; choose a name that ends in .png", path);
    OIIO::ImageSpec spec(width, height, channels, type);
    spec.attribute("oiio:UnassociatedAlpha", is_exr(path) ? 0 : 1);
    spec.attribute("DateTime", "2000:01:01 00:00:00"); // else EXR holds the time of writing: same pixels, same bytes
    if (is_jpeg(path)) spec.attribute("CompressionQuality", jpeg_quality);

    OIIO::Filesystem::IOVecOutput memory;
    std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(path, &memory);
    if (!output) return fail("cannot write image %s: %s", path, one_line(OIIO::geterror()).c_str());
    if (!output->open(path, spec) || !output->write_image(type, pixels) || !output->close())
        return fail("cannot write image %s: %s", path, one_line(output->geterror()).c_str());
    return file_write(path, memory.buffer().data(), memory.buffer().size());
}

bool save_float(const char *path, const ImageF *image) {
    std::vector<float> values(image->values, image->values + (size_t)image->width * image->height * image->channels);
    if (image->channels == 4 && is_exr(path))
        for (size_t i = 0; i < values.size(); i += 4)
            for (int c = 0; c < 3; c++) values[i + c] *= values[i + 3];
    return save(path, image->width, image->height, image->channels, OIIO::TypeDesc::FLOAT, values.data());
}

bool fail_ending(const char *path) {
    return fail("cannot write image %s: its name must end in .png, .jpg, .exr or .tif", path);
}

} // namespace

bool image_probe(const char *path, int *width, int *height, int *channels) {
    Source source;
    return open_source(path, source) && measure(source, width, height, channels);
}

bool image_probe_stored(const char *path, int *width, int *height, int *channels) {
    Source source;
    if (!open_source(path, source)) return false;
    source.orientation = orientation_upright;
    return measure(source, width, height, channels);
}

bool image_load8(const char *path, Image8 *image) {
    *image = Image8{};
    Source source;
    return open_source(path, source) && load_bytes(path, source, image);
}

bool image_load8_stored(const char *path, Image8 *image) {
    *image = Image8{};
    Source source;
    if (!open_source(path, source)) return false;
    source.orientation = orientation_upright;
    return load_bytes(path, source, image);
}

bool image_loadf(const char *path, ImageF *image) {
    *image = ImageF{};
    Source source;
    if (!open_source(path, source)) return false;
    return load_float(path, source, source.alpha >= 0 ? 3 : source.colours, image);
}

bool image_save8(const char *path, const Image8 *image) {
    if (is_byte_format(path))
        return save(path, image->width, image->height, image->channels, OIIO::TypeDesc::UINT8, image->bytes);
    if (!is_float_format(path)) return fail_ending(path);
    ImageF floats = imagef_from_8(image);
    bool ok = save_float(path, &floats);
    imagef_destroy(&floats);
    return ok;
}

bool image_savef(const char *path, const ImageF *image) {
    if (is_float_format(path)) return save_float(path, image);
    if (!is_byte_format(path)) return fail_ending(path);
    Image8 bytes = image8_from_float(image);
    bool ok = image_save8(path, &bytes);
    image8_destroy(&bytes);
    return ok;
}

bool image_save_gif(const char *path, const Image8 *frames, int count, int delay_ms) {
    if (!file_has_ending(path, ".gif")) return fail("cannot write film %s: its name must end in .gif", path);
    if (count < 1) return fail("cannot write film %s: it has no frames", path);
    OIIO::ImageSpec spec(frames[0].width, frames[0].height, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("FramesPerSecond", 1000.0f / (float)(delay_ms < 10 ? 10 : delay_ms));
    std::vector<OIIO::ImageSpec> specs(count, spec);

    OIIO::Filesystem::IOVecOutput memory;
    std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(path, &memory);
    if (!output) return fail("cannot write film %s: %s", path, one_line(OIIO::geterror()).c_str());
    bool good = output->open(path, count, specs.data());
    for (int i = 0; good && i < count; i++) {
        if (frames[i].width != spec.width || frames[i].height != spec.height || frames[i].channels != 3)
            return fail("cannot write film %s: frame %d is %d x %d of %d channels, want %d x %d of 3 as the first",
                        path, i, frames[i].width, frames[i].height, frames[i].channels, spec.width, spec.height);
        good = (i == 0 || output->open(path, spec, OIIO::ImageOutput::AppendSubimage)) &&
               output->write_image(OIIO::TypeDesc::UINT8, frames[i].bytes);
    }
    if (!good || !output->close()) return fail("cannot write film %s: %s", path, one_line(output->geterror()).c_str());
    return file_write(path, memory.buffer().data(), memory.buffer().size());
}
