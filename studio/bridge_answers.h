// studio/bridge_answers.h: reads requests, and answers those that need more than a few lines.
#pragma once

#include "engine/base/monitor.h"
#include "engine/interpreter.h"
#include "studio/editor/request_members.h"

#include <string>
#include <vector>

namespace sikku {

/// The interpreter that a request names: `draw` or `play`. @throws BadRequest
const Interpreter& interpreter_of(const Json& request);
/// The member `options` of a request.
OptionValues options_of(const Json& request);
/// The compiled pattern of a request, which is cached. @throws PatternError
Document document_of(const Json& request);
/// Names an output: `curve.svg` for curve.lsys.
std::string output_name(const Document& document, const std::string& format);

/// Makes a work in memory: its outputs, one after the other, are appended to `bytes`.
Json made_by(Work& work, const std::string& name, const Monitor& monitor, std::string& bytes);

Json json_of(const std::vector<Remark>& remarks);
Json json_of(const std::vector<Diagnostic>& diagnostics);

// One function for each kind of request.
Json answer_open(const Json& request, const Monitor& monitor);
Json answer_pixels(const Json& request, const Monitor& monitor, std::string& bytes);
Json answer_affordable(const Json& request, const Monitor& monitor);
/// Options of prints that the format, the drawing or other options exclude, or that have no effect.
Json answer_unfit(const Json& request);
/// Lines as pairs of doubles; those of splines are control polygons.
Json answer_lines(const Json& request, const Monitor& monitor, std::string& bytes);
Json answer_notes(const Json& request, const Monitor& monitor, std::string& bytes);
Json answer_arrangements();
/// A score of an arrangement; its patterns are bundled, or in its text.
Json answer_make_arrangement(const Json& request, const Monitor& monitor, std::string& bytes);
Json answer_origins(const Json& request, const Monitor& monitor);
Json answer_import(const Json& request, const std::string& file);
Json answer_scale(const Json& request, const std::string& file);
Json answer_show(const Json& request, const std::string& file);
Json answer_dots(const Json& request);
Json answer_grid(const Json& request, const Monitor& monitor);
Json answer_read(const Json& request, const std::string& file, const Monitor& monitor, std::string& bytes);
Json answer_command(const Json& request);
Json answer_editor(const Json& request, const Monitor& monitor);
Json answer_link(const Json& request);
Json answer_read_link(const Json& request);

}  // namespace sikku
