#include "python/values.h"

#include "art/prints.h"
#include "engine/base/keys.h"
#include "music/scores.h"
#include "python/errors.h"

namespace py = pybind11;

namespace sikku {

OptionValues to_values(const TextPairs& pairs) {
    OptionValues values;
    for (const auto& [name, text] : pairs) values.push_back({name, text});
    return values;
}

std::vector<Setting> to_settings(const TextPairs& pairs) {
    std::vector<Setting> settings;
    for (const auto& [name, text] : pairs) settings.emplace_back(name, text);
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

py::list list_options(std::span<const OptionInfo* const> options) {
    py::list list;
    for (const OptionInfo* option : options) {
        list.append(py::make_tuple(option->name, option->is_list, option->kind == OptionKind::flag, option->value,
                                   option->help));
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

}  // namespace sikku
