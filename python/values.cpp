#include "python/values.h"

#include "engine/base/keys.h"
#include "python/errors.h"

#include <array>
#include <memory>

namespace py = pybind11;

namespace sikku {
namespace {

/// An array that owns the memory of the vector.
template <class Number, class Element>
py::array array_of(std::vector<Element> vector, py::array::ShapeContainer shape) {
    auto kept = std::make_unique<std::vector<Element>>(std::move(vector));
    auto* const first = reinterpret_cast<Number*>(kept->data());
    const py::capsule owner(kept.get(), [](void* memory) { delete static_cast<std::vector<Element>*>(memory); });
    static_cast<void>(kept.release());
    return py::array_t<Number>(std::move(shape), first, owner);
}

template <class Number, class Get>
py::array column(const std::vector<Note>& notes, const Get& get) {
    py::array_t<Number> result(static_cast<py::ssize_t>(notes.size()));
    Number* next = result.mutable_data();
    for (const Note& note : notes) *next++ = get(note);
    return result;
}

}  // namespace

OptionValues to_values(const TextPairs& pairs) {
    OptionValues values;
    for (const auto& [name, text] : pairs) values.push_back({name, text});
    return values;
}

std::vector<Setting> to_settings(const TextPairs& pairs) {
    std::vector<Setting> settings;
    for (const auto& [name, text] : pairs) {
        // Named as the argument.
        settings.emplace_back(name == "derivation length" ? "n" : name, name, text);
    }
    return settings;
}

const Interpreter& interpreter_of(const std::string& name) {
    if (name == "prints") return prints();
    if (name == "scores") return scores();
    throw py::value_error("expected 'prints' or 'scores'");
}

py::list to_list(const std::vector<Remark>& remarks) {
    py::list list;
    for (const Remark& remark : remarks) list.append(py::make_tuple(remark.is_warning, to_text(remark.text)));
    return list;
}

py::dict to_dict(const MemoryDestination& outputs, const FormatName* format) {
    py::dict dict;
    for (const auto& [name, bytes] : outputs.outputs()) {
        const bool is_text = format && format->is_text;
        dict[to_text(name)] = is_text ? py::object(to_text(bytes)) : py::object(py::bytes(bytes));
    }
    return dict;
}

py::list list_options(std::span<const OptionInfo* const> options) {
    constexpr std::array kinds = {"text", "number", "whole", "flag"};  // in the order of OptionKind
    py::list list;
    for (const OptionInfo* option : options) {
        list.append(py::make_tuple(option->name, option->is_list, kinds[static_cast<std::size_t>(option->kind)],
                                   option->value, option->help));
    }
    return list;
}

py::list list_formats(const Interpreter& interpreter) {
    py::list list;
    for (const FormatName& format : interpreter.formats()) {
        list.append(py::make_tuple(format.extension, format.alias, format.is_text));
    }
    return list;
}

py::list list_keys() {
    py::list list;
    for (const KeyInfo& key : language_keys()) list.append(py::str(key.name.data(), key.name.size()));
    return list;
}

py::tuple to_arrays(DrawnLines lines) {
    return std::visit(
        [](auto& drawn) -> py::tuple {
            using Point = typename std::decay_t<decltype(drawn.points)>::value_type;
            static_assert(sizeof(Point) == sizeof(double) * static_cast<std::size_t>(Point::length()));
            const auto points = static_cast<py::ssize_t>(drawn.points.size());
            const auto begins = static_cast<py::ssize_t>(drawn.begins.size());
            return py::make_tuple(
                array_of<double>(std::move(drawn.points), std::vector<py::ssize_t>{points, Point::length()}),
                array_of<std::int64_t>(std::move(drawn.begins), std::vector<py::ssize_t>{begins}));
        },
        lines);
}

py::array to_array(DrawnPixels pixels) {
    const std::vector<py::ssize_t> shape = {pixels.height, pixels.width, 4};
    return array_of<std::uint8_t>(std::move(pixels.bytes), shape);
}

py::tuple to_tuple(const NoteList& list) {
    py::list changes;
    for (const SectionChange& change : list.changes) {
        const Meter& meter = change.to.meter;
        changes.append(py::make_tuple(change.onset, change.to.tempo, py::make_tuple(meter.beats, meter.unit)));
    }
    return py::make_tuple(to_arrays(list.notes), list.end, list.tempo, list.meter.beats, list.meter.unit, changes,
                          list.upbeat);
}

py::tuple to_arrays(const std::vector<Note>& notes) {
    std::vector<double> places;
    places.reserve(4 * notes.size());
    for (const Note& note : notes) places.insert(places.end(), {note.from.x, note.from.y, note.to.x, note.to.y});
    const auto count = static_cast<py::ssize_t>(notes.size());
    return py::make_tuple(column<std::int64_t>(notes, [](const Note& note) { return note.onset; }),
                          column<std::int64_t>(notes, [](const Note& note) { return note.duration; }),
                          column<double>(notes, [](const Note& note) { return note.key; }),
                          column<std::uint8_t>(notes, [](const Note& note) { return note.velocity; }),
                          column<std::int16_t>(notes, [](const Note& note) { return note.voice; }),
                          array_of<double>(std::move(places), std::vector<py::ssize_t>{count, 2, 2}));
}

}  // namespace sikku
