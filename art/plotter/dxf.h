// art/plotter/dxf.h: writes strokes as DXF, for laser cutters, mills and CAD programs.
#pragma once

#include "art/plotter/plot_writer.h"
#include "art/print/print.h"
#include "art/print/tile_kinds.h"
#include "engine/base/output.h"

#include <memory>
#include <vector>

namespace sikku {

/// Begins the file: DXF of release 12, which every CAD program reads. Millimetres with 4 decimals, from the bottom
/// left corner of the page, y up; $INSUNITS and $MEASUREMENT, which later releases added, state the unit. A stroke is
/// a LINE or a POLYLINE, closed where the stroke is; curves are followed within 0.01 mm by lines and by arcs, which
/// are bulges of the polyline, and closed strokes around one centre are CIRCLEs. Pen n has the layer PEN-n, or that
/// of Style::cut_layers. Polygons are closed POLYLINEs in the layers of their kinds (TileKind::layer()). Layers
/// have the nearest of the seven standard colours; other programs may show different ones. Widths are left out,
/// because a laser has a fixed width. The recipe is stored in comments, which readers ignore. `print` and `file`
/// are kept by reference. After finish() the file is complete, but not committed.
/// @param kinds  kinds of all polygons that will be written, in the order in which TileKinds numbers them
/// @throws std::runtime_error, from here and from every call of the writer, if the file cannot be written, and if the
/// drawing leaves the page
/// Source: Autodesk, DXF Reference, release 12: group codes; POLYLINE, bulge; CIRCLE; layer names and colour numbers;
/// release 2000: $INSUNITS, $MEASUREMENT.
std::unique_ptr<PlotWriter> write_dxf(const Print& print, Output& file, std::vector<TileKind> kinds = {});

}  // namespace sikku
