#include "engine/language/document.h"

#include "engine/base/input_file.h"
#include "engine/base/keys.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

namespace sikku {
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

void require_turtle(const Document& document, std::string_view consequence) {
    if (!document.map()) return;
    Diagnostics diagnostics;
    diagnostics.error(document.pattern().find("map")->name_at,
                      fmt::format("a map has no turtle, so {}", consequence));
    diagnostics.throw_if_errors();
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
    if (library.patterns().empty()) {
        throw NotFound(fmt::format("no file is named '{}', and {}", pattern, missing_patterns()), true);
    }
    const auto similar = library.similar(pattern);
    throw NotFound(fmt::format("no file or pattern named '{}'{}", pattern, did_you_mean(similar)), !similar.empty());
}

std::string read_pattern(std::FILE* stream, const std::string& name, const Monitor& monitor) {
    return read_stream(stream, name, most_pattern_bytes, monitor);
}

std::string read_pattern(const PatternFile& file, const Monitor& monitor) {
    std::error_code error;
    const std::filesystem::path folder = file.path.parent_path();
    if (!std::filesystem::exists(file.path, error) &&
        (folder.empty() || std::filesystem::is_directory(folder, error))) {
        // Names of bundled patterns omit the extension.
        const std::string stem = file.path.stem().string();
        const bool is_bundled = file.path == stem + ".lsys" && PatternLibrary::bundled().find(stem);
        throw NotFound(
            fmt::format("{}: No such file or directory{}", file.name, is_bundled ? did_you_mean(stem) : ""),
            is_bundled);
    }
    return read_file(file.path, file.name, most_pattern_bytes, monitor);
}

Document load(const std::string& pattern, const Overrides& overrides, const PatternLibrary& library) {
    const PatternFile found = find_pattern(pattern, library);
    // Messages use the name that the caller gave.
    return parse(found.name, read_pattern({pattern, found.path}), overrides);
}

}  // namespace sikku
