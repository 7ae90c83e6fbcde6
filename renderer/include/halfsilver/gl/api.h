#pragma once

#include <GL/glcorearb.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

// The project's own table of GL functions. It is filled through the current context's getProcAddress, so the same code
// runs on EGL, OSMesa and GLFW; there is no global loader. Objects keep a pointer to the table: it must outlive them.
namespace halfsilver::gl {

using Proc = void (*)();
using GetProcAddress = std::function<Proc(const char* name)>;

// X(type, name): name without its "gl" prefix.
#define HALFSILVER_GL_FUNCTIONS(X)                                       \
  X(PFNGLGETERRORPROC, GetError)                                         \
  X(PFNGLGETSTRINGPROC, GetString)                                       \
  X(PFNGLGETSTRINGIPROC, GetStringi)                                     \
  X(PFNGLGETINTEGERVPROC, GetIntegerv)                                   \
  X(PFNGLGETINTEGERI_VPROC, GetIntegeri_v)                               \
  X(PFNGLGETINTEGER64VPROC, GetInteger64v)                               \
  X(PFNGLGETINTEGER64I_VPROC, GetInteger64i_v)                           \
  X(PFNGLGETFLOATVPROC, GetFloatv)                                       \
  X(PFNGLGETFLOATI_VPROC, GetFloati_v)                                   \
  X(PFNGLGETDOUBLEI_VPROC, GetDoublei_v)                                 \
  X(PFNGLGETBOOLEANVPROC, GetBooleanv)                                   \
  X(PFNGLGETBOOLEANI_VPROC, GetBooleani_v)                               \
  X(PFNGLISENABLEDPROC, IsEnabled)                                       \
  X(PFNGLISENABLEDIPROC, IsEnabledi)                                     \
  X(PFNGLENABLEPROC, Enable)                                             \
  X(PFNGLDISABLEPROC, Disable)                                           \
  X(PFNGLENABLEIPROC, Enablei)                                           \
  X(PFNGLDISABLEIPROC, Disablei)                                         \
  X(PFNGLFLUSHPROC, Flush)                                               \
  X(PFNGLFINISHPROC, Finish)                                             \
  X(PFNGLVIEWPORTPROC, Viewport)                                         \
  X(PFNGLVIEWPORTINDEXEDFPROC, ViewportIndexedf)                         \
  X(PFNGLSCISSORPROC, Scissor)                                           \
  X(PFNGLSCISSORINDEXEDPROC, ScissorIndexed)                             \
  X(PFNGLDEPTHFUNCPROC, DepthFunc)                                       \
  X(PFNGLDEPTHMASKPROC, DepthMask)                                       \
  X(PFNGLCOLORMASKPROC, ColorMask)                                       \
  X(PFNGLCOLORMASKIPROC, ColorMaski)                                     \
  X(PFNGLDEPTHRANGEPROC, DepthRange)                                     \
  X(PFNGLDEPTHRANGEINDEXEDPROC, DepthRangeIndexed)                       \
  X(PFNGLCLIPCONTROLPROC, ClipControl)                                   \
  X(PFNGLCULLFACEPROC, CullFace)                                         \
  X(PFNGLFRONTFACEPROC, FrontFace)                                       \
  X(PFNGLPOLYGONMODEPROC, PolygonMode)                                   \
  X(PFNGLPOLYGONOFFSETPROC, PolygonOffset)                               \
  X(PFNGLPROVOKINGVERTEXPROC, ProvokingVertex)                           \
  X(PFNGLBLENDFUNCSEPARATEPROC, BlendFuncSeparate)                       \
  X(PFNGLBLENDFUNCSEPARATEIPROC, BlendFuncSeparatei)                     \
  X(PFNGLBLENDEQUATIONSEPARATEPROC, BlendEquationSeparate)               \
  X(PFNGLBLENDEQUATIONSEPARATEIPROC, BlendEquationSeparatei)             \
  X(PFNGLPIXELSTOREIPROC, PixelStorei)                                   \
  X(PFNGLCREATEBUFFERSPROC, CreateBuffers)                               \
  X(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                               \
  X(PFNGLNAMEDBUFFERSTORAGEPROC, NamedBufferStorage)                     \
  X(PFNGLNAMEDBUFFERSUBDATAPROC, NamedBufferSubData)                     \
  X(PFNGLGETNAMEDBUFFERSUBDATAPROC, GetNamedBufferSubData)               \
  X(PFNGLCLEARNAMEDBUFFERDATAPROC, ClearNamedBufferData)                 \
  X(PFNGLCLEARNAMEDBUFFERSUBDATAPROC, ClearNamedBufferSubData)           \
  X(PFNGLCOPYNAMEDBUFFERSUBDATAPROC, CopyNamedBufferSubData)             \
  X(PFNGLMAPNAMEDBUFFERRANGEPROC, MapNamedBufferRange)                   \
  X(PFNGLFENCESYNCPROC, FenceSync)                                       \
  X(PFNGLDELETESYNCPROC, DeleteSync)                                     \
  X(PFNGLCLIENTWAITSYNCPROC, ClientWaitSync)                             \
  X(PFNGLBINDBUFFERPROC, BindBuffer)                                     \
  X(PFNGLBINDBUFFERBASEPROC, BindBufferBase)                             \
  X(PFNGLBINDBUFFERRANGEPROC, BindBufferRange)                           \
  X(PFNGLCREATETEXTURESPROC, CreateTextures)                             \
  X(PFNGLDELETETEXTURESPROC, DeleteTextures)                             \
  X(PFNGLTEXTURESTORAGE2DPROC, TextureStorage2D)                         \
  X(PFNGLTEXTURESTORAGE3DPROC, TextureStorage3D)                         \
  X(PFNGLTEXTURESUBIMAGE2DPROC, TextureSubImage2D)                       \
  X(PFNGLTEXTURESUBIMAGE3DPROC, TextureSubImage3D)                       \
  X(PFNGLTEXTUREPARAMETERIPROC, TextureParameteri)                       \
  X(PFNGLTEXTUREPARAMETERFPROC, TextureParameterf)                       \
  X(PFNGLTEXTUREPARAMETERFVPROC, TextureParameterfv)                     \
  X(PFNGLGENERATETEXTUREMIPMAPPROC, GenerateTextureMipmap)               \
  X(PFNGLTEXTUREBUFFERPROC, TextureBuffer)                               \
  X(PFNGLGETTEXTUREIMAGEPROC, GetTextureImage)                           \
  X(PFNGLCLEARTEXIMAGEPROC, ClearTexImage)                               \
  X(PFNGLBINDTEXTUREUNITPROC, BindTextureUnit)                           \
  X(PFNGLBINDTEXTUREPROC, BindTexture)                                   \
  X(PFNGLBINDIMAGETEXTUREPROC, BindImageTexture)                         \
  X(PFNGLACTIVETEXTUREPROC, ActiveTexture)                               \
  X(PFNGLCREATESAMPLERSPROC, CreateSamplers)                             \
  X(PFNGLDELETESAMPLERSPROC, DeleteSamplers)                             \
  X(PFNGLBINDSAMPLERPROC, BindSampler)                                   \
  X(PFNGLSAMPLERPARAMETERIPROC, SamplerParameteri)                       \
  X(PFNGLSAMPLERPARAMETERFPROC, SamplerParameterf)                       \
  X(PFNGLCREATEFRAMEBUFFERSPROC, CreateFramebuffers)                     \
  X(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)                     \
  X(PFNGLNAMEDFRAMEBUFFERTEXTUREPROC, NamedFramebufferTexture)           \
  X(PFNGLNAMEDFRAMEBUFFERTEXTURELAYERPROC, NamedFramebufferTextureLayer) \
  X(PFNGLNAMEDFRAMEBUFFERDRAWBUFFERPROC, NamedFramebufferDrawBuffer)     \
  X(PFNGLNAMEDFRAMEBUFFERDRAWBUFFERSPROC, NamedFramebufferDrawBuffers)   \
  X(PFNGLNAMEDFRAMEBUFFERPARAMETERIPROC, NamedFramebufferParameteri)     \
  X(PFNGLCHECKNAMEDFRAMEBUFFERSTATUSPROC, CheckNamedFramebufferStatus)   \
  X(PFNGLCLEARNAMEDFRAMEBUFFERFVPROC, ClearNamedFramebufferfv)           \
  X(PFNGLCLEARNAMEDFRAMEBUFFERUIVPROC, ClearNamedFramebufferuiv)         \
  X(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                           \
  X(PFNGLREADPIXELSPROC, ReadPixels)                                     \
  X(PFNGLCREATEVERTEXARRAYSPROC, CreateVertexArrays)                     \
  X(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)                     \
  X(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                           \
  X(PFNGLDRAWARRAYSPROC, DrawArrays)                                     \
  X(PFNGLDRAWARRAYSINSTANCEDPROC, DrawArraysInstanced)                   \
  X(PFNGLDRAWARRAYSINDIRECTPROC, DrawArraysIndirect)                     \
  X(PFNGLDISPATCHCOMPUTEPROC, DispatchCompute)                           \
  X(PFNGLDISPATCHCOMPUTEINDIRECTPROC, DispatchComputeIndirect)           \
  X(PFNGLMEMORYBARRIERPROC, MemoryBarrier)                               \
  X(PFNGLCREATESHADERPROC, CreateShader)                                 \
  X(PFNGLDELETESHADERPROC, DeleteShader)                                 \
  X(PFNGLSHADERSOURCEPROC, ShaderSource)                                 \
  X(PFNGLCOMPILESHADERPROC, CompileShader)                               \
  X(PFNGLGETSHADERIVPROC, GetShaderiv)                                   \
  X(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)                         \
  X(PFNGLCREATEPROGRAMPROC, CreateProgram)                               \
  X(PFNGLDELETEPROGRAMPROC, DeleteProgram)                               \
  X(PFNGLATTACHSHADERPROC, AttachShader)                                 \
  X(PFNGLLINKPROGRAMPROC, LinkProgram)                                   \
  X(PFNGLGETPROGRAMIVPROC, GetProgramiv)                                 \
  X(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)                       \
  X(PFNGLUSEPROGRAMPROC, UseProgram)                                     \
  X(PFNGLBINDPROGRAMPIPELINEPROC, BindProgramPipeline)                   \
  X(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation)                     \
  X(PFNGLPROGRAMUNIFORM1IPROC, ProgramUniform1i)                         \
  X(PFNGLPROGRAMUNIFORM1UIPROC, ProgramUniform1ui)                       \
  X(PFNGLPROGRAMUNIFORM1FPROC, ProgramUniform1f)                         \
  X(PFNGLPROGRAMUNIFORM2FPROC, ProgramUniform2f)                         \
  X(PFNGLPROGRAMUNIFORM3FPROC, ProgramUniform3f)                         \
  X(PFNGLPROGRAMUNIFORM4FPROC, ProgramUniform4f)                         \
  X(PFNGLPROGRAMUNIFORM3IPROC, ProgramUniform3i)                         \
  X(PFNGLPROGRAMUNIFORMMATRIX4FVPROC, ProgramUniformMatrix4fv)           \
  X(PFNGLGENQUERIESPROC, GenQueries)                                     \
  X(PFNGLDELETEQUERIESPROC, DeleteQueries)                               \
  X(PFNGLQUERYCOUNTERPROC, QueryCounter)                                 \
  X(PFNGLGETQUERYOBJECTUI64VPROC, GetQueryObjectui64v)                   \
  X(PFNGLDEBUGMESSAGECALLBACKPROC, DebugMessageCallback)                 \
  X(PFNGLDEBUGMESSAGECONTROLPROC, DebugMessageControl)                   \
  X(PFNGLPUSHDEBUGGROUPPROC, PushDebugGroup)                             \
  X(PFNGLPOPDEBUGGROUPPROC, PopDebugGroup)                               \
  X(PFNGLOBJECTLABELPROC, ObjectLabel)

struct Limits {
  GLint64 storageBlockBytes = 0;  // one shader storage block
  GLint64 bufferTexels = 0;       // one buffer texture
  GLint textureSize = 0;
  GLint arrayLayers = 0;
  GLint framebufferSize = 0;  // smaller of width and height
  GLint computeStorageBlocks = 0;
  GLint fragmentStorageBlocks = 0;
  GLint textureUnits = 0;
};

struct Api {
#define HALFSILVER_GL_MEMBER(type, name) type name = nullptr;
  HALFSILVER_GL_FUNCTIONS(HALFSILVER_GL_MEMBER)
#undef HALFSILVER_GL_MEMBER

  Limits limits;
  std::string vendor, renderer, version;
  bool software = false;  // a software rasterizer: the loop limit of its shaders applies (see tracing)

  // How often the host has been made to wait for the GPU (see gl/readback.h). Copies of the table share the count.
  std::shared_ptr<std::uint64_t> hostWaits = std::make_shared<std::uint64_t>(0);

  // Fills the table from the current context. Throws Error (noContext) that names a missing function, a version
  // below 4.5 or a limit that is too small for the project.
  static Api load(const GetProcAddress& getProcAddress);
};

}  // namespace halfsilver::gl
