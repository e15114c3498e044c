// python/module.cpp: the compiled part of the package `sikku`. The package around it, python/src/sikku, defines the
// public names, defaults and documentation.
#include "art/analysis.h"
#include "art/kolam/kolam_text.h"
#include "art/prints.h"
#include "art/sheets.h"
#include "art/workbook/workbook.h"
#include "engine/measurement.h"
#include "music/scores.h"
#include "python/collections.h"
#include "python/contents.h"
#include "python/errors.h"
#include "python/interruption.h"
#include "python/kolams.h"
#include "python/tiles.h"
#include "python/values.h"
#include "python/word_iterator.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <optional>

namespace py = pybind11;

namespace sikku {
namespace {

/// A document, and the warnings about its keys.
struct Loaded {
    Document document;
    std::vector<Diagnostic> warnings;
};

/// @param text  text of the pattern; if absent, `name` is a file, a print or score of a pattern, or a bundled pattern
Loaded load_document(const std::string& name, const std::optional<std::string>& text, const std::string& variant,
                     const TextPairs& settings) {
    return long_call([&](const Monitor& monitor) {
        std::string shown = name;
        std::string content;
        if (text) {
            content = *text;
        } else {
            const PatternFile found = find_pattern(name);
            shown = found.name;
            auto stored = stored_pattern(found.path);
            content = stored ? std::move(stored->pattern) : read_pattern(PatternFile{name, found.path}, monitor);
        }
        refuse_foreign(shown, content);
        const std::array interpreters = {&prints(), &scores()};
        Diagnostics diagnostics;
        Document document = compile(std::move(shown), std::move(content), {variant, to_settings(settings)},
                                    interpreters, diagnostics);
        diagnostics.throw_if_errors();
        return Loaded{std::move(document), diagnostics.sorted()};
    });
}

/// Makes an output in memory. Returns (contents by name, remarks).
py::tuple make_outputs(const Document& document, const std::string& interpreter_name, const std::string& format,
                       const TextPairs& values, const py::object& progress) {
    const Interpreter& interpreter = interpreter_of(interpreter_name);
    MemoryDestination memory;
    const auto make = [&](const Monitor& monitor) {
        const Assignment assigned = assign(interpreter, document, to_values(values));
        return interpreter.plan(assigned.document, format, assigned.options)
            ->make(memory, "memory." + format, monitor);
    };
    const Made made = long_call(make, progress);
    return py::make_tuple(to_dict(memory, find_format(interpreter.formats(), format)), to_list(made.remarks));
}

/// Writes an output and returns the remarks.
py::list write_outputs(const Document& document, const std::string& interpreter_name, const std::string& format,
                       const TextPairs& values, const std::string& path, const py::object& progress) {
    const Interpreter& interpreter = interpreter_of(interpreter_name);
    const auto make = [&](const Monitor& monitor) {
        const Assignment assigned = assign(interpreter, document, to_values(values));
        return interpreter.plan(assigned.document, format, assigned.options)->make(file_system(), path, monitor);
    };
    return to_list(long_call(make, progress).remarks);
}

using DocumentsWithOptions = std::vector<std::pair<Document, TextPairs>>;

std::vector<SheetItem> to_items(const DocumentsWithOptions& drawings) {
    std::vector<SheetItem> items;
    for (const auto& [document, own] : drawings) items.push_back({document, to_values(own)});
    return items;
}

/// Writes several documents, each with its own options, on one sheet, and returns the remarks.
py::list write_sheet(const DocumentsWithOptions& drawings, const std::string& format, const TextPairs& values,
                     const std::string& path, const py::object& progress) {
    const auto make = [&](const Monitor& monitor) {
        return plan_sheet(to_items(drawings), format, to_values(values))->make(file_system(), path, monitor);
    };
    return to_list(long_call(make, progress).remarks);
}

/// Writes a workbook of several documents, each with its own options, and returns the remarks.
py::list write_workbook(const DocumentsWithOptions& kolams, const TextPairs& values, const std::string& path,
                        const py::object& progress) {
    const auto make = [&](const Monitor& monitor) {
        return plan_workbook(to_items(kolams), to_values(values))->make(file_system(), path, monitor);
    };
    return to_list(long_call(make, progress).remarks);
}

/// Returns (array of shape (height, width, 4), remarks): red, green, blue and straight alpha, rows from the top.
py::tuple pixels_of(const Document& document, const TextPairs& values, const py::object& progress) {
    const auto draw = [&](const Monitor& monitor) { return draw_pixels(document, to_values(values), monitor); };
    DrawnPixels drawn = long_call(draw, progress);
    const py::list remarks = to_list(drawn.remarks);
    return py::make_tuple(to_array(std::move(drawn)), remarks);
}

py::str measure_document(const Document& document, double budget) {
    return to_text(long_call([&](const Monitor& monitor) { return measure_as_json(document, budget, monitor); }));
}

py::str examine_document(const Document& document, double budget) {
    return to_text(long_call([&](const Monitor& monitor) {
        const KolamExamination examined = examine_kolam(document, budget, monitor);
        return kolam_json(document.text("title"), document.grammar().steps(), examined);
    }));
}

py::tuple path_of(const Document& document, double budget) {
    return to_arrays(long_call([&](const Monitor& monitor) { return drawn_lines(document, budget, monitor); }));
}

py::tuple notes_of(const Document& document, const TextPairs& values) {
    return to_tuple(long_call([&](const Monitor& monitor) {
        const Assignment assigned = assign(scores(), document, to_values(values));
        return list_notes(std::span(&assigned.document, 1), assigned.options, monitor);
    }));
}

/// Returns (name, kind, title, source) for each bundled pattern.
py::list list_patterns() {
    py::list list;
    for (const LibraryPattern& known : PatternLibrary::bundled().patterns()) {
        Diagnostics diagnostics;
        const std::string text = read_pattern(PatternFile{known.name, known.file});
        const Pattern pattern = parse_pattern(known.name, text, diagnostics);
        list.append(
            py::make_tuple(known.name, known.kind, to_text(pattern.text("title")), to_text(pattern.text("source"))));
    }
    return list;
}

void add_documents(py::module_& module) {
    py::class_<Document>(module, "Document", "A pattern that was read, checked and compiled. Immutable.")
        .def_property_readonly("name", [](const Document& self) { return to_text(self.source().name()); })
        .def_property_readonly("source_text", [](const Document& self) { return to_text(self.source().text()); })
        .def_property_readonly("steps", [](const Document& self) { return self.grammar().steps(); })
        .def_property_readonly("is_melody", [](const Document& self) { return sets_keys_of(scores(), self); })
        .def_property_readonly("variant", [](const Document& self) { return to_text(self.overrides().variant); })
        .def_property_readonly("settings", &settings_of)
        .def_property_readonly("keys", &key_values_of)
        .def_property_readonly("defines", &defines_of)
        .def_property_readonly("variants", &variants_of)
        .def_property_readonly("productions", &productions_of)
        .def("key", [](const Document& self, const std::string& key) { return to_text(self.text(key)); })
        .def("with_settings", [](const Document& self, const TextPairs& settings) {
            return long_call([&](const Monitor&) { return self.with(to_settings(settings)); });
        });
    module.def("load", [](const std::string& name, const std::optional<std::string>& text, const std::string& variant,
                          const TextPairs& settings) {
        const Loaded loaded = load_document(name, text, variant, settings);
        return py::make_tuple(loaded.document, to_list(loaded.warnings));
    });
    module.def("patterns", &list_patterns);
    module.def("import_systems", &import_systems);
    module.def("provenance", &provenance_of);
}

void add_collections(py::module_& module) {
    py::class_<LoadedArrangement>(module, "Arrangement", "An arrangement that was read and compiled. Immutable.")
        .def_property_readonly("title", [](const LoadedArrangement& self) { return to_text(self.arrangement.title); })
        .def_property_readonly("text", [](const LoadedArrangement& self) { return to_text(self.arrangement.text); })
        .def_property_readonly("folder",
                               [](const LoadedArrangement& self) { return py::bytes(self.folder.string()); })
        .def_property_readonly("documents", [](const LoadedArrangement& self) {
            std::vector<Document> documents;
            for (const Track& track : self.arrangement.tracks) documents.push_back(track.document);
            return documents;
        });
    module.def("load_arrangement", &load_arrangement);
    module.def("make_piece", &make_piece);
    module.def("write_piece", &write_piece);
    module.def("notes_of_piece", &notes_of_piece);
    module.def("make_gallery",
               [](std::vector<std::string> patterns, std::string file, std::string folder, std::string poster,
                  std::string contact, std::map<std::string, std::string> keys, bool force, bool keep_going,
                  double memory, int threads, const py::object& progress) {
                   return make_gallery({std::move(patterns), std::move(file), std::move(folder), std::move(poster),
                                        std::move(contact), std::move(keys), force, keep_going, memory, threads},
                                       progress);
               });
}

void add_words(py::module_& module) {
    py::class_<WordIterator>(module, "WordIterator", "Modules of a word in lists, derived as they are read.")
        .def(py::init<const Document&, bool>())
        .def("__iter__", [](const py::object& self) { return self; })
        .def("__next__", &WordIterator::next)
        .def("close", &WordIterator::close, "End the derivation; no further modules follow.");
    py::module_::import("atexit").attr("register")(py::cpp_function(&WordIterator::close_all));
}

}  // namespace
}  // namespace sikku

PYBIND11_MODULE(_core, module) {
    using namespace sikku;
    module.doc() = "The compiled part of sikku; use the package around it.";
    register_errors();
    add_documents(module);
    add_words(module);
    add_collections(module);
    module.def("make", &make_outputs);
    module.def("write", &write_outputs);
    module.def("write_sheet", &write_sheet);
    module.def("write_workbook", &write_workbook);
    module.def("measure", &measure_document);
    module.def("kolam", &examine_document);
    module.def("path", &path_of);
    module.def("pixels", &pixels_of);
    module.def("tiles", &tiles_of);
    module.def("make_kolam", &make_kolam);
    module.def("make_radial_kolam", &make_radial_kolam);
    module.def("read_kolam", &read_kolam);
    module.def("tile_counts", &count_tiles);
    module.def("notes", &notes_of);
    module.def("options", [](const std::string& name) { return list_options(interpreter_of(name).options()); });
    module.def("sheet_options", [] { return list_options(sheet_options()); });
    module.def("workbook_options", [] { return list_options(workbook_options()); });
    module.def("formats", [](const std::string& name) { return list_formats(interpreter_of(name)); });
    module.def("keys", &list_keys);
    module.attr("version") = SIKKU_VERSION;
    module.attr("ticks_per_quarter") = ticks_per_quarter;
}
