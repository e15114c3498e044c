// art/product/model_print.cpp: models of drawings, OBJ and glTF.
#include "art/drawing/faint_inks.h"
#include "art/product/print_work.h"
#include "art/writer/draw.h"
#include "art/writer/make_drawing.h"
#include "art/writer/print_cost.h"
#include "engine/base/text.h"
#include "engine/derivation/forecast.h"

namespace sikku {
namespace {

class ModelPrint : public PrintWork {
public:
    explicit ModelPrint(PrintRequest request) : PrintWork(std::move(request)) {
        require_plain("models have no hand-drawn lines; set hand to 0");
        require_straight("models have straight lines, not splines; set line to straight");
        refuse_line_work("a model has");
        if (document().map()) require_turtle(document(), "it cannot be a model");
    }

    Cost forecast() const override { return solid_cost(shorten(grammar()), print(), drawing(), format()); }

private:
    void make_product(Destination& destination, const std::filesystem::path& name, const DrawOptions& options,
                      Made& made) override {
        const ModelReport model = draw_model(grammar(), print(), options, format(), name, destination);
        if (options.lists_contents) {
            const auto drawn = make_drawing(grammar(), print().style, options);
            Print placed = print();
            drawn->place(placed);
            placed.style = drawn->style();
            report.contents = contents_of(*drawn, placed);
        }
        made.fact(counted(model.triangles, "triangle") + ", " + counted(model.materials, "material"));
    }
};

}  // namespace

std::unique_ptr<PrintWork> plan_model(PrintRequest request) {
    return std::make_unique<ModelPrint>(std::move(request));
}

}  // namespace sikku
