// cpfg files pass through a C preprocessor before cpfg reads them, so the reader expands defines. Defines with
// numeric values remain names in expressions. Expressions are rewritten, because in cpfg powers associate to the
// left, signs bind tighter, and angles are degrees. cpfg tries productions in the order of the file, patterns try
// those with contexts first; added conditions compensate for this.
#include "engine/import/cpfg_system.h"

namespace sikku {
namespace {

std::string name_of(const SourcePointer& file) {
    std::string stem = import_base_name(file->name());
    if (const std::size_t dot = stem.rfind('.'); dot != std::string::npos && dot > 0) stem.resize(dot);
    return printable(stem, 80);
}

ImportedSystem import_system(const SourcePointer& file, const SourcePointer& view_file, Diagnostics& diagnostics) {
    cpfg::Report report(file, diagnostics);
    const cpfg::View view = view_file ? cpfg::read_view(view_file, report) : cpfg::View();
    cpfg::System read = cpfg::read_system(file->text(), view, report);
    const std::size_t at = read.at;
    if (at == std::string::npos) {
        report.error(0, "there is no line 'Lsystem:' in this file");
    } else if (!read.axiom && !report.failed()) {
        report.error(at, "there is no 'Axiom:'");
    }
    ImportedSystem system;
    system.name = name_of(file);
    if (at != std::string::npos) system.line = report.losses().line(at);
    if (!report.failed()) {
        system.pattern = cpfg::write_pattern(std::move(read), view, system.name, file, report);
        const Span where(file, at, 1);
        compile_import(system, where, diagnostics);
    }
    system.losses = report.losses().take();
    return system;
}

}  // namespace

std::vector<ImportedSystem> import_cpfg(const SourcePointer& file, const SourcePointer& view,
                                        Diagnostics& diagnostics) {
    for (const SourcePointer& source : {file, view}) {
        if (source && !is_importable(source, "a cpfg file", diagnostics)) return {};
    }
    return {import_system(file, view, diagnostics)};
}

}  // namespace sikku
