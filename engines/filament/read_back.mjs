// Reads Filament's render target as floats: its package binds no read-back, so the textures are caught as it makes them.

const full_screen = `#version 300 es
void main() { gl_Position = vec4(4 * (gl_VertexID & 1) - 1, 2 * (gl_VertexID & 2) - 1, 0, 1); }`;
const depth_of = `#version 300 es
precision highp float;
uniform highp sampler2D image;
out vec4 color;
void main() { color = vec4(texelFetch(image, ivec2(gl_FragCoord.xy), 0).r); }`;

/** Reads textures of a WebGL context that another library draws with: what that one has bound is bound again. */
export class ReadBack {
  constructor(gl) {
    this.gl = gl;
    if (!gl.getExtension('EXT_color_buffer_float')) throw new Error('WebGL cannot draw to 32-bit floats here');
    this.made = new Map();
    const original = gl.texStorage2D.bind(gl);
    gl.texStorage2D = (target, levels, format, ...size) => {
      this.made.set(format, gl.getParameter(gl.TEXTURE_BINDING_2D));
      original(target, levels, format, ...size);
    };
    const program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, full_screen], [gl.FRAGMENT_SHADER, depth_of]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    const sampler = gl.createSampler();  // depth cannot be filtered
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.samplerParameteri(sampler, name, gl.NEAREST);
    Object.assign(this, {program, sampler, vertices: gl.createVertexArray(), framebuffer: gl.createFramebuffer()});
  }

  /** The texture of this format that was made last. */
  last(format) {
    const texture = this.made.get(format);
    if (!texture) throw new Error('Filament made no texture to draw to');
    return texture;
  }

  /** Runs `work` and restores what it may have changed. */
  guarded(work) {
    const {gl} = this;
    const get = (name) => gl.getParameter(name);
    const unit = get(gl.ACTIVE_TEXTURE);
    gl.activeTexture(gl.TEXTURE0);
    const switches = [gl.BLEND, gl.CULL_FACE, gl.DEPTH_TEST, gl.SCISSOR_TEST, gl.STENCIL_TEST]
      .filter((name) => gl.isEnabled(name));
    const kept = {
      program: get(gl.CURRENT_PROGRAM), vertices: get(gl.VERTEX_ARRAY_BINDING), texture: get(gl.TEXTURE_BINDING_2D),
      sampler: get(gl.SAMPLER_BINDING), draw: get(gl.DRAW_FRAMEBUFFER_BINDING), read: get(gl.READ_FRAMEBUFFER_BINDING),
      viewport: get(gl.VIEWPORT), mask: get(gl.COLOR_WRITEMASK), pack: get(gl.PIXEL_PACK_BUFFER_BINDING),
    };
    try {
      for (const name of switches) gl.disable(name);
      gl.colorMask(true, true, true, true);
      gl.bindSampler(0, this.sampler);
      gl.bindBuffer(gl.PIXEL_PACK_BUFFER, null);
      gl.bindFramebuffer(gl.FRAMEBUFFER, this.framebuffer);
      return work();
    } finally {
      for (const name of switches) gl.enable(name);
      gl.colorMask(...kept.mask);
      gl.useProgram(kept.program);
      gl.bindVertexArray(kept.vertices);
      gl.bindTexture(gl.TEXTURE_2D, kept.texture);
      gl.bindSampler(0, kept.sampler);
      gl.activeTexture(unit);
      gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, kept.draw);
      gl.bindFramebuffer(gl.READ_FRAMEBUFFER, kept.read);
      gl.bindBuffer(gl.PIXEL_PACK_BUFFER, kept.pack);
      gl.viewport(...kept.viewport);
    }
  }

  attach(texture) {
    const {gl} = this;
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
  }

  pixels(width, height) {
    const {gl} = this;
    const pixels = new Float32Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, pixels);
    return pixels;
  }

  color(texture, width, height) {
    return this.guarded(() => {
      this.attach(texture);
      return this.pixels(width, height);
    });
  }

  /** Window depth, four times for each pixel. */
  depth(texture, width, height) {
    const {gl} = this;
    return this.guarded(() => {
      const image = gl.createTexture();
      gl.bindTexture(gl.TEXTURE_2D, image);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, width, height, 0, gl.RGBA, gl.FLOAT, null);
      this.attach(image);
      gl.bindTexture(gl.TEXTURE_2D, texture);
      gl.useProgram(this.program);
      gl.bindVertexArray(this.vertices);
      gl.viewport(0, 0, width, height);
      gl.drawArrays(gl.TRIANGLES, 0, 3);
      const pixels = this.pixels(width, height);
      gl.deleteTexture(image);
      return pixels;
    });
  }
}
