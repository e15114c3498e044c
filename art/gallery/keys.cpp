#include "art/gallery/keys.h"

#include "engine/base/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace sikku {

GalleryKeys::GalleryKeys(std::vector<const Interpreter*> interpreters, PieceReader pieces)
    : interpreters_(std::move(interpreters)), pieces_(std::move(pieces)) {
    using enum OptionKind;
    for (const Interpreter* interpreter : interpreters_) {
        for (const FormatName& row : interpreter->formats()) {
            if (row.is_several) continue;
            for (const std::string_view name : {row.extension, row.alias}) {
                if (name.empty() || known(name)) continue;
                known_.push_back({name, row.label, interpreter});
                formats_.push_back(name);
            }
        }
    }
    keys_ = {{.name = "n", .help = "derivation length, or a range of them: 1:6", .kind = whole},
             {.name = "variant", .help = "one of the pattern's variants"},
             {.name = "seed", .help = "random seed", .kind = whole},
             {.name = "budget", .help = "maximum number of derivation nodes visited", .kind = number, .least = 1}};
    for (const Interpreter* interpreter : interpreters_) {
        for (const OptionInfo* info : interpreter->options()) {
            const std::string name = (info->is_on ? "no-" : "") + std::string(info->name);
            // Keys of patterns are added below, but those that accept more as options, such as no value.
            if (info->is_alone || (info->is_key && !info->sets_more) || find(name)) continue;
            const bool has_optional_value = info->value.starts_with('[');
            keys_.push_back({.name = name,
                             .help = std::string(info->help) + (has_optional_value ? "; true: without a value" : ""),
                             .unit = info->unit,
                             .use = interpreter,
                             .kind = info->kind,
                             .least = info->least,
                             .most = info->most,
                             .has_optional_value = has_optional_value,
                             .sets_scale = info->sets_scale});
        }
    }
    keys_.push_back({.name = "angle",
                     .help = "the pattern's angle: its define of that name, or its angle increment",
                     .overrides = true});
    for (const char* key : {"angle-increment", "angle-factor", "heading", "turn"}) {
        keys_.push_back({.name = key, .help = "", .overrides = true, .is_option = false});
    }
    keys_.push_back(
        {.name = "scale-factor", .help = "", .use = reader_of(KeyOwner::art), .overrides = true, .is_option = false});
    for (const KeyInfo& key : language_keys()) {
        if (key.owner == KeyOwner::engine || key.is_for_symbols()) continue;
        const Interpreter* reader = reader_of(key.owner);
        if (!reader) continue;
        std::string name(key.name);
        std::replace(name.begin(), name.end(), ' ', '-');
        if (find(name)) continue;
        // Keys that are also options of the interpreter use its table.
        const OptionInfo* option = find_option(reader->options(), key.name);
        const bool is_option = option && option->is_key && !option->is_alone;
        keys_.push_back(
            {.name = std::move(name), .help = std::string(key.help), .use = reader, .overrides = !is_option});
    }
}

const Interpreter* GalleryKeys::reader_of(KeyOwner owner) const {
    const auto found = std::find_if(interpreters_.begin(), interpreters_.end(),
                                    [&](const Interpreter* one) { return one->owner() == owner; });
    return found == interpreters_.end() ? nullptr : *found;
}

const GalleryKey* GalleryKeys::find(std::string_view name) const {
    const auto found =
        std::find_if(keys_.begin(), keys_.end(), [&](const GalleryKey& key) { return key.name == name; });
    return found == keys_.end() ? nullptr : &*found;
}

std::string GalleryKeys::not_a_key(std::string_view name) const {
    for (const Interpreter* interpreter : interpreters_) {
        const OptionInfo* option = find_option(interpreter->options(), name);
        if (!option || !option->is_alone) continue;
        return fmt::format(
            "'{}' is an option of single works, not a key of galleries: each job makes one file of one derivation "
            "length; 'n' lists derivation lengths",
            name);
    }
    return {};
}

const GalleryKeys::Known* GalleryKeys::known(std::string_view format) const {
    const auto found =
        std::find_if(known_.begin(), known_.end(), [&](const Known& row) { return row.name == format; });
    return found == known_.end() ? nullptr : &*found;
}

const Interpreter& GalleryKeys::interpreter_of(std::string_view format) const {
    return *known(format)->interpreter;
}

std::string GalleryKeys::format_list() const {
    std::string list;
    for (const Interpreter* interpreter : interpreters_) {
        for (const FormatName& row : interpreter->formats()) {
            if (!row.is_several && &interpreter_of(row.extension) == interpreter) {
                list += (list.empty() ? "" : ", ") + std::string(row.extension);
            }
        }
    }
    return list;
}

std::string_view GalleryKeys::label(std::string_view format) const {
    return known(format)->label;
}

std::string folded_key(std::string key) {
    for (char& letter : key) {
        if (letter == '_' || letter == ' ') letter = '-';
    }
    if (key == "generations" || key == "steps") return "n";
    if (key == "seeds" || key == "formats" || key == "patterns") key.pop_back();
    return key;
}

}  // namespace sikku
