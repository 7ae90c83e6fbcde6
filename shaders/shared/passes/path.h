// Bindings of the path tracer's own: effects/path/shade.comp.
#ifndef HALFSILVER_PASSES_PATH_H
#define HALFSILVER_PASSES_PATH_H

#define UNIT_EMITTERS 8    // usamplerBuffer, LightTable::entries; the path tracer reads no shadow maps
#define UNIT_SKY_TABLE 13  // samplerBuffer, SkyTable::sums; nor these parts of the G-buffer

#endif
