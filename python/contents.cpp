#include "python/contents.h"

#include "engine/base/input_file.h"
#include "engine/import/import.h"
#include "engine/language/foreign_text.h"
#include "music/score/midi_texts.h"
#include "python/errors.h"
#include "python/interruption.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string_view>

namespace py = pybind11;

namespace sikku {
namespace {

py::str text_of(const Span& span) {
    return to_text(std::string(span.trimmed().view()));
}
py::object text_or_none(const std::optional<Span>& span) {
    if (!span) return py::none();
    return text_of(*span);
}

SourcePointer read_source(const std::string& path, const Monitor& monitor) {
    std::error_code error;
    if (!std::filesystem::exists(path, error)) throw NotFound(path + ": No such file or directory", false);
    return std::make_shared<const Source>(path, read_file(path, path, most_import_bytes, monitor));
}

}  // namespace

std::vector<std::pair<std::string, std::string>> settings_of(const Document& document) {
    std::vector<std::pair<std::string, std::string>> settings;
    for (const Setting& setting : document.overrides().settings) settings.emplace_back(setting.key, setting.value);
    return settings;
}

py::dict key_values_of(const Document& document) {
    py::dict keys;
    for (const Key& key : document.pattern().keys) keys[to_text(key.name)] = text_of(key.value);
    return keys;
}

py::dict defines_of(const Document& document) {
    py::dict defines;
    for (const Define& define : document.pattern().defines) defines[text_of(define.name)] = text_of(define.value);
    return defines;
}

py::dict variants_of(const Document& document) {
    py::dict variants;
    for (const Variant& variant : document.pattern().variants) {
        py::dict settings;
        for (const Key& setting : variant.settings) settings[to_text(setting.name)] = text_of(setting.value);
        variants[text_of(variant.name)] = settings;
    }
    return variants;
}

py::list productions_of(const Document& document) {
    const py::object type = py::module_::import("sikku.data").attr("Production");
    py::list list;
    const auto add = [&](const std::vector<ProductionText>& productions, const py::object& table, bool interprets) {
        for (const ProductionText& one : productions) {
            list.append(type(text_of(one.predecessor), text_of(one.successor), text_or_none(one.left),
                             text_or_none(one.right), text_or_none(one.condition), text_or_none(one.weight), table,
                             interprets));
        }
    };
    const Pattern& pattern = document.pattern();
    add(pattern.common, py::none(), false);
    for (const TableText& table : pattern.tables) add(table.productions, text_of(table.name), false);
    add(pattern.interpret, py::none(), true);
    return list;
}

py::tuple import_systems(const std::string& path, const std::optional<std::string>& view) {
    Diagnostics diagnostics;
    const std::vector<ImportedSystem> systems = long_call([&](const Monitor& monitor) {
        const SourcePointer file = read_source(path, monitor);
        const auto format = import_format(file->text());
        if (!format) {
            const ForeignKind kind = foreign_kind(file->text());
            throw std::runtime_error(fmt::format("{}: {}; only files of cpfg and Fractint can be imported", path,
                                                 kind == ForeignKind::none
                                                     ? "the program it was written for is not recognised"
                                                     : fmt::format("this is {}", foreign_kind_name(kind))));
        }
        if (*format == ImportFormat::fractint) {
            if (view) throw std::runtime_error("view: a Fractint collection has no view file");
            return import_fractint(file, diagnostics);
        }
        const std::filesystem::path beside = view ? std::filesystem::path(*view) : view_file_beside(path);
        return import_cpfg(file, beside.empty() ? nullptr : read_source(beside.string(), monitor), diagnostics);
    });
    if (systems.empty()) diagnostics.throw_if_errors();
    py::list list;
    for (const ImportedSystem& one : systems) {
        py::list losses;
        for (const std::string& loss : one.losses) losses.append(to_text(loss));
        list.append(py::make_tuple(to_text(one.name), one.line, to_text(one.pattern), losses, one.draws));
    }
    return py::make_tuple(list, to_list(diagnostics.sorted()));
}

std::optional<Provenance> stored_pattern(const std::filesystem::path& file) {
    if (auto print = read_provenance(file)) return print;
    auto texts = read_midi_file_texts(file);
    if (!texts) return std::nullopt;
    return Provenance{std::move(texts->pattern), std::move(texts->made)};
}

py::object provenance_of(const std::string& path) {
    const auto found = long_call([&](const Monitor&) { return stored_pattern(path); });
    if (!found) return py::none();
    return py::make_tuple(to_text(found->pattern), to_text(found->made));
}

void refuse_foreign(const std::string& name, const std::string& text) {
    const ForeignKind kind = foreign_kind(text);
    if (kind == ForeignKind::none) return;
    const bool is_known = kind == ForeignKind::fractint || kind == ForeignKind::cpfg;
    throw std::runtime_error(fmt::format("{}: this is {}, not a pattern{}", name, foreign_kind_name(kind),
                                         is_known ? "; sikku.import_systems() reads it" : ""));
}

}  // namespace sikku
