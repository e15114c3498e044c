#include "art/provenance/provenance.h"

#include "art/provenance/provenance_readers.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <system_error>

namespace sikku {
namespace {

using namespace std::string_view_literals;

bool begins_as_xml(std::string_view head) {
    if (head.starts_with("\xEF\xBB\xBF")) head.remove_prefix(3);
    const std::size_t first = head.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && head[first] == '<';
}

template <char... signature>
bool begins_with(std::string_view head) {
    constexpr char bytes[] = {signature...};
    return head.starts_with(std::string_view(bytes, sizeof bytes));
}

bool begins_as_tiff(std::string_view head) {
    return head.starts_with("II*\0"sv) || head.starts_with("MM\0*"sv) || head.starts_with("II+\0"sv) ||
           head.starts_with("MM\0+"sv);
}

bool begins_as_html(std::string_view head) {
    return begins_as_xml(head) && head.find("<!DOCTYPE html") != std::string_view::npos;
}

bool begins_as_musicxml(std::string_view head) {
    return begins_as_xml(head) && head.find("<score-partwise") != std::string_view::npos;
}

bool begins_as_gcode(std::string_view head) {
    return head.find("(recipe: sikku:") != std::string_view::npos;
}

bool begins_as_eps(std::string_view head) {
    return head.starts_with("%!PS-Adobe-") &&
           head.substr(0, head.find('\n')).find(" EPSF-") != std::string_view::npos;
}

bool begins_as_obj(std::string_view head) {
    return head.starts_with("# ") && head.find("\n# sikku:") != std::string_view::npos;
}

bool begins_as_lilypond(std::string_view head) {
    return head.starts_with("\\version \"");
}

bool begins_as_mxl(std::string_view head) {
    return head.starts_with("PK\x03\x04") && head.find("META-INF/container.xml") != std::string_view::npos;
}

bool begins_as_abc(std::string_view head) {
    return head.starts_with("%abc");
}

bool begins_as_csound(std::string_view head) {
    return head.starts_with("<CsoundSynthesizer>");
}

bool begins_as_csound_score(std::string_view head) {
    return head.starts_with("; score for Csound\n");
}

bool begins_as_strudel(std::string_view head) {
    return head.starts_with("// https://strudel.cc/#");
}

bool begins_as_wav(std::string_view head) {
    return head.starts_with("RIFF") && head.find("WAVE") == 8;
}

bool begins_as_stl(std::string_view head) {
    return head.starts_with("Binary STL in millimetres, sikku ");
}

/// Sound files do not contain a pattern.
std::optional<Provenance> read_nothing(const InputFile& /*file*/) {
    return std::nullopt;
}

/// An STL has 80 bytes for texts.
std::optional<Provenance> read_stl_provenance(const InputFile& /*file*/) {
    throw UnreadableFile("has no room for the pattern; an OBJ or glTF of the same relief contains it");
}

struct Format {
    std::string_view name;                  ///< with its article
    bool (*begins)(std::string_view head);  ///< true if a file with this head has the format
    std::optional<Provenance> (*read)(const InputFile& file);
};
constexpr std::size_t head_bytes = 1024;
constexpr std::array<Format, 24> formats = {{
    {"a PNG file", begins_with<'\x89', 'P', 'N', 'G', '\r', '\n', '\x1A', '\n'>, read_png_provenance},
    {"a TIFF file", begins_as_tiff, read_tiff_provenance},
    {"a JPEG file", begins_with<'\xFF', '\xD8', '\xFF'>, read_jpeg_provenance},
    {"an EXR file", begins_with<'\x76', '\x2F', '\x31', '\x01'>, read_exr_provenance},
    {"a PDF file", begins_with<'%', 'P', 'D', 'F', '-'>, read_pdf_provenance},
    {"an EPS file", begins_as_eps, read_comment_provenance},
    {"a GIF file", begins_with<'G', 'I', 'F', '8'>, read_comment_provenance},
    {"a GLB file", begins_with<'g', 'l', 'T', 'F'>, read_comment_provenance},
    {"an HP-GL file", begins_with<'I', 'N', ';'>, read_comment_provenance},
    {"a G-code file", begins_as_gcode, read_comment_provenance},
    {"a DXF file", begins_with<'9', '9', '9', '\n'>, read_comment_provenance},
    {"an OBJ file", begins_as_obj, read_comment_provenance},
    {"an STL file", begins_as_stl, read_stl_provenance},
    {"a WAV file", begins_as_wav, read_nothing},
    {"a FLAC file", begins_with<'f', 'L', 'a', 'C'>, read_nothing},
    {"a LilyPond file", begins_as_lilypond, read_lilypond_provenance},
    {"a compressed MusicXML file", begins_as_mxl, read_musicxml_provenance},
    {"an ABC file", begins_as_abc, read_lilypond_provenance},
    {"a Csound file", begins_as_csound, read_csound_provenance},
    {"a Csound score", begins_as_csound_score, read_csound_provenance},
    {"a Strudel program", begins_as_strudel, read_strudel_provenance},
    {"an HTML page", begins_as_html, read_page_provenance},
    {"a MusicXML file", begins_as_musicxml, read_musicxml_provenance},
    {"an SVG file", begins_as_xml, read_svg_provenance},
}};

}  // namespace

std::optional<KnownFormat> known_format(const std::filesystem::path& file) {
    try {
        const std::string head = InputFile(file).read(0, head_bytes);
        const auto format =
            std::find_if(formats.begin(), formats.end(), [&](const Format& each) { return each.begins(head); });
        if (format == formats.end()) return std::nullopt;
        return KnownFormat{format->name, format->read != read_nothing && format->read != read_stl_provenance};
    } catch (const std::system_error&) {
        return std::nullopt;
    }
}

std::optional<Provenance> read_provenance(const std::filesystem::path& file) {
    std::optional<InputFile> input;
    try {
        input.emplace(file);
    } catch (const std::system_error&) {
        return std::nullopt;
    }
    try {
        const std::string head = input->read(0, head_bytes);
        const auto format =
            std::find_if(formats.begin(), formats.end(), [&](const Format& each) { return each.begins(head); });
        if (format == formats.end()) return std::nullopt;
        std::string refusal = "contains no pattern";
        try {
            auto found = format->read(*input);
            if (format->read == read_nothing) refusal = "contains sound and no pattern";
            if (found && !found->pattern.empty()) {
                limit_made(found->made);
                return found;
            }
        } catch (const UnreadableFile& error) {
            refusal = error.what();
        }
        throw std::runtime_error(
            fmt::format("{}: this {} {}", file.string(), format->name.substr(format->name.find(' ') + 1), refusal));
    } catch (const std::system_error& error) {
        throw std::runtime_error(fmt::format("{}: {}", file.string(), error.code().message()));
    }
}

}  // namespace sikku
