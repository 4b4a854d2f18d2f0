// In a browser, of each case {names, point, canMultiply, css, wgsl, glsl}: the matrices as the language has them, by
// columns, and projection * view * point where both are there. An error message stands for what failed.

function evaluateCss({names, point, canMultiply, css}) {
  const style = document.createElement("style");
  style.textContent = css;
  document.head.append(style);
  const root = getComputedStyle(document.documentElement);
  const matrices = {};
  for (const name of names) matrices[name] = Array.from(new DOMMatrix(root.getPropertyValue("--" + name)).toFloat64Array());
  const result = {matrices};
  if (canMultiply) {
    const box = document.getElementById("box");
    box.style.transform = "var(--projection) var(--view)";
    const p = new DOMMatrix(getComputedStyle(box).transform).transformPoint(new DOMPoint(...point));
    result.product = [p.x, p.y, p.z, p.w];
  }
  style.remove();
  return result;
}

/// The numbers that a shader gives, four for each of these expressions.
function expressions({names, point, canMultiply}, vec4) {
  const axes = ["1.0, 0.0, 0.0, 0.0", "0.0, 1.0, 0.0, 0.0", "0.0, 0.0, 1.0, 0.0", "0.0, 0.0, 0.0, 1.0"];
  const columns = names.flatMap(name => axes.map(axis => `${name} * ${vec4}(${axis})`));
  const literal = point.map(x => x.toFixed(3)).join(", ");
  return canMultiply ? [...columns, `projection * view * ${vec4}(${literal})`] : columns;
}

function named({names, canMultiply}, numbers) {
  const matrices = Object.fromEntries(names.map((name, i) => [name, numbers.slice(16 * i, 16 * i + 16)]));
  return canMultiply ? {matrices, product: numbers.slice(16 * names.length, 16 * names.length + 4)} : {matrices};
}

async function evaluateWgsl(test, device) {
  const asked = expressions(test, "vec4<f32>");
  const code = `${test.wgsl}
@group(0) @binding(0) var<storage, read_write> result: array<vec4<f32>>;
@compute @workgroup_size(1) fn main() {
${asked.map((expression, i) => `  result[${i}] = ${expression};`).join("\n")}
}`;
  const module = device.createShaderModule({code});
  const errors = (await module.getCompilationInfo()).messages.filter(m => m.type === "error");
  if (errors.length > 0) return errors.map(e => `${e.lineNum}: ${e.message}`).join("; ");
  const pipeline = await device.createComputePipelineAsync({layout: "auto", compute: {module, entryPoint: "main"}});
  const size = 16 * asked.length;
  const storage = device.createBuffer({size, usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC});
  const readable = device.createBuffer({size, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST});
  const encoder = device.createCommandEncoder();
  const pass = encoder.beginComputePass();
  pass.setPipeline(pipeline);
  pass.setBindGroup(0, device.createBindGroup({
    layout: pipeline.getBindGroupLayout(0), entries: [{binding: 0, resource: {buffer: storage}}]}));
  pass.dispatchWorkgroups(1);
  pass.end();
  encoder.copyBufferToBuffer(storage, 0, readable, 0, size);
  device.queue.submit([encoder.finish()]);
  await readable.mapAsync(GPUMapMode.READ);
  return named(test, Array.from(new Float32Array(readable.getMappedRange())));
}

/// Four expressions at a time, by transform feedback.
function evaluateGlsl(test, gl) {
  const asked = expressions(test, "vec4");
  const numbers = [];
  for (let first = 0; first < asked.length; first += 4) {
    const part = asked.slice(first, first + 4);
    const shader = (type, source) => {
      const s = gl.createShader(type);
      gl.shaderSource(s, "#version 300 es\nprecision highp float;\n" + source);
      gl.compileShader(s);
      return s;
    };
    const program = gl.createProgram();
    const vertex = shader(gl.VERTEX_SHADER, test.glsl + part.map((_, i) => `out vec4 r${i};\n`).join("") +
      "void main() {\n" + part.map((expression, i) => `  r${i} = ${expression};\n`).join("") + "}\n");
    gl.attachShader(program, vertex);
    gl.attachShader(program, shader(gl.FRAGMENT_SHADER, "out vec4 colour;\nvoid main() { colour = vec4(0.0); }\n"));
    gl.transformFeedbackVaryings(program, part.map((_, i) => "r" + i), gl.INTERLEAVED_ATTRIBS);
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS))
      return gl.getShaderInfoLog(vertex) + gl.getProgramInfoLog(program);
    const buffer = gl.createBuffer();
    gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, buffer);
    gl.bufferData(gl.TRANSFORM_FEEDBACK_BUFFER, 64, gl.DYNAMIC_READ);
    gl.useProgram(program);
    gl.enable(gl.RASTERIZER_DISCARD);
    gl.beginTransformFeedback(gl.POINTS);
    gl.drawArrays(gl.POINTS, 0, 1);
    gl.endTransformFeedback();
    const got = new Float32Array(4 * part.length);
    gl.getBufferSubData(gl.TRANSFORM_FEEDBACK_BUFFER, 0, got);
    numbers.push(...got);
  }
  return named(test, numbers);
}

async function each(evaluate) {
  const results = [];
  for (const test of cases) {
    try {
      results.push(await evaluate(test));
    } catch (error) {
      results.push(String(error));
    }
  }
  return results;
}

(async () => {
  const results = {css: await each(evaluateCss)};
  const adapter = navigator.gpu ? await navigator.gpu.requestAdapter() : null;
  const device = adapter ? await adapter.requestDevice() : null;
  results.wgsl = device ? await each(test => evaluateWgsl(test, device)) : "this browser has no WebGPU here";
  const gl = document.createElement("canvas").getContext("webgl2");
  results.glsl = gl ? await each(test => evaluateGlsl(test, gl)) : "this browser has no WebGL 2 here";
  await fetch("/", {method: "POST", body: JSON.stringify(results)});
})();
