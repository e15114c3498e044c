// cli/lsp.cpp: `sikku lsp`: the language server on standard input and output, and grammars for highlighting.
#include "cli/command.h"
#include "cli/mistakes.h"
#include "studio/editor/highlighting.h"
#include "studio/editor/language_server.h"
#include "studio/editor/message_reader.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>

namespace sikku {
namespace {

/// True if bytes or the end of standard input can be read at once.
bool input_waits() {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    return ::poll(&input, 1, 0) > 0;
}

/// Reads the available bytes, at least one; empty at the end of the input. @throws Interrupted, std::system_error
std::string_view read_some(std::array<char, 1U << 16U>& buffer) {
    for (;;) {
        const ssize_t count = ::read(STDIN_FILENO, buffer.data(), buffer.size());
        if (count >= 0) return {buffer.data(), static_cast<std::size_t>(count)};
        if (interrupted()) throw Interrupted("interrupted");
        if (errno != EINTR) throw std::system_error(errno, std::generic_category(), "standard input");
    }
}

/// Serves an editor on standard input and output.
class Connection {
public:
    /// Returns the exit status.
    int serve() {
        ignore_closed_pipes();
        while (!server_.has_ended()) {
            // All messages that have arrived are read before one is answered: they can cancel a request, or replace a
            // text.
            if (has_news() || (has_input_ && !server_.has_work())) {
                read();
            } else if (server_.has_work()) {
                server_.work();
            } else {
                break;
            }
        }
        if (!is_broken_ || server_.has_ended()) return server_.exit_status();
        server_.refuse("expected a header 'Content-Length: BYTES' and an empty line before each message");
        return 1;
    }

private:
    /// The largest number of bytes that are read before messages are answered.
    static constexpr std::size_t most_ahead = std::size_t{1} << 20U;

    /// True if there is input that may be read now.
    bool has_news() const { return has_input_ && (!server_.has_work() || ahead_ < most_ahead) && input_waits(); }

    void read() {
        if (!server_.has_work()) {
            ahead_ = 0;
            if (!input_waits()) server_.publish();
        }
        const std::string_view bytes = read_some(buffer_);
        has_input_ = !bytes.empty();
        ahead_ += bytes.size();
        reader_.add(bytes);
        while (const auto message = reader_.next()) {
            if (message->is_skipped) {
                server_.refuse(fmt::format("a message of {} is too large; the limit is {}",
                                           bytes_text(static_cast<double>(message->size)),
                                           bytes_text(static_cast<double>(MessageReader::most_bytes))));
            } else {
                server_.receive(message->content);
            }
        }
        if (reader_.is_broken()) {
            is_broken_ = true;
            has_input_ = false;
        }
    }

    LanguageServer server_{[](const std::string& message) { write_all(STDOUT_FILENO, with_header(message)); },
                           [this] { return has_news(); }, stop_monitor()};
    MessageReader reader_;
    std::array<char, 1U << 16U> buffer_{};
    bool has_input_ = true;  // false after its end
    bool is_broken_ = false;
    std::size_t ahead_ = 0;
};

}  // namespace

void add_lsp(CLI::App& app, bool& /*quiet*/) {
    auto* command =
        app.add_subcommand("lsp", "Run the language server: errors while you type, help, completion, renaming");
    auto grammar = std::make_shared<std::string>();
    command
        ->add_option("--grammar", *grammar, "print a grammar for syntax highlighting instead: textmate (JSON) or vim")
        ->type_name("KIND")
        ->check(one_of({"textmate", "vim"}));
    command->footer(
        "Editors start this command and exchange messages with it on standard input and output, in the language "
        "server protocol. The server reports errors, explains keys and symbols, completes and renames names, finds "
        "definitions, formats patterns, and shows colours and the length and extent of the drawing. A document can "
        "have at most 4 MB. Exit status: 0 if the editor requested the shutdown, otherwise 1.\n\n"
        "Examples:\n"
        "  sikku lsp --grammar vim > ~/.config/nvim/syntax/sikku.vim\n"
        "  sikku lsp --grammar textmate > sikku.tmLanguage.json");
    command->callback([grammar] {
        if (*grammar == "textmate") return fmt::print("{}", textmate_grammar());
        if (*grammar == "vim") return fmt::print("{}", vim_syntax());
        if (const int status = Connection().serve(); status != 0) throw CLI::RuntimeError(status);
    });
}

}  // namespace sikku
