// `when (condition) { ... }` is an `if` that is also a jump on software rasterizers: those run both sides of an `if`
// under a mask, while a loop ends once no lane needs it. For rare or expensive bodies; hardware compilers see an `if`.
#define when(condition) for (bool pending = (condition); pending; pending = false)
