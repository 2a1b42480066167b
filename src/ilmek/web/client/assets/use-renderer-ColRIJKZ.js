import{dt as e,et as t,lt as n,st as r,tt as i}from"./ui-DclGgGtY.js";import{C as a,w as o}from"./strokes-BiikK0-K.js";var s=`#version 300 es
uniform vec4 u_tile;   // first column and line, columns and lines of the tile
uniform vec4 u_view;   // middle of the view [knots], breadth and height of a knot [px]
uniform vec2 u_size;   // of the canvas [px]
out vec2 v_at;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  v_at = corner * u_tile.zw;
  vec2 px = (u_tile.xy + v_at - u_view.xy) * u_view.zw;
  gl_Position = vec4(2.0 * px.x / u_size.x, -2.0 * px.y / u_size.y, 0.0, 1.0);
}`,c=`#version 300 es
precision highp float;
precision highp int;
precision highp usampler2D;
uniform usampler2D u_knots;
uniform sampler2D u_palette;
uniform sampler2D u_symbols;
uniform sampler2D u_source;
uniform vec4 u_tile;
uniform vec4 u_view;
uniform vec2 u_size;
uniform vec2 u_grid;      // columns and lines of the chart
uniform float u_split;    // from here to the right the carpet is shown [px]
uniform int u_left;       // what is left of it: 0 chart, 1 picture
uniform int u_samples;    // samples of a pixel in each direction
uniform float u_lines;    // every so many knots a stronger line
uniform float u_ratio;    // pixels of the screen for one of the page
in vec2 v_at;
out vec4 colour;

vec3 linear(vec3 c) { return c * c; }
vec3 coded(vec3 c) { return sqrt(c); }
uint knotAt(vec2 at) { return texelFetch(u_knots, clamp(ivec2(at), ivec2(0), ivec2(u_tile.zw) - 1), 0).r; }
vec3 yarnOf(uint knot) { return texelFetch(u_palette, ivec2(int(knot), 0), 0).rgb; }
float hash(vec2 p) { return fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.5453); }

vec3 averaged() {
  vec2 step = 1.0 / u_view.zw;
  vec3 sum = vec3(0.0);
  for (int i = 0; i < u_samples; i++) {
    for (int j = 0; j < u_samples; j++) {
      vec2 offset = (vec2(float(i), float(j)) + 0.5) / float(u_samples) - 0.5;
      sum += linear(yarnOf(knotAt(v_at + offset * step)));
    }
  }
  return coded(sum / float(u_samples * u_samples));
}

vec3 chartColour(vec3 c, vec2 within, vec2 knot, float px) {
  float ink = dot(c, vec3(0.3, 0.59, 0.11)) > 0.45 ? 0.0 : 1.0;
  if (px > 13.0 * u_ratio) {
    uint yarn = knotAt(v_at);
    vec2 cell = vec2(float(yarn & 15u), float(yarn >> 4u));
    float side = min(u_view.z, u_view.w);
    vec2 local = (within - 0.5) * u_view.zw / side + 0.5;
    float sign = texture(u_symbols, (cell + clamp(local, 0.0, 1.0)) / 16.0).r;
    float fade = clamp((px / u_ratio - 13.0) / 6.0, 0.0, 1.0);
    if (local == clamp(local, 0.0, 1.0)) c = mix(c, vec3(ink), 0.85 * sign * fade);
  }
  if (px > 5.0 * u_ratio) {
    vec2 far = min(within, 1.0 - within) * u_view.zw;
    float fade = clamp((px / u_ratio - 5.0) / 8.0, 0.0, 1.0);
    float thin = 1.0 - smoothstep(0.25, 0.75, min(far.x, far.y) / u_ratio);
    // Lines are counted from the lower left knot, as the weaver counts.
    vec2 from = vec2(knot.x + within.x, u_grid.y - knot.y - within.y);
    vec2 strong = abs(from - u_lines * floor(from / u_lines + 0.5)) * u_view.zw;
    float thick = 1.0 - smoothstep(0.75, 1.5, min(strong.x, strong.y) / u_ratio);
    c = mix(c, vec3(ink), fade * max(0.22 * thin, 0.65 * thick));
  }
  return c;
}

float lot(float at) {
  return mix(hash(vec2(floor(at), 7.0)), hash(vec2(floor(at) + 1.0, 7.0)), smoothstep(0.0, 1.0, fract(at))) - 0.5;
}

vec3 carpetColour(vec3 c, vec2 within, vec2 knot, float px) {
  float near = clamp((px / u_ratio - 2.0) / 6.0, 0.0, 1.0);
  float grain = hash(knot) - 0.5;
  // Hand-dyed lots follow each other along the carpet; pile is darker than flat yarn.
  float row = knot.y + within.y;
  c *= 1.0 + 0.07 * near * grain + 0.09 * lot(row / 11.0) + 0.05 * lot(row / 3.0 + 40.0);
  vec2 p = 2.0 * within - 1.0;
  float side = 1.0 - abs(p.x);
  // A knot shows the ends of its yarn as two tufts side by side, the nap towards the lower edge.
  float tuft = 1.0 - 0.55 * pow(abs(abs(p.x) - 0.48) / 0.52, 2.0);
  float nap = 1.04 - 0.30 * smoothstep(0.25, 1.0, p.y) - 0.16 * smoothstep(0.4, 1.0, -p.y);
  float fibre = 0.05 * sin(40.0 * p.x + 6.0 * grain + 3.0 * p.y);
  return c * mix(0.86, 1.1 * clamp(tuft, 0.0, 1.0) * nap * (1.0 + fibre) * (0.86 + 0.14 * smoothstep(0.0, 0.3, side)), near);
}

void main() {
  float px = u_view.w;
  vec2 within = fract(v_at);
  vec2 knot = u_tile.xy + floor(v_at);
  bool carpet = gl_FragCoord.x >= u_split;
  if (!carpet && u_left == 1) {
    colour = vec4(texture(u_source, (u_tile.xy + v_at) / u_grid).rgb, 1.0);
  } else {
    vec3 c = u_samples > 1 ? averaged() : yarnOf(knotAt(v_at));
    c = carpet ? carpetColour(c, within, knot, px) : chartColour(c, within, knot, px);
    colour = vec4(c, 1.0);
  }
  if (abs(gl_FragCoord.x - u_split) < u_ratio && u_split > 0.0 && u_split < u_size.x) {
    colour = vec4(mix(colour.rgb, vec3(1.0), 0.75), 1.0);
  }
}`,l=[`u_knots`,`u_palette`,`u_symbols`,`u_source`,`u_tile`,`u_view`,`u_size`,`u_grid`,`u_split`,`u_left`,`u_samples`,`u_lines`,`u_ratio`],u=8192,d=64,f=120,p=24,m=class e{canvas;#e;#t;#n;#r;#i;#a;#o=[];#s={rows:0,columns:0,aspect:1};#c=null;#l=0;#u;#d=!1;#f=!1;#p={width:1,height:1};#m=16;#h=0;#g=!1;#_=0;#v=``;static of(t){let n=t.getContext(`webgl2`,{antialias:!1,alpha:!0,preserveDrawingBuffer:!1});return n===null?null:new e(t,n)}constructor(e,t){this.canvas=e,this.#e=t,this.#t=_(t),this.#n=Object.fromEntries(l.map(e=>[e,t.getUniformLocation(this.#t,e)])),this.#r=g(t,t.NEAREST),this.#i=g(t,t.LINEAR_MIPMAP_LINEAR),this.#a=g(t,t.LINEAR),t.pixelStorei(t.UNPACK_ALIGNMENT,1),t.bindTexture(t.TEXTURE_2D,this.#a),t.texImage2D(t.TEXTURE_2D,0,t.RGB8,1,1,0,t.RGB,t.UNSIGNED_BYTE,new Uint8Array(3))}get largestTile(){return Math.min(u,this.#e.getParameter(this.#e.MAX_TEXTURE_SIZE))}setChart(e,t){let n=this.#e,r=e.rows===this.#s.rows&&e.columns===this.#s.columns;if(this.#s=e,!r){for(let e of this.#o)n.deleteTexture(e.texture);this.#o=o(e.rows,e.columns,this.largestTile).map(e=>({...e,texture:g(n,n.NEAREST)}))}for(let i of this.#o){n.bindTexture(n.TEXTURE_2D,i.texture);let o=a(t,e.columns,i),{columns:s,rows:c}=i;r?n.texSubImage2D(n.TEXTURE_2D,0,0,0,s,c,n.RED_INTEGER,n.UNSIGNED_BYTE,o):n.texImage2D(n.TEXTURE_2D,0,n.R8UI,s,c,0,n.RED_INTEGER,n.UNSIGNED_BYTE,o)}this.draw()}paint(e,t){let n=this.#e,r=new Uint8Array(this.#s.columns).fill(t);for(let t of this.#o){n.bindTexture(n.TEXTURE_2D,t.texture);for(let{column:i,line:a,length:o}of e){let e=Math.max(i-t.column,0),s=Math.min(i+o-t.column,t.columns)-e,c=a-t.line;s<1||c<0||c>=t.rows||n.texSubImage2D(n.TEXTURE_2D,0,e,c,s,1,n.RED_INTEGER,n.UNSIGNED_BYTE,r)}}this.draw()}setYarns(e){let t=this.#e,n=new Uint8Array(1024).fill(255);e.forEach((e,t)=>{let r=Number.parseInt(e.srgb.slice(1),16);n.set([r>>16,r>>8&255,r&255],4*t)}),t.bindTexture(t.TEXTURE_2D,this.#r),t.texImage2D(t.TEXTURE_2D,0,t.RGBA8,256,1,0,t.RGBA,t.UNSIGNED_BYTE,n);let r=e.map(e=>e.symbol).join(`
`);r!==this.#v&&this.#y(e),this.#v=r,this.draw()}#y(e){let t=this.#e,n=document.createElement(`canvas`);n.width=1024,n.height=1024;let r=n.getContext(`2d`);r!==null&&(r.fillStyle=`#000`,r.fillRect(0,0,n.width,n.height),r.fillStyle=`#fff`,r.textAlign=`center`,r.textBaseline=`middle`,r.font=`${.66*d}px "DejaVu Sans", system-ui, sans-serif`,e.slice(0,256).forEach((e,t)=>{r.fillText(e.symbol,(t%16+.5)*d,(Math.floor(t/16)+.54)*d,.9*d)}),t.bindTexture(t.TEXTURE_2D,this.#i),t.texImage2D(t.TEXTURE_2D,0,t.R8,t.RED,t.UNSIGNED_BYTE,n),t.generateMipmap(t.TEXTURE_2D))}setSource(e,t,n){let r=this.#e;r.bindTexture(r.TEXTURE_2D,this.#a),r.texImage2D(r.TEXTURE_2D,0,r.RGB8,e,t,0,r.RGB,r.UNSIGNED_BYTE,n),this.#g=!0,this.draw()}show(e){this.#c=e,this.#d&&(this.#f=!1),this.#d=!1,this.draw(),clearTimeout(this.#u),this.#u=setTimeout(()=>{this.#d=!0,this.draw()},f)}resize(e,t){this.#p={width:e,height:t},this.draw()}draw(){this.#l===0&&(this.#l=requestAnimationFrame(()=>this.#b()))}#b(){this.#l=0;let[e,t,n]=[this.#e,this.#c,this.#s],r=performance.now();!this.#d&&r-this.#h<f&&(this.#m+=.2*(r-this.#h-this.#m)),this.#h=r,this.#m>p&&(this.#f=!0);let i=this.#f&&!this.#d?2:1,[a,o]=[Math.ceil(this.#p.width/i),Math.ceil(this.#p.height/i)];if(this.canvas.width!==a&&(this.canvas.width=a),this.canvas.height!==o&&(this.canvas.height=o),e.viewport(0,0,a,o),e.clearColor(0,0,0,0),e.clear(e.COLOR_BUFFER_BIT),t===null||n.rows===0||e.isContextLost())return;let s=a/Math.max(1,this.canvas.clientWidth),c=t.view.scale*s,l=c*Math.min(1,n.aspect);e.useProgram(this.#t),[null,this.#r,this.#i,this.#a].forEach((t,n)=>{e.activeTexture(e.TEXTURE0+n),t!==null&&e.bindTexture(e.TEXTURE_2D,t)}),e.uniform1i(this.#n.u_knots,0),e.uniform1i(this.#n.u_palette,1),e.uniform1i(this.#n.u_symbols,2),e.uniform1i(this.#n.u_source,3),e.uniform4f(this.#n.u_view,t.view.x,t.view.y,c*n.aspect,c),e.uniform2f(this.#n.u_size,a,o),e.uniform2f(this.#n.u_grid,n.columns,n.rows),e.uniform1f(this.#n.u_split,t.split>=1?a+9:t.split*a),e.uniform1i(this.#n.u_left,t.left===`source`&&this.#g?1:0),e.uniform1i(this.#n.u_samples,h(l,this.#d?8:this.#f?1:2)),e.uniform1f(this.#n.u_lines,10),e.uniform1f(this.#n.u_ratio,s),e.activeTexture(e.TEXTURE0);for(let t of this.#o)e.bindTexture(e.TEXTURE_2D,t.texture),e.uniform4f(this.#n.u_tile,t.column,t.line,t.columns,t.rows),e.drawArrays(e.TRIANGLE_STRIP,0,4);this.#_+=1,this.canvas.dataset.pictures=String(this.#_)}end(){cancelAnimationFrame(this.#l),clearTimeout(this.#u);let e=this.#e;for(let t of this.#o)e.deleteTexture(t.texture);for(let t of[this.#r,this.#i,this.#a])e.deleteTexture(t);e.deleteProgram(this.#t),this.#o=[]}};function h(e,t){return e>=2?1:Math.min(Math.ceil(1/e)+1,t)}function g(e,t){let n=e.createTexture();return e.bindTexture(e.TEXTURE_2D,n),e.texParameteri(e.TEXTURE_2D,e.TEXTURE_MIN_FILTER,t),e.texParameteri(e.TEXTURE_2D,e.TEXTURE_MAG_FILTER,t===e.NEAREST?e.NEAREST:e.LINEAR),e.texParameteri(e.TEXTURE_2D,e.TEXTURE_WRAP_S,e.CLAMP_TO_EDGE),e.texParameteri(e.TEXTURE_2D,e.TEXTURE_WRAP_T,e.CLAMP_TO_EDGE),n}function _(e){let t=e.createProgram();for(let[n,r]of[[e.VERTEX_SHADER,s],[e.FRAGMENT_SHADER,c]]){let i=e.createShader(n);e.shaderSource(i,r),e.compileShader(i),e.attachShader(t,i)}if(e.linkProgram(t),!e.getProgramParameter(t,e.LINK_STATUS)&&!e.isContextLost()){let n=e.getAttachedShaders(t)??[];throw Error(n.map(t=>e.getShaderInfoLog(t)).join(`
`))}return t}function v(a){let o=n(null),s=n(null),c=t({width:1,height:1}),l=t(0),[u,d]=e(!1);return r(()=>{let e=o.current;if(e===null)return;let t=()=>{let t=Math.min(devicePixelRatio,2),[n,r]=[Math.max(1,e.clientWidth),Math.max(1,e.clientHeight)];c.value={width:n,height:r},s.current?.resize(Math.round(n*t),Math.round(r*t))},n=()=>{s.current=m.of(e),d(s.current===null)},r=e=>e.preventDefault(),i=()=>{n(),t(),l.value+=1};n(),e.addEventListener(`webglcontextlost`,r),e.addEventListener(`webglcontextrestored`,i);let a=new ResizeObserver(t);return a.observe(e),()=>{a.disconnect(),e.removeEventListener(`webglcontextlost`,r),e.removeEventListener(`webglcontextrestored`,i),s.current?.end(),s.current=null}},[]),i(()=>{l.value;let e=a.chart.value;e!==null&&(s.current?.setYarns(e.about.yarns),s.current?.setChart(e.grid,e.knots))}),{canvas:o,renderer:s,size:c,restored:l,missing:u}}export{v as t};