#include "engine/language/document.h"

#include "engine/base/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

namespace sikku {
namespace {

/// At most one byte more than a pattern may have, which is enough to see that a file is too long.
std::string contents(const std::filesystem::path& file, const std::string& name) {
    std::error_code error;
    if (std::filesystem::is_directory(file, error)) throw std::runtime_error(fmt::format("{} is a folder", name));
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw std::runtime_error(fmt::format("{}: {}", name, std::generic_category().message(errno)));
    std::string text;
    std::string block(std::size_t{1} << 16, '\0');
    while (stream && text.size() <= most_pattern_bytes) {
        stream.read(block.data(), static_cast<std::streamsize>(block.size()));
        text.append(block, 0, static_cast<std::size_t>(stream.gcount()));
    }
    if (stream.bad()) throw std::runtime_error(fmt::format("{}: {}", name, std::generic_category().message(errno)));
    return text;
}

}  // namespace

Document Document::compile(std::string name, std::string text, const Overrides& overrides, Diagnostics& diagnostics) {
    auto content = std::make_shared<Content>();
    content->pattern = parse_pattern(std::move(name), std::move(text), diagnostics);
    content->overrides = overrides;
    apply_overrides(content->pattern, overrides.variant, overrides.settings, diagnostics);
    Grammar grammar;
    if (!diagnostics.is_unreadable()) {
        check_keys(content->pattern, diagnostics);
        grammar = compile_grammar(content->pattern, diagnostics);
    }
    content->grammar = std::make_shared<const Grammar>(std::move(grammar));
    if (!diagnostics.has_errors()) content->warnings = diagnostics.sorted();
    return Document(std::move(content));
}

bool Document::has_override(std::string_view key) const {
    return std::any_of(content_->overrides.settings.begin(), content_->overrides.settings.end(),
                       [&](const Setting& setting) { return setting.key == key; });
}

Document Document::with(const std::vector<Setting>& settings) const {
    auto content = std::make_shared<Content>(*content_);
    content->overrides.settings.insert(content->overrides.settings.end(), settings.begin(), settings.end());
    Diagnostics diagnostics;
    apply_overrides(content->pattern, {}, settings, diagnostics);
    check_keys(content->pattern, diagnostics);
    const auto concerns_grammar = [](const Setting& setting) {
        const KeyInfo* key = find_language_key(setting.key);
        return !key || key->owner == KeyOwner::engine;
    };
    if (std::any_of(settings.begin(), settings.end(), concerns_grammar)) {
        content->grammar = std::make_shared<const Grammar>(compile_grammar(content->pattern, diagnostics));
    }
    diagnostics.throw_if_errors();
    return Document(std::move(content));
}

Document parse(std::string name, std::string text, const Overrides& overrides) {
    Diagnostics diagnostics;
    Document document = Document::compile(std::move(name), std::move(text), overrides, diagnostics);
    diagnostics.throw_if_errors();
    return document;
}

PatternFile find_pattern(const std::string& pattern, const PatternLibrary& library) {
    const std::filesystem::path path = pattern;
    std::error_code error;
    const bool may_be_name = pattern.find('/') == std::string::npos && !pattern.ends_with(".lsys");
    const bool is_folder = std::filesystem::is_directory(path, error);
    if (!may_be_name || (std::filesystem::exists(path, error) && !is_folder)) return {pattern, path};
    if (const LibraryPattern* known = library.find(pattern)) return {known->name + ".lsys", known->file};
    if (is_folder) throw NotFound(fmt::format("{} is a folder", pattern), true);
    const std::string_view near = library.nearest(pattern);
    throw NotFound(fmt::format("no file or pattern named '{}'{}", pattern,
                               near.empty() ? std::string() : fmt::format("; did you mean '{}'?", near)),
                   !near.empty());
}

Document load(const std::string& pattern, const Overrides& overrides, const PatternLibrary& library) {
    PatternFile found = find_pattern(pattern, library);
    return parse(std::move(found.name), contents(found.path, pattern), overrides);
}

}  // namespace sikku
