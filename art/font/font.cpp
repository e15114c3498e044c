#include "art/font/font.h"

#include "art/font/font_module.h"
#include "engine/base/diagnostic.h"
#include "engine/base/input_file.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <stdexcept>

namespace sikku {
namespace {

constexpr std::size_t most_font_bytes = std::size_t{64} << 20;

const FontModule& font_module() {
    static const auto& loaded = *static_cast<const FontModule*>(
        load_module("sikku_font", font_module_version(SIKKU_VERSION),
                    "fonts need the font module, which could not be loaded (on Debian 12, install libharfbuzz0b, "
                    "libfribidi0 and libfontconfig1; single strokes do not need it)"));
    return loaded;
}

FoundFont installed_font(const std::string& name) {
    FoundFont found = font_module().find(name);
    if (found.is_wanted) return found;
    throw std::runtime_error(fmt::format(
        "no font named '{}' is installed; {}", printable(name, 80),
        found.name.empty() ? "there are no fonts" : "the nearest is '" + printable(found.name, 80) + "'"));
}

std::string bytes_of(const std::filesystem::path& file) {
    const InputFile input(file);
    if (input.size() > most_font_bytes)
        throw std::runtime_error("the font file is too large; expected at most 64 MB");
    return input.read(0, input.size());
}

}  // namespace

bool is_font_file(std::string_view name) {
    const std::string lower = lower_case(name);
    return lower.ends_with(".ttf") || lower.ends_with(".otf") || lower.ends_with(".ttc") || lower.ends_with(".otc");
}

std::shared_ptr<const Font> open_font(const std::string& name, const std::filesystem::path& folder) {
    FoundFont found;
    if (is_font_file(name)) {
        found.file = (folder / name).string();
    } else {
        found = installed_font(name);
    }
    return font_module().open(bytes_of(found.file), found);
}

}  // namespace sikku
