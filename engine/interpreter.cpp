#include "engine/interpreter.h"

#include "engine/base/keys.h"

#include <algorithm>
#include <utility>

namespace sikku {

std::string recipe(const Document& document, const Grammar& grammar, const std::string& before,
                   const std::string& after) {
    std::string text = "sikku " SIKKU_VERSION ", -n " + std::to_string(grammar.steps()) + before;
    const Overrides& overrides = document.overrides();
    if (!overrides.variant.empty()) text += " --variant " + overrides.variant;
    const auto is_seed = [](const Setting& setting) { return setting.origin == "--seed"; };
    for (const Setting& setting : overrides.settings) {
        if (is_seed(setting)) text += " --seed " + setting.value;
    }
    for (const Setting& setting : overrides.settings) {
        if (is_seed(setting) || setting.key == "derivation length") continue;
        text += " --set '" + setting.key + "=" + setting.value + "'";
    }
    return text + after;
}

std::string make_in_memory(const Interpreter& interpreter, const Document& document, std::string_view format,
                           const OptionValues& values) {
    const auto options = interpreter.options();
    OptionValues own;
    std::vector<Setting> settings;
    for (const OptionValue& value : values) {
        const auto row = std::find_if(options.begin(), options.end(),
                                      [&](const OptionInfo* info) { return info->name == value.name; });
        const KeyInfo* key = find_language_key(value.name);
        const bool is_option = row != options.end();
        if (is_option) own.push_back(value);
        // The random seed concerns both.
        if (!is_option || (key && key->owner == KeyOwner::engine)) {
            settings.push_back({value.name, value.name, value.text});
        }
    }
    const Document set = settings.empty() ? document : document.with(settings);
    MemoryDestination memory;
    const std::string name = "memory." + std::string(format);
    interpreter.plan(set, format, own)->make(memory, name, {});
    return memory.take(name);
}

}  // namespace sikku
