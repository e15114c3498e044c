#include "art/product/border_files.h"

#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <memory>
#include <system_error>

namespace sikku {
namespace {

/// Finds a pattern. Files are sought in `folders`, in their order; all other names are those of bundled patterns.
PatternFile find_border(const std::string& name, std::initializer_list<std::filesystem::path> folders) {
    if (!lower_case(name).ends_with(".lsys")) {
        const PatternLibrary& library = PatternLibrary::bundled();
        if (const LibraryPattern* known = library.find(name)) return {known->name + ".lsys", known->file};
        const auto similar = library.similar(name);
        throw NotFound(fmt::format("no pattern named '{}'{}; names of files end in .lsys", printable(name, 80),
                                   did_you_mean(similar)),
                       !similar.empty());
    }
    std::error_code error;
    for (const std::filesystem::path& folder : folders) {
        if (std::filesystem::exists(folder / name, error)) return {name, folder / name};
    }
    return {name, *folders.begin() / name};
}

std::shared_ptr<const BorderPattern> load_part(const std::string& name, const DrawSettings& settings,
                                               std::initializer_list<std::filesystem::path> folders,
                                               const FileWitness& witness) {
    try {
        const PatternFile file = find_border(name, folders);
        std::error_code error;
        if (std::filesystem::is_fifo(file.path, error)) throw std::runtime_error("this is a pipe");
        std::string text = read_pattern(file);
        if (witness) witness(name, text);
        const Document document = parse(file.name, std::move(text));
        Diagnostics diagnostics;
        Style style = read_style(document.pattern(), settings.paper.dpi, diagnostics);
        diagnostics.throw_if_errors();
        return std::make_shared<const BorderPattern>(BorderPattern{document.shared_grammar(), std::move(style)});
    } catch (const NotFound& error) {
        std::vector<std::string_view> names(border_names().begin(), border_names().end());
        names.push_back("none");
        const std::string_view near = nearest(name, names);
        if (near == name) refuse_option("border", name, "a border with a corner consists of two patterns");
        refuse_option("border", name,
                      near.empty()
                          ? fmt::format("expected {}, or a pattern: {}", fmt::join(names, ", "), error.what())
                          : "unknown border" + did_you_mean(near));
    } catch (const Stopped&) {
        throw;
    } catch (const PatternError& error) {
        refuse_option("border", name, error.what());
    } catch (const std::runtime_error& error) {
        refuse_option("border", name, error.what());
    }
}

}  // namespace

void load_border(const Style& style, const Document& document, const DrawSettings& settings,
                 const std::filesystem::path& folder, DrawingOptions& options, const FileWitness& witness) {
    if (!style.border || style.border->kind != BorderKind::pattern) return;
    const std::string& source = document.source().name();
    const std::filesystem::path beside = source == "-" ? folder : std::filesystem::path(source).parent_path();
    const auto load = [&](const std::string& name) {
        return settings.look.border ? load_part(name, settings, {folder, beside}, witness)
                                    : load_part(name, settings, {beside, folder}, witness);
    };
    options.border_repeat = load(style.border->pattern);
    if (!style.border->corner.empty()) options.border_corner = load(style.border->corner);
}

}  // namespace sikku
