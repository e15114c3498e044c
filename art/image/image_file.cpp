#include "art/image/image_file.h"

#include "art/image/image_module.h"
#include "art/image/png_writer.h"
#include "art/module/module.h"
#include "engine/base/threads.h"
#include "engine/base/toml_file.h"

#include <sys/mman.h>

#include <algorithm>
#include <initializer_list>
#include <stdexcept>

namespace sikku {
namespace {

/// Rejects limits under which the libraries of the module would abort: they start threads and allocate memory on
/// loading.
void require_resources(int threads) {
    // One for the log of an unused library, the pools of OpenImageIO and OpenEXR, the bands of the picture.
    constexpr int at_load = 4;
    constexpr int least_pool = 3;
    const int bands = thread_count(threads);
    const int wanted = at_load + 2 * std::max({bands, thread_count(0), least_pool}) + bands;
    if (const int there = startable_threads(wanted); there < wanted) {
        throw std::runtime_error("pictures need " + std::to_string(wanted) + " threads, but only " +
                                 std::to_string(there) +
                                 " can be started; raise `ulimit -u` or `-v`, or use fewer threads");
    }
    constexpr std::size_t address_space = std::size_t{640} << 20;
    void* const reserved =
        ::mmap(nullptr, address_space, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (reserved == MAP_FAILED) {
        throw std::runtime_error("pictures need 640 MB of address space; raise `ulimit -v`");
    }
    ::munmap(reserved, address_space);
}

/// Never unloaded: OpenImageIO keeps threads of its own.
/// @param threads  threads for pictures (0: one for each core), as known to the first caller
const ImageModule& image_module(int threads = 0) {
    static const ImageModule& loaded = [threads]() -> const ImageModule& {
        require_resources(threads);
        return *static_cast<const ImageModule*>(load_module(
            "sikku_image", image_module_version(SIKKU_VERSION),
            "TIFF, JPEG, EXR and CMYK profiles need the OpenImageIO module, which could not be loaded (on Debian 12, "
            "install libopenimageio2.4 and liblcms2-2; PNG does not need it)"));
    }();
    return loaded;
}

/// Calls a function that reads a profile. @throws FileError instead of its std::runtime_error: the profile is a
/// faulty file
template <class Use>
auto use_profile(const Use& use) {
    try {
        return use();
    } catch (const std::runtime_error& error) {
        throw FileError(error.what());
    }
}

}  // namespace

void prepare_images(int threads) {
    image_module(threads);
}

std::unique_ptr<ImageWriter> open_image(const std::filesystem::path& path, const ImageSpec& spec) {
    return spec.format == "png" ? open_png(path, spec) : image_module().open(path, spec);
}

std::unique_ptr<InkProfile> open_inks(const std::filesystem::path& file) {
    const ImageModule& module = image_module();
    return use_profile([&] { return module.open_inks(file); });
}

void check_cmyk_profile(const std::filesystem::path& file) {
    const ImageModule& module = image_module();
    use_profile([&] { module.check_cmyk_profile(file); });
}

bool is_picture(std::string_view bytes) {
    using namespace std::string_view_literals;
    const auto is_any_of = [](std::string_view text, std::initializer_list<std::string_view> words) {
        return std::find(words.begin(), words.end(), text) != words.end();
    };
    return bytes.starts_with("\xFF\xD8\xFF"sv) || bytes.starts_with("\x89PNG\r\n\x1A\n"sv) ||
           is_any_of(bytes.substr(0, 4), {"II*\0"sv, "MM\0*"sv, "II+\0"sv, "MM\0+"sv}) ||
           bytes.starts_with("RIFF"sv) ||
           (bytes.size() >= 12 && bytes.substr(4, 4) == "ftyp"sv &&
            is_any_of(bytes.substr(8, 4), {"heic"sv, "heix"sv, "mif1"sv, "avif"sv})) ||
           (bytes.starts_with("BM"sv) && bytes.size() >= 18 && bytes.substr(6, 4) == "\0\0\0\0"sv);
}

}  // namespace sikku
