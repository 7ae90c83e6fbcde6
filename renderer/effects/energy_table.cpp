#include "effects/energy_table.h"

#include <utility>

#include "shared/passes/energy.h"

namespace halfsilver {

void EnergyTable::bind() {
  if (!table_) {
    gl::Texture table(*api_,
                      {.target = GL_TEXTURE_3D,
                       .format = GL_RG32F,
                       .width = ENERGY_SIZE,
                       .height = ENERGY_SIZE,
                       .depth = ENERGY_ETAS + 1},
                      "energy of rough surfaces");
    table.parameter(GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    table.parameter(GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    const gl::Program program = gl::Program::compute(*api_, "effects/common/energy.comp");
    program.use();
    table.bindImage(IMAGE_ENERGY, GL_WRITE_ONLY);
    api_->DispatchCompute(ENERGY_SIZE / 8, ENERGY_SIZE / 8, ENERGY_ETAS + 1);
    // The table is fetched by shading.
    api_->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    table_ = std::move(table);
  }
  table_.bind(UNIT_ENERGY);
}

}  // namespace halfsilver
