// python/module.cpp: the compiled part of the package `sikku`. The package around it, python/src/sikku, defines the
// public names, defaults and documentation.
#include "art/analysis.h"
#include "art/kolam/kolam_text.h"
#include "art/prints.h"
#include "art/sheets.h"
#include "engine/measurement.h"
#include "music/scores.h"
#include "python/errors.h"
#include "python/interruption.h"
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

/// @param text  text of the pattern; if absent, `name` is a file or a bundled pattern
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
            content = read_pattern(PatternFile{name, found.path}, monitor);
        }
        const std::array interpreters = {&prints(), &scores()};
        Diagnostics diagnostics;
        Document document = compile(std::move(shown), std::move(content), {variant, to_settings(settings)},
                                    interpreters, diagnostics);
        diagnostics.throw_if_errors();
        return Loaded{std::move(document), diagnostics.sorted()};
    });
}

py::object content_of(const std::string& bytes, bool is_text) {
    if (is_text) return to_text(bytes);
    return py::bytes(bytes);
}

/// Makes an output in memory. Returns (contents by name, remarks).
py::tuple make_outputs(const Document& document, const std::string& interpreter_name, const std::string& format,
                       const TextPairs& values) {
    const Interpreter& interpreter = interpreter_of(interpreter_name);
    const FormatName* row = find_format(interpreter.formats(), format);
    MemoryDestination memory;
    const Made made = long_call([&](const Monitor& monitor) {
        const Assignment assigned = assign(interpreter, document, to_values(values));
        return interpreter.plan(assigned.document, format, assigned.options)
            ->make(memory, "memory." + format, monitor);
    });
    py::dict outputs;
    for (const auto& [name, bytes] : memory.outputs()) {
        outputs[to_text(name)] = content_of(bytes, row && row->is_text);
    }
    return py::make_tuple(outputs, to_list(made.remarks));
}

/// Writes an output and returns the remarks.
py::list write_outputs(const Document& document, const std::string& interpreter_name, const std::string& format,
                       const TextPairs& values, const std::string& path) {
    const Interpreter& interpreter = interpreter_of(interpreter_name);
    const Made made = long_call([&](const Monitor& monitor) {
        const Assignment assigned = assign(interpreter, document, to_values(values));
        return interpreter.plan(assigned.document, format, assigned.options)->make(file_system(), path, monitor);
    });
    return to_list(made.remarks);
}

/// Writes several documents, each with its own options, on one sheet, and returns the remarks.
py::list write_sheet(const std::vector<std::pair<Document, TextPairs>>& drawings, const std::string& format,
                     const TextPairs& values, const std::string& path) {
    const Made made = long_call([&](const Monitor& monitor) {
        std::vector<SheetItem> items;
        for (const auto& [document, own] : drawings) items.push_back({document, to_values(own)});
        return plan_sheet(items, format, to_values(values))->make(file_system(), path, monitor);
    });
    return to_list(made.remarks);
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

/// Returns (arrays of the notes, end, tempo, beats of a bar, their unit).
py::tuple notes_of(const Document& document, const TextPairs& values) {
    const NoteList list = long_call([&](const Monitor& monitor) {
        const Assignment assigned = assign(scores(), document, to_values(values));
        return list_notes(std::span(&assigned.document, 1), assigned.options, monitor);
    });
    return py::make_tuple(to_arrays(list.notes), list.end, list.tempo, list.meter.beats, list.meter.unit);
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
    module.def("make", &make_outputs);
    module.def("write", &write_outputs);
    module.def("write_sheet", &write_sheet);
    module.def("measure", &measure_document);
    module.def("kolam", &examine_document);
    module.def("path", &path_of);
    module.def("notes", &notes_of);
    module.def("options", [](const std::string& name) { return list_options(interpreter_of(name).options()); });
    module.def("sheet_options", [] { return list_options(sheet_options()); });
    module.def("formats", [](const std::string& name) { return list_formats(interpreter_of(name)); });
    module.def("keys", &list_keys);
    module.attr("version") = SIKKU_VERSION;
    module.attr("ticks_per_quarter") = ticks_per_quarter;
}
