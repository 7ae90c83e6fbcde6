// Bindings of the screen-space method: tracing/screen/.
#ifndef HALFSILVER_PASSES_SCREEN_H
#define HALFSILVER_PASSES_SCREEN_H

#define UNIT_SCREEN_DEPTHS 8  // sampler2D; a trace reads no shadow maps
#define IMAGE_SCREEN_DEPTHS 0

#define SCREEN_LEVELS 6  // of the pyramid; the largest cell is 32 pixels wide

#endif
