// A user of the installed libraries.
#include <cstdio>

#include <sikku/art/style/style.h>
#include <sikku/engine/measure/extent.h>

int main() {
    sikku::Diagnostics diagnostics;
    const auto pattern = sikku::parse_pattern("koch", "axiom: F\nF --> F-F++F-F\nangle factor: 6\n", diagnostics);
    const auto grammar = sikku::compile_grammar(pattern, diagnostics).with_steps(5);
    diagnostics.throw_if_errors();
    const auto measured = sikku::measure(*grammar, 1e6);
    const bool good = measured.drawn.value == 1024 && sikku::parse_colour("navy").has_value();
    std::puts(good ? "the libraries work" : "the libraries do not work");
    return good ? 0 : 1;
}
