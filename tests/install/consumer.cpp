// A user of the installed libraries, with a folder of the same name as one of theirs on its include path.
#include <sikku/art/analysis.h>
#include <sikku/art/gallery/gallery.h>
#include <sikku/engine/base/installation.h>
#include <sikku/engine/measurement.h>

#include <engine/base/output.h>

#include <cstdio>

int main() {
    const sikku::Document koch =
        sikku::parse("koch", "axiom: F\nF --> F-F++F-F\nangle factor: 6\nderivation length: 5\n");
    const bool measures = sikku::measure_as_json(koch, 1e6).find("1024") != std::string::npos;
    const auto lines = std::get<sikku::Polylines<glm::dvec2>>(sikku::drawn_lines(koch, 1e6, {}));
    const bool finds = !sikku::PatternLibrary::bundled().patterns().empty();
    const bool good = measures && finds && own_output == 1 && !lines.points.empty();
    std::puts(good ? "the libraries work" : "the libraries do not work");
    return good ? 0 : 1;
}
