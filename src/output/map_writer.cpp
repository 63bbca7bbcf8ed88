#include "output/map_writer.h"

namespace tenku {

const MapWriter& map_writer() {
  static const auto& writer = dynamic_cast<const MapWriter&>(load_plugin("maps"));
  return writer;
}

}  // namespace tenku
