// studio/bridge_editor.cpp: answers requests of the editor about the text of a pattern, as the language server does.
#include "studio/bridge_answers.h"
#include "studio/editor/answers.h"

#include <chrono>
#include <string>
#include <utility>

namespace sikku {

Json answer_editor(const Json& request, const Monitor& monitor) {
    const std::string method = text_of(request, "method");
    const EditorAnswer answer = find_editor_answer(method);
    if (!answer) throw BadRequest("unknown method '" + method + "'");
    const Json& parameters = member(request, "parameters");
    const Json& document = member(parameters, "textDocument");
    struct Measuring {
        const Monitor& request;
        std::chrono::steady_clock::time_point end;
    } measuring{monitor, std::chrono::steady_clock::now() + measuring_time};
    const auto is_over = [](void* context) {
        const auto* time = static_cast<const Measuring*>(context);
        return time->request.stop_requested() || std::chrono::steady_clock::now() >= time->end;
    };
    const ReadPattern read(text_of(document, "uri"), text_of(document, "text"));
    Json result = answer(read, parameters, Monitor(is_over, nullptr, &measuring));
    monitor.check();
    return {{"result", std::move(result)}};
}

}  // namespace sikku
