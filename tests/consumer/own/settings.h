#pragma once

// The engine's own.
namespace engine {
inline constexpr bool settings = true;
}
