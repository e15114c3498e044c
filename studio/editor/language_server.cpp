#include "studio/editor/language_server.h"

#include "engine/base/json.h"
#include "engine/base/text.h"
#include "engine/language/pattern.h"
#include "studio/editor/answers.h"
#include "studio/editor/rename.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <new>
#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

/// Codes of JSON-RPC and of the protocol.
enum ErrorCode : int {
    parse_error = -32700,
    invalid_request = -32600,
    unknown_method = -32601,
    invalid_parameters = -32602,
    internal_error = -32603,
    not_initialized = -32002,
    request_cancelled = -32800,
    request_failed = -32803,
};

/// An error that the server sends as the answer to a request.
class ServerError : public std::runtime_error {
public:
    ServerError(int code, const std::string& message) : std::runtime_error(message), code_(code) {}
    int code() const { return code_; }

private:
    int code_;
};

/// Ends the work on a request because other messages arrived; the work starts again after these.
class Postponed {};

/// Stops work after some time, when the program is asked to stop, or when messages arrive.
class Deadline {
public:
    Deadline(std::chrono::milliseconds time, const Monitor& stop, const LanguageServer::HasNews* news = nullptr)
        : end_(std::chrono::steady_clock::now() + time), stop_(stop), news_(news) {}
    Monitor monitor() { return Monitor(&is_over, nullptr, this); }
    /// Call after the work. @throws Stopped if the program is asked to stop; Postponed
    void require_no_news() const {
        stop_.check();
        if (has_news_) throw Postponed();
    }

private:
    static bool is_over(void* context) {
        auto* self = static_cast<Deadline*>(context);
        if (self->stop_.stop_requested() || std::chrono::steady_clock::now() >= self->end_) return true;
        if (self->news_ && *self->news_ && (*self->news_)()) self->has_news_ = true;
        return self->has_news_;
    }
    std::chrono::steady_clock::time_point end_;
    const Monitor& stop_;
    const LanguageServer::HasNews* news_;
    std::atomic<bool> has_news_ = false;
};

constexpr std::chrono::seconds checking_time{2};

/// True for requests of the user, which are refused if the document is too large. Editors send the others
/// automatically and often, and would show each error.
bool is_of_user(std::string_view method) {
    static constexpr std::array methods = {"textDocument/prepareRename", "textDocument/rename",
                                           "textDocument/formatting"};
    return std::find(methods.begin(), methods.end(), method) != methods.end();
}

/// The answer about a document that is too large.
Json no_answer(std::string_view method) {
    if (is_of_user(method)) throw ServerError(request_failed, "the document is too large");
    return method == "textDocument/documentColor" ? Json::array() : Json(nullptr);
}

}  // namespace

void LanguageServer::reply(const Json& id, const char* member, Json value) {
    const Json message = {{"jsonrpc", "2.0"}, {"id", id}, {member, std::move(value)}};
    // Messages can contain incomplete characters.
    send_(message.dump(-1, ' ', false, Json::error_handler_t::replace));
}

void LanguageServer::notify(const char* method, Json parameters) {
    const Json message = {{"jsonrpc", "2.0"}, {"method", method}, {"params", std::move(parameters)}};
    send_(message.dump(-1, ' ', false, Json::error_handler_t::replace));
}

void LanguageServer::refuse(const std::string& reason) {
    reply(nullptr, "error", {{"code", invalid_request}, {"message", reason}});
}

void LanguageServer::receive(const std::string& message) {
    try {
        Json request = read_json(message);
        if (!request.is_object()) throw ServerError(invalid_request, "expected an object");
        if (request.contains("method")) {
            if (request["method"] == "$/cancelRequest") {
                if (request.contains("params")) cancel(request["params"]);
            } else {
                waiting_.push_back(std::move(request));
            }
        } else if (!request.contains("result") && !request.contains("error")) {  // nor a response
            throw ServerError(invalid_request, "'method' is missing");
        }
    } catch (const JsonError& error) {
        const std::string reason = fmt::format("{}, at byte {}", error.what(), error.byte);
        reply(nullptr, "error", {{"code", parse_error}, {"message", reason}});
    } catch (const ServerError& error) {
        reply(nullptr, "error", {{"code", error.code()}, {"message", error.what()}});
    } catch (const std::bad_alloc&) {
        reply(nullptr, "error", {{"code", internal_error}, {"message", "not enough memory"}});
    }
}

/// Cancels a waiting request; a request that does not wait has been answered.
void LanguageServer::cancel(const Json& parameters) {
    if (!parameters.is_object() || !parameters.contains("id")) return;
    const auto found = std::find_if(waiting_.begin(), waiting_.end(), [&](const Json& request) {
        return request.contains("id") && request["id"] == parameters["id"];
    });
    if (found == waiting_.end()) return;
    waiting_.erase(found);
    reply(parameters["id"], "error", {{"code", request_cancelled}, {"message", "cancelled"}});
}

void LanguageServer::work() {
    if (waiting_.empty()) return;
    Json request = std::move(waiting_.front());
    waiting_.pop_front();
    const bool is_request = request.contains("id");
    Json id = nullptr, result;
    const auto fail = [&](int code, const std::string& reason) {
        if (is_request) return reply(id, "error", {{"code", code}, {"message", reason}});
        notify("window/logMessage", {{"type", Severity::error}, {"message", reason}});
    };
    try {
        if (is_request && (request["id"].is_string() || request["id"].is_number())) id = request["id"];
        const std::string method = text_of(request, "method");
        const Json none = Json::object();
        const auto found = request.find("params");
        const Json& parameters = found == request.end() ? none : *found;
        if (!is_request) return notice(method, parameters);
        publish();
        result = answer(method, parameters);
    } catch (const Postponed&) {
        waiting_.push_back(std::move(request));
        return;
    } catch (const ServerError& error) {
        return fail(error.code(), error.what());
    } catch (const BadRequest& error) {
        return fail(invalid_parameters, error.what());
    } catch (const RenameError& error) {
        return fail(request_failed, error.what());
    } catch (const std::bad_alloc&) {
        return fail(internal_error, "not enough memory");
    } catch (const Stopped&) {
        stop_.check();
        return fail(request_failed, "this takes too long");
    } catch (const PatternError&) {
        return fail(request_failed, "the pattern has errors");
    } catch (const std::exception& error) {
        return fail(internal_error, error.what());
    }
    reply(id, "result", std::move(result));
}

Json LanguageServer::answer(const std::string& method, const Json& parameters) {
    if (is_shut_down_) throw ServerError(invalid_request, "the server has been shut down");
    if (!is_initialized_ && method != "initialize") {
        throw ServerError(not_initialized, "expected the request 'initialize' before any other");
    }
    if (method == "initialize") return initialize();
    if (method == "shutdown") {
        is_shut_down_ = true;
        return nullptr;
    }
    if (method == "textDocument/colorPresentation") return colour_texts(parameters);
    const EditorAnswer found = find_editor_answer(method);
    if (!found) throw ServerError(unknown_method, fmt::format("unknown method '{}'", printable(method, 80)));
    const OpenDocument& document = documents_.at(text_of(member(parameters, "textDocument"), "uri"));
    if (document.is_too_large()) return no_answer(method);
    Deadline deadline(measuring_time, stop_, &news_);
    Json result = found(ReadPattern(document.name, document.text), parameters, deadline.monitor());
    deadline.require_no_news();
    return result;
}

Json LanguageServer::initialize() {
    if (is_initialized_) throw ServerError(invalid_request, "the server is already initialized");
    is_initialized_ = true;
    const Json capabilities = {
        {"textDocumentSync", {{"openClose", true}, {"change", 1}}},  // whole texts
        {"hoverProvider", true},
        {"completionProvider", {{"triggerCharacters", {":", " "}}}},
        {"definitionProvider", true},
        {"renameProvider", {{"prepareProvider", true}}},
        {"documentFormattingProvider", true},
        {"colorProvider", true},
        {"codeLensProvider", {{"resolveProvider", false}}},
        {"semanticTokensProvider",
         {{"legend", {{"tokenTypes", token_types()}, {"tokenModifiers", Json::array()}}}, {"full", true}}}};
    return {{"capabilities", capabilities}, {"serverInfo", {{"name", "sikku"}, {"version", SIKKU_VERSION}}}};
}

void LanguageServer::notice(const std::string& method, const Json& parameters) {
    if (method == "exit") has_ended_ = true;
    if (!is_initialized_ || is_shut_down_) return;
    const auto address = [&](const Json& document) { return text_of(document, "uri"); };
    if (method == "textDocument/didOpen") {
        const Json& document = member(parameters, "textDocument");
        documents_.put(address(document), text_of(document, "text"));
    } else if (method == "textDocument/didChange") {
        documents_.change(address(member(parameters, "textDocument")), member(parameters, "contentChanges"));
    } else if (method == "textDocument/didClose") {
        const std::string closed = address(member(parameters, "textDocument"));
        if (!documents_.close(closed)) return;
        notify("textDocument/publishDiagnostics", {{"uri", closed}, {"diagnostics", Json::array()}});
    }
}

void LanguageServer::publish() {
    const bool changes = std::any_of(waiting_.begin(), waiting_.end(), [](const Json& message) {
        return message["method"] == "textDocument/didChange";
    });
    if (changes) return;
    for (auto& [address, document] : documents_.all()) {
        if (!document.is_changed) continue;
        document.is_changed = false;
        notify("textDocument/publishDiagnostics", {{"uri", address}, {"diagnostics", diagnostics_of(document)}});
        if (!document.is_too_large() || document.is_refusal_told) continue;
        document.is_refusal_told = true;
        notify("window/showMessage",
               {{"type", Severity::warning}, {"message", document.name + ": " + too_large_text(document)}});
    }
}

Json LanguageServer::diagnostics_of(const OpenDocument& document) const {
    if (document.is_too_large()) return whole_document_diagnostics(Severity::error, too_large_text(document));
    Deadline deadline(checking_time, stop_);
    try {
        return editor_diagnostics(document.name, document.text, deadline.monitor());
    } catch (const Stopped&) {
        stop_.check();
        return whole_document_diagnostics(Severity::warning,
                                          "the pattern was not checked: checking takes longer than 2 s");
    } catch (const std::bad_alloc&) {
        return whole_document_diagnostics(Severity::warning, "the pattern was not checked: not enough memory");
    }
}

}  // namespace sikku
