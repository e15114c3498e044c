#include "engine/interpreter.h"

#include "engine/base/text.h"

#include <algorithm>
#include <utility>

namespace sikku {

const FormatName* find_format(std::span<const FormatName> formats, std::string_view name) {
    const std::string wanted = lower_case(name);
    const auto found = std::find_if(formats.begin(), formats.end(), [&](const FormatName& row) {
        return wanted == row.extension || (!wanted.empty() && wanted == row.alias);
    });
    return found == formats.end() ? nullptr : &*found;
}

Document compile(std::string name, std::string text, const Overrides& overrides,
                 std::span<const Interpreter* const> interpreters, Diagnostics& diagnostics) {
    Document document = Document::compile(std::move(name), std::move(text), overrides, diagnostics);
    if (diagnostics.is_unreadable()) return document;
    for (const Interpreter* interpreter : interpreters) interpreter->check_keys(document.pattern(), diagnostics);
    return document;
}

bool sets_keys_of(const Interpreter& interpreter, const Document& document) {
    const auto& keys = document.pattern().keys;
    return std::any_of(keys.begin(), keys.end(), [&](const Key& key) {
        const KeyInfo* known = find_language_key(key.name);
        return known && known->owner == interpreter.owner();
    });
}

OptionValues without_keys(OptionValues values, const std::vector<Setting>& keys) {
    std::erase_if(values, [&](const OptionValue& value) {
        return std::any_of(keys.begin(), keys.end(), [&](const Setting& key) { return key.origin == value.name; });
    });
    return values;
}

std::string recipe(const Document& document, const RecipeOptions& options) {
    std::string text = "sikku " SIKKU_VERSION ",";
    if (!options.sets_lengths) text += " -n " + std::to_string(document.grammar().steps());
    const Overrides& overrides = document.overrides();
    if (!overrides.variant.empty()) text += " --variant " + shell_word(overrides.variant);
    const auto is_seed = [](const Setting& setting) { return setting.key == "seed" && !setting.is_assignment; };
    for (const Setting& setting : overrides.settings) {
        if (is_seed(setting) && !options.sets_seed) text += " --seed " + setting.value;
    }
    for (const Setting& setting : overrides.settings) {
        if (is_seed(setting) || setting.key == "derivation length") continue;
        const KeyInfo* key = find_language_key(setting.key);
        const bool is_file = key && key->names_file && key->names_file(setting.value);
        text +=
            " --set " + shell_word(setting.key + "=" + (is_file ? without_folders(setting.value) : setting.value));
    }
    return text + options.text;
}

std::string reason_of_no_steps(const Document& document) {
    if (document.map() || document.grammar().steps() > 0 || document.pattern().find("derivation length") ||
        document.has_override("derivation length")) {
        return {};
    }
    const auto& tables = document.grammar().tables();
    const bool is_plain =
        std::all_of(tables.begin(), tables.end(), [](const Table& table) { return table.productions().empty(); });
    return is_plain ? "" : "the productions are not applied, because `derivation length:` is missing";
}

namespace {

/// The key that an option of the command line sets: `-n`, `--steps`.
std::string key_of(const std::string& name) {
    return name == "n" || name == "steps" ? "derivation length" : name;
}

/// @throws SettingError for a name that is neither an option nor a key nor a define
void require_known(const Interpreter& interpreter, const Document& document, const std::string& name) {
    if (find_language_key(name)) return;
    std::vector<std::string_view> known;
    for (const OptionInfo* option : interpreter.options()) known.push_back(option->name);
    for (const KeyInfo& key : language_keys()) known.push_back(key.name);
    for (const Define& define : document.pattern().defines) known.push_back(define.name.view());
    if (std::find(known.begin(), known.end(), name) != known.end()) return;
    throw SettingError(name, "", "unknown option or key" + did_you_mean(nearest(name, known)));
}

}  // namespace

Assignment assign(const Interpreter& interpreter, const Document& document, const OptionValues& values) {
    OptionValues own;
    std::vector<Setting> settings;
    for (const OptionValue& value : values) {
        const std::string key = key_of(value.name);
        require_known(interpreter, document, key);
        const bool is_option = find_option(interpreter.options(), key) != nullptr;
        if (is_option) own.push_back(value);
        // A seed applies to both the pattern and the option.
        if (!is_option || key == "seed") settings.push_back({value.name, key, value.text});
    }
    // So does the seed that the document was made with.
    if (find_option(interpreter.options(), "seed")) {
        const auto is_seed = [](const auto& value) { return value.name == "seed"; };
        const auto& given = document.overrides().settings;
        const auto seed =
            std::find_if(given.rbegin(), given.rend(), [](const Setting& one) { return one.key == "seed"; });
        if (seed != given.rend() && std::none_of(own.begin(), own.end(), is_seed))
            own.push_back({"seed", seed->value});
    }
    return {settings.empty() ? document : document.with(settings), std::move(own)};
}

std::string make_in_memory(const Interpreter& interpreter, const Document& document, std::string_view format,
                           const OptionValues& values, const Monitor& monitor) {
    const Assignment assigned = assign(interpreter, document, values);
    MemoryDestination memory;
    const std::string name = "memory." + std::string(format);
    interpreter.plan(assigned.document, format, assigned.options)->make(memory, name, monitor);
    if (memory.outputs().size() != 1 || !memory.outputs().contains(name)) {
        throw std::runtime_error(std::to_string(memory.outputs().size()) +
                                 " files instead of one: use plan() and make() with a destination");
    }
    return memory.take(name);
}

}  // namespace sikku
