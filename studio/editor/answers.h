// studio/editor/answers.h: answers to what editors ask about a pattern, for the language server and the studio.
// Source: Microsoft, Language Server Protocol 3.17.
#pragma once

#include "engine/base/monitor.h"
#include "studio/editor/occurrences.h"
#include "studio/editor/request_members.h"
#include "studio/editor/text_edit.h"

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Time limit for measuring drawings for one answer.
constexpr std::chrono::milliseconds measuring_time{500};

/// A pattern that was read to answer a request.
struct ReadPattern {
    /// @param name  path of the file, for messages and for files that the pattern names
    ReadPattern(const std::string& name, const std::string& text);
    /// The name at the position in the parameters of a request; null if there is none. @throws BadRequest
    const Occurrence* name_at(const Json& parameters) const;

    Diagnostics diagnostics;
    Pattern pattern;
    TextPositions positions;
    std::vector<Occurrence> names;  ///< empty if the text is unreadable
};

/// Answers a request: its result.
/// @param parameters  of the request, as in the protocol
/// @param monitor     stops measurements, which are then left out of the answer
/// @throws BadRequest, RenameError
using EditorAnswer = Json (*)(const ReadPattern& read, const Json& parameters, const Monitor& monitor);

/// The answer to a request about a document, such as `textDocument/hover`; null if the method is unknown.
EditorAnswer find_editor_answer(std::string_view method);

/// How a colour can be written, for `textDocument/colorPresentation`. @throws BadRequest
Json colour_texts(const Json& parameters);

/// The errors and warnings of a pattern, as the protocol lists them. @param name  as in ReadPattern @throws Stopped
Json editor_diagnostics(const std::string& name, const std::string& text, const Monitor& monitor);

enum class Severity : int { error = 1, warning = 2 };
/// A list with one message about a whole document.
Json whole_document_diagnostics(Severity severity, const std::string& message);

/// Kinds of names that editors colour: the legend of `textDocument/semanticTokens/full`.
Json token_types();

}  // namespace sikku
