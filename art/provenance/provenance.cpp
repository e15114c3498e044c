#include "art/provenance/provenance.h"

#include "art/print/recipe_comments.h"
#include "art/provenance/provenance_readers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <system_error>
#include <utility>

namespace sikku {
namespace {

using namespace std::string_view_literals;

bool begins_as_xml(std::string_view head) {
    if (head.starts_with("\xEF\xBB\xBF")) head.remove_prefix(3);
    const std::size_t first = head.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && head[first] == '<';
}

bool begins_as_eps(std::string_view head) {
    return head.substr(0, head.find('\n')).find(" EPSF-") != std::string_view::npos;
}

bool begins_as_wav(std::string_view head) {
    return head.find("WAVE") == 8;
}

/// G-code, HP-GL, DXF, EPS, OBJ, glTF and GIF, whose texts are comments: at the beginning or at the end of the file.
std::optional<Provenance> read_comment_provenance(const InputFile& file) {
    // Maximum size of the comments of a recipe, with their marks and the bytes around them.
    constexpr std::uint64_t most_bytes = 3 * most_commented_bytes;
    const std::uint64_t tail = file.size() - std::min(file.size(), most_bytes);
    for (const std::uint64_t begin : {std::uint64_t{0}, tail}) {
        if (auto found = read_recipe_comments(file.read(begin, most_bytes))) {
            return Provenance{std::move(found->first), std::move(found->second)};
        }
    }
    return std::nullopt;
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
    std::string_view name;    ///< with its article
    std::string_view begin;   ///< the first bytes of a file
    std::string_view within;  ///< a text in the head of a file
    std::optional<Provenance> (*read)(const InputFile& file);
    bool (*check)(std::string_view head) = nullptr;  ///< what else a head must fulfil

    bool begins(std::string_view head) const {
        return head.starts_with(begin) && head.find(within) != std::string_view::npos && (!check || check(head));
    }
};
constexpr std::size_t head_bytes = 1024;
constexpr std::array formats = {
    Format{"a PNG file", "\x89PNG\r\n\x1A\n", "", read_png_provenance},
    Format{"a TIFF file", "II*\0"sv, "", read_tiff_provenance},
    Format{"a TIFF file", "MM\0*"sv, "", read_tiff_provenance},
    Format{"a TIFF file", "II+\0"sv, "", read_tiff_provenance},
    Format{"a TIFF file", "MM\0+"sv, "", read_tiff_provenance},
    Format{"a JPEG file", "\xFF\xD8\xFF", "", read_jpeg_provenance},
    Format{"an EXR file", "\x76\x2F\x31\x01", "", read_exr_provenance},
    Format{"a PDF file", "%PDF-", "", read_pdf_provenance},
    Format{"an EPS file", "%!PS-Adobe-", "", read_comment_provenance, begins_as_eps},
    Format{"a GIF file", "GIF8", "", read_comment_provenance},
    Format{"a GLB file", "glTF", "", read_comment_provenance},
    Format{"an HP-GL file", "IN;", "", read_comment_provenance},
    Format{"a G-code file", "", "(recipe: sikku:", read_comment_provenance},
    Format{"a G-code file", "", "; recipe: sikku:", read_comment_provenance},
    Format{"a DXF file", "999\n", "", read_comment_provenance},
    Format{"an OBJ file", "# ", "\n# sikku:", read_comment_provenance},
    Format{"an STL file", "Binary STL in millimetres, sikku ", "", read_stl_provenance},
    Format{"a WAV file", "RIFF", "", read_nothing, begins_as_wav},
    Format{"a FLAC file", "fLaC", "", read_nothing},
    Format{"a LilyPond file", "\\version \"", "", read_lilypond_provenance},
    Format{"a compressed MusicXML file", "PK\x03\x04", "META-INF/container.xml", read_musicxml_provenance},
    Format{"an ABC file", "%abc", "", read_lilypond_provenance},
    Format{"a Csound file", "<CsoundSynthesizer>", "", read_csound_provenance},
    Format{"a Csound score", "; score for Csound\n", "", read_csound_provenance},
    Format{"a Strudel program", "// https://strudel.cc/#", "", read_strudel_provenance},
    Format{"an HTML page", "", "<!DOCTYPE html", read_page_provenance, begins_as_xml},
    Format{"a MusicXML file", "", "<score-partwise", read_musicxml_provenance, begins_as_xml},
    Format{"an SVG file", "", "", read_svg_provenance, begins_as_xml},
};

const Format* format_of(const InputFile& file) {
    const std::string head = file.read(0, head_bytes);
    const auto* const found =
        std::find_if(formats.begin(), formats.end(), [&](const Format& each) { return each.begins(head); });
    return found == formats.end() ? nullptr : found;
}

}  // namespace

std::optional<KnownFormat> known_format(const std::filesystem::path& file) {
    try {
        const Format* const format = format_of(InputFile(file));
        if (!format) return std::nullopt;
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
        const Format* const format = format_of(*input);
        if (!format) return std::nullopt;
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
