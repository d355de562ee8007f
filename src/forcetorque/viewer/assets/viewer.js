"use strict";(()=>{var ci="#1f2430",pa="#c9ced6",lm="#0072B2",Vl="#D55E00",Gl=["#D55E00","#009E73","#0072B2"],Hl="#7a4a00",Wl="#882255",Xl="#5b6472",ql=["#f3efe6","#f2c14e","#d1495b","#3b0f70"],Mr={calibration:"#56B4E9",validation:"#009E73",ignore:"#8a8f98"},cy="#000000",od=["#0072B2","#D55E00","#009E73","#CC79A7","#E69F00","#56B4E9"];function Ri(n,e){if(e.role==="expected")return cy;let t=n.wrenches.filter(i=>i.role==="measured").indexOf(e);return od[t%od.length]??od[0]}function ma(n,e){return n+Math.round(e*255).toString(16).padStart(2,"0")}function wr(n){let e={begin:0,point:1,end:2};return[...n].sort((t,i)=>t.sample-i.sample||e[t.mark]-e[i.mark])}function Bi(n,e){let t=[],i=new Set(n.scene.intervals.map(r=>r.label)),s=null;for(let r of wr(e))if(r.mark==="begin")s=r;else if(r.mark==="end"&&s!==null){let o=hy(s.label||"marked",i),a={start_s:s.time_s,end_s:uy(n,r.sample),use:s.use},l={supportLines:dy(n,a),overlaps:fy(n,a)};t.push({begin:s,label:o,...a,...l}),s=null}return t}function cm(n){let e=[],t=null;for(let i of wr(n))i.mark!=="point"&&(i.mark==="end"&&t===null&&e.push(i),i.mark==="begin"&&t!==null&&e.push(t),t=i.mark==="begin"?i:null);return t===null?e:[...e,t]}function hm(n,e){return[...n.scene.intervals,...Bi(n,e)].filter(t=>t.use==="ignore")}function hy(n,e){let t=n;for(let i=2;e.has(t);i++)t=`${n} ${i}`;return e.add(t),t}function uy(n,e){let t=n.samples-1,[i,s]=n.span,r=t>0?(s-i)/t:1;return Math.min(e<t?n.time[e+1]??0:s+r,n.scene.end_s)}function dy(n,{start_s:e,end_s:t,use:i}){let{intervals:s}=n.scene;if(!s.every(o=>o.states_support))return[];let r=s.find(o=>o.support!==null&&o.start_s<=e&&t<=o.end_s+1e-9);return r?[`support = ${ga(r.support??"")}`]:i==="ignore"?[]:['# support = "..."  # state the link that stands still']}function fy(n,{start_s:e,end_s:t,use:i}){return n.scene.intervals.filter(s=>i!=="ignore"&&s.use!=="ignore").filter(s=>s.start_s<t-1e-9&&e<s.end_s-1e-9).map(s=>s.label)}function ga(n){return JSON.stringify(n).replaceAll("\x7F","\\u007f")}function um(n,e,t){let i=0;for(let a=0;a<n;a++)t(a)&&i++;let s=Math.max(1,Math.ceil(i/e)),r=new Uint32Array(Math.ceil(i/s)),o=0;for(let a=0;a<n;a++)t(a)&&(o%s===0&&(r[o/s]=a),o++);return r}function dm(n,e,t,i,s){let r=i-t;if(r<=2*s){let l=Array.from({length:r},(c,h)=>t+h);return{x:l.map(c=>n[c]??0),y:e.map(({values:c,place:h})=>l.map(u=>ad(c[6*u+h])))}}let o=[],a=e.map(()=>[]);for(let l=0;l<s;l++){let c=t+Math.floor(r*l/s),h=t+Math.floor(r*(l+1)/s);o.push(n[c]??0,n[c+h>>1]??0),e.forEach(({values:u,place:d},f)=>a[f]?.push(...py(u,d,c,h)))}return{x:o,y:a}}function py(n,e,t,i){let s=-1,r=-1;for(let o=t;o<i;o++){let a=n[6*o+e]??Number.NaN;Number.isNaN(a)||((s<0||a<(n[6*s+e]??0))&&(s=o),(r<0||a>(n[6*r+e]??0))&&(r=o))}return s<0?[null,null]:[ad(n[6*Math.min(s,r)+e]),ad(n[6*Math.max(s,r)+e])]}function ad(n){return n===void 0||Number.isNaN(n)?null:n}function fm(n,e){let t=Number.POSITIVE_INFINITY,i=Number.NEGATIVE_INFINITY;for(let s=e;s<n.length;s+=6){let r=n[s]??Number.NaN;r<t&&(t=r),r>i&&(i=r)}return t<=i?[t,i]:null}function _a(n,e,t){if(!(e>n))return[n];let i=(e-n)/t,s=10**Math.floor(Math.log10(i)),r=[1,2,5,10].map(a=>a*s).find(a=>a>=i)??i,o=[];for(let a=Math.ceil(n/r-1e-9);a*r<=e+1e-9*r;a++)o.push(Number((a*r).toPrecision(12)));return o}var Js={force:"N",moment:"N m"},ya={force:0,moment:3},Yl=class{constructor(e,t){this.scene=e;this.block=t;this.time=this.doubles(e.time_s),this.positions=this.floats(e.positions),this.root=this.floats(e.root)}scene;block;time;positions;root;ranges=new Map;get samples(){return this.scene.samples}floats(e){return new Float32Array(this.block,this.placed(e,"float32",4),xa(e))}doubles(e){return new Float64Array(this.block,this.placed(e,"float64",8),xa(e))}integers(e){return new Uint32Array(this.block,this.placed(e,"uint32",4),xa(e))}vector(e,t,i){let s=this.floats(e.values),r=6*t+ya[i];return[s[r]??Number.NaN,s[r+1]??Number.NaN,s[r+2]??Number.NaN]}range(e,t){let i=`${e.values.offset} ${t}`,s=this.ranges.get(i);if(s!==void 0)return s;let r=fm(this.floats(e.values),t);return this.ranges.set(i,r),r}position(e,t){return this.positions[e*this.scene.coordinates.length+t]??Number.NaN}isLength(e){let t=this.scene.coordinates[e];return this.scene.robot.joints.some(i=>i.name===t&&i.type==="prismatic")}sensor(e){return this.scene.sensors[e]}sampleAt(e){let t=0,i=this.samples;for(;t<i;){let s=t+i>>1;(this.time[s]??0)<=e?t=s+1:i=s}return Math.max(0,t-1)}nearestSample(e){let t=this.sampleAt(e),i=Math.min(t+1,this.samples-1),s=Math.abs((this.time[i]??0)-e)<Math.abs((this.time[t]??0)-e);return Math.max(0,s?i:t)}get span(){return[this.time[0]??0,this.time[this.samples-1]??0]}placed(e,t,i){if(e.dtype!==t)throw new Error(`expected an array of ${t}, got ${e.dtype}`);if(e.offset+i*xa(e)>this.block.byteLength){let s=e.offset+i*xa(e);throw new Error(`an array ends at byte ${s}, the data are ${this.block.byteLength} bytes long`)}return e.offset}};function xa(n){return n.shape.reduce((e,t)=>e*t,1)}var my=2e4,gy=3,$l=class{constructor(e){this.data=e}data;key="";last={samples:new Uint32Array,clouds:[],centre:[0,0,0],half:1};of(e){let t=e.hideIgnored?hm(this.data,e.marks):[],i=JSON.stringify([e.sensor,e.quantity,t.map(s=>[s.start_s,s.end_s])]);return i!==this.key&&(this.key=i,this.last=_y(this.data,e.sensor,e.quantity,t)),this.last}};function _y(n,e,t,i){let s=new Uint8Array(n.samples);for(let{start_s:c,end_s:h}of i)s.fill(1,pm(n,c),pm(n,h));let r=n.sensor(e),o=Math.floor(my/Math.max(1,r?.wrenches.length??0)),a=um(n.samples,o,c=>s[c]===0),l=(r?.wrenches??[]).map(c=>({series:c,colour:r?Ri(r,c):"#000000",points:xy(n.floats(c.values),a,ya[t]),ellipsoid:t==="force"?c.ellipsoid_force:c.ellipsoid_moment,sphere:t==="force"?c.reference_force:c.reference_moment}));return{samples:a,clouds:l,...yy(l)}}function pm(n,e){let t=n.sampleAt(e);return(n.time[t]??0)<e?t+1:t}function xy(n,e,t){let i=new Float32Array(3*e.length);return e.forEach((s,r)=>i.set(n.subarray(6*s+t,6*s+t+3),3*r)),i}function yy(n){let e=[0,1,2].map(o=>{let a=n.flatMap(({points:u})=>[...u.filter((d,f)=>f%3===o&&!Number.isNaN(d))]),l=a.length>0?[vy(Float64Array.from(a).sort())]:[],c=n.flatMap(({sphere:u})=>u?[[u.centre[o]??0,u.radius]]:[]),h=[...l,...c.map(([u,d])=>[u-d,u+d])];return h.length>0?[Math.min(...h.map(([u])=>u)),Math.max(...h.map(([,u])=>u))]:[0,0]}),[t,i,s]=e.map(([o,a])=>(o+a)/2),r=Math.max(...e.map(([o,a])=>a-o));return{centre:[t??0,i??0,s??0],half:r>0?.55*r:1}}function vy(n){let e=o=>n[Math.round(o*(n.length-1))]??0,[t,i,s]=[e(.01),e(.5),e(.99)],r=gy*Math.max(s-i,i-t);return[Math.max(e(0),i-r),Math.min(e(1),i+r)]}function ee(n,e={},...t){let i=document.createElement(n);for(let[s,r]of Object.entries(e))r!==!1&&r!==null&&i.setAttribute(s,r===!0?"":String(r));return i.append(...t),i}function cn(n,e,t={}){let i=ee("button",{type:"button",...t},n);return i.addEventListener("click",e),i}function ld(n,e,t,i){let s=ee("input",{type:"checkbox","aria-label":i??null});return s.checked=e,s.addEventListener("change",()=>t(s.checked)),{row:ee("label",{class:"check"},s,...n),box:s}}function js(n,e,t,i){let s=ee("select",{"aria-label":n});for(let[r,o]of e)s.append(ee("option",{value:r},o));return s.value=t,s.addEventListener("change",()=>i(s.value)),s}function Zl(n,e,t){let i=URL.createObjectURL(new Blob([e],{type:t})),s=ee("a",{href:i,download:n});document.body.append(s),s.click(),s.remove(),setTimeout(()=>URL.revokeObjectURL(i),6e4)}function Kl(n,e){return`${n.replace(/[^\w.-]+/gu,"_").slice(0,80)||"experiment"}${e}`}var cd=200;function mm(n){let e=[...n.scene.notes];if(n.samples===0&&e.push("The scene has no samples."),e.length===0)return[];let t=ee("ul",{},...e.map(s=>ee("li",{},s))),i=e.length===1?"1 note":`${e.length} notes`;return[ee("section",{class:"notes","aria-label":"Notes"},ee("details",{open:!0},ee("summary",{},i),t))]}function gm(n,e){let t=n.scene.intervals.map(i=>{let s=ee("span",{class:"chip"});s.style.background=Mr[i.use];let r=cn(i.label,()=>xm(n,e,i.start_s),{class:"link"}),o=`${i.start_s.toFixed(1)}\u2013${i.end_s.toFixed(1)} s, ${i.use}`,a=i.support===null?"":`, on ${i.support}`;return ee("li",{},s,r,ee("span",{class:"muted"},o+a))});return ym(`Intervals (${t.length})`,t,t.length>0?"":"The experiment names none.")}function _m(n,e){let{findings:t}=n.scene,i=t.slice(0,cd).map(s=>{let{start_s:r}=s,o=`${s.kind}${r===null?"":` at ${r.toFixed(2)} s`}`,a=r===null?ee("b",{},o):cn(o,()=>xm(n,e,r),{class:"link"});return ee("li",{},a,ee("span",{class:"muted"},`${s.stream}: ${s.message}`))});return t.length>cd&&i.push(ee("li",{},`and ${t.length-cd} more`)),ym(`Findings (${t.length})`,i,t.length>0?"":"None.")}function xm(n,e,t){e.set({sample:n.nearestSample(t),playing:!1})}function ym(n,e,t){return ee("details",{},ee("summary",{},n),ee("ul",{class:"entries"},...e),ee("p",{class:"absent"},t))}var Jl=class{waiting=new Set;request=0;later(e){this.waiting.add(e),this.request===0&&(this.request=requestAnimationFrame(()=>this.flush()))}flush(){cancelAnimationFrame(this.request),this.request=0;let e=[...this.waiting];this.waiting.clear();for(let t of e)t.draw()}};var hd=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1];function jl(n,e){let t=new Array(16).fill(0);for(let i=0;i<4;i++)for(let s=0;s<4;s++){let r=0;for(let o=0;o<4;o++)r+=(n[4*i+o]??0)*(e[4*o+s]??0);t[4*i+s]=r}return t}function Sy(n,e){let t=n.root.subarray(7*e,7*e+7),[i=0,s=0,r=0,o=1,a=0,l=0,c=0]=t;if(t.length<7||t.some(Number.isNaN))return hd;let h=2/(o*o+a*a+l*l+c*c);return[1-h*(l*l+c*c),h*(a*l-c*o),h*(a*c+l*o),i,h*(a*l+c*o),1-h*(a*a+c*c),h*(l*c-a*o),s,h*(a*c-l*o),h*(l*c+a*o),1-h*(a*a+l*l),r,0,0,0,1]}function by(n,e,t){if(e.column===null)return e.offset;let i=n.position(t,e.column);return e.multiplier*(Number.isNaN(i)?0:i)+e.offset}function va(n,e){let{robot:t}=n.scene,i=new Map([[t.root_link,Sy(n,e)]]);for(let s of t.joints){let r=i.get(s.parent);if(!r)throw new Error(`joint ${s.name}: link ${s.parent} comes after it`);let o=jl(r,s.parent_H_child);i.set(s.child,s.type==="fixed"?o:jl(o,My(s,n,e)))}return i}function My(n,e,t){let[i=0,s=0,r=1]=n.axis,o=by(e,n,t);if(n.type==="prismatic")return[1,0,0,i*o,0,1,0,s*o,0,0,1,r*o,0,0,0,1];let a=Math.sin(o),l=2*Math.sin(o/2)**2;return[1-l*(s*s+r*r),l*i*s-a*r,l*i*r+a*s,0,l*i*s+a*r,1-l*(i*i+r*r),l*s*r-a*i,0,l*i*r-a*s,l*s*r+a*i,1-l*(i*i+s*s),0,0,0,0,1]}var Sd=(n,e,t)=>{if(!e.has(n))throw TypeError("Cannot "+t)},V=(n,e,t)=>(Sd(n,e,"read from private field"),t?t.call(n):e.get(n)),ft=(n,e,t)=>{if(e.has(n))throw TypeError("Cannot add the same private member more than once");e instanceof WeakSet?e.add(n):e.set(n,t)},Bn=(n,e,t,i)=>(Sd(n,e,"write to private field"),i?i.call(n,t):e.set(n,t),t),wy=(n,e,t,i)=>({set _(s){Bn(n,e,s,t)},get _(){return V(n,e,i)}}),St=(n,e,t)=>(Sd(n,e,"access private method"),t),Tt=new Uint8Array(8),hs=new DataView(Tt.buffer),Tn=n=>[(n%256+256)%256],Rt=n=>(hs.setUint16(0,n,!1),[Tt[0],Tt[1]]),Ty=n=>(hs.setInt16(0,n,!1),[Tt[0],Tt[1]]),Sm=n=>(hs.setUint32(0,n,!1),[Tt[1],Tt[2],Tt[3]]),Oe=n=>(hs.setUint32(0,n,!1),[Tt[0],Tt[1],Tt[2],Tt[3]]),Ey=n=>(hs.setInt32(0,n,!1),[Tt[0],Tt[1],Tt[2],Tt[3]]),Pr=n=>(hs.setUint32(0,Math.floor(n/2**32),!1),hs.setUint32(4,n,!1),[Tt[0],Tt[1],Tt[2],Tt[3],Tt[4],Tt[5],Tt[6],Tt[7]]),bd=n=>(hs.setInt16(0,2**8*n,!1),[Tt[0],Tt[1]]),ls=n=>(hs.setInt32(0,2**16*n,!1),[Tt[0],Tt[1],Tt[2],Tt[3]]),ud=n=>(hs.setInt32(0,2**30*n,!1),[Tt[0],Tt[1],Tt[2],Tt[3]]),Pi=(n,e=!1)=>{let t=Array(n.length).fill(null).map((i,s)=>n.charCodeAt(s));return e&&t.push(0),t},sc=n=>n&&n[n.length-1],Md=n=>{let e;for(let t of n)(!e||t.presentationTimestamp>e.presentationTimestamp)&&(e=t);return e},cs=(n,e,t=!0)=>{let i=n*e;return t?Math.round(i):i},bm=n=>{let e=n*(Math.PI/180),t=Math.cos(e),i=Math.sin(e);return[t,i,0,-i,t,0,0,0,1]},Mm=bm(0),wm=n=>[ls(n[0]),ls(n[1]),ud(n[2]),ls(n[3]),ls(n[4]),ud(n[5]),ls(n[6]),ls(n[7]),ud(n[8])],Ma=n=>!n||typeof n!="object"?n:Array.isArray(n)?n.map(Ma):Object.fromEntries(Object.entries(n).map(([e,t])=>[e,Ma(t)])),co=n=>n>=0&&n<2**32,vn=(n,e,t)=>({type:n,contents:e&&new Uint8Array(e.flat(10)),children:t}),Kt=(n,e,t,i,s)=>vn(n,[Tn(e),Sm(t),i??[]],s),Ay=n=>{let e=512;return n.fragmented?vn("ftyp",[Pi("iso5"),Oe(e),Pi("iso5"),Pi("iso6"),Pi("mp41")]):vn("ftyp",[Pi("isom"),Oe(e),Pi("isom"),n.holdsAvc?Pi("avc1"):[],Pi("mp41")])},dd=n=>({type:"mdat",largeSize:n}),Cy=n=>({type:"free",size:n}),Ql=(n,e,t=!1)=>vn("moov",null,[Ry(e,n),...n.map(i=>Py(i,e)),t?av(n):null]),Ry=(n,e)=>{let t=cs(Math.max(0,...e.filter(o=>o.samples.length>0).map(o=>{let a=Md(o.samples);return a.presentationTimestamp+a.duration})),md),i=Math.max(...e.map(o=>o.id))+1,s=!co(n)||!co(t),r=s?Pr:Oe;return Kt("mvhd",+s,0,[r(n),r(n),Oe(md),r(t),ls(1),bd(1),Array(10).fill(0),wm(Mm),Array(24).fill(0),Oe(i)])},Py=(n,e)=>vn("trak",null,[Iy(n,e),Dy(n,e)]),Iy=(n,e)=>{let t=Md(n.samples),i=cs(t?t.presentationTimestamp+t.duration:0,md),s=!co(e)||!co(i),r=s?Pr:Oe,o;return n.info.type==="video"?o=typeof n.info.rotation=="number"?bm(n.info.rotation):n.info.rotation:o=Mm,Kt("tkhd",+s,3,[r(e),r(e),Oe(n.id),Oe(0),r(i),Array(8).fill(0),Rt(0),Rt(0),bd(n.info.type==="audio"?1:0),Rt(0),wm(o),ls(n.info.type==="video"?n.info.width:0),ls(n.info.type==="video"?n.info.height:0)])},Dy=(n,e)=>vn("mdia",null,[Ly(n,e),Ny(n.info.type==="video"?"vide":"soun"),Uy(n)]),Ly=(n,e)=>{let t=Md(n.samples),i=cs(t?t.presentationTimestamp+t.duration:0,n.timescale),s=!co(e)||!co(i),r=s?Pr:Oe;return Kt("mdhd",+s,0,[r(e),r(e),Oe(n.timescale),r(i),Rt(21956),Rt(0)])},Ny=n=>Kt("hdlr",0,0,[Pi("mhlr"),Pi(n),Oe(0),Oe(0),Oe(0),Pi("mp4-muxer-hdlr",!0)]),Uy=n=>vn("minf",null,[n.info.type==="video"?Fy():Oy(),By(),Vy(n)]),Fy=()=>Kt("vmhd",0,1,[Rt(0),Rt(0),Rt(0),Rt(0)]),Oy=()=>Kt("smhd",0,0,[Rt(0),Rt(0)]),By=()=>vn("dinf",null,[ky()]),ky=()=>Kt("dref",0,0,[Oe(1)],[zy()]),zy=()=>Kt("url ",0,1),Vy=n=>{let e=n.compositionTimeOffsetTable.length>1||n.compositionTimeOffsetTable.some(t=>t.sampleCompositionTimeOffset!==0);return vn("stbl",null,[Gy(n),tv(n),nv(n),iv(n),sv(n),rv(n),e?ov(n):null])},Gy=n=>Kt("stsd",0,0,[Oe(1)],[n.info.type==="video"?Hy(_v[n.info.codec],n):jy(yv[n.info.codec],n)]),Hy=(n,e)=>vn(n,[Array(6).fill(0),Rt(1),Rt(0),Rt(0),Array(12).fill(0),Rt(e.info.width),Rt(e.info.height),Oe(4718592),Oe(4718592),Oe(0),Rt(1),Array(32).fill(0),Rt(24),Ty(65535)],[xv[e.info.codec](e),e.info.decoderConfig.colorSpace?Yy(e):null]),Wy={bt709:1,bt470bg:5,smpte170m:6},Xy={bt709:1,smpte170m:6,"iec61966-2-1":13},qy={rgb:0,bt709:1,bt470bg:5,smpte170m:6},Yy=n=>vn("colr",[Pi("nclx"),Rt(Wy[n.info.decoderConfig.colorSpace.primaries]),Rt(Xy[n.info.decoderConfig.colorSpace.transfer]),Rt(qy[n.info.decoderConfig.colorSpace.matrix]),Tn((n.info.decoderConfig.colorSpace.fullRange?1:0)<<7)]),$y=n=>n.info.decoderConfig&&vn("avcC",[...new Uint8Array(n.info.decoderConfig.description)]),Zy=n=>n.info.decoderConfig&&vn("hvcC",[...new Uint8Array(n.info.decoderConfig.description)]),Ky=n=>{if(!n.info.decoderConfig)return null;let e=n.info.decoderConfig;if(!e.colorSpace)throw new Error("'colorSpace' is required in the decoder config for VP9.");let t=e.codec.split("."),i=Number(t[1]),s=Number(t[2]),a=(Number(t[3])<<4)+(0<<1)+Number(e.colorSpace.fullRange);return Kt("vpcC",1,0,[Tn(i),Tn(s),Tn(a),Tn(2),Tn(2),Tn(2),Rt(0)])},Jy=()=>{let t=(1<<7)+1;return vn("av1C",[t,0,0,0])},jy=(n,e)=>vn(n,[Array(6).fill(0),Rt(1),Rt(0),Rt(0),Oe(0),Rt(e.info.numberOfChannels),Rt(16),Rt(0),Rt(0),ls(e.info.sampleRate)],[vv[e.info.codec](e)]),Qy=n=>{let e=new Uint8Array(n.info.decoderConfig.description);return Kt("esds",0,0,[Oe(58753152),Tn(32+e.byteLength),Rt(1),Tn(0),Oe(75530368),Tn(18+e.byteLength),Tn(64),Tn(21),Sm(0),Oe(130071),Oe(130071),Oe(92307584),Tn(e.byteLength),...e,Oe(109084800),Tn(1),Tn(2)])},ev=n=>{let e=3840,t=0,i=n.info.decoderConfig?.description;if(i){if(i.byteLength<18)throw new TypeError("Invalid decoder description provided for Opus; must be at least 18 bytes long.");let s=ArrayBuffer.isView(i)?new DataView(i.buffer,i.byteOffset,i.byteLength):new DataView(i);e=s.getUint16(10,!0),t=s.getInt16(14,!0)}return vn("dOps",[Tn(0),Tn(n.info.numberOfChannels),Rt(e),Oe(n.info.sampleRate),bd(t),Tn(0)])},tv=n=>Kt("stts",0,0,[Oe(n.timeToSampleTable.length),n.timeToSampleTable.map(e=>[Oe(e.sampleCount),Oe(e.sampleDelta)])]),nv=n=>{if(n.samples.every(t=>t.type==="key"))return null;let e=[...n.samples.entries()].filter(([,t])=>t.type==="key");return Kt("stss",0,0,[Oe(e.length),e.map(([t])=>Oe(t+1))])},iv=n=>Kt("stsc",0,0,[Oe(n.compactlyCodedChunkTable.length),n.compactlyCodedChunkTable.map(e=>[Oe(e.firstChunk),Oe(e.samplesPerChunk),Oe(1)])]),sv=n=>Kt("stsz",0,0,[Oe(0),Oe(n.samples.length),n.samples.map(e=>Oe(e.size))]),rv=n=>n.finalizedChunks.length>0&&sc(n.finalizedChunks).offset>=2**32?Kt("co64",0,0,[Oe(n.finalizedChunks.length),n.finalizedChunks.map(e=>Pr(e.offset))]):Kt("stco",0,0,[Oe(n.finalizedChunks.length),n.finalizedChunks.map(e=>Oe(e.offset))]),ov=n=>Kt("ctts",0,0,[Oe(n.compositionTimeOffsetTable.length),n.compositionTimeOffsetTable.map(e=>[Oe(e.sampleCount),Oe(e.sampleCompositionTimeOffset)])]),av=n=>vn("mvex",null,n.map(lv)),lv=n=>Kt("trex",0,0,[Oe(n.id),Oe(1),Oe(0),Oe(0),Oe(0)]),vm=(n,e)=>vn("moof",null,[cv(n),...e.map(hv)]),cv=n=>Kt("mfhd",0,0,[Oe(n)]),Tm=n=>{let e=0,t=0,i=0,s=0,r=n.type==="delta";return t|=+r,r?e|=1:e|=2,e<<24|t<<16|i<<8|s},hv=n=>vn("traf",null,[uv(n),dv(n),fv(n)]),uv=n=>{let e=0;e|=8,e|=16,e|=32,e|=131072;let t=n.currentChunk.samples[1]??n.currentChunk.samples[0],i={duration:t.timescaleUnitsToNextSample,size:t.size,flags:Tm(t)};return Kt("tfhd",0,e,[Oe(n.id),Oe(i.duration),Oe(i.size),Oe(i.flags)])},dv=n=>Kt("tfdt",1,0,[Pr(cs(n.currentChunk.startTimestamp,n.timescale))]),fv=n=>{let e=n.currentChunk.samples.map(v=>v.timescaleUnitsToNextSample),t=n.currentChunk.samples.map(v=>v.size),i=n.currentChunk.samples.map(Tm),s=n.currentChunk.samples.map(v=>cs(v.presentationTimestamp-v.decodeTimestamp,n.timescale)),r=new Set(e),o=new Set(t),a=new Set(i),l=new Set(s),c=a.size===2&&i[0]!==i[1],h=r.size>1,u=o.size>1,d=!c&&a.size>1,f=l.size>1||[...l].some(v=>v!==0),g=0;return g|=1,g|=4*+c,g|=256*+h,g|=512*+u,g|=1024*+d,g|=2048*+f,Kt("trun",1,g,[Oe(n.currentChunk.samples.length),Oe(n.currentChunk.offset-n.currentChunk.moofOffset||0),c?Oe(i[0]):[],n.currentChunk.samples.map((v,m)=>[h?Oe(e[m]):[],u?Oe(t[m]):[],d?Oe(i[m]):[],f?Ey(s[m]):[]])])},pv=n=>vn("mfra",null,[...n.map(mv),gv()]),mv=(n,e)=>Kt("tfra",1,0,[Oe(n.id),Oe(63),Oe(n.finalizedChunks.length),n.finalizedChunks.map(i=>[Pr(cs(i.startTimestamp,n.timescale)),Pr(i.moofOffset),Oe(e+1),Oe(1),Oe(1)])]),gv=()=>Kt("mfro",0,0,[Oe(0)]),_v={avc:"avc1",hevc:"hvc1",vp9:"vp09",av1:"av01"},xv={avc:$y,hevc:Zy,vp9:Ky,av1:Jy},yv={aac:"mp4a",opus:"Opus"},vv={aac:Qy,opus:ev};var hc=class{},wd=class extends hc{constructor(){super(...arguments),this.buffer=null}},Em=class extends hc{constructor(n){if(super(),this.options=n,typeof n!="object")throw new TypeError("StreamTarget requires an options object to be passed to its constructor.");if(n.onData){if(typeof n.onData!="function")throw new TypeError("options.onData, when provided, must be a function.");if(n.onData.length<2)throw new TypeError("options.onData, when provided, must be a function that takes in at least two arguments (data and position). Ignoring the position argument, which specifies the byte offset at which the data is to be written, can lead to broken outputs.")}if(n.chunked!==void 0&&typeof n.chunked!="boolean")throw new TypeError("options.chunked, when provided, must be a boolean.");if(n.chunkSize!==void 0&&(!Number.isInteger(n.chunkSize)||n.chunkSize<1024))throw new TypeError("options.chunkSize, when provided, must be an integer and not smaller than 1024.")}},Sv=class extends hc{constructor(n,e){if(super(),this.stream=n,this.options=e,!(n instanceof FileSystemWritableFileStream))throw new TypeError("FileSystemWritableFileStreamTarget requires a FileSystemWritableFileStream instance.");if(e!==void 0&&typeof e!="object")throw new TypeError("FileSystemWritableFileStreamTarget's options, when provided, must be an object.");if(e&&e.chunkSize!==void 0&&(!Number.isInteger(e.chunkSize)||e.chunkSize<=0))throw new TypeError("options.chunkSize, when provided, must be a positive integer")}},Tr,oo,Am=class{constructor(){this.pos=0,ft(this,Tr,new Uint8Array(8)),ft(this,oo,new DataView(V(this,Tr).buffer)),this.offsets=new WeakMap}seek(n){this.pos=n}writeU32(n){V(this,oo).setUint32(0,n,!1),this.write(V(this,Tr).subarray(0,4))}writeU64(n){V(this,oo).setUint32(0,Math.floor(n/2**32),!1),V(this,oo).setUint32(4,n,!1),this.write(V(this,Tr).subarray(0,8))}writeAscii(n){for(let e=0;e<n.length;e++)V(this,oo).setUint8(e%8,n.charCodeAt(e)),e%8===7&&this.write(V(this,Tr));n.length%8!==0&&this.write(V(this,Tr).subarray(0,n.length%8))}writeBox(n){if(this.offsets.set(n,this.pos),n.contents&&!n.children)this.writeBoxHeader(n,n.size??n.contents.byteLength+8),this.write(n.contents);else{let e=this.pos;if(this.writeBoxHeader(n,0),n.contents&&this.write(n.contents),n.children)for(let s of n.children)s&&this.writeBox(s);let t=this.pos,i=n.size??t-e;this.seek(e),this.writeBoxHeader(n,i),this.seek(t)}}writeBoxHeader(n,e){this.writeU32(n.largeSize?1:e),this.writeAscii(n.type),n.largeSize&&this.writeU64(e)}measureBoxHeader(n){return 8+(n.largeSize?8:0)}patchBox(n){let e=this.pos;this.seek(this.offsets.get(n)),this.writeBox(n),this.seek(e)}measureBox(n){if(n.contents&&!n.children)return this.measureBoxHeader(n)+n.contents.byteLength;{let e=this.measureBoxHeader(n);if(n.contents&&(e+=n.contents.byteLength),n.children)for(let t of n.children)t&&(e+=this.measureBox(t));return e}}};Tr=new WeakMap;oo=new WeakMap;var ec,Rr,Ca,Sa,tc,fd,bv=class extends Am{constructor(n){super(),ft(this,tc),ft(this,ec,void 0),ft(this,Rr,new ArrayBuffer(2**16)),ft(this,Ca,new Uint8Array(V(this,Rr))),ft(this,Sa,0),Bn(this,ec,n)}write(n){St(this,tc,fd).call(this,this.pos+n.byteLength),V(this,Ca).set(n,this.pos),this.pos+=n.byteLength,Bn(this,Sa,Math.max(V(this,Sa),this.pos))}finalize(){St(this,tc,fd).call(this,this.pos),V(this,ec).buffer=V(this,Rr).slice(0,Math.max(V(this,Sa),this.pos))}};ec=new WeakMap;Rr=new WeakMap;Ca=new WeakMap;Sa=new WeakMap;tc=new WeakSet;fd=function(n){let e=V(this,Rr).byteLength;for(;e<n;)e*=2;if(e===V(this,Rr).byteLength)return;let t=new ArrayBuffer(e),i=new Uint8Array(t);i.set(V(this,Ca),0),Bn(this,Rr,t),Bn(this,Ca,i)};var Mv=2**24,wv=2,wa,Er,ba,Ts,_i,rc,pd,Td,Cm,Ed,Rm,Ta,oc,Ad=class extends Am{constructor(n){super(),ft(this,rc),ft(this,Td),ft(this,Ed),ft(this,Ta),ft(this,wa,void 0),ft(this,Er,[]),ft(this,ba,void 0),ft(this,Ts,void 0),ft(this,_i,[]),Bn(this,wa,n),Bn(this,ba,n.options?.chunked??!1),Bn(this,Ts,n.options?.chunkSize??Mv)}write(n){V(this,Er).push({data:n.slice(),start:this.pos}),this.pos+=n.byteLength}flush(){if(V(this,Er).length===0)return;let n=[],e=[...V(this,Er)].sort((t,i)=>t.start-i.start);n.push({start:e[0].start,size:e[0].data.byteLength});for(let t=1;t<e.length;t++){let i=n[n.length-1],s=e[t];s.start<=i.start+i.size?i.size=Math.max(i.size,s.start+s.data.byteLength-i.start):n.push({start:s.start,size:s.data.byteLength})}for(let t of n){t.data=new Uint8Array(t.size);for(let i of V(this,Er))t.start<=i.start&&i.start<t.start+t.size&&t.data.set(i.data,i.start-t.start);V(this,ba)?(St(this,rc,pd).call(this,t.data,t.start),St(this,Ta,oc).call(this)):V(this,wa).options.onData?.(t.data,t.start)}V(this,Er).length=0}finalize(){V(this,ba)&&St(this,Ta,oc).call(this,!0)}};wa=new WeakMap;Er=new WeakMap;ba=new WeakMap;Ts=new WeakMap;_i=new WeakMap;rc=new WeakSet;pd=function(n,e){let t=V(this,_i).findIndex(a=>a.start<=e&&e<a.start+V(this,Ts));t===-1&&(t=St(this,Ed,Rm).call(this,e));let i=V(this,_i)[t],s=e-i.start,r=n.subarray(0,Math.min(V(this,Ts)-s,n.byteLength));i.data.set(r,s);let o={start:s,end:s+r.byteLength};if(St(this,Td,Cm).call(this,i,o),i.written[0].start===0&&i.written[0].end===V(this,Ts)&&(i.shouldFlush=!0),V(this,_i).length>wv){for(let a=0;a<V(this,_i).length-1;a++)V(this,_i)[a].shouldFlush=!0;St(this,Ta,oc).call(this)}r.byteLength<n.byteLength&&St(this,rc,pd).call(this,n.subarray(r.byteLength),e+r.byteLength)};Td=new WeakSet;Cm=function(n,e){let t=0,i=n.written.length-1,s=-1;for(;t<=i;){let r=Math.floor(t+(i-t+1)/2);n.written[r].start<=e.start?(t=r+1,s=r):i=r-1}for(n.written.splice(s+1,0,e),(s===-1||n.written[s].end<e.start)&&s++;s<n.written.length-1&&n.written[s].end>=n.written[s+1].start;)n.written[s].end=Math.max(n.written[s].end,n.written[s+1].end),n.written.splice(s+1,1)};Ed=new WeakSet;Rm=function(n){let t={start:Math.floor(n/V(this,Ts))*V(this,Ts),data:new Uint8Array(V(this,Ts)),written:[],shouldFlush:!1};return V(this,_i).push(t),V(this,_i).sort((i,s)=>i.start-s.start),V(this,_i).indexOf(t)};Ta=new WeakSet;oc=function(n=!1){for(let e=0;e<V(this,_i).length;e++){let t=V(this,_i)[e];if(!(!t.shouldFlush&&!n)){for(let i of t.written)V(this,wa).options.onData?.(t.data.subarray(i.start,i.end),t.start+i.start);V(this,_i).splice(e--,1)}}};var Tv=class extends Ad{constructor(n){super(new Em({onData:(e,t)=>n.stream.write({type:"write",data:e,position:t}),chunked:!0,chunkSize:n.options?.chunkSize}))}},md=1e3,Ev=["avc","hevc","vp9","av1"],Av=["aac","opus"],Cv=2082844800,Rv=["strict","offset","cross-track-offset"],Ye,nt,ac,gi,Hn,On,ao,lo,Cd,Ar,Cr,Ea,gd,Pm,_d,Im,Rd,Dm,xd,Lm,Pd,Nm,nc,yd,as,ws,Id,Um,Aa,lc,cc,Dd,ho,Ra,ic,vd,Fm=class{constructor(n){if(ft(this,gd),ft(this,_d),ft(this,Rd),ft(this,xd),ft(this,Pd),ft(this,nc),ft(this,as),ft(this,Id),ft(this,Aa),ft(this,cc),ft(this,ho),ft(this,ic),ft(this,Ye,void 0),ft(this,nt,void 0),ft(this,ac,void 0),ft(this,gi,void 0),ft(this,Hn,null),ft(this,On,null),ft(this,ao,Math.floor(Date.now()/1e3)+Cv),ft(this,lo,[]),ft(this,Cd,1),ft(this,Ar,[]),ft(this,Cr,[]),ft(this,Ea,!1),St(this,gd,Pm).call(this,n),n.video=Ma(n.video),n.audio=Ma(n.audio),n.fastStart=Ma(n.fastStart),this.target=n.target,Bn(this,Ye,{firstTimestampBehavior:"strict",...n}),n.target instanceof wd)Bn(this,nt,new bv(n.target));else if(n.target instanceof Em)Bn(this,nt,new Ad(n.target));else if(n.target instanceof Sv)Bn(this,nt,new Tv(n.target));else throw new Error(`Invalid target: ${n.target}`);St(this,xd,Lm).call(this),St(this,_d,Im).call(this)}addVideoChunk(n,e,t,i){if(!(n instanceof EncodedVideoChunk))throw new TypeError("addVideoChunk's first argument (sample) must be of type EncodedVideoChunk.");if(e&&typeof e!="object")throw new TypeError("addVideoChunk's second argument (meta), when provided, must be an object.");if(t!==void 0&&(!Number.isFinite(t)||t<0))throw new TypeError("addVideoChunk's third argument (timestamp), when provided, must be a non-negative real number.");if(i!==void 0&&!Number.isFinite(i))throw new TypeError("addVideoChunk's fourth argument (compositionTimeOffset), when provided, must be a real number.");let s=new Uint8Array(n.byteLength);n.copyTo(s),this.addVideoChunkRaw(s,n.type,t??n.timestamp,n.duration,e,i)}addVideoChunkRaw(n,e,t,i,s,r){if(!(n instanceof Uint8Array))throw new TypeError("addVideoChunkRaw's first argument (data) must be an instance of Uint8Array.");if(e!=="key"&&e!=="delta")throw new TypeError("addVideoChunkRaw's second argument (type) must be either 'key' or 'delta'.");if(!Number.isFinite(t)||t<0)throw new TypeError("addVideoChunkRaw's third argument (timestamp) must be a non-negative real number.");if(!Number.isFinite(i)||i<0)throw new TypeError("addVideoChunkRaw's fourth argument (duration) must be a non-negative real number.");if(s&&typeof s!="object")throw new TypeError("addVideoChunkRaw's fifth argument (meta), when provided, must be an object.");if(r!==void 0&&!Number.isFinite(r))throw new TypeError("addVideoChunkRaw's sixth argument (compositionTimeOffset), when provided, must be a real number.");if(St(this,ic,vd).call(this),!V(this,Ye).video)throw new Error("No video track declared.");if(typeof V(this,Ye).fastStart=="object"&&V(this,Hn).samples.length===V(this,Ye).fastStart.expectedVideoChunks)throw new Error(`Cannot add more video chunks than specified in 'fastStart' (${V(this,Ye).fastStart.expectedVideoChunks}).`);let o=St(this,nc,yd).call(this,V(this,Hn),n,e,t,i,s,r);if(V(this,Ye).fastStart==="fragmented"&&V(this,On)){for(;V(this,Cr).length>0&&V(this,Cr)[0].decodeTimestamp<=o.decodeTimestamp;){let a=V(this,Cr).shift();St(this,as,ws).call(this,V(this,On),a)}o.decodeTimestamp<=V(this,On).lastDecodeTimestamp?St(this,as,ws).call(this,V(this,Hn),o):V(this,Ar).push(o)}else St(this,as,ws).call(this,V(this,Hn),o)}addAudioChunk(n,e,t){if(!(n instanceof EncodedAudioChunk))throw new TypeError("addAudioChunk's first argument (sample) must be of type EncodedAudioChunk.");if(e&&typeof e!="object")throw new TypeError("addAudioChunk's second argument (meta), when provided, must be an object.");if(t!==void 0&&(!Number.isFinite(t)||t<0))throw new TypeError("addAudioChunk's third argument (timestamp), when provided, must be a non-negative real number.");let i=new Uint8Array(n.byteLength);n.copyTo(i),this.addAudioChunkRaw(i,n.type,t??n.timestamp,n.duration,e)}addAudioChunkRaw(n,e,t,i,s){if(!(n instanceof Uint8Array))throw new TypeError("addAudioChunkRaw's first argument (data) must be an instance of Uint8Array.");if(e!=="key"&&e!=="delta")throw new TypeError("addAudioChunkRaw's second argument (type) must be either 'key' or 'delta'.");if(!Number.isFinite(t)||t<0)throw new TypeError("addAudioChunkRaw's third argument (timestamp) must be a non-negative real number.");if(!Number.isFinite(i)||i<0)throw new TypeError("addAudioChunkRaw's fourth argument (duration) must be a non-negative real number.");if(s&&typeof s!="object")throw new TypeError("addAudioChunkRaw's fifth argument (meta), when provided, must be an object.");if(St(this,ic,vd).call(this),!V(this,Ye).audio)throw new Error("No audio track declared.");if(typeof V(this,Ye).fastStart=="object"&&V(this,On).samples.length===V(this,Ye).fastStart.expectedAudioChunks)throw new Error(`Cannot add more audio chunks than specified in 'fastStart' (${V(this,Ye).fastStart.expectedAudioChunks}).`);let r=St(this,nc,yd).call(this,V(this,On),n,e,t,i,s);if(V(this,Ye).fastStart==="fragmented"&&V(this,Hn)){for(;V(this,Ar).length>0&&V(this,Ar)[0].decodeTimestamp<=r.decodeTimestamp;){let o=V(this,Ar).shift();St(this,as,ws).call(this,V(this,Hn),o)}r.decodeTimestamp<=V(this,Hn).lastDecodeTimestamp?St(this,as,ws).call(this,V(this,On),r):V(this,Cr).push(r)}else St(this,as,ws).call(this,V(this,On),r)}finalize(){if(V(this,Ea))throw new Error("Cannot finalize a muxer more than once.");if(V(this,Ye).fastStart==="fragmented"){for(let e of V(this,Ar))St(this,as,ws).call(this,V(this,Hn),e);for(let e of V(this,Cr))St(this,as,ws).call(this,V(this,On),e);St(this,cc,Dd).call(this,!1)}else V(this,Hn)&&St(this,Aa,lc).call(this,V(this,Hn)),V(this,On)&&St(this,Aa,lc).call(this,V(this,On));let n=[V(this,Hn),V(this,On)].filter(Boolean);if(V(this,Ye).fastStart==="in-memory"){let e;for(let i=0;i<2;i++){let s=Ql(n,V(this,ao)),r=V(this,nt).measureBox(s);e=V(this,nt).measureBox(V(this,gi));let o=V(this,nt).pos+r+e;for(let a of V(this,lo)){a.offset=o;for(let{data:l}of a.samples)o+=l.byteLength,e+=l.byteLength}if(o<2**32)break;e>=2**32&&(V(this,gi).largeSize=!0)}let t=Ql(n,V(this,ao));V(this,nt).writeBox(t),V(this,gi).size=e,V(this,nt).writeBox(V(this,gi));for(let i of V(this,lo))for(let s of i.samples)V(this,nt).write(s.data),s.data=null}else if(V(this,Ye).fastStart==="fragmented"){let e=V(this,nt).pos,t=pv(n);V(this,nt).writeBox(t);let i=V(this,nt).pos-e;V(this,nt).seek(V(this,nt).pos-4),V(this,nt).writeU32(i)}else{let e=V(this,nt).offsets.get(V(this,gi)),t=V(this,nt).pos-e;V(this,gi).size=t,V(this,gi).largeSize=t>=2**32,V(this,nt).patchBox(V(this,gi));let i=Ql(n,V(this,ao));if(typeof V(this,Ye).fastStart=="object"){V(this,nt).seek(V(this,ac)),V(this,nt).writeBox(i);let s=e-V(this,nt).pos;V(this,nt).writeBox(Cy(s))}else V(this,nt).writeBox(i)}St(this,ho,Ra).call(this),V(this,nt).finalize(),Bn(this,Ea,!0)}};Ye=new WeakMap;nt=new WeakMap;ac=new WeakMap;gi=new WeakMap;Hn=new WeakMap;On=new WeakMap;ao=new WeakMap;lo=new WeakMap;Cd=new WeakMap;Ar=new WeakMap;Cr=new WeakMap;Ea=new WeakMap;gd=new WeakSet;Pm=function(n){if(typeof n!="object")throw new TypeError("The muxer requires an options object to be passed to its constructor.");if(!(n.target instanceof hc))throw new TypeError("The target must be provided and an instance of Target.");if(n.video){if(!Ev.includes(n.video.codec))throw new TypeError(`Unsupported video codec: ${n.video.codec}`);if(!Number.isInteger(n.video.width)||n.video.width<=0)throw new TypeError(`Invalid video width: ${n.video.width}. Must be a positive integer.`);if(!Number.isInteger(n.video.height)||n.video.height<=0)throw new TypeError(`Invalid video height: ${n.video.height}. Must be a positive integer.`);let e=n.video.rotation;if(typeof e=="number"&&![0,90,180,270].includes(e))throw new TypeError(`Invalid video rotation: ${e}. Has to be 0, 90, 180 or 270.`);if(Array.isArray(e)&&(e.length!==9||e.some(t=>typeof t!="number")))throw new TypeError(`Invalid video transformation matrix: ${e.join()}`);if(n.video.frameRate!==void 0&&(!Number.isInteger(n.video.frameRate)||n.video.frameRate<=0))throw new TypeError(`Invalid video frame rate: ${n.video.frameRate}. Must be a positive integer.`)}if(n.audio){if(!Av.includes(n.audio.codec))throw new TypeError(`Unsupported audio codec: ${n.audio.codec}`);if(!Number.isInteger(n.audio.numberOfChannels)||n.audio.numberOfChannels<=0)throw new TypeError(`Invalid number of audio channels: ${n.audio.numberOfChannels}. Must be a positive integer.`);if(!Number.isInteger(n.audio.sampleRate)||n.audio.sampleRate<=0)throw new TypeError(`Invalid audio sample rate: ${n.audio.sampleRate}. Must be a positive integer.`)}if(n.firstTimestampBehavior&&!Rv.includes(n.firstTimestampBehavior))throw new TypeError(`Invalid first timestamp behavior: ${n.firstTimestampBehavior}`);if(typeof n.fastStart=="object"){if(n.video){if(n.fastStart.expectedVideoChunks===void 0)throw new TypeError("'fastStart' is an object but is missing property 'expectedVideoChunks'.");if(!Number.isInteger(n.fastStart.expectedVideoChunks)||n.fastStart.expectedVideoChunks<0)throw new TypeError("'expectedVideoChunks' must be a non-negative integer.")}if(n.audio){if(n.fastStart.expectedAudioChunks===void 0)throw new TypeError("'fastStart' is an object but is missing property 'expectedAudioChunks'.");if(!Number.isInteger(n.fastStart.expectedAudioChunks)||n.fastStart.expectedAudioChunks<0)throw new TypeError("'expectedAudioChunks' must be a non-negative integer.")}}else if(![!1,"in-memory","fragmented"].includes(n.fastStart))throw new TypeError("'fastStart' option must be false, 'in-memory', 'fragmented' or an object.");if(n.minFragmentDuration!==void 0&&(!Number.isFinite(n.minFragmentDuration)||n.minFragmentDuration<0))throw new TypeError("'minFragmentDuration' must be a non-negative number.")};_d=new WeakSet;Im=function(){if(V(this,nt).writeBox(Ay({holdsAvc:V(this,Ye).video?.codec==="avc",fragmented:V(this,Ye).fastStart==="fragmented"})),Bn(this,ac,V(this,nt).pos),V(this,Ye).fastStart==="in-memory")Bn(this,gi,dd(!1));else if(V(this,Ye).fastStart!=="fragmented"){if(typeof V(this,Ye).fastStart=="object"){let n=St(this,Rd,Dm).call(this);V(this,nt).seek(V(this,nt).pos+n)}Bn(this,gi,dd(!0)),V(this,nt).writeBox(V(this,gi))}St(this,ho,Ra).call(this)};Rd=new WeakSet;Dm=function(){if(typeof V(this,Ye).fastStart!="object")return;let n=0,e=[V(this,Ye).fastStart.expectedVideoChunks,V(this,Ye).fastStart.expectedAudioChunks];for(let t of e)t&&(n+=8*Math.ceil(2/3*t),n+=4*t,n+=12*Math.ceil(2/3*t),n+=4*t,n+=8*t);return n+=4096,n};xd=new WeakSet;Lm=function(){if(V(this,Ye).video&&Bn(this,Hn,{id:1,info:{type:"video",codec:V(this,Ye).video.codec,width:V(this,Ye).video.width,height:V(this,Ye).video.height,rotation:V(this,Ye).video.rotation??0,decoderConfig:null},timescale:V(this,Ye).video.frameRate??57600,samples:[],finalizedChunks:[],currentChunk:null,firstDecodeTimestamp:void 0,lastDecodeTimestamp:-1,timeToSampleTable:[],compositionTimeOffsetTable:[],lastTimescaleUnits:null,lastSample:null,compactlyCodedChunkTable:[]}),V(this,Ye).audio&&(Bn(this,On,{id:V(this,Ye).video?2:1,info:{type:"audio",codec:V(this,Ye).audio.codec,numberOfChannels:V(this,Ye).audio.numberOfChannels,sampleRate:V(this,Ye).audio.sampleRate,decoderConfig:null},timescale:V(this,Ye).audio.sampleRate,samples:[],finalizedChunks:[],currentChunk:null,firstDecodeTimestamp:void 0,lastDecodeTimestamp:-1,timeToSampleTable:[],compositionTimeOffsetTable:[],lastTimescaleUnits:null,lastSample:null,compactlyCodedChunkTable:[]}),V(this,Ye).audio.codec==="aac")){let n=St(this,Pd,Nm).call(this,2,V(this,Ye).audio.sampleRate,V(this,Ye).audio.numberOfChannels);V(this,On).info.decoderConfig={codec:V(this,Ye).audio.codec,description:n,numberOfChannels:V(this,Ye).audio.numberOfChannels,sampleRate:V(this,Ye).audio.sampleRate}}};Pd=new WeakSet;Nm=function(n,e,t){let s=[96e3,88200,64e3,48e3,44100,32e3,24e3,22050,16e3,12e3,11025,8e3,7350].indexOf(e),r=t,o="";o+=n.toString(2).padStart(5,"0"),o+=s.toString(2).padStart(4,"0"),s===15&&(o+=e.toString(2).padStart(24,"0")),o+=r.toString(2).padStart(4,"0");let a=Math.ceil(o.length/8)*8;o=o.padEnd(a,"0");let l=new Uint8Array(o.length/8);for(let c=0;c<o.length;c+=8)l[c/8]=parseInt(o.slice(c,c+8),2);return l};nc=new WeakSet;yd=function(n,e,t,i,s,r,o){let a=i/1e6,l=(i-(o??0))/1e6,c=s/1e6,h=St(this,Id,Um).call(this,a,l,n);return a=h.presentationTimestamp,l=h.decodeTimestamp,r?.decoderConfig&&(n.info.decoderConfig===null?n.info.decoderConfig=r.decoderConfig:Object.assign(n.info.decoderConfig,r.decoderConfig)),{presentationTimestamp:a,decodeTimestamp:l,duration:c,data:e,size:e.byteLength,type:t,timescaleUnitsToNextSample:cs(c,n.timescale)}};as=new WeakSet;ws=function(n,e){V(this,Ye).fastStart!=="fragmented"&&n.samples.push(e);let t=cs(e.presentationTimestamp-e.decodeTimestamp,n.timescale);if(n.lastTimescaleUnits!==null){let s=cs(e.decodeTimestamp,n.timescale,!1),r=Math.round(s-n.lastTimescaleUnits);if(n.lastTimescaleUnits+=r,n.lastSample.timescaleUnitsToNextSample=r,V(this,Ye).fastStart!=="fragmented"){let o=sc(n.timeToSampleTable);o.sampleCount===1?(o.sampleDelta=r,o.sampleCount++):o.sampleDelta===r?o.sampleCount++:(o.sampleCount--,n.timeToSampleTable.push({sampleCount:2,sampleDelta:r}));let a=sc(n.compositionTimeOffsetTable);a.sampleCompositionTimeOffset===t?a.sampleCount++:n.compositionTimeOffsetTable.push({sampleCount:1,sampleCompositionTimeOffset:t})}}else n.lastTimescaleUnits=0,V(this,Ye).fastStart!=="fragmented"&&(n.timeToSampleTable.push({sampleCount:1,sampleDelta:cs(e.duration,n.timescale)}),n.compositionTimeOffsetTable.push({sampleCount:1,sampleCompositionTimeOffset:t}));n.lastSample=e;let i=!1;if(!n.currentChunk)i=!0;else{let s=e.presentationTimestamp-n.currentChunk.startTimestamp;if(V(this,Ye).fastStart==="fragmented"){let r=V(this,Hn)??V(this,On),o=V(this,Ye).minFragmentDuration??1;n===r&&e.type==="key"&&s>=o&&(i=!0,St(this,cc,Dd).call(this))}else i=s>=.5}i&&(n.currentChunk&&St(this,Aa,lc).call(this,n),n.currentChunk={startTimestamp:e.presentationTimestamp,samples:[]}),n.currentChunk.samples.push(e)};Id=new WeakSet;Um=function(n,e,t){let i=V(this,Ye).firstTimestampBehavior==="strict",s=t.lastDecodeTimestamp===-1;if(i&&s&&e!==0)throw new Error(`The first chunk for your media track must have a timestamp of 0 (received DTS=${e}).Non-zero first timestamps are often caused by directly piping frames or audio data from a MediaStreamTrack into the encoder. Their timestamps are typically relative to the age of thedocument, which is probably what you want.

If you want to offset all timestamps of a track such that the first one is zero, set firstTimestampBehavior: 'offset' in the options.
`);if(V(this,Ye).firstTimestampBehavior==="offset"||V(this,Ye).firstTimestampBehavior==="cross-track-offset"){t.firstDecodeTimestamp===void 0&&(t.firstDecodeTimestamp=e);let o;V(this,Ye).firstTimestampBehavior==="offset"?o=t.firstDecodeTimestamp:o=Math.min(V(this,Hn)?.firstDecodeTimestamp??1/0,V(this,On)?.firstDecodeTimestamp??1/0),e-=o,n-=o}if(e<t.lastDecodeTimestamp)throw new Error(`Timestamps must be monotonically increasing (DTS went from ${t.lastDecodeTimestamp*1e6} to ${e*1e6}).`);return t.lastDecodeTimestamp=e,{presentationTimestamp:n,decodeTimestamp:e}};Aa=new WeakSet;lc=function(n){if(V(this,Ye).fastStart==="fragmented")throw new Error("Can't finalize individual chunks if 'fastStart' is set to 'fragmented'.");if(n.currentChunk){if(n.finalizedChunks.push(n.currentChunk),V(this,lo).push(n.currentChunk),(n.compactlyCodedChunkTable.length===0||sc(n.compactlyCodedChunkTable).samplesPerChunk!==n.currentChunk.samples.length)&&n.compactlyCodedChunkTable.push({firstChunk:n.finalizedChunks.length,samplesPerChunk:n.currentChunk.samples.length}),V(this,Ye).fastStart==="in-memory"){n.currentChunk.offset=0;return}n.currentChunk.offset=V(this,nt).pos;for(let e of n.currentChunk.samples)V(this,nt).write(e.data),e.data=null;St(this,ho,Ra).call(this)}};cc=new WeakSet;Dd=function(n=!0){if(V(this,Ye).fastStart!=="fragmented")throw new Error("Can't finalize a fragment unless 'fastStart' is set to 'fragmented'.");let e=[V(this,Hn),V(this,On)].filter(a=>a&&a.currentChunk);if(e.length===0)return;let t=wy(this,Cd)._++;if(t===1){let a=Ql(e,V(this,ao),!0);V(this,nt).writeBox(a)}let i=V(this,nt).pos,s=vm(t,e);V(this,nt).writeBox(s);{let a=dd(!1),l=0;for(let h of e)for(let u of h.currentChunk.samples)l+=u.size;let c=V(this,nt).measureBox(a)+l;c>=2**32&&(a.largeSize=!0,c=V(this,nt).measureBox(a)+l),a.size=c,V(this,nt).writeBox(a)}for(let a of e){a.currentChunk.offset=V(this,nt).pos,a.currentChunk.moofOffset=i;for(let l of a.currentChunk.samples)V(this,nt).write(l.data),l.data=null}let r=V(this,nt).pos;V(this,nt).seek(V(this,nt).offsets.get(s));let o=vm(t,e);V(this,nt).writeBox(o),V(this,nt).seek(r);for(let a of e)a.finalizedChunks.push(a.currentChunk),V(this,lo).push(a.currentChunk),a.currentChunk=null;n&&St(this,ho,Ra).call(this)};ho=new WeakSet;Ra=function(){V(this,nt)instanceof Ad&&V(this,nt).flush()};ic=new WeakSet;vd=function(){if(V(this,Ea))throw new Error("Cannot add new video or audio chunks after the file has been finalized.")};var Pv=new Set(["moov","trak","mdia"]),Iv=new Set(["mvhd","tkhd","mdhd"]);function Om(n){return Bm(n,0,n.length),n}function Bm(n,e,t){let i=new DataView(n.buffer,n.byteOffset,n.byteLength);for(let s=e;s+8<=t;){let r=i.getUint32(s),o=String.fromCharCode(...n.subarray(s+4,s+8));if(Pv.has(o)&&Bm(n,s+8,s+r),Iv.has(o)&&n.fill(0,s+12,s+12+(n[s+8]===1?16:8)),r<8)return;s+=r}}var Dv=44,Lv=2,Nv=4,Uv={h264:["avc1.640028","avc1.42002a"],vp9:["vp09.00.40.08"]},km=1e-9,Fv=24;function Ov(n,e){let{fps:t=20,speed:i=1,start:s=0,end:r=n.samples-1}=e,[o,a]=[n.time[s],n.time[r]];if(!(t>0&&i>0)||o===void 0||a===void 0||a<o){let c=`fps ${t}, speed ${i}, samples ${s} to ${r} of ${n.samples}`;throw new Error(`video: expected fps and speed above 0, and a last sample after the first one, got ${c}`)}let l=Math.floor((a-o)*t/i+km)+1;return Array.from({length:l},(c,h)=>o+h*i/t+km)}async function uc(n,e,t){let{fps:i=20,width:s=960,height:r=480}=e;if(s%2!==0||r%2!==0||s<64||r<64)throw new Error(`video: expected an even width and height of at least 64 x 64, got ${s} x ${r}`);let o=Ov(n.data,e),{config:a,codec:l}=await Bv(e.codec?[e.codec]:["h264","vp9"],s,r,i),c=new wd,h=new Fm({target:c,video:{codec:l==="h264"?"avc":"vp9",width:s,height:r,frameRate:i},fastStart:"in-memory"}),u=null,d=new VideoEncoder({output:(v,m)=>h.addVideoChunk(v,m),error:v=>{u=v}});d.configure(a);let f=new OffscreenCanvas(s,r),g=n.store.state;n.store.set({playing:!1});for(let v of[n.robot,n.space])v.hold(s/2,r-Dv);try{for(let[v,m]of o.entries()){kv(n,f,n.data.sampleAt(m));let p=new VideoFrame(f,{timestamp:Math.round(v*1e6/i),duration:Math.round(1e6/i)}),y={keyFrame:v%Math.max(1,Math.round(Lv*i))===0,vp9:{quantizer:Fv}};d.encode(p,y),p.close(),t((v+1)/o.length);do await new Promise(C=>setTimeout(C,0));while(d.encodeQueueSize>Nv&&u===null);if(u!==null)throw u}await d.flush()}finally{d.state!=="closed"&&d.close();for(let v of[n.robot,n.space])v.release();n.store.set({sample:g.sample})}return h.finalize(),Om(new Uint8Array(c.buffer))}async function Bv(n,e,t,i){if(typeof VideoEncoder>"u")throw new Error("video: this browser has no WebCodecs; Chromium has");for(let s of n){let r=s==="h264"?{bitrate:4e6,avc:{format:"avc"}}:{bitrateMode:"quantizer"};for(let o of Uv[s]){let a={codec:o,width:e,height:t,framerate:i,latencyMode:"quality",hardwareAcceleration:"prefer-software",...r};if((await VideoEncoder.isConfigSupported(a).catch(()=>null))?.supported)return{config:a,codec:s}}}throw new Error(`video: this browser does not encode ${n.join(" or ")} at ${e} x ${t}`)}function kv(n,e,t){let{data:i,store:s,robot:r,space:o}=n;s.set({sample:t}),n.flush(),r.draw(),o.draw();let a=e.getContext("2d");if(!a)throw new Error("video: this browser draws nothing on a canvas");let{width:l,height:c}=e;a.fillStyle="#ffffff",a.fillRect(0,0,l,c),a.drawImage(r.canvas,0,0),a.drawImage(o.canvas,l/2,0),a.fillStyle=ci,a.font="14px system-ui, 'DejaVu Sans', sans-serif";let h=i.sensor(s.state.sensor),u=s.state.quantity==="force"?"force":"torque";a.fillText(`${i.scene.title} \xB7 ${h?.name??""} \xB7 ${u}`,12,c-26,l/2),a.fillText(`sample ${t} \xB7 ${(i.time[t]??0).toFixed(3)} s`,12,c-8);let d=l/2+12;for(let f of h?.wrenches??[])s.state.hidden.has(f.name)||(a.fillStyle=h?Ri(h,f):ci,a.fillRect(d,c-22,10,10),a.fillText(f.name,d+14,c-12),d+=30+a.measureText(f.name).width)}function zm(n,e,t){let i=n.store.state;return{reset(){n.store.set(i);for(let s of[n.robot,n.space])s.reset();n.flush()},show(s){let r=Math.max(0,n.data.samples-1);n.store.set({sample:Math.min(r,Math.max(0,s)),playing:!1}),n.flush()},sample:()=>n.store.state.sample,linkPoses:s=>Object.fromEntries([...va(n.data,s)].map(([r,o])=>[r,[...o]])),spacePoint(s,r){let o=e.sampleOnCanvas(s,r),a=e.canvas.getBoundingClientRect();return o&&{x:a.left+o.x,y:a.top+o.y}},planePoint:(s,r,o)=>t[s]?.sampleOnScreen(r,o)??null,cloudSamples:()=>[...e.samples()],skin:()=>n.robot.skin.shown(),video:async(s={})=>zv(await uc(n,s,()=>{}))}}function zv(n){let e="";for(let t=0;t<n.length;t+=32768)e+=String.fromCharCode(...n.subarray(t,t+32768));return btoa(e)}var Vv=["0.1","0.25","0.5","1","2","5","10","50"],Gv=["point","begin","end"];function Vm(n,e,t){let i=Math.max(0,n.samples-1),s=ee("input",{type:"range",min:0,max:i,step:1,"aria-label":"Sample slider",class:"slider"});s.addEventListener("input",()=>e.set({sample:Number(s.value),playing:!1}));let r=ee("input",{type:"number",min:0,max:i,step:1,"aria-label":"Sample number"});r.addEventListener("change",()=>{let h=Math.round(r.valueAsNumber);Number.isFinite(h)&&e.set({sample:Math.min(i,Math.max(0,h)),playing:!1}),r.value=String(e.state.sample)});let o=ee("time",{"aria-label":"Time"}),a=cn("\u25B6 Play",()=>Nd(n,e),{class:"play"}),l=Vv.map(h=>[h,`${h}\xD7`]),c=js("Speed",l,"1",h=>e.set({speed:Number(h)}));return e.on(["sample"],()=>{let{sample:h}=e.state;s.value=String(h),r.value=String(h);let u=(n.time[h]??0).toFixed(3);s.setAttribute("aria-valuetext",`sample ${h}, ${u} s`),o.textContent=`${u} s`}),e.on(["playing"],()=>{let{playing:h}=e.state;a.textContent=h?"\u275A\u275A Pause":"\u25B6 Play",a.setAttribute("aria-label",h?"Pause":"Play"),a.setAttribute("aria-pressed",String(h))}),ee("footer",{class:"transport"},a,c,cn("\u22121",()=>dc(n,e,-1),{"aria-label":"One sample back"}),s,cn("+1",()=>dc(n,e,1),{"aria-label":"One sample on"}),r,o,Hv(n,e,t))}function Hv(n,e,t){let i=ee("span",{class:"segments",role:"radiogroup","aria-label":"Saved sample is"});for(let s of Gv){let r=ee("input",{type:"radio",name:"mark-kind",value:s});r.addEventListener("change",()=>e.set({markKind:s})),e.on(["markKind"],()=>{r.checked=e.state.markKind===s}),i.append(ee("label",{},r,ee("span",{},s)))}return ee("span",{class:"saving"},i,cn("Save sample",()=>Ld(n,e,t),{class:"primary"}))}function Ld(n,e,t){let{sample:i,markKind:s,marks:r}=e.state;if(n.samples===0)return;let o=n.time[i]??0,a={sample:i,time_s:o,mark:s,label:"",use:"ignore"},l={begin:"end",end:"begin",point:"point"};e.set({marks:[...r,a],markKind:l[s]}),t(`Saved sample ${i} at ${o.toFixed(3)} s as ${s}.`)}function dc(n,e,t){let i=Math.min(Math.max(0,n.samples-1),Math.max(0,e.state.sample+t));e.set({sample:i,playing:!1})}function Nd(n,e){let{playing:t,sample:i}=e.state;!t&&i>=n.samples-1&&e.set({sample:0}),e.set({playing:!t&&n.samples>1})}function Gm(n,e){let t=0,i=-1,s=0,r=o=>{let{playing:a,sample:l,speed:c}=e.state;a&&(l!==i&&(t=n.time[l]??0),t+=Math.min(.5,(o-s)/1e3)*c,s=o,i=n.sampleAt(t),e.set({sample:i,playing:i<n.samples-1}),requestAnimationFrame(r))};e.on(["playing"],()=>{e.state.playing&&(i=-1,s=performance.now(),requestAnimationFrame(r))})}var Hm=[["\u2190 \u2192","one sample back, on; with Shift ten"],["Home End","first, last sample"],["Space","play, pause"],["f t","force, torque"],["p b e","the saved sample is a point, begin, end"],["s","save the sample"],["Alt + arrows, + \u2212, 0","turn, zoom, reset the focused 3-D view"]];function Wm(n,e,t){let i={Home:()=>e.set({sample:0,playing:!1}),End:()=>e.set({sample:Math.max(0,n.samples-1),playing:!1})," ":()=>Nd(n,e),f:()=>e.set({quantity:"force"}),t:()=>e.set({quantity:"moment"}),p:()=>e.set({markKind:"point"}),b:()=>e.set({markKind:"begin"}),e:()=>e.set({markKind:"end"}),s:()=>Ld(n,e,t)};document.addEventListener("keydown",s=>{if(s.ctrlKey||s.metaKey||s.altKey||Wv(s.target,s.key))return;let r=s.key==="ArrowRight"?1:s.key==="ArrowLeft"?-1:0,o=r!==0?()=>dc(n,e,s.shiftKey?10*r:r):i[s.key];o&&(s.preventDefault(),o())})}function Xm(){document.addEventListener("change",({target:n})=>{(n instanceof HTMLSelectElement||n instanceof HTMLInputElement&&n.type==="radio")&&!n.matches(":focus-visible")&&n.blur()})}function Wv(n,e){return n instanceof HTMLInputElement?n.type==="range"?!1:n.type==="checkbox"?e===" ":n.type==="radio"?e===" "||e.startsWith("Arrow"):!0:n instanceof HTMLSelectElement||n instanceof HTMLTextAreaElement?!0:n instanceof HTMLElement&&n.closest("button, summary, a")!==null&&e===" "}function qm(n,e,t){let i=ee("p",{role:"status",class:"status"}),s=ee("div",{class:"view"}),r=ee("div",{class:"view"}),o=ee("p",{class:"overlay"}),a=[0,1,2].map(()=>ee("div",{class:"view"})),l=ee("div",{class:"strip"}),c=[0,1,2].map(()=>ee("div",{class:"plot"})),h=ee("aside",{class:"side","aria-label":"Details"}),u=ee("div",{class:"tools"}),d=ee("div",{class:"tools"}),f=ee("div",{class:"views"},Ud(e,"Robot","robot",u,s,o),Ud(e,"Force space","space",d,r),Ud(e,"Planes","planes",ee("div",{class:"tools"}),ee("div",{class:"three"},...a)));f.classList.toggle("robot-alone",n.scene.sensors.length===0),e.on(["large"],()=>{f.dataset.large=e.state.large??""});let g=cn("Whole recording",()=>e.set({window:n.span}),{class:"unzoom"});e.on(["window"],()=>{let[y,C]=n.span;g.hidden=e.state.window[0]===y&&e.state.window[1]===C});let v=n.scene.sensors.length===0?[]:c,m=ee("section",{class:"times","aria-label":"Time plots"},l,...v,g),p=ee("div",{class:"app"},Xv(n,e),ee("main",{},f,m),h,t(y=>{i.textContent=y}));return e.on(["quantity"],()=>{let y=p.querySelector(".space h2");y&&(y.textContent=e.state.quantity==="force"?"Force space":"Torque space")}),{robot:s,space:r,planes:a,strip:l,plots:c,side:h,scale:o,robotTitle:u,spaceTitle:d,status:i,app:p}}function Xv(n,e){let t=n.scene.sensors.map((o,a)=>[String(a),o.serial?`${o.name} (${o.serial})`:o.name]),i=js("Sensor",t,"0",o=>e.set({sensor:Number(o)}));e.on(["sensor"],()=>{i.value=String(e.state.sensor)});let s=ee("span",{class:"segments",role:"radiogroup","aria-label":"Quantity"});for(let[o,a]of[["force","Force"],["moment","Torque"]]){let l=ee("input",{type:"radio",name:"quantity",value:o});l.addEventListener("change",()=>e.set({quantity:o})),e.on(["quantity"],()=>{l.checked=e.state.quantity===o}),s.append(ee("label",{},l,ee("span",{},a)))}let r=ee("details",{class:"keys"},ee("summary",{},"Keys"),ee("dl",{},...Hm.flatMap(([o,a])=>[ee("dt",{},o),ee("dd",{},a)])));return ee("header",{},ee("h1",{title:n.scene.title},n.scene.title),i,s,r)}function Ud(n,e,t,i,...s){let r=cn("\u2922",()=>n.set({large:n.state.large===t?null:t}),{"aria-label":`Enlarge ${e.toLowerCase()}`,title:"Enlarge"});n.on(["large"],()=>r.setAttribute("aria-pressed",String(n.state.large===t))),i.append(r);let o=ee("div",{class:"heading"},ee("h2",{},e),i);return ee("section",{class:`panel ${t}`,"aria-label":e},o,...s)}function $m(){let n=document.getElementById("scene")?.textContent;if(!n)throw new Error('the page holds no scene: expected a script element with id "scene"');let e=JSON.parse(n);if(e.schema!=="forcetorque/scene/1")throw new Error(`expected a scene of schema "forcetorque/scene/1", got ${JSON.stringify(e.schema)}`);return e}async function Zm(n){let e=document.getElementById("data");if(!e)throw new Error('the page holds no data: expected a script element with id "data"');let t=e.dataset.url;if(t)return Yv(t,n);let i=qv(e.textContent??"");return e.textContent="",i}function qv(n){let e=n.trim(),t=e.endsWith("==")?2:e.endsWith("=")?1:0,i=new Uint8Array(e.length/4*3-t),s=0;for(let r=0;r<e.length;r+=1048576){let o=atob(e.slice(r,r+1048576));for(let a=0;a<o.length;a++)i[s++]=o.charCodeAt(a)}return i.buffer}async function Yv(n,e){e(0,0);let t=await Ym(n,0);if(t.status===200){let o=await t.arrayBuffer();return e(o.byteLength,o.byteLength),o}let i=Number(/\/(\d+)$/.exec(t.headers.get("Content-Range")??"")?.[1]??Number.NaN);if(!Number.isFinite(i))throw new Error(`${n}: the server sent a piece without saying how long the whole is`);let s=new Uint8Array(i),r=0;for(let o=t;;o=await Ym(n,r)){let a=new Uint8Array(await o.arrayBuffer());if(a.length===0||r+a.length>i)throw new Error(`${n}: expected ${i-r} more bytes at most, got ${a.length}`);if(s.set(a,r),r+=a.length,e(r,i),r===i)return s.buffer}}async function Ym(n,e){let t=await fetch(n,{headers:{Range:`bytes=${e}-${e+4194304-1}`}});if(!t.ok)throw new Error(`${n}: the server answered ${t.status} ${t.statusText}`);return t}var $v=180/Math.PI;function Jm(n,e){let t=n.scene.coordinates.map((s,r)=>`${s}${n.isLength(r)?"_m":"_deg"}`),i=wr(e).map(s=>[String(s.sample),eg(s.time_s),s.mark,s.label,...n.scene.coordinates.map((r,o)=>Zv(n,s.sample,o))]);return[["sample","time_s","mark","label",...t],...i].map(s=>`${s.map(Kv).join(",")}
`).join("")}function jm(n,e){return[`# intervals marked in the viewer; copy them into the experiment file
`,...Bi(n,e).map(i=>{let s=["[[interval]]",`label = ${ga(i.label)}`,`start_s = ${Km(i.start_s)}`,`end_s = ${Km(i.end_s)}`,`use = ${ga(i.use)}`,...i.supportLines],r=i.overlaps.map(ga).join(", ");return r&&s.push(`# overlaps ${r}: shorten those, as a sample is fitted or judged once`),`${s.join(`
`)}
`})].join(`
`)}function Qm(n,e){return{samples:wr(e),intervals:Bi(n,e).map(({label:t,start_s:i,end_s:s,use:r})=>({label:t,start_s:i,end_s:s,use:r}))}}function Zv(n,e,t){let i=n.position(e,t);return Number.isNaN(i)?"":n.isLength(t)?i.toFixed(6):(i*$v).toFixed(4)}function eg(n){return n.toFixed(9).replace(/0+$/,"").replace(/\.$/,"")}function Km(n){let e=eg(n);return e.includes(".")?e:`${e}.0`}function Kv(n){return/[",\r\n]/.test(n)?`"${n.replaceAll('"','""')}"`:n}var Jv=[["ignore","ignore"],["calibration","calibration"],["validation","validation"]],jv=180;function tg(n,e,t){let i=ee("ul",{class:"marks","aria-label":"Saved samples"}),s=ee("ul",{class:"marks","aria-label":"Marked intervals"});e.on(["marks"],()=>{let{marks:a}=e.state;(!i.contains(document.activeElement)||i.children.length!==a.length)&&i.replaceChildren(...wr(a).map(l=>Qv(l,e))),a.length===0&&i.replaceChildren(ee("li",{class:"absent"},"None yet: \u201CSave sample\u201D keeps the one shown.")),s.replaceChildren(...eS(n,e))});let r=new Set;return addEventListener("beforeunload",a=>{let{marks:l}=e.state;l.length>0&&!r.has(l)&&a.preventDefault()}),ee("div",{},i,s,tS(n,e,t,a=>{r.add(a)}))}function Qv(n,e){let t=n,i=`sample ${n.sample}`,s=ee("input",{type:"text",maxlength:jv,value:n.label,placeholder:"label","aria-label":`Label of ${i}`});s.addEventListener("change",()=>{let o={...t,label:s.value.trim()},a=e.state.marks.map(l=>l===t?o:l);t=o,e.set({marks:a})});let r=()=>e.set({marks:e.state.marks.filter(o=>o!==t)});return ee("li",{},cn(`${n.sample}`,()=>e.set({sample:n.sample,playing:!1}),{class:"link","aria-label":`Go to ${i}`}),ee("span",{class:"muted"},`${n.time_s.toFixed(2)} s ${n.mark}`),s,cn("\u2715",r,{"aria-label":`Delete ${i}`}))}function eS(n,e){let t=Bi(n,e.state.marks).map(s=>{let r=js(`Use of ${s.label}`,Jv,s.use,c=>{let h=e.state.marks.map(u=>u===s.begin?{...u,use:c}:u);e.set({marks:h})}),o=`${s.label}: ${s.start_s.toFixed(2)}\u2013${s.end_s.toFixed(2)} s`,a=s.overlaps.join(", "),l=a?[ee("span",{class:"muted clash"},`overlaps ${a}: shorten it there`)]:[];return ee("li",{},ee("span",{class:"grow"},o),r,...l)}),i=cm(e.state.marks).map(({mark:s,sample:r})=>ee("li",{class:"absent"},s==="begin"?`begin at ${r} has no end`:`end at ${r} has no begin`));return[...t,...i]}function tS(n,e,t,i){let{title:s,annotations_url:r}=n.scene,o=(l,c,h)=>{Zl(Kl(s,l),c,h),i(e.state.marks)},a=ee("div",{class:"row"},cn("Samples as CSV",()=>o("_samples.csv",Jm(n,e.state.marks),"text/csv")),cn("Intervals as TOML",()=>o("_intervals.toml",jm(n,e.state.marks),"application/toml")));return r!==null&&a.append(cn("Write beside the experiment",()=>{let{marks:l}=e.state;nS(r,n,l,t).then(c=>{c&&i(l)})},{class:"primary"})),a}async function nS(n,e,t,i){try{let s=JSON.stringify(Qm(e,t)),r=await fetch(n,{method:"POST",headers:{"Content-Type":"application/json"},body:s}),o=await r.text();if(!r.ok)throw new Error(`${r.status} ${r.statusText}: ${o.slice(0,300)}`);let{files:a}=JSON.parse(o);return i(`Written beside the experiment: ${a.join(", ")}`),!0}catch(s){return i(`Not written. ${s instanceof Error?s.message:String(s)}`),!1}}function ng(n,e){let t=n.sensor(e)?.wrenches.find(r=>r.role==="expected");if(!t)return 0;let i=n.floats(t.values),s=["validation","calibration"];for(let{start_s:r,end_s:o}of s.flatMap(a=>n.scene.intervals.filter(l=>l.use===a)))for(let a=n.sampleAt(r);a<n.samples;a++){let l=n.time[a]??o;if(l>=o)break;if(l>=r&&Number.isFinite(i[6*a]))return a}return 0}var dr={LEFT:0,MIDDLE:1,RIGHT:2,ROTATE:0,DOLLY:1,PAN:2},fr={ROTATE:0,PAN:1,DOLLY_PAN:2,DOLLY_ROTATE:3},Fg=0,ff=1,Og=2;var fl=1,Bg=2,Vo=3,pr=0,ri=1,oi=2,Br=0,Go=1,pf=2,mf=3,gf=4,kg=5;var kr=100,zg=101,Vg=102,Gg=103,Hg=104,Wg=200,Xg=201,qg=202,Yg=203,_f=204,xf=205,$g=206,Zg=207,Kg=208,Jg=209,jg=210,Qg=211,e0=212,t0=213,n0=214,Gc=0,Hc=1,Wc=2,Po=3,Xc=4,qc=5,Yc=6,$c=7,Sh=0,i0=1,s0=2,ms=0,yf=1,vf=2,Sf=3,bf=4,Mf=5,wf=6,Tf=7;var Ef=300,zr=301,Ho=302,bh=303,Mh=304,Zc=1e3,ds=1001,Kc=1002,zn=1003,r0=1004;var pl=1005;var ni=1006,wh=1007;var Os=1008;var hi=1009,Af=1010,Cf=1011,Wo=1012,Th=1013,qi=1014,Yi=1015,$i=1016,Eh=1017,Ah=1018,Vr=1020,Rf=35902,Pf=35899,If=1021,Df=1022,Zi=1023,Ls=1026,Bs=1027,Lf=1028,Ch=1029,mr=1030,Rh=1031;var Ph=1033,ml=33776,gl=33777,_l=33778,xl=33779,Ih=35840,Dh=35841,Lh=35842,Nh=35843,Uh=36196,Fh=37492,Oh=37496,Bh=37488,kh=37489,yl=37490,zh=37491,Vh=37808,Gh=37809,Hh=37810,Wh=37811,Xh=37812,qh=37813,Yh=37814,$h=37815,Zh=37816,Kh=37817,Jh=37818,jh=37819,Qh=37820,eu=37821,tu=36492,nu=36494,iu=36495,su=36283,ru=36284,vl=36285,ou=36286;var Va=2300,Jc=2301,zc=2302,rf=2303,of=2400,af=2401,lf=2402;var o0=3200;var au=0,a0=1,ks="",vi="srgb",Ga="srgb-linear",Ha="linear",Lt="srgb";var Vc=7680;var l0=519,c0=512,h0=513,u0=514,Nf=515,d0=516,f0=517,Uf=518,Ff=519,Of=35044;var Bf="300 es",Di=2e3,Io=2001;function iS(n){for(let e=n.length-1;e>=0;--e)if(n[e]>=65535)return!0;return!1}function sS(n){return ArrayBuffer.isView(n)&&!(n instanceof DataView)}function Wa(n){return document.createElementNS("http://www.w3.org/1999/xhtml",n)}function p0(){let n=Wa("canvas");return n.style.display="block",n}var ig={},Do=null;function Xa(...n){let e="THREE."+n.shift();Do?Do("log",e,...n):console.log(e,...n)}function m0(n){let e=n[0];if(typeof e=="string"&&e.startsWith("TSL:")){let t=n[1];t&&t.isStackTrace?n[0]+=" "+t.getLocation():n[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return n}function Ke(...n){n=m0(n);let e="THREE."+n.shift();if(Do)Do("warn",e,...n);else{let t=n[0];t&&t.isStackTrace?console.warn(t.getError(e)):console.warn(e,...n)}}function it(...n){n=m0(n);let e="THREE."+n.shift();if(Do)Do("error",e,...n);else{let t=n[0];t&&t.isStackTrace?console.error(t.getError(e)):console.error(e,...n)}}function Ba(...n){let e=n.join(" ");e in ig||(ig[e]=!0,Ke(...n))}function g0(n,e,t){return new Promise(function(i,s){function r(){switch(n.clientWaitSync(e,n.SYNC_FLUSH_COMMANDS_BIT,0)){case n.WAIT_FAILED:s();break;case n.TIMEOUT_EXPIRED:setTimeout(r,t);break;default:i()}}setTimeout(r,t)})}var _0={[Gc]:Gc,[Wc]:Yc,[Xc]:Xc,[Po]:qc,[Hc]:Hc,[Yc]:Wc,[$c]:$c,[qc]:Po},Gi=class{addEventListener(e,t){this._listeners===void 0&&(this._listeners={});let i=this._listeners;i[e]===void 0&&(i[e]=[]),i[e].indexOf(t)===-1&&i[e].push(t)}hasEventListener(e,t){let i=this._listeners;return i===void 0?!1:i[e]!==void 0&&i[e].indexOf(t)!==-1}removeEventListener(e,t){let i=this._listeners;if(i===void 0)return;let s=i[e];if(s!==void 0){let r=s.indexOf(t);r!==-1&&s.splice(r,1)}}dispatchEvent(e){let t=this._listeners;if(t===void 0)return;let i=t[e.type];if(i!==void 0){e.target=this;let s=i.slice(0);for(let r=0,o=s.length;r<o;r++)s[r].call(this,e);e.target=null}}},qn=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"],sg=1234567,ka=Math.PI/180,Lo=180/Math.PI;function gr(){let n=Math.random()*4294967295|0,e=Math.random()*4294967295|0,t=Math.random()*4294967295|0,i=Math.random()*4294967295|0;return(qn[n&255]+qn[n>>8&255]+qn[n>>16&255]+qn[n>>24&255]+"-"+qn[e&255]+qn[e>>8&255]+"-"+qn[e>>16&15|64]+qn[e>>24&255]+"-"+qn[t&63|128]+qn[t>>8&255]+"-"+qn[t>>16&255]+qn[t>>24&255]+qn[i&255]+qn[i>>8&255]+qn[i>>16&255]+qn[i>>24&255]).toLowerCase()}function xt(n,e,t){return Math.max(e,Math.min(t,n))}function kf(n,e){return(n%e+e)%e}function rS(n,e,t,i,s){return i+(n-e)*(s-i)/(t-e)}function oS(n,e,t){return n!==e?(t-n)/(e-n):0}function za(n,e,t){return(1-t)*n+t*e}function aS(n,e,t,i){return za(n,e,1-Math.exp(-t*i))}function lS(n,e=1){return e-Math.abs(kf(n,e*2)-e)}function cS(n,e,t){return n<=e?0:n>=t?1:(n=(n-e)/(t-e),n*n*(3-2*n))}function hS(n,e,t){return n<=e?0:n>=t?1:(n=(n-e)/(t-e),n*n*n*(n*(n*6-15)+10))}function uS(n,e){return n+Math.floor(Math.random()*(e-n+1))}function dS(n,e){return n+Math.random()*(e-n)}function fS(n){return n*(.5-Math.random())}function pS(n){n!==void 0&&(sg=n);let e=sg+=1831565813;return e=Math.imul(e^e>>>15,e|1),e^=e+Math.imul(e^e>>>7,e|61),((e^e>>>14)>>>0)/4294967296}function mS(n){return n*ka}function gS(n){return n*Lo}function _S(n){return n>0&&Number.isInteger(n)&&2**Math.round(Math.log2(n))===n}function xS(n){return Math.pow(2,Math.ceil(Math.log(n)/Math.LN2))}function zf(n){return Math.pow(2,Math.floor(Math.log(n)/Math.LN2))}function yS(n,e,t,i,s){let r=Math.cos,o=Math.sin,a=r(t/2),l=o(t/2),c=r((e+i)/2),h=o((e+i)/2),u=r((e-i)/2),d=o((e-i)/2),f=r((i-e)/2),g=o((i-e)/2);switch(s){case"XYX":n.set(a*h,l*u,l*d,a*c);break;case"YZY":n.set(l*d,a*h,l*u,a*c);break;case"ZXZ":n.set(l*u,l*d,a*h,a*c);break;case"XZX":n.set(a*h,l*g,l*f,a*c);break;case"YXY":n.set(l*f,a*h,l*g,a*c);break;case"ZYZ":n.set(l*g,l*f,a*h,a*c);break;default:Ke("MathUtils: .setQuaternionFromProperEuler() encountered an unknown order: "+s)}}function lu(n){switch(n.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function Vf(n,e){if(e.constructor===Float32Array)return n;let t=lu(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(n/t,-1)}function Gf(n,e){if(e.constructor===Float32Array)return n;let t=lu(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(n*t)}var Hf={DEG2RAD:ka,RAD2DEG:Lo,generateUUID:gr,clamp:xt,euclideanModulo:kf,mapLinear:rS,inverseLerp:oS,lerp:za,damp:aS,pingpong:lS,smoothstep:cS,smootherstep:hS,randInt:uS,randFloat:dS,randFloatSpread:fS,seededRandom:pS,degToRad:mS,radToDeg:gS,isPowerOfTwo:_S,ceilPowerOfTwo:xS,floorPowerOfTwo:zf,setQuaternionFromProperEuler:yS,normalize:Gf,denormalize:Vf},$e=class{static{this.prototype.isVector2=!0}constructor(e=0,t=0){this.x=e,this.y=t}get width(){return this.x}set width(e){this.x=e}get height(){return this.y}set height(e){this.y=e}set(e,t){return this.x=e,this.y=t,this}setScalar(e){return this.x=e,this.y=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;default:throw new Error("THREE.Vector2: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y)}copy(e){return this.x=e.x,this.y=e.y,this}add(e){return this.x+=e.x,this.y+=e.y,this}addScalar(e){return this.x+=e,this.y+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this}subScalar(e){return this.x-=e,this.y-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this}multiply(e){return this.x*=e.x,this.y*=e.y,this}multiplyScalar(e){return this.x*=e,this.y*=e,this}divide(e){return this.x/=e.x,this.y/=e.y,this}divideScalar(e){return this.multiplyScalar(1/e)}applyMatrix3(e){let t=this.x,i=this.y,s=e.elements;return this.x=s[0]*t+s[3]*i+s[6],this.y=s[1]*t+s[4]*i+s[7],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this}clamp(e,t){return this.x=xt(this.x,e.x,t.x),this.y=xt(this.y,e.y,t.y),this}clampScalar(e,t){return this.x=xt(this.x,e,t),this.y=xt(this.y,e,t),this}clampLength(e,t){let i=this.length();return this.divideScalar(i||1).multiplyScalar(xt(i,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(e){return this.x*e.x+this.y*e.y}cross(e){return this.x*e.y-this.y*e.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let i=this.dot(e)/t;return Math.acos(xt(i,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,i=this.y-e.y;return t*t+i*i}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this}lerpVectors(e,t,i){return this.x=e.x+(t.x-e.x)*i,this.y=e.y+(t.y-e.y)*i,this}equals(e){return e.x===this.x&&e.y===this.y}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this}rotateAround(e,t){let i=Math.cos(t),s=Math.sin(t),r=this.x-e.x,o=this.y-e.y;return this.x=r*i-o*s+e.x,this.y=r*s+o*i+e.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}},ii=class{constructor(e=0,t=0,i=0,s=1){this.isQuaternion=!0,this._x=e,this._y=t,this._z=i,this._w=s}static slerpFlat(e,t,i,s,r,o,a){let l=i[s+0],c=i[s+1],h=i[s+2],u=i[s+3],d=r[o+0],f=r[o+1],g=r[o+2],v=r[o+3];if(u!==v||l!==d||c!==f||h!==g){let m=l*d+c*f+h*g+u*v;m<0&&(d=-d,f=-f,g=-g,v=-v,m=-m);let p=1-a;if(m<.9995){let y=Math.acos(m),C=Math.sin(y);p=Math.sin(p*y)/C,a=Math.sin(a*y)/C,l=l*p+d*a,c=c*p+f*a,h=h*p+g*a,u=u*p+v*a}else{l=l*p+d*a,c=c*p+f*a,h=h*p+g*a,u=u*p+v*a;let y=1/Math.sqrt(l*l+c*c+h*h+u*u);l*=y,c*=y,h*=y,u*=y}}e[t]=l,e[t+1]=c,e[t+2]=h,e[t+3]=u}static multiplyQuaternionsFlat(e,t,i,s,r,o){let a=i[s],l=i[s+1],c=i[s+2],h=i[s+3],u=r[o],d=r[o+1],f=r[o+2],g=r[o+3];return e[t]=a*g+h*u+l*f-c*d,e[t+1]=l*g+h*d+c*u-a*f,e[t+2]=c*g+h*f+a*d-l*u,e[t+3]=h*g-a*u-l*d-c*f,e}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get w(){return this._w}set w(e){this._w=e,this._onChangeCallback()}set(e,t,i,s){return this._x=e,this._y=t,this._z=i,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(e){return this._x=e.x,this._y=e.y,this._z=e.z,this._w=e.w,this._onChangeCallback(),this}setFromEuler(e,t=!0){let i=e._x,s=e._y,r=e._z,o=e._order,a=Math.cos,l=Math.sin,c=a(i/2),h=a(s/2),u=a(r/2),d=l(i/2),f=l(s/2),g=l(r/2);switch(o){case"XYZ":this._x=d*h*u+c*f*g,this._y=c*f*u-d*h*g,this._z=c*h*g+d*f*u,this._w=c*h*u-d*f*g;break;case"YXZ":this._x=d*h*u+c*f*g,this._y=c*f*u-d*h*g,this._z=c*h*g-d*f*u,this._w=c*h*u+d*f*g;break;case"ZXY":this._x=d*h*u-c*f*g,this._y=c*f*u+d*h*g,this._z=c*h*g+d*f*u,this._w=c*h*u-d*f*g;break;case"ZYX":this._x=d*h*u-c*f*g,this._y=c*f*u+d*h*g,this._z=c*h*g-d*f*u,this._w=c*h*u+d*f*g;break;case"YZX":this._x=d*h*u+c*f*g,this._y=c*f*u+d*h*g,this._z=c*h*g-d*f*u,this._w=c*h*u-d*f*g;break;case"XZY":this._x=d*h*u-c*f*g,this._y=c*f*u-d*h*g,this._z=c*h*g+d*f*u,this._w=c*h*u+d*f*g;break;default:Ke("Quaternion: .setFromEuler() encountered an unknown order: "+o)}return t===!0&&this._onChangeCallback(),this}setFromAxisAngle(e,t){let i=t/2,s=Math.sin(i);return this._x=e.x*s,this._y=e.y*s,this._z=e.z*s,this._w=Math.cos(i),this._onChangeCallback(),this}setFromRotationMatrix(e){let t=e.elements,i=t[0],s=t[4],r=t[8],o=t[1],a=t[5],l=t[9],c=t[2],h=t[6],u=t[10],d=i+a+u;if(d>0){let f=.5/Math.sqrt(d+1);this._w=.25/f,this._x=(h-l)*f,this._y=(r-c)*f,this._z=(o-s)*f}else if(i>a&&i>u){let f=2*Math.sqrt(1+i-a-u);this._w=(h-l)/f,this._x=.25*f,this._y=(s+o)/f,this._z=(r+c)/f}else if(a>u){let f=2*Math.sqrt(1+a-i-u);this._w=(r-c)/f,this._x=(s+o)/f,this._y=.25*f,this._z=(l+h)/f}else{let f=2*Math.sqrt(1+u-i-a);this._w=(o-s)/f,this._x=(r+c)/f,this._y=(l+h)/f,this._z=.25*f}return this._onChangeCallback(),this}setFromUnitVectors(e,t){let i=e.dot(t)+1;return i<1e-8?(i=0,Math.abs(e.x)>Math.abs(e.z)?(this._x=-e.y,this._y=e.x,this._z=0,this._w=i):(this._x=0,this._y=-e.z,this._z=e.y,this._w=i)):(this._x=e.y*t.z-e.z*t.y,this._y=e.z*t.x-e.x*t.z,this._z=e.x*t.y-e.y*t.x,this._w=i),this.normalize()}angleTo(e){return 2*Math.acos(Math.abs(xt(this.dot(e),-1,1)))}rotateTowards(e,t){let i=this.angleTo(e);if(i===0)return this;let s=Math.min(1,t/i);return this.slerp(e,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(e){return this._x*e._x+this._y*e._y+this._z*e._z+this._w*e._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let e=this.length();return e===0?(this._x=0,this._y=0,this._z=0,this._w=1):(e=1/e,this._x=this._x*e,this._y=this._y*e,this._z=this._z*e,this._w=this._w*e),this._onChangeCallback(),this}multiply(e){return this.multiplyQuaternions(this,e)}premultiply(e){return this.multiplyQuaternions(e,this)}multiplyQuaternions(e,t){let i=e._x,s=e._y,r=e._z,o=e._w,a=t._x,l=t._y,c=t._z,h=t._w;return this._x=i*h+o*a+s*c-r*l,this._y=s*h+o*l+r*a-i*c,this._z=r*h+o*c+i*l-s*a,this._w=o*h-i*a-s*l-r*c,this._onChangeCallback(),this}slerp(e,t){let i=e._x,s=e._y,r=e._z,o=e._w,a=this.dot(e);a<0&&(i=-i,s=-s,r=-r,o=-o,a=-a);let l=1-t;if(a<.9995){let c=Math.acos(a),h=Math.sin(c);l=Math.sin(l*c)/h,t=Math.sin(t*c)/h,this._x=this._x*l+i*t,this._y=this._y*l+s*t,this._z=this._z*l+r*t,this._w=this._w*l+o*t,this._onChangeCallback()}else this._x=this._x*l+i*t,this._y=this._y*l+s*t,this._z=this._z*l+r*t,this._w=this._w*l+o*t,this.normalize();return this}slerpQuaternions(e,t,i){return this.copy(e).slerp(t,i)}random(){let e=2*Math.PI*Math.random(),t=2*Math.PI*Math.random(),i=Math.random(),s=Math.sqrt(1-i),r=Math.sqrt(i);return this.set(s*Math.sin(e),s*Math.cos(e),r*Math.sin(t),r*Math.cos(t))}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._w===this._w}fromArray(e,t=0){return this._x=e[t],this._y=e[t+1],this._z=e[t+2],this._w=e[t+3],this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._w,e}fromBufferAttribute(e,t){return this._x=e.getX(t),this._y=e.getY(t),this._z=e.getZ(t),this._w=e.getW(t),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},B=class{static{this.prototype.isVector3=!0}constructor(e=0,t=0,i=0){this.x=e,this.y=t,this.z=i}set(e,t,i){return i===void 0&&(i=this.z),this.x=e,this.y=t,this.z=i,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;default:throw new Error("THREE.Vector3: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this}multiplyVectors(e,t){return this.x=e.x*t.x,this.y=e.y*t.y,this.z=e.z*t.z,this}applyEuler(e){return this.applyQuaternion(rg.setFromEuler(e))}applyAxisAngle(e,t){return this.applyQuaternion(rg.setFromAxisAngle(e,t))}applyMatrix3(e){let t=this.x,i=this.y,s=this.z,r=e.elements;return this.x=r[0]*t+r[3]*i+r[6]*s,this.y=r[1]*t+r[4]*i+r[7]*s,this.z=r[2]*t+r[5]*i+r[8]*s,this}applyNormalMatrix(e){return this.applyMatrix3(e).normalize()}applyMatrix4(e){let t=this.x,i=this.y,s=this.z,r=e.elements,o=1/(r[3]*t+r[7]*i+r[11]*s+r[15]);return this.x=(r[0]*t+r[4]*i+r[8]*s+r[12])*o,this.y=(r[1]*t+r[5]*i+r[9]*s+r[13])*o,this.z=(r[2]*t+r[6]*i+r[10]*s+r[14])*o,this}applyQuaternion(e){let t=this.x,i=this.y,s=this.z,r=e.x,o=e.y,a=e.z,l=e.w,c=2*(o*s-a*i),h=2*(a*t-r*s),u=2*(r*i-o*t);return this.x=t+l*c+o*u-a*h,this.y=i+l*h+a*c-r*u,this.z=s+l*u+r*h-o*c,this}project(e){return this.applyMatrix4(e.matrixWorldInverse).applyMatrix4(e.projectionMatrix)}unproject(e){return this.applyMatrix4(e.projectionMatrixInverse).applyMatrix4(e.matrixWorld)}transformDirection(e){let t=this.x,i=this.y,s=this.z,r=e.elements;return this.x=r[0]*t+r[4]*i+r[8]*s,this.y=r[1]*t+r[5]*i+r[9]*s,this.z=r[2]*t+r[6]*i+r[10]*s,this.normalize()}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this}divideScalar(e){return this.multiplyScalar(1/e)}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this}clamp(e,t){return this.x=xt(this.x,e.x,t.x),this.y=xt(this.y,e.y,t.y),this.z=xt(this.z,e.z,t.z),this}clampScalar(e,t){return this.x=xt(this.x,e,t),this.y=xt(this.y,e,t),this.z=xt(this.z,e,t),this}clampLength(e,t){let i=this.length();return this.divideScalar(i||1).multiplyScalar(xt(i,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this}lerpVectors(e,t,i){return this.x=e.x+(t.x-e.x)*i,this.y=e.y+(t.y-e.y)*i,this.z=e.z+(t.z-e.z)*i,this}cross(e){return this.crossVectors(this,e)}crossVectors(e,t){let i=e.x,s=e.y,r=e.z,o=t.x,a=t.y,l=t.z;return this.x=s*l-r*a,this.y=r*o-i*l,this.z=i*a-s*o,this}projectOnVector(e){let t=e.lengthSq();if(t===0)return this.set(0,0,0);let i=e.dot(this)/t;return this.copy(e).multiplyScalar(i)}projectOnPlane(e){return Fd.copy(this).projectOnVector(e),this.sub(Fd)}reflect(e){return this.sub(Fd.copy(e).multiplyScalar(2*this.dot(e)))}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let i=this.dot(e)/t;return Math.acos(xt(i,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,i=this.y-e.y,s=this.z-e.z;return t*t+i*i+s*s}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)+Math.abs(this.z-e.z)}setFromSpherical(e){return this.setFromSphericalCoords(e.radius,e.phi,e.theta)}setFromSphericalCoords(e,t,i){let s=Math.sin(t)*e;return this.x=s*Math.sin(i),this.y=Math.cos(t)*e,this.z=s*Math.cos(i),this}setFromCylindrical(e){return this.setFromCylindricalCoords(e.radius,e.theta,e.y)}setFromCylindricalCoords(e,t,i){return this.x=e*Math.sin(t),this.y=i,this.z=e*Math.cos(t),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this}setFromMatrixScale(e){let t=this.setFromMatrixColumn(e,0).length(),i=this.setFromMatrixColumn(e,1).length(),s=this.setFromMatrixColumn(e,2).length();return this.x=t,this.y=i,this.z=s,this}setFromMatrixColumn(e,t){return this.fromArray(e.elements,t*4)}setFromMatrix3Column(e,t){return this.fromArray(e.elements,t*3)}setFromEuler(e){return this.x=e._x,this.y=e._y,this.z=e._z,this}setFromColor(e){return this.x=e.r,this.y=e.g,this.z=e.b,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let e=Math.random()*Math.PI*2,t=Math.random()*2-1,i=Math.sqrt(1-t*t);return this.x=i*Math.cos(e),this.y=t,this.z=i*Math.sin(e),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}},Fd=new B,rg=new ii,st=class{static{this.prototype.isMatrix3=!0}constructor(e,t,i,s,r,o,a,l,c){this.elements=[1,0,0,0,1,0,0,0,1],e!==void 0&&this.set(e,t,i,s,r,o,a,l,c)}set(e,t,i,s,r,o,a,l,c){let h=this.elements;return h[0]=e,h[1]=s,h[2]=a,h[3]=t,h[4]=r,h[5]=l,h[6]=i,h[7]=o,h[8]=c,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(e){let t=this.elements,i=e.elements;return t[0]=i[0],t[1]=i[1],t[2]=i[2],t[3]=i[3],t[4]=i[4],t[5]=i[5],t[6]=i[6],t[7]=i[7],t[8]=i[8],this}extractBasis(e,t,i){return e.setFromMatrix3Column(this,0),t.setFromMatrix3Column(this,1),i.setFromMatrix3Column(this,2),this}setFromMatrix4(e){let t=e.elements;return this.set(t[0],t[4],t[8],t[1],t[5],t[9],t[2],t[6],t[10]),this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let i=e.elements,s=t.elements,r=this.elements,o=i[0],a=i[3],l=i[6],c=i[1],h=i[4],u=i[7],d=i[2],f=i[5],g=i[8],v=s[0],m=s[3],p=s[6],y=s[1],C=s[4],w=s[7],P=s[2],E=s[5],x=s[8];return r[0]=o*v+a*y+l*P,r[3]=o*m+a*C+l*E,r[6]=o*p+a*w+l*x,r[1]=c*v+h*y+u*P,r[4]=c*m+h*C+u*E,r[7]=c*p+h*w+u*x,r[2]=d*v+f*y+g*P,r[5]=d*m+f*C+g*E,r[8]=d*p+f*w+g*x,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[3]*=e,t[6]*=e,t[1]*=e,t[4]*=e,t[7]*=e,t[2]*=e,t[5]*=e,t[8]*=e,this}determinant(){let e=this.elements,t=e[0],i=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8];return t*o*h-t*a*c-i*r*h+i*a*l+s*r*c-s*o*l}invert(){let e=this.elements,t=e[0],i=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8],u=h*o-a*c,d=a*l-h*r,f=c*r-o*l,g=t*u+i*d+s*f;if(g===0)return this.set(0,0,0,0,0,0,0,0,0);let v=1/g;return e[0]=u*v,e[1]=(s*c-h*i)*v,e[2]=(a*i-s*o)*v,e[3]=d*v,e[4]=(h*t-s*l)*v,e[5]=(s*r-a*t)*v,e[6]=f*v,e[7]=(i*l-c*t)*v,e[8]=(o*t-i*r)*v,this}transpose(){let e,t=this.elements;return e=t[1],t[1]=t[3],t[3]=e,e=t[2],t[2]=t[6],t[6]=e,e=t[5],t[5]=t[7],t[7]=e,this}getNormalMatrix(e){return this.setFromMatrix4(e).invert().transpose()}transposeIntoArray(e){let t=this.elements;return e[0]=t[0],e[1]=t[3],e[2]=t[6],e[3]=t[1],e[4]=t[4],e[5]=t[7],e[6]=t[2],e[7]=t[5],e[8]=t[8],this}setUvTransform(e,t,i,s,r,o,a){let l=Math.cos(r),c=Math.sin(r);return this.set(i*l,i*c,-i*(l*o+c*a)+o+e,-s*c,s*l,-s*(-c*o+l*a)+a+t,0,0,1),this}scale(e,t){return Ba("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(Od.makeScale(e,t)),this}rotate(e){return Ba("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(Od.makeRotation(-e)),this}translate(e,t){return Ba("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(Od.makeTranslation(e,t)),this}makeTranslation(e,t){return e.isVector2?this.set(1,0,e.x,0,1,e.y,0,0,1):this.set(1,0,e,0,1,t,0,0,1),this}makeRotation(e){let t=Math.cos(e),i=Math.sin(e);return this.set(t,-i,0,i,t,0,0,0,1),this}makeScale(e,t){return this.set(e,0,0,0,t,0,0,0,1),this}equals(e){let t=this.elements,i=e.elements;for(let s=0;s<9;s++)if(t[s]!==i[s])return!1;return!0}fromArray(e,t=0){for(let i=0;i<9;i++)this.elements[i]=e[i+t];return this}toArray(e=[],t=0){let i=this.elements;return e[t]=i[0],e[t+1]=i[1],e[t+2]=i[2],e[t+3]=i[3],e[t+4]=i[4],e[t+5]=i[5],e[t+6]=i[6],e[t+7]=i[7],e[t+8]=i[8],e}clone(){return new this.constructor().fromArray(this.elements)}},Od=new st,og=new st().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),ag=new st().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function vS(){let n={enabled:!0,workingColorSpace:Ga,spaces:{},convert:function(s,r,o){return this.enabled===!1||r===o||!r||!o||(this.spaces[r].transfer===Lt&&(s.r=Ds(s.r),s.g=Ds(s.g),s.b=Ds(s.b)),this.spaces[r].primaries!==this.spaces[o].primaries&&(s.applyMatrix3(this.spaces[r].toXYZ),s.applyMatrix3(this.spaces[o].fromXYZ)),this.spaces[o].transfer===Lt&&(s.r=Ro(s.r),s.g=Ro(s.g),s.b=Ro(s.b))),s},workingToColorSpace:function(s,r){return this.convert(s,this.workingColorSpace,r)},colorSpaceToWorking:function(s,r){return this.convert(s,r,this.workingColorSpace)},getPrimaries:function(s){return this.spaces[s].primaries},getTransfer:function(s){return s===ks?Ha:this.spaces[s].transfer},getToneMappingMode:function(s){return this.spaces[s].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(s,r=this.workingColorSpace){return s.fromArray(this.spaces[r].luminanceCoefficients)},define:function(s){Object.assign(this.spaces,s)},_getMatrix:function(s,r,o){return s.copy(this.spaces[o].fromXYZ).multiply(this.spaces[r].toXYZ)},_getDrawingBufferColorSpace:function(s){return this.spaces[s].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(s=this.workingColorSpace){return this.spaces[s].workingColorSpaceConfig.unpackColorSpace}},e=[.64,.33,.3,.6,.15,.06],t=[.2126,.7152,.0722],i=[.3127,.329];return n.define({[Ga]:{primaries:e,whitePoint:i,transfer:Ha,toXYZ:og,fromXYZ:ag,luminanceCoefficients:t,workingColorSpaceConfig:{unpackColorSpace:vi},outputColorSpaceConfig:{drawingBufferColorSpace:vi}},[vi]:{primaries:e,whitePoint:i,transfer:Lt,toXYZ:og,fromXYZ:ag,luminanceCoefficients:t,outputColorSpaceConfig:{drawingBufferColorSpace:vi}}}),n}var bt=vS();function Ds(n){return n<.04045?n*.0773993808:Math.pow(n*.9478672986+.0521327014,2.4)}function Ro(n){return n<.0031308?n*12.92:1.055*Math.pow(n,.41666)-.055}var uo,jc=class{static getDataURL(e,t="image/png"){if(/^data:/i.test(e.src)||typeof HTMLCanvasElement>"u")return e.src;let i;if(e instanceof HTMLCanvasElement)i=e;else{uo===void 0&&(uo=Wa("canvas")),uo.width=e.width,uo.height=e.height;let s=uo.getContext("2d");e instanceof ImageData?s.putImageData(e,0,0):s.drawImage(e,0,0,e.width,e.height),i=uo}return i.toDataURL(t)}static sRGBToLinear(e){if(typeof HTMLImageElement<"u"&&e instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&e instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&e instanceof ImageBitmap){let t=Wa("canvas");t.width=e.width,t.height=e.height;let i=t.getContext("2d");i.drawImage(e,0,0,e.width,e.height);let s=i.getImageData(0,0,e.width,e.height),r=s.data;for(let o=0;o<r.length;o++)r[o]=Ds(r[o]/255)*255;return i.putImageData(s,0,0),t}else if(e.data){let t=e.data.slice(0);for(let i=0;i<t.length;i++)t instanceof Uint8Array||t instanceof Uint8ClampedArray?t[i]=Math.floor(Ds(t[i]/255)*255):t[i]=Ds(t[i]);return{data:t,width:e.width,height:e.height}}else return Ke("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),e}},SS=0,No=class{constructor(e=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:SS++}),this.uuid=gr(),this.data=e,this.dataReady=!0,this.version=0}getSize(e){let t=this.data;return typeof HTMLVideoElement<"u"&&t instanceof HTMLVideoElement?e.set(t.videoWidth,t.videoHeight,0):typeof VideoFrame<"u"&&t instanceof VideoFrame?e.set(t.displayWidth,t.displayHeight,0):t!==null?e.set(t.width||0,t.height||0,t.depth||0):e.set(0,0,0),e}set needsUpdate(e){e===!0&&this.version++}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.images[this.uuid]!==void 0)return e.images[this.uuid];let i={uuid:this.uuid,url:""},s=this.data;if(s!==null){let r;if(Array.isArray(s)){r=[];for(let o=0,a=s.length;o<a;o++)s[o].isDataTexture?r.push(Bd(s[o].image)):r.push(Bd(s[o]))}else r=Bd(s);i.url=r}return t||(e.images[this.uuid]=i),i}};function Bd(n){return typeof HTMLImageElement<"u"&&n instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&n instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&n instanceof ImageBitmap?jc.getDataURL(n):n.data?{data:Array.from(n.data),width:n.width,height:n.height,type:n.data.constructor.name}:(Ke("Texture: Unable to serialize Texture."),{})}var bS=0,kd=new B,si=class n extends Gi{constructor(e=n.DEFAULT_IMAGE,t=n.DEFAULT_MAPPING,i=ds,s=ds,r=ni,o=Os,a=Zi,l=hi,c=n.DEFAULT_ANISOTROPY,h=ks){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:bS++}),this.uuid=gr(),this.name="",this.source=new No(e),this.mipmaps=[],this.mapping=t,this.channel=0,this.wrapS=i,this.wrapT=s,this.magFilter=r,this.minFilter=o,this.anisotropy=c,this.format=a,this.internalFormat=null,this.type=l,this.offset=new $e(0,0),this.repeat=new $e(1,1),this.center=new $e(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new st,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=h,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(e&&e.depth&&e.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(kd).x}get height(){return this.source.getSize(kd).y}get depth(){return this.source.getSize(kd).z}get image(){return this.source.data}set image(e){this.source.data=e}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(e){return this.name=e.name,this.source=e.source,this.mipmaps=e.mipmaps.slice(0),this.mapping=e.mapping,this.channel=e.channel,this.wrapS=e.wrapS,this.wrapT=e.wrapT,this.magFilter=e.magFilter,this.minFilter=e.minFilter,this.anisotropy=e.anisotropy,this.format=e.format,this.internalFormat=e.internalFormat,this.type=e.type,this.normalized=e.normalized,this.offset.copy(e.offset),this.repeat.copy(e.repeat),this.center.copy(e.center),this.rotation=e.rotation,this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrix.copy(e.matrix),this.generateMipmaps=e.generateMipmaps,this.mipmapsAutoUpdate=e.mipmapsAutoUpdate,this.premultiplyAlpha=e.premultiplyAlpha,this.flipY=e.flipY,this.unpackAlignment=e.unpackAlignment,this.colorSpace=e.colorSpace,this.renderTarget=e.renderTarget,this.isRenderTargetTexture=e.isRenderTargetTexture,this.isPMREMTexture=e.isPMREMTexture,this.isArrayTexture=e.isArrayTexture,this.userData=JSON.parse(JSON.stringify(e.userData)),this.needsUpdate=!0,this}setValues(e){for(let t in e){let i=e[t];if(i===void 0){Ke(`Texture.setValues(): parameter '${t}' has value of undefined.`);continue}let s=this[t];if(s===void 0){Ke(`Texture.setValues(): property '${t}' does not exist.`);continue}s&&i&&s.isVector2&&i.isVector2||s&&i&&s.isVector3&&i.isVector3||s&&i&&s.isMatrix3&&i.isMatrix3?s.copy(i):this[t]=i}}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.textures[this.uuid]!==void 0)return e.textures[this.uuid];let i={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(e).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(i.userData=this.userData),t||(e.textures[this.uuid]=i),i}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(e){if(this.mapping!==Ef)return e;if(e.applyMatrix3(this.matrix),e.x<0||e.x>1)switch(this.wrapS){case Zc:e.x=e.x-Math.floor(e.x);break;case ds:e.x=e.x<0?0:1;break;case Kc:Math.abs(Math.floor(e.x)%2)===1?e.x=Math.ceil(e.x)-e.x:e.x=e.x-Math.floor(e.x);break}if(e.y<0||e.y>1)switch(this.wrapT){case Zc:e.y=e.y-Math.floor(e.y);break;case ds:e.y=e.y<0?0:1;break;case Kc:Math.abs(Math.floor(e.y)%2)===1?e.y=Math.ceil(e.y)-e.y:e.y=e.y-Math.floor(e.y);break}return this.flipY&&(e.y=1-e.y),e}set needsUpdate(e){e===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(e){e===!0&&this.pmremVersion++}};si.DEFAULT_IMAGE=null;si.DEFAULT_MAPPING=Ef;si.DEFAULT_ANISOTROPY=1;var tn=class{static{this.prototype.isVector4=!0}constructor(e=0,t=0,i=0,s=1){this.x=e,this.y=t,this.z=i,this.w=s}get width(){return this.z}set width(e){this.z=e}get height(){return this.w}set height(e){this.w=e}set(e,t,i,s){return this.x=e,this.y=t,this.z=i,this.w=s,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this.w=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setW(e){return this.w=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;case 3:this.w=t;break;default:throw new Error("THREE.Vector4: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this.w=e.w!==void 0?e.w:1,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this.w+=e.w,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this.w+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this.w=e.w+t.w,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this.w+=e.w*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this.w-=e.w,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this.w-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this.w=e.w-t.w,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this.w*=e.w,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this.w*=e,this}applyMatrix4(e){let t=this.x,i=this.y,s=this.z,r=this.w,o=e.elements;return this.x=o[0]*t+o[4]*i+o[8]*s+o[12]*r,this.y=o[1]*t+o[5]*i+o[9]*s+o[13]*r,this.z=o[2]*t+o[6]*i+o[10]*s+o[14]*r,this.w=o[3]*t+o[7]*i+o[11]*s+o[15]*r,this}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this.w/=e.w,this}divideScalar(e){return this.multiplyScalar(1/e)}setAxisAngleFromQuaternion(e){this.w=2*Math.acos(e.w);let t=Math.sqrt(1-e.w*e.w);return t<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=e.x/t,this.y=e.y/t,this.z=e.z/t),this}setAxisAngleFromRotationMatrix(e){let t,i,s,r,l=e.elements,c=l[0],h=l[4],u=l[8],d=l[1],f=l[5],g=l[9],v=l[2],m=l[6],p=l[10];if(Math.abs(h-d)<.01&&Math.abs(u-v)<.01&&Math.abs(g-m)<.01){if(Math.abs(h+d)<.1&&Math.abs(u+v)<.1&&Math.abs(g+m)<.1&&Math.abs(c+f+p-3)<.1)return this.set(1,0,0,0),this;t=Math.PI;let C=(c+1)/2,w=(f+1)/2,P=(p+1)/2,E=(h+d)/4,x=(u+v)/4,T=(g+m)/4;return C>w&&C>P?C<.01?(i=0,s=.707106781,r=.707106781):(i=Math.sqrt(C),s=E/i,r=x/i):w>P?w<.01?(i=.707106781,s=0,r=.707106781):(s=Math.sqrt(w),i=E/s,r=T/s):P<.01?(i=.707106781,s=.707106781,r=0):(r=Math.sqrt(P),i=x/r,s=T/r),this.set(i,s,r,t),this}let y=Math.sqrt((m-g)*(m-g)+(u-v)*(u-v)+(d-h)*(d-h));return Math.abs(y)<.001&&(y=1),this.x=(m-g)/y,this.y=(u-v)/y,this.z=(d-h)/y,this.w=Math.acos((c+f+p-1)/2),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this.w=t[15],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this.w=Math.min(this.w,e.w),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this.w=Math.max(this.w,e.w),this}clamp(e,t){return this.x=xt(this.x,e.x,t.x),this.y=xt(this.y,e.y,t.y),this.z=xt(this.z,e.z,t.z),this.w=xt(this.w,e.w,t.w),this}clampScalar(e,t){return this.x=xt(this.x,e,t),this.y=xt(this.y,e,t),this.z=xt(this.z,e,t),this.w=xt(this.w,e,t),this}clampLength(e,t){let i=this.length();return this.divideScalar(i||1).multiplyScalar(xt(i,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z+this.w*e.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this.w+=(e.w-this.w)*t,this}lerpVectors(e,t,i){return this.x=e.x+(t.x-e.x)*i,this.y=e.y+(t.y-e.y)*i,this.z=e.z+(t.z-e.z)*i,this.w=e.w+(t.w-e.w)*i,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z&&e.w===this.w}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this.w=e[t+3],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e[t+3]=this.w,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this.w=e.getW(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}},Qc=class extends Gi{constructor(e=1,t=1,i={}){super(),i=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:ni,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},i),this.isRenderTarget=!0,this.width=e,this.height=t,this.depth=i.depth,this.scissor=new tn(0,0,e,t),this.scissorTest=!1,this.viewport=new tn(0,0,e,t),this.textures=[];let s=i.count;for(let r=0;r<s;r++)this.textures[r]=new si({width:e,height:t,depth:i.depth}),this.textures[r].isRenderTargetTexture=!0,this.textures[r].renderTarget=this;this._setTextureOptions(i),this.depthBuffer=i.depthBuffer,this.stencilBuffer=i.stencilBuffer,this.resolveColorBuffer=i.resolveColorBuffer,this.resolveDepthBuffer=i.resolveDepthBuffer,this.resolveStencilBuffer=i.resolveStencilBuffer,this.storeMultisampledColorBuffer=i.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=i.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=i.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=i.depthTexture,this.samples=i.samples,this.multiview=i.multiview,this.useArrayDepthTexture=i.useArrayDepthTexture}_setTextureOptions(e={}){let t={minFilter:ni,generateMipmaps:!1,flipY:!1,internalFormat:null};e.mapping!==void 0&&(t.mapping=e.mapping),e.wrapS!==void 0&&(t.wrapS=e.wrapS),e.wrapT!==void 0&&(t.wrapT=e.wrapT),e.wrapR!==void 0&&(t.wrapR=e.wrapR),e.magFilter!==void 0&&(t.magFilter=e.magFilter),e.minFilter!==void 0&&(t.minFilter=e.minFilter),e.format!==void 0&&(t.format=e.format),e.type!==void 0&&(t.type=e.type),e.anisotropy!==void 0&&(t.anisotropy=e.anisotropy),e.colorSpace!==void 0&&(t.colorSpace=e.colorSpace),e.flipY!==void 0&&(t.flipY=e.flipY),e.generateMipmaps!==void 0&&(t.generateMipmaps=e.generateMipmaps),e.mipmapsAutoUpdate!==void 0&&(t.mipmapsAutoUpdate=e.mipmapsAutoUpdate),e.internalFormat!==void 0&&(t.internalFormat=e.internalFormat);for(let i=0;i<this.textures.length;i++)this.textures[i].setValues(t)}get texture(){return this.textures[0]}set texture(e){this.textures[0]=e}set depthTexture(e){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),e!==null&&e.renderTarget===null&&(e.renderTarget=this),this._depthTexture=e}get depthTexture(){return this._depthTexture}setSize(e,t,i=1){if(this.width!==e||this.height!==t||this.depth!==i){this.width=e,this.height=t,this.depth=i;for(let s=0,r=this.textures.length;s<r;s++)this.textures[s].image.width=e,this.textures[s].image.height=t,this.textures[s].image.depth=i,this.textures[s].isData3DTexture!==!0&&(this.textures[s].isArrayTexture=this.textures[s].image.depth>1);this.dispose()}this.viewport.set(0,0,e,t),this.scissor.set(0,0,e,t)}clone(){return new this.constructor().copy(this)}copy(e){this.width=e.width,this.height=e.height,this.depth=e.depth,this.scissor.copy(e.scissor),this.scissorTest=e.scissorTest,this.viewport.copy(e.viewport),this.textures.length=0;for(let t=0,i=e.textures.length;t<i;t++){this.textures[t]=e.textures[t].clone(),this.textures[t].isRenderTargetTexture=!0,this.textures[t].renderTarget=this;let s=Object.assign({},e.textures[t].image);this.textures[t].source=new No(s)}if(this.depthBuffer=e.depthBuffer,this.stencilBuffer=e.stencilBuffer,this.resolveColorBuffer=e.resolveColorBuffer,this.resolveDepthBuffer=e.resolveDepthBuffer,this.resolveStencilBuffer=e.resolveStencilBuffer,this.storeMultisampledColorBuffer=e.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=e.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=e.storeMultisampledStencilBuffer,e.depthTexture!==null)if(e.depthTexture.renderTarget===e){let t=e.depthTexture.clone();t.renderTarget=null,this.depthTexture=t}else this.depthTexture=e.depthTexture;else this.depthTexture=null;return this.samples=e.samples,this.multiview=e.multiview,this.useArrayDepthTexture=e.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},bi=class extends Qc{constructor(e=1,t=1,i={}){super(e,t,i),this.isWebGLRenderTarget=!0}},qa=class extends si{constructor(e=null,t=1,i=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:e,width:t,height:i,depth:s},this.magFilter=zn,this.minFilter=zn,this.wrapR=ds,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}addLayerUpdate(e){this.layerUpdates.add(e)}clearLayerUpdates(){this.layerUpdates.clear()}};var eh=class extends si{constructor(e=null,t=1,i=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:e,width:t,height:i,depth:s},this.magFilter=zn,this.minFilter=zn,this.wrapR=ds,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}};var Pt=class n{static{this.prototype.isMatrix4=!0}constructor(e,t,i,s,r,o,a,l,c,h,u,d,f,g,v,m){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],e!==void 0&&this.set(e,t,i,s,r,o,a,l,c,h,u,d,f,g,v,m)}set(e,t,i,s,r,o,a,l,c,h,u,d,f,g,v,m){let p=this.elements;return p[0]=e,p[4]=t,p[8]=i,p[12]=s,p[1]=r,p[5]=o,p[9]=a,p[13]=l,p[2]=c,p[6]=h,p[10]=u,p[14]=d,p[3]=f,p[7]=g,p[11]=v,p[15]=m,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new n().fromArray(this.elements)}copy(e){let t=this.elements,i=e.elements;return t[0]=i[0],t[1]=i[1],t[2]=i[2],t[3]=i[3],t[4]=i[4],t[5]=i[5],t[6]=i[6],t[7]=i[7],t[8]=i[8],t[9]=i[9],t[10]=i[10],t[11]=i[11],t[12]=i[12],t[13]=i[13],t[14]=i[14],t[15]=i[15],this}copyPosition(e){let t=this.elements,i=e.elements;return t[12]=i[12],t[13]=i[13],t[14]=i[14],this}setFromMatrix3(e){let t=e.elements;return this.set(t[0],t[3],t[6],0,t[1],t[4],t[7],0,t[2],t[5],t[8],0,0,0,0,1),this}extractBasis(e,t,i){return this.determinantAffine()===0?(e.set(1,0,0),t.set(0,1,0),i.set(0,0,1),this):(e.setFromMatrixColumn(this,0),t.setFromMatrixColumn(this,1),i.setFromMatrixColumn(this,2),this)}makeBasis(e,t,i){return this.set(e.x,t.x,i.x,0,e.y,t.y,i.y,0,e.z,t.z,i.z,0,0,0,0,1),this}extractRotation(e){if(e.determinantAffine()===0)return this.identity();let t=this.elements,i=e.elements,s=1/fo.setFromMatrixColumn(e,0).length(),r=1/fo.setFromMatrixColumn(e,1).length(),o=1/fo.setFromMatrixColumn(e,2).length();return t[0]=i[0]*s,t[1]=i[1]*s,t[2]=i[2]*s,t[3]=0,t[4]=i[4]*r,t[5]=i[5]*r,t[6]=i[6]*r,t[7]=0,t[8]=i[8]*o,t[9]=i[9]*o,t[10]=i[10]*o,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromEuler(e){let t=this.elements,i=e.x,s=e.y,r=e.z,o=Math.cos(i),a=Math.sin(i),l=Math.cos(s),c=Math.sin(s),h=Math.cos(r),u=Math.sin(r);if(e.order==="XYZ"){let d=o*h,f=o*u,g=a*h,v=a*u;t[0]=l*h,t[4]=-l*u,t[8]=c,t[1]=f+g*c,t[5]=d-v*c,t[9]=-a*l,t[2]=v-d*c,t[6]=g+f*c,t[10]=o*l}else if(e.order==="YXZ"){let d=l*h,f=l*u,g=c*h,v=c*u;t[0]=d+v*a,t[4]=g*a-f,t[8]=o*c,t[1]=o*u,t[5]=o*h,t[9]=-a,t[2]=f*a-g,t[6]=v+d*a,t[10]=o*l}else if(e.order==="ZXY"){let d=l*h,f=l*u,g=c*h,v=c*u;t[0]=d-v*a,t[4]=-o*u,t[8]=g+f*a,t[1]=f+g*a,t[5]=o*h,t[9]=v-d*a,t[2]=-o*c,t[6]=a,t[10]=o*l}else if(e.order==="ZYX"){let d=o*h,f=o*u,g=a*h,v=a*u;t[0]=l*h,t[4]=g*c-f,t[8]=d*c+v,t[1]=l*u,t[5]=v*c+d,t[9]=f*c-g,t[2]=-c,t[6]=a*l,t[10]=o*l}else if(e.order==="YZX"){let d=o*l,f=o*c,g=a*l,v=a*c;t[0]=l*h,t[4]=v-d*u,t[8]=g*u+f,t[1]=u,t[5]=o*h,t[9]=-a*h,t[2]=-c*h,t[6]=f*u+g,t[10]=d-v*u}else if(e.order==="XZY"){let d=o*l,f=o*c,g=a*l,v=a*c;t[0]=l*h,t[4]=-u,t[8]=c*h,t[1]=d*u+v,t[5]=o*h,t[9]=f*u-g,t[2]=g*u-f,t[6]=a*h,t[10]=v*u+d}return t[3]=0,t[7]=0,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromQuaternion(e){return this.compose(MS,e,wS)}lookAt(e,t,i){let s=this.elements;return xi.subVectors(e,t),xi.lengthSq()===0&&(xi.z=1),xi.normalize(),Qs.crossVectors(i,xi),Qs.lengthSq()===0&&(Math.abs(i.z)===1?xi.x+=1e-4:xi.z+=1e-4,xi.normalize(),Qs.crossVectors(i,xi)),Qs.normalize(),fc.crossVectors(xi,Qs),s[0]=Qs.x,s[4]=fc.x,s[8]=xi.x,s[1]=Qs.y,s[5]=fc.y,s[9]=xi.y,s[2]=Qs.z,s[6]=fc.z,s[10]=xi.z,this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let i=e.elements,s=t.elements,r=this.elements,o=i[0],a=i[4],l=i[8],c=i[12],h=i[1],u=i[5],d=i[9],f=i[13],g=i[2],v=i[6],m=i[10],p=i[14],y=i[3],C=i[7],w=i[11],P=i[15],E=s[0],x=s[4],T=s[8],k=s[12],N=s[1],L=s[5],z=s[9],W=s[13],D=s[2],X=s[6],$=s[10],H=s[14],he=s[3],J=s[7],Q=s[11],re=s[15];return r[0]=o*E+a*N+l*D+c*he,r[4]=o*x+a*L+l*X+c*J,r[8]=o*T+a*z+l*$+c*Q,r[12]=o*k+a*W+l*H+c*re,r[1]=h*E+u*N+d*D+f*he,r[5]=h*x+u*L+d*X+f*J,r[9]=h*T+u*z+d*$+f*Q,r[13]=h*k+u*W+d*H+f*re,r[2]=g*E+v*N+m*D+p*he,r[6]=g*x+v*L+m*X+p*J,r[10]=g*T+v*z+m*$+p*Q,r[14]=g*k+v*W+m*H+p*re,r[3]=y*E+C*N+w*D+P*he,r[7]=y*x+C*L+w*X+P*J,r[11]=y*T+C*z+w*$+P*Q,r[15]=y*k+C*W+w*H+P*re,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[4]*=e,t[8]*=e,t[12]*=e,t[1]*=e,t[5]*=e,t[9]*=e,t[13]*=e,t[2]*=e,t[6]*=e,t[10]*=e,t[14]*=e,t[3]*=e,t[7]*=e,t[11]*=e,t[15]*=e,this}determinant(){let e=this.elements,t=e[0],i=e[4],s=e[8],r=e[12],o=e[1],a=e[5],l=e[9],c=e[13],h=e[2],u=e[6],d=e[10],f=e[14],g=e[3],v=e[7],m=e[11],p=e[15],y=l*f-c*d,C=a*f-c*u,w=a*d-l*u,P=o*f-c*h,E=o*d-l*h,x=o*u-a*h;return t*(v*y-m*C+p*w)-i*(g*y-m*P+p*E)+s*(g*C-v*P+p*x)-r*(g*w-v*E+m*x)}determinantAffine(){let e=this.elements,t=e[0],i=e[4],s=e[8],r=e[1],o=e[5],a=e[9],l=e[2],c=e[6],h=e[10];return t*(o*h-a*c)-i*(r*h-a*l)+s*(r*c-o*l)}transpose(){let e=this.elements,t;return t=e[1],e[1]=e[4],e[4]=t,t=e[2],e[2]=e[8],e[8]=t,t=e[6],e[6]=e[9],e[9]=t,t=e[3],e[3]=e[12],e[12]=t,t=e[7],e[7]=e[13],e[13]=t,t=e[11],e[11]=e[14],e[14]=t,this}setPosition(e,t,i){let s=this.elements;return e.isVector3?(s[12]=e.x,s[13]=e.y,s[14]=e.z):(s[12]=e,s[13]=t,s[14]=i),this}invert(){let e=this.elements,t=e[0],i=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8],u=e[9],d=e[10],f=e[11],g=e[12],v=e[13],m=e[14],p=e[15],y=t*a-i*o,C=t*l-s*o,w=t*c-r*o,P=i*l-s*a,E=i*c-r*a,x=s*c-r*l,T=h*v-u*g,k=h*m-d*g,N=h*p-f*g,L=u*m-d*v,z=u*p-f*v,W=d*p-f*m,D=y*W-C*z+w*L+P*N-E*k+x*T;if(D===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let X=1/D;return e[0]=(a*W-l*z+c*L)*X,e[1]=(s*z-i*W-r*L)*X,e[2]=(v*x-m*E+p*P)*X,e[3]=(d*E-u*x-f*P)*X,e[4]=(l*N-o*W-c*k)*X,e[5]=(t*W-s*N+r*k)*X,e[6]=(m*w-g*x-p*C)*X,e[7]=(h*x-d*w+f*C)*X,e[8]=(o*z-a*N+c*T)*X,e[9]=(i*N-t*z-r*T)*X,e[10]=(g*E-v*w+p*y)*X,e[11]=(u*w-h*E-f*y)*X,e[12]=(a*k-o*L-l*T)*X,e[13]=(t*L-i*k+s*T)*X,e[14]=(v*C-g*P-m*y)*X,e[15]=(h*P-u*C+d*y)*X,this}scale(e){let t=this.elements,i=e.x,s=e.y,r=e.z;return t[0]*=i,t[4]*=s,t[8]*=r,t[1]*=i,t[5]*=s,t[9]*=r,t[2]*=i,t[6]*=s,t[10]*=r,t[3]*=i,t[7]*=s,t[11]*=r,this}getMaxScaleOnAxis(){let e=this.elements,t=e[0]*e[0]+e[1]*e[1]+e[2]*e[2],i=e[4]*e[4]+e[5]*e[5]+e[6]*e[6],s=e[8]*e[8]+e[9]*e[9]+e[10]*e[10];return Math.sqrt(Math.max(t,i,s))}makeTranslation(e,t,i){return e.isVector3?this.set(1,0,0,e.x,0,1,0,e.y,0,0,1,e.z,0,0,0,1):this.set(1,0,0,e,0,1,0,t,0,0,1,i,0,0,0,1),this}makeRotationX(e){let t=Math.cos(e),i=Math.sin(e);return this.set(1,0,0,0,0,t,-i,0,0,i,t,0,0,0,0,1),this}makeRotationY(e){let t=Math.cos(e),i=Math.sin(e);return this.set(t,0,i,0,0,1,0,0,-i,0,t,0,0,0,0,1),this}makeRotationZ(e){let t=Math.cos(e),i=Math.sin(e);return this.set(t,-i,0,0,i,t,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(e,t){let i=Math.cos(t),s=Math.sin(t),r=1-i,o=e.x,a=e.y,l=e.z,c=r*o,h=r*a;return this.set(c*o+i,c*a-s*l,c*l+s*a,0,c*a+s*l,h*a+i,h*l-s*o,0,c*l-s*a,h*l+s*o,r*l*l+i,0,0,0,0,1),this}makeScale(e,t,i){return this.set(e,0,0,0,0,t,0,0,0,0,i,0,0,0,0,1),this}makeShear(e,t,i,s,r,o){return this.set(1,i,r,0,e,1,o,0,t,s,1,0,0,0,0,1),this}compose(e,t,i){let s=this.elements,r=t._x,o=t._y,a=t._z,l=t._w,c=r+r,h=o+o,u=a+a,d=r*c,f=r*h,g=r*u,v=o*h,m=o*u,p=a*u,y=l*c,C=l*h,w=l*u,P=i.x,E=i.y,x=i.z;return s[0]=(1-(v+p))*P,s[1]=(f+w)*P,s[2]=(g-C)*P,s[3]=0,s[4]=(f-w)*E,s[5]=(1-(d+p))*E,s[6]=(m+y)*E,s[7]=0,s[8]=(g+C)*x,s[9]=(m-y)*x,s[10]=(1-(d+v))*x,s[11]=0,s[12]=e.x,s[13]=e.y,s[14]=e.z,s[15]=1,this}decompose(e,t,i){let s=this.elements;e.x=s[12],e.y=s[13],e.z=s[14];let r=this.determinantAffine();if(r===0)return i.set(1,1,1),t.identity(),this;let o=fo.set(s[0],s[1],s[2]).length(),a=fo.set(s[4],s[5],s[6]).length(),l=fo.set(s[8],s[9],s[10]).length();r<0&&(o=-o),ki.copy(this);let c=1/o,h=1/a,u=1/l;return ki.elements[0]*=c,ki.elements[1]*=c,ki.elements[2]*=c,ki.elements[4]*=h,ki.elements[5]*=h,ki.elements[6]*=h,ki.elements[8]*=u,ki.elements[9]*=u,ki.elements[10]*=u,t.setFromRotationMatrix(ki),i.x=o,i.y=a,i.z=l,this}makePerspective(e,t,i,s,r,o,a=Di,l=!1){let c=this.elements,h=2*r/(t-e),u=2*r/(i-s),d=(t+e)/(t-e),f=(i+s)/(i-s),g,v;if(l)g=r/(o-r),v=o*r/(o-r);else if(a===Di)g=-(o+r)/(o-r),v=-2*o*r/(o-r);else if(a===Io)g=-o/(o-r),v=-o*r/(o-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=d,c[12]=0,c[1]=0,c[5]=u,c[9]=f,c[13]=0,c[2]=0,c[6]=0,c[10]=g,c[14]=v,c[3]=0,c[7]=0,c[11]=-1,c[15]=0,this}makeOrthographic(e,t,i,s,r,o,a=Di,l=!1){let c=this.elements,h=2/(t-e),u=2/(i-s),d=-(t+e)/(t-e),f=-(i+s)/(i-s),g,v;if(l)g=1/(o-r),v=o/(o-r);else if(a===Di)g=-2/(o-r),v=-(o+r)/(o-r);else if(a===Io)g=-1/(o-r),v=-r/(o-r);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=0,c[12]=d,c[1]=0,c[5]=u,c[9]=0,c[13]=f,c[2]=0,c[6]=0,c[10]=g,c[14]=v,c[3]=0,c[7]=0,c[11]=0,c[15]=1,this}equals(e){let t=this.elements,i=e.elements;for(let s=0;s<16;s++)if(t[s]!==i[s])return!1;return!0}fromArray(e,t=0){for(let i=0;i<16;i++)this.elements[i]=e[i+t];return this}toArray(e=[],t=0){let i=this.elements;return e[t]=i[0],e[t+1]=i[1],e[t+2]=i[2],e[t+3]=i[3],e[t+4]=i[4],e[t+5]=i[5],e[t+6]=i[6],e[t+7]=i[7],e[t+8]=i[8],e[t+9]=i[9],e[t+10]=i[10],e[t+11]=i[11],e[t+12]=i[12],e[t+13]=i[13],e[t+14]=i[14],e[t+15]=i[15],e}},fo=new B,ki=new Pt,MS=new B(0,0,0),wS=new B(1,1,1),Qs=new B,fc=new B,xi=new B,lg=new Pt,cg=new ii,Ns=class n{constructor(e=0,t=0,i=0,s=n.DEFAULT_ORDER){this.isEuler=!0,this._x=e,this._y=t,this._z=i,this._order=s}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get order(){return this._order}set order(e){this._order=e,this._onChangeCallback()}set(e,t,i,s=this._order){return this._x=e,this._y=t,this._z=i,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(e){return this._x=e._x,this._y=e._y,this._z=e._z,this._order=e._order,this._onChangeCallback(),this}setFromRotationMatrix(e,t=this._order,i=!0){let s=e.elements,r=s[0],o=s[4],a=s[8],l=s[1],c=s[5],h=s[9],u=s[2],d=s[6],f=s[10];switch(t){case"XYZ":this._y=Math.asin(xt(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(-h,f),this._z=Math.atan2(-o,r)):(this._x=Math.atan2(d,c),this._z=0);break;case"YXZ":this._x=Math.asin(-xt(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(a,f),this._z=Math.atan2(l,c)):(this._y=Math.atan2(-u,r),this._z=0);break;case"ZXY":this._x=Math.asin(xt(d,-1,1)),Math.abs(d)<.9999999?(this._y=Math.atan2(-u,f),this._z=Math.atan2(-o,c)):(this._y=0,this._z=Math.atan2(l,r));break;case"ZYX":this._y=Math.asin(-xt(u,-1,1)),Math.abs(u)<.9999999?(this._x=Math.atan2(d,f),this._z=Math.atan2(l,r)):(this._x=0,this._z=Math.atan2(-o,c));break;case"YZX":this._z=Math.asin(xt(l,-1,1)),Math.abs(l)<.9999999?(this._x=Math.atan2(-h,c),this._y=Math.atan2(-u,r)):(this._x=0,this._y=Math.atan2(a,f));break;case"XZY":this._z=Math.asin(-xt(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(d,c),this._y=Math.atan2(a,r)):(this._x=Math.atan2(-h,f),this._y=0);break;default:Ke("Euler: .setFromRotationMatrix() encountered an unknown order: "+t)}return this._order=t,i===!0&&this._onChangeCallback(),this}setFromQuaternion(e,t,i){return lg.makeRotationFromQuaternion(e),this.setFromRotationMatrix(lg,t,i)}setFromVector3(e,t=this._order){return this.set(e.x,e.y,e.z,t)}reorder(e){return cg.setFromEuler(this),this.setFromQuaternion(cg,e)}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._order===this._order}fromArray(e){return this._x=e[0],this._y=e[1],this._z=e[2],e[3]!==void 0&&(this._order=e[3]),this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._order,e}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};Ns.DEFAULT_ORDER="XYZ";var Ya=class{constructor(){this.mask=1}set(e){this.mask=(1<<e|0)>>>0}enable(e){this.mask|=1<<e|0}enableAll(){this.mask=-1}toggle(e){this.mask^=1<<e|0}disable(e){this.mask&=~(1<<e|0)}disableAll(){this.mask=0}test(e){return(this.mask&e.mask)!==0}isEnabled(e){return(this.mask&(1<<e|0))!==0}},TS=0,hg=new B,po=new ii,Es=new Pt,pc=new B,Pa=new B,ES=new B,AS=new ii,ug=new B(1,0,0),dg=new B(0,1,0),fg=new B(0,0,1),pg={type:"added"},CS={type:"removed"},mo={type:"childadded",child:null},zd={type:"childremoved",child:null},En=class n extends Gi{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:TS++}),this.uuid=gr(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=n.DEFAULT_UP.clone();let e=new B,t=new Ns,i=new ii,s=new B(1,1,1);function r(){i.setFromEuler(t,!1)}function o(){t.setFromQuaternion(i,void 0,!1)}t._onChange(r),i._onChange(o),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:e},rotation:{configurable:!0,enumerable:!0,value:t},quaternion:{configurable:!0,enumerable:!0,value:i},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new Pt},normalMatrix:{value:new st}}),this.matrix=new Pt,this.matrixWorld=new Pt,this.matrixAutoUpdate=n.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=n.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new Ya,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(e){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(e),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(e){return this.quaternion.premultiply(e),this}setRotationFromAxisAngle(e,t){this.quaternion.setFromAxisAngle(e,t)}setRotationFromEuler(e){this.quaternion.setFromEuler(e,!0)}setRotationFromMatrix(e){this.quaternion.setFromRotationMatrix(e)}setRotationFromQuaternion(e){this.quaternion.copy(e)}rotateOnAxis(e,t){return po.setFromAxisAngle(e,t),this.quaternion.multiply(po),this}rotateOnWorldAxis(e,t){return po.setFromAxisAngle(e,t),this.quaternion.premultiply(po),this}rotateX(e){return this.rotateOnAxis(ug,e)}rotateY(e){return this.rotateOnAxis(dg,e)}rotateZ(e){return this.rotateOnAxis(fg,e)}translateOnAxis(e,t){return hg.copy(e).applyQuaternion(this.quaternion),this.position.add(hg.multiplyScalar(t)),this}translateX(e){return this.translateOnAxis(ug,e)}translateY(e){return this.translateOnAxis(dg,e)}translateZ(e){return this.translateOnAxis(fg,e)}localToWorld(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(this.matrixWorld)}worldToLocal(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(Es.copy(this.matrixWorld).invert())}lookAt(e,t,i){e.isVector3?pc.copy(e):pc.set(e,t,i);let s=this.parent;this.updateWorldMatrix(!0,!1),Pa.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?Es.lookAt(Pa,pc,this.up):Es.lookAt(pc,Pa,this.up),this.quaternion.setFromRotationMatrix(Es),s&&(Es.extractRotation(s.matrixWorld),po.setFromRotationMatrix(Es),this.quaternion.premultiply(po.invert()))}add(e){if(arguments.length>1){for(let t=0;t<arguments.length;t++)this.add(arguments[t]);return this}return e===this?(it("Object3D.add: object can't be added as a child of itself.",e),this):(e&&e.isObject3D?(e.removeFromParent(),e.parent=this,this.children.push(e),e.dispatchEvent(pg),mo.child=e,this.dispatchEvent(mo),mo.child=null):it("Object3D.add: object not an instance of THREE.Object3D.",e),this)}remove(e){if(arguments.length>1){for(let i=0;i<arguments.length;i++)this.remove(arguments[i]);return this}let t=this.children.indexOf(e);return t!==-1&&(e.parent=null,this.children.splice(t,1),e.dispatchEvent(CS),zd.child=e,this.dispatchEvent(zd),zd.child=null),this}removeFromParent(){let e=this.parent;return e!==null&&e.remove(this),this}clear(){return this.remove(...this.children)}attach(e){return this.updateWorldMatrix(!0,!1),Es.copy(this.matrixWorld).invert(),e.parent!==null&&(e.parent.updateWorldMatrix(!0,!1),Es.multiply(e.parent.matrixWorld)),e.applyMatrix4(Es),e.removeFromParent(),e.parent=this,this.children.push(e),e.updateWorldMatrix(!1,!0),e.dispatchEvent(pg),mo.child=e,this.dispatchEvent(mo),mo.child=null,this}getObjectById(e){return this.getObjectByProperty("id",e)}getObjectByName(e){return this.getObjectByProperty("name",e)}getObjectByProperty(e,t){if(this[e]===t)return this;for(let i=0,s=this.children.length;i<s;i++){let o=this.children[i].getObjectByProperty(e,t);if(o!==void 0)return o}}getObjectsByProperty(e,t,i=[]){this[e]===t&&i.push(this);let s=this.children;for(let r=0,o=s.length;r<o;r++)s[r].getObjectsByProperty(e,t,i);return i}getWorldPosition(e){return this.updateWorldMatrix(!0,!1),e.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Pa,e,ES),e}getWorldScale(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Pa,AS,e),e}getWorldDirection(e){this.updateWorldMatrix(!0,!1);let t=this.matrixWorld.elements;return e.set(t[8],t[9],t[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(e){e(this);let t=this.children;for(let i=0,s=t.length;i<s;i++)t[i].traverse(e)}traverseVisible(e){if(this.visible===!1)return;e(this);let t=this.children;for(let i=0,s=t.length;i<s;i++)t[i].traverseVisible(e)}traverseAncestors(e){let t=this.parent;t!==null&&(e(t),t.traverseAncestors(e))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let e=this.pivot;if(e!==null){let t=e.x,i=e.y,s=e.z,r=this.matrix.elements;r[12]+=t-r[0]*t-r[4]*i-r[8]*s,r[13]+=i-r[1]*t-r[5]*i-r[9]*s,r[14]+=s-r[2]*t-r[6]*i-r[10]*s}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(e){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||e)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,e=!0);let t=this.children;for(let i=0,s=t.length;i<s;i++)t[i].updateMatrixWorld(e)}updateWorldMatrix(e,t,i=!1){let s=this.parent;if(e===!0&&s!==null&&s.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||i)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,i=!0),t===!0){let r=this.children;for(let o=0,a=r.length;o<a;o++)r[o].updateWorldMatrix(!1,!0,i)}}toJSON(e){let t=e===void 0||typeof e=="string",i={};t&&(e={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},i.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let s={};s.uuid=this.uuid,s.type=this.type,s.name=this.name,s.castShadow=this.castShadow,s.receiveShadow=this.receiveShadow,s.visible=this.visible,s.frustumCulled=this.frustumCulled,s.renderOrder=this.renderOrder,s.static=this.static,s.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.pivot!==null&&(s.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(s.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(s.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.geometryInfo=this._geometryInfo.map(a=>({...a,boundingBox:a.boundingBox?a.boundingBox.toJSON():void 0,boundingSphere:a.boundingSphere?a.boundingSphere.toJSON():void 0})),s.instanceInfo=this._instanceInfo.map(a=>({...a})),s.availableInstanceIds=this._availableInstanceIds.slice(),s.availableGeometryIds=this._availableGeometryIds.slice(),s.nextIndexStart=this._nextIndexStart,s.nextVertexStart=this._nextVertexStart,s.geometryCount=this._geometryCount,s.maxInstanceCount=this._maxInstanceCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.matricesTexture=this._matricesTexture.toJSON(e),s.indirectTexture=this._indirectTexture.toJSON(e),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(e)),this.boundingSphere!==null&&(s.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(s.boundingBox=this.boundingBox.toJSON()));function r(a,l){return a[l.uuid]===void 0&&(a[l.uuid]=l.toJSON(e)),l.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(e).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(e).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=r(e.geometries,this.geometry);let a=this.geometry.parameters;if(a!==void 0&&a.shapes!==void 0){let l=a.shapes;if(Array.isArray(l))for(let c=0,h=l.length;c<h;c++){let u=l[c];r(e.shapes,u)}else r(e.shapes,l)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(e.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let a=[];for(let l=0,c=this.material.length;l<c;l++)a.push(r(e.materials,this.material[l]));s.material=a}else s.material=r(e.materials,this.material);if(this.children.length>0){s.children=[];for(let a=0;a<this.children.length;a++)s.children.push(this.children[a].toJSON(e).object)}if(this.animations.length>0){s.animations=[];for(let a=0;a<this.animations.length;a++){let l=this.animations[a];s.animations.push(r(e.animations,l))}}if(t){let a=o(e.geometries),l=o(e.materials),c=o(e.textures),h=o(e.images),u=o(e.shapes),d=o(e.skeletons),f=o(e.animations),g=o(e.nodes);a.length>0&&(i.geometries=a),l.length>0&&(i.materials=l),c.length>0&&(i.textures=c),h.length>0&&(i.images=h),u.length>0&&(i.shapes=u),d.length>0&&(i.skeletons=d),f.length>0&&(i.animations=f),g.length>0&&(i.nodes=g)}return i.object=s,i;function o(a){let l=[];for(let c in a){let h=a[c];delete h.metadata,l.push(h)}return l}}clone(e){return new this.constructor().copy(this,e)}copy(e,t=!0){if(this.name=e.name,this.up.copy(e.up),this.position.copy(e.position),this.rotation.order=e.rotation.order,this.quaternion.copy(e.quaternion),this.scale.copy(e.scale),this.pivot=e.pivot!==null?e.pivot.clone():null,this.matrix.copy(e.matrix),this.matrixWorld.copy(e.matrixWorld),this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrixWorldAutoUpdate=e.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=e.matrixWorldNeedsUpdate,this.layers.mask=e.layers.mask,this.visible=e.visible,this.castShadow=e.castShadow,this.receiveShadow=e.receiveShadow,this.frustumCulled=e.frustumCulled,this.renderOrder=e.renderOrder,this.static=e.static,this.animations=e.animations.slice(),this.userData=JSON.parse(JSON.stringify(e.userData)),t===!0)for(let i=0;i<e.children.length;i++){let s=e.children[i];this.add(s.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};En.DEFAULT_UP=new B(0,1,0);En.DEFAULT_MATRIX_AUTO_UPDATE=!0;En.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var Wt=class extends En{constructor(){super(),this.isGroup=!0,this.type="Group"}},RS={type:"move"},Uo=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new Wt,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new Wt,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new B,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new B),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new Wt,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new B,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new B,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(e){return this._targetRay!==null&&this._targetRay.dispatchEvent(e),this._grip!==null&&this._grip.dispatchEvent(e),this._hand!==null&&this._hand.dispatchEvent(e),this}connect(e){if(e&&e.hand){let t=this._hand;if(t)for(let i of e.hand.values())this._getHandJoint(t,i)}return this.dispatchEvent({type:"connected",data:e}),this}disconnect(e){return this.dispatchEvent({type:"disconnected",data:e}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(e,t,i){let s=null,r=null,o=null,a=this._targetRay,l=this._grip,c=this._hand;if(e&&t.session.visibilityState!=="visible-blurred"){if(c&&e.hand){o=!0;for(let v of e.hand.values()){let m=t.getJointPose(v,i),p=this._getHandJoint(c,v);m!==null&&(p.matrix.fromArray(m.transform.matrix),p.matrix.decompose(p.position,p.quaternion,p.scale),p.matrixWorldNeedsUpdate=!0,p.jointRadius=m.radius),p.visible=m!==null}let h=c.joints["index-finger-tip"],u=c.joints["thumb-tip"],d=h.position.distanceTo(u.position),f=.02,g=.005;c.inputState.pinching&&d>f+g?(c.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:e.handedness,target:this})):!c.inputState.pinching&&d<=f-g&&(c.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:e.handedness,target:this}))}else l!==null&&e.gripSpace&&(r=t.getPose(e.gripSpace,i),r!==null&&(l.matrix.fromArray(r.transform.matrix),l.matrix.decompose(l.position,l.quaternion,l.scale),l.matrixWorldNeedsUpdate=!0,r.linearVelocity?(l.hasLinearVelocity=!0,l.linearVelocity.copy(r.linearVelocity)):l.hasLinearVelocity=!1,r.angularVelocity?(l.hasAngularVelocity=!0,l.angularVelocity.copy(r.angularVelocity)):l.hasAngularVelocity=!1,l.eventsEnabled&&l.dispatchEvent({type:"gripUpdated",data:e,target:this})));a!==null&&(s=t.getPose(e.targetRaySpace,i),s===null&&r!==null&&(s=r),s!==null&&(a.matrix.fromArray(s.transform.matrix),a.matrix.decompose(a.position,a.quaternion,a.scale),a.matrixWorldNeedsUpdate=!0,s.linearVelocity?(a.hasLinearVelocity=!0,a.linearVelocity.copy(s.linearVelocity)):a.hasLinearVelocity=!1,s.angularVelocity?(a.hasAngularVelocity=!0,a.angularVelocity.copy(s.angularVelocity)):a.hasAngularVelocity=!1,this.dispatchEvent(RS)))}return a!==null&&(a.visible=s!==null),l!==null&&(l.visible=r!==null),c!==null&&(c.visible=o!==null),this}_getHandJoint(e,t){if(e.joints[t.jointName]===void 0){let i=new Wt;i.matrixAutoUpdate=!1,i.visible=!1,e.joints[t.jointName]=i,e.add(i)}return e.joints[t.jointName]}},x0={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},er={h:0,s:0,l:0},mc={h:0,s:0,l:0};function Vd(n,e,t){return t<0&&(t+=1),t>1&&(t-=1),t<1/6?n+(e-n)*6*t:t<1/2?e:t<2/3?n+(e-n)*6*(2/3-t):n}var je=class{constructor(e,t,i){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(e,t,i)}set(e,t,i){if(t===void 0&&i===void 0){let s=e;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(e,t,i);return this}setScalar(e){return this.r=e,this.g=e,this.b=e,this}setHex(e,t=vi){return e=Math.floor(e),this.r=(e>>16&255)/255,this.g=(e>>8&255)/255,this.b=(e&255)/255,bt.colorSpaceToWorking(this,t),this}setRGB(e,t,i,s=bt.workingColorSpace){return this.r=e,this.g=t,this.b=i,bt.colorSpaceToWorking(this,s),this}setHSL(e,t,i,s=bt.workingColorSpace){if(e=kf(e,1),t=xt(t,0,1),i=xt(i,0,1),t===0)this.r=this.g=this.b=i;else{let r=i<=.5?i*(1+t):i+t-i*t,o=2*i-r;this.r=Vd(o,r,e+1/3),this.g=Vd(o,r,e),this.b=Vd(o,r,e-1/3)}return bt.colorSpaceToWorking(this,s),this}setStyle(e,t=vi){function i(r){r!==void 0&&parseFloat(r)<1&&Ke("Color: Alpha component of "+e+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(e)){let r,o=s[1],a=s[2];switch(o){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,t);if(r=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setRGB(Math.min(100,parseFloat(r[1]))/100,Math.min(100,parseFloat(r[2]))/100,Math.min(100,parseFloat(r[3]))/100,t);break;case"hsl":case"hsla":if(r=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,t);break;default:Ke("Color: Unknown color model "+e)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(e)){let r=s[1],o=r.length;if(o===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,t);if(o===6)return this.setHex(parseInt(r,16),t);Ke("Color: Invalid hex color "+e)}else if(e&&e.length>0)return this.setColorName(e,t);return this}setColorName(e,t=vi){let i=x0[e.toLowerCase()];return i!==void 0?this.setHex(i,t):Ke("Color: Unknown color "+e),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(e){return this.r=e.r,this.g=e.g,this.b=e.b,this}copySRGBToLinear(e){return this.r=Ds(e.r),this.g=Ds(e.g),this.b=Ds(e.b),this}copyLinearToSRGB(e){return this.r=Ro(e.r),this.g=Ro(e.g),this.b=Ro(e.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(e=vi){return bt.workingToColorSpace(Yn.copy(this),e),Math.round(xt(Yn.r*255,0,255))*65536+Math.round(xt(Yn.g*255,0,255))*256+Math.round(xt(Yn.b*255,0,255))}getHexString(e=vi){return("000000"+this.getHex(e).toString(16)).slice(-6)}getHSL(e,t=bt.workingColorSpace){bt.workingToColorSpace(Yn.copy(this),t);let i=Yn.r,s=Yn.g,r=Yn.b,o=Math.max(i,s,r),a=Math.min(i,s,r),l,c,h=(a+o)/2;if(a===o)l=0,c=0;else{let u=o-a;switch(c=h<=.5?u/(o+a):u/(2-o-a),o){case i:l=(s-r)/u+(s<r?6:0);break;case s:l=(r-i)/u+2;break;case r:l=(i-s)/u+4;break}l/=6}return e.h=l,e.s=c,e.l=h,e}getRGB(e,t=bt.workingColorSpace){return bt.workingToColorSpace(Yn.copy(this),t),e.r=Yn.r,e.g=Yn.g,e.b=Yn.b,e}getStyle(e=vi){bt.workingToColorSpace(Yn.copy(this),e);let t=Yn.r,i=Yn.g,s=Yn.b;return e!==vi?`color(${e} ${t.toFixed(3)} ${i.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(t*255)},${Math.round(i*255)},${Math.round(s*255)})`}offsetHSL(e,t,i){return this.getHSL(er),this.setHSL(er.h+e,er.s+t,er.l+i)}add(e){return this.r+=e.r,this.g+=e.g,this.b+=e.b,this}addColors(e,t){return this.r=e.r+t.r,this.g=e.g+t.g,this.b=e.b+t.b,this}addScalar(e){return this.r+=e,this.g+=e,this.b+=e,this}sub(e){return this.r=Math.max(0,this.r-e.r),this.g=Math.max(0,this.g-e.g),this.b=Math.max(0,this.b-e.b),this}multiply(e){return this.r*=e.r,this.g*=e.g,this.b*=e.b,this}multiplyScalar(e){return this.r*=e,this.g*=e,this.b*=e,this}lerp(e,t){return this.r+=(e.r-this.r)*t,this.g+=(e.g-this.g)*t,this.b+=(e.b-this.b)*t,this}lerpColors(e,t,i){return this.r=e.r+(t.r-e.r)*i,this.g=e.g+(t.g-e.g)*i,this.b=e.b+(t.b-e.b)*i,this}lerpHSL(e,t){this.getHSL(er),e.getHSL(mc);let i=za(er.h,mc.h,t),s=za(er.s,mc.s,t),r=za(er.l,mc.l,t);return this.setHSL(i,s,r),this}setFromVector3(e){return this.r=e.x,this.g=e.y,this.b=e.z,this}applyMatrix3(e){let t=this.r,i=this.g,s=this.b,r=e.elements;return this.r=r[0]*t+r[3]*i+r[6]*s,this.g=r[1]*t+r[4]*i+r[7]*s,this.b=r[2]*t+r[5]*i+r[8]*s,this}equals(e){return e.r===this.r&&e.g===this.g&&e.b===this.b}fromArray(e,t=0){return this.r=e[t],this.g=e[t+1],this.b=e[t+2],this}toArray(e=[],t=0){return e[t]=this.r,e[t+1]=this.g,e[t+2]=this.b,e}fromBufferAttribute(e,t){return this.r=e.getX(t),this.g=e.getY(t),this.b=e.getZ(t),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},Yn=new je;je.NAMES=x0;var $a=class extends En{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new Ns,this.environmentIntensity=1,this.environmentRotation=new Ns,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(e,t){return super.copy(e,t),this.background=e.background!==null?e.background.clone():null,this.environment=e.environment!==null?e.environment.clone():null,this.fog=e.fog!==null?e.fog.clone():null,this.backgroundBlurriness=e.backgroundBlurriness,this.backgroundIntensity=e.backgroundIntensity,this.backgroundRotation.copy(e.backgroundRotation),this.environmentIntensity=e.environmentIntensity,this.environmentRotation.copy(e.environmentRotation),this.overrideMaterial=e.overrideMaterial!==null?e.overrideMaterial.clone():null,this.matrixAutoUpdate=e.matrixAutoUpdate,this}toJSON(e){let t=super.toJSON(e);return this.fog!==null&&(t.object.fog=this.fog.toJSON()),t.object.backgroundBlurriness=this.backgroundBlurriness,t.object.backgroundIntensity=this.backgroundIntensity,t.object.backgroundRotation=this.backgroundRotation.toArray(),t.object.environmentIntensity=this.environmentIntensity,t.object.environmentRotation=this.environmentRotation.toArray(),t}},zi=new B,As=new B,Gd=new B,Cs=new B,go=new B,_o=new B,mg=new B,Hd=new B,Wd=new B,Xd=new B,qd=new tn,Yd=new tn,$d=new tn,Is=class n{constructor(e=new B,t=new B,i=new B){this.a=e,this.b=t,this.c=i}static getNormal(e,t,i,s){s.subVectors(i,t),zi.subVectors(e,t),s.cross(zi);let r=s.lengthSq();return r>0?s.multiplyScalar(1/Math.sqrt(r)):s.set(0,0,0)}static getBarycoord(e,t,i,s,r){zi.subVectors(s,t),As.subVectors(i,t),Gd.subVectors(e,t);let o=zi.dot(zi),a=zi.dot(As),l=zi.dot(Gd),c=As.dot(As),h=As.dot(Gd),u=o*c-a*a;if(u===0)return r.set(0,0,0),null;let d=1/u,f=(c*l-a*h)*d,g=(o*h-a*l)*d;return r.set(1-f-g,g,f)}static containsPoint(e,t,i,s){return this.getBarycoord(e,t,i,s,Cs)===null?!1:Cs.x>=0&&Cs.y>=0&&Cs.x+Cs.y<=1}static getInterpolation(e,t,i,s,r,o,a,l){return this.getBarycoord(e,t,i,s,Cs)===null?(l.x=0,l.y=0,"z"in l&&(l.z=0),"w"in l&&(l.w=0),null):(l.setScalar(0),l.addScaledVector(r,Cs.x),l.addScaledVector(o,Cs.y),l.addScaledVector(a,Cs.z),l)}static getInterpolatedAttribute(e,t,i,s,r,o){return qd.setScalar(0),Yd.setScalar(0),$d.setScalar(0),qd.fromBufferAttribute(e,t),Yd.fromBufferAttribute(e,i),$d.fromBufferAttribute(e,s),o.setScalar(0),o.addScaledVector(qd,r.x),o.addScaledVector(Yd,r.y),o.addScaledVector($d,r.z),o}static isFrontFacing(e,t,i,s){return zi.subVectors(i,t),As.subVectors(e,t),zi.cross(As).dot(s)<0}set(e,t,i){return this.a.copy(e),this.b.copy(t),this.c.copy(i),this}setFromPointsAndIndices(e,t,i,s){return this.a.copy(e[t]),this.b.copy(e[i]),this.c.copy(e[s]),this}setFromAttributeAndIndices(e,t,i,s){return this.a.fromBufferAttribute(e,t),this.b.fromBufferAttribute(e,i),this.c.fromBufferAttribute(e,s),this}clone(){return new this.constructor().copy(this)}copy(e){return this.a.copy(e.a),this.b.copy(e.b),this.c.copy(e.c),this}getArea(){return zi.subVectors(this.c,this.b),As.subVectors(this.a,this.b),zi.cross(As).length()*.5}getMidpoint(e){return e.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(e){return n.getNormal(this.a,this.b,this.c,e)}getPlane(e){return e.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(e,t){return n.getBarycoord(e,this.a,this.b,this.c,t)}getInterpolation(e,t,i,s,r){return n.getInterpolation(e,this.a,this.b,this.c,t,i,s,r)}containsPoint(e){return n.containsPoint(e,this.a,this.b,this.c)}isFrontFacing(e){return n.isFrontFacing(this.a,this.b,this.c,e)}intersectsBox(e){return e.intersectsTriangle(this)}closestPointToPoint(e,t){let i=this.a,s=this.b,r=this.c,o,a;go.subVectors(s,i),_o.subVectors(r,i),Hd.subVectors(e,i);let l=go.dot(Hd),c=_o.dot(Hd);if(l<=0&&c<=0)return t.copy(i);Wd.subVectors(e,s);let h=go.dot(Wd),u=_o.dot(Wd);if(h>=0&&u<=h)return t.copy(s);let d=l*u-h*c;if(d<=0&&l>=0&&h<=0&&l-h>0)return o=l/(l-h),t.copy(i).addScaledVector(go,o);Xd.subVectors(e,r);let f=go.dot(Xd),g=_o.dot(Xd);if(g>=0&&f<=g)return t.copy(r);let v=f*c-l*g;if(v<=0&&c>=0&&g<=0)return a=c/(c-g),t.copy(i).addScaledVector(_o,a);let m=h*g-f*u;if(m<=0&&u-h>=0&&f-g>=0)return mg.subVectors(r,s),a=(u-h)/(u-h+(f-g)),t.copy(s).addScaledVector(mg,a);let p=1/(m+v+d);return o=v*p,a=d*p,t.copy(i).addScaledVector(go,o).addScaledVector(_o,a)}equals(e){return e.a.equals(this.a)&&e.b.equals(this.b)&&e.c.equals(this.c)}},Hi=class{constructor(e=new B(1/0,1/0,1/0),t=new B(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=e,this.max=t}set(e,t){return this.min.copy(e),this.max.copy(t),this}setFromArray(e){this.makeEmpty();for(let t=0,i=e.length;t<i;t+=3)this.expandByPoint(Vi.fromArray(e,t));return this}setFromBufferAttribute(e){this.makeEmpty();for(let t=0,i=e.count;t<i;t++)this.expandByPoint(Vi.fromBufferAttribute(e,t));return this}setFromPoints(e){this.makeEmpty();for(let t=0,i=e.length;t<i;t++)this.expandByPoint(e[t]);return this}setFromCenterAndSize(e,t){let i=Vi.copy(t).multiplyScalar(.5);return this.min.copy(e).sub(i),this.max.copy(e).add(i),this}setFromObject(e,t=!1){return this.makeEmpty(),this.expandByObject(e,t)}clone(){return new this.constructor().copy(this)}copy(e){return this.min.copy(e.min),this.max.copy(e.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(e){return this.isEmpty()?e.set(0,0,0):e.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(e){return this.isEmpty()?e.set(0,0,0):e.subVectors(this.max,this.min)}expandByPoint(e){return this.min.min(e),this.max.max(e),this}expandByVector(e){return this.min.sub(e),this.max.add(e),this}expandByScalar(e){return this.min.addScalar(-e),this.max.addScalar(e),this}expandByObject(e,t=!1){e.updateWorldMatrix(!1,!1);let i=e.geometry;if(i!==void 0){let r=i.getAttribute("position");if(t===!0&&r!==void 0&&e.isInstancedMesh!==!0&&e.isBatchedMesh!==!0)for(let o=0,a=r.count;o<a;o++)e.isMesh===!0?e.getVertexPosition(o,Vi):Vi.fromBufferAttribute(r,o),Vi.applyMatrix4(e.matrixWorld),this.expandByPoint(Vi);else e.boundingBox!==void 0?(e.boundingBox===null&&e.computeBoundingBox(),gc.copy(e.boundingBox)):(i.boundingBox===null&&i.computeBoundingBox(),gc.copy(i.boundingBox)),gc.applyMatrix4(e.matrixWorld),this.union(gc)}let s=e.children;for(let r=0,o=s.length;r<o;r++)this.expandByObject(s[r],t);return this}containsPoint(e){return e.x>=this.min.x&&e.x<=this.max.x&&e.y>=this.min.y&&e.y<=this.max.y&&e.z>=this.min.z&&e.z<=this.max.z}containsBox(e){return this.min.x<=e.min.x&&e.max.x<=this.max.x&&this.min.y<=e.min.y&&e.max.y<=this.max.y&&this.min.z<=e.min.z&&e.max.z<=this.max.z}getParameter(e,t){return t.set((e.x-this.min.x)/(this.max.x-this.min.x),(e.y-this.min.y)/(this.max.y-this.min.y),(e.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(e){return e.max.x>=this.min.x&&e.min.x<=this.max.x&&e.max.y>=this.min.y&&e.min.y<=this.max.y&&e.max.z>=this.min.z&&e.min.z<=this.max.z}intersectsSphere(e){return this.clampPoint(e.center,Vi),Vi.distanceToSquared(e.center)<=e.radius*e.radius}intersectsPlane(e){let t,i;return e.normal.x>0?(t=e.normal.x*this.min.x,i=e.normal.x*this.max.x):(t=e.normal.x*this.max.x,i=e.normal.x*this.min.x),e.normal.y>0?(t+=e.normal.y*this.min.y,i+=e.normal.y*this.max.y):(t+=e.normal.y*this.max.y,i+=e.normal.y*this.min.y),e.normal.z>0?(t+=e.normal.z*this.min.z,i+=e.normal.z*this.max.z):(t+=e.normal.z*this.max.z,i+=e.normal.z*this.min.z),t<=-e.constant&&i>=-e.constant}intersectsTriangle(e){if(this.isEmpty())return!1;this.getCenter(Ia),_c.subVectors(this.max,Ia),xo.subVectors(e.a,Ia),yo.subVectors(e.b,Ia),vo.subVectors(e.c,Ia),tr.subVectors(yo,xo),nr.subVectors(vo,yo),Ir.subVectors(xo,vo);let t=[0,-tr.z,tr.y,0,-nr.z,nr.y,0,-Ir.z,Ir.y,tr.z,0,-tr.x,nr.z,0,-nr.x,Ir.z,0,-Ir.x,-tr.y,tr.x,0,-nr.y,nr.x,0,-Ir.y,Ir.x,0];return!Zd(t,xo,yo,vo,_c)||(t=[1,0,0,0,1,0,0,0,1],!Zd(t,xo,yo,vo,_c))?!1:(xc.crossVectors(tr,nr),t=[xc.x,xc.y,xc.z],Zd(t,xo,yo,vo,_c))}clampPoint(e,t){return t.copy(e).clamp(this.min,this.max)}distanceToPoint(e){return this.clampPoint(e,Vi).distanceTo(e)}getBoundingSphere(e){return this.isEmpty()?e.makeEmpty():(this.getCenter(e.center),e.radius=this.getSize(Vi).length()*.5),e}intersect(e){return this.min.max(e.min),this.max.min(e.max),this.isEmpty()&&this.makeEmpty(),this}union(e){return this.min.min(e.min),this.max.max(e.max),this}applyMatrix4(e){return this.isEmpty()?this:(Rs[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(e),Rs[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(e),Rs[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(e),Rs[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(e),Rs[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(e),Rs[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(e),Rs[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(e),Rs[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(e),this.setFromPoints(Rs),this)}translate(e){return this.min.add(e),this.max.add(e),this}equals(e){return e.min.equals(this.min)&&e.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(e){return this.min.fromArray(e.min),this.max.fromArray(e.max),this}},Rs=[new B,new B,new B,new B,new B,new B,new B,new B],Vi=new B,gc=new Hi,xo=new B,yo=new B,vo=new B,tr=new B,nr=new B,Ir=new B,Ia=new B,_c=new B,xc=new B,Dr=new B;function Zd(n,e,t,i,s){for(let r=0,o=n.length-3;r<=o;r+=3){Dr.fromArray(n,r);let a=s.x*Math.abs(Dr.x)+s.y*Math.abs(Dr.y)+s.z*Math.abs(Dr.z),l=e.dot(Dr),c=t.dot(Dr),h=i.dot(Dr);if(Math.max(-Math.max(l,c,h),Math.min(l,c,h))>a)return!1}return!0}var Sn=new B,yc=new $e,PS=0,hn=class extends Gi{constructor(e,t,i=!1){if(super(),Array.isArray(e))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:PS++}),this.name="",this.array=e,this.itemSize=t,this.count=e!==void 0?e.length/t:0,this.normalized=i,this.usage=Of,this.updateRanges=[],this.gpuType=Yi,this.version=0,this._normalizationScale=e!==void 0?lu(e):void 0}onUploadCallback(){}set needsUpdate(e){e===!0&&this.version++}setUsage(e){return this.usage=e,this}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}copy(e){return this.name=e.name,this.array=new e.array.constructor(e.array),this.itemSize=e.itemSize,this.count=e.count,this.normalized=e.normalized,this.usage=e.usage,this.gpuType=e.gpuType,this._normalizationScale=e._normalizationScale,this}copyAt(e,t,i){e*=this.itemSize,i*=t.itemSize;for(let s=0,r=this.itemSize;s<r;s++)this.array[e+s]=t.array[i+s];return this}copyArray(e){return this.array.set(e),this}applyMatrix3(e){if(this.itemSize===2)for(let t=0,i=this.count;t<i;t++)yc.fromBufferAttribute(this,t),yc.applyMatrix3(e),this.setXY(t,yc.x,yc.y);else if(this.itemSize===3)for(let t=0,i=this.count;t<i;t++)Sn.fromBufferAttribute(this,t),Sn.applyMatrix3(e),this.setXYZ(t,Sn.x,Sn.y,Sn.z);return this}applyMatrix4(e){for(let t=0,i=this.count;t<i;t++)Sn.fromBufferAttribute(this,t),Sn.applyMatrix4(e),this.setXYZ(t,Sn.x,Sn.y,Sn.z);return this}applyNormalMatrix(e){for(let t=0,i=this.count;t<i;t++)Sn.fromBufferAttribute(this,t),Sn.applyNormalMatrix(e),this.setXYZ(t,Sn.x,Sn.y,Sn.z);return this}transformDirection(e){for(let t=0,i=this.count;t<i;t++)Sn.fromBufferAttribute(this,t),Sn.transformDirection(e),this.setXYZ(t,Sn.x,Sn.y,Sn.z);return this}set(e,t=0){return this.array.set(e,t),this}getComponent(e,t){let i=this.array[e*this.itemSize+t];return this.normalized&&(i=this._denormalize(i)),i}setComponent(e,t,i){return this.normalized&&(i=this._normalize(i)),this.array[e*this.itemSize+t]=i,this}getX(e){let t=this.array[e*this.itemSize];return this.normalized&&(t=this._denormalize(t)),t}setX(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize]=t,this}getY(e){let t=this.array[e*this.itemSize+1];return this.normalized&&(t=this._denormalize(t)),t}setY(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+1]=t,this}getZ(e){let t=this.array[e*this.itemSize+2];return this.normalized&&(t=this._denormalize(t)),t}setZ(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+2]=t,this}getW(e){let t=this.array[e*this.itemSize+3];return this.normalized&&(t=this._denormalize(t)),t}setW(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+3]=t,this}setXY(e,t,i){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),i=this._normalize(i)),this.array[e+0]=t,this.array[e+1]=i,this}setXYZ(e,t,i,s){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),i=this._normalize(i),s=this._normalize(s)),this.array[e+0]=t,this.array[e+1]=i,this.array[e+2]=s,this}setXYZW(e,t,i,s,r){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),i=this._normalize(i),s=this._normalize(s),r=this._normalize(r)),this.array[e+0]=t,this.array[e+1]=i,this.array[e+2]=s,this.array[e+3]=r,this}onUpload(e){return this.onUploadCallback=e,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let e={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return e.name=this.name,e.usage=this.usage,e.gpuType=this.gpuType,e}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(e){let t=this._normalizationScale;return t!==void 0?Math.max(e/t,-1):Vf(e,this.array)}_normalize(e){let t=this._normalizationScale;return t!==void 0?Math.round(e*t):Gf(e,this.array)}};var Za=class extends hn{constructor(e,t,i){super(new Uint16Array(e),t,i)}};var Ka=class extends hn{constructor(e,t,i){super(new Uint32Array(e),t,i)}};var un=class extends hn{constructor(e,t,i){super(new Float32Array(e),t,i)}},IS=new Hi,Da=new B,Kd=new B,sr=class{constructor(e=new B,t=-1){this.isSphere=!0,this.center=e,this.radius=t}set(e,t){return this.center.copy(e),this.radius=t,this}setFromPoints(e,t){let i=this.center;t!==void 0?i.copy(t):IS.setFromPoints(e).getCenter(i);let s=0;for(let r=0,o=e.length;r<o;r++)s=Math.max(s,i.distanceToSquared(e[r]));return this.radius=Math.sqrt(s),this}copy(e){return this.center.copy(e.center),this.radius=e.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(e){return e.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(e){return e.distanceTo(this.center)-this.radius}intersectsSphere(e){let t=this.radius+e.radius;return e.center.distanceToSquared(this.center)<=t*t}intersectsBox(e){return e.intersectsSphere(this)}intersectsPlane(e){return Math.abs(e.distanceToPoint(this.center))<=this.radius}clampPoint(e,t){let i=this.center.distanceToSquared(e);return t.copy(e),i>this.radius*this.radius&&(t.sub(this.center).normalize(),t.multiplyScalar(this.radius).add(this.center)),t}getBoundingBox(e){return this.isEmpty()?(e.makeEmpty(),e):(e.set(this.center,this.center),e.expandByScalar(this.radius),e)}applyMatrix4(e){return this.center.applyMatrix4(e),this.radius=this.radius*e.getMaxScaleOnAxis(),this}translate(e){return this.center.add(e),this}expandByPoint(e){if(this.isEmpty())return this.center.copy(e),this.radius=0,this;Da.subVectors(e,this.center);let t=Da.lengthSq();if(t>this.radius*this.radius){let i=Math.sqrt(t),s=(i-this.radius)*.5;this.center.addScaledVector(Da,s/i),this.radius+=s}return this}union(e){return e.isEmpty()?this:this.isEmpty()?(this.copy(e),this):(this.center.equals(e.center)===!0?this.radius=Math.max(this.radius,e.radius):(Kd.subVectors(e.center,this.center).setLength(e.radius),this.expandByPoint(Da.copy(e.center).add(Kd)),this.expandByPoint(Da.copy(e.center).sub(Kd))),this)}equals(e){return e.center.equals(this.center)&&e.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(e){return this.radius=e.radius,this.center.fromArray(e.center),this}},DS=0,Ii=new Pt,Jd=new En,So=new B,yi=new Hi,La=new Hi,kn=new B,Xt=class n extends Gi{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:DS++}),this.uuid=gr(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(e){return Array.isArray(e)?this.index=new(iS(e)?Ka:Za)(e,1):this.index=e,this}setIndirect(e,t=0){return this.indirect=e,this.indirectOffset=t,this}getIndirect(){return this.indirect}getAttribute(e){return this.attributes[e]}setAttribute(e,t){return this.attributes[e]=t,this}deleteAttribute(e){return delete this.attributes[e],this}hasAttribute(e){return this.attributes[e]!==void 0}addGroup(e,t,i=0){this.groups.push({start:e,count:t,materialIndex:i})}clearGroups(){this.groups=[]}setDrawRange(e,t){this.drawRange.start=e,this.drawRange.count=t}applyMatrix4(e){let t=this.attributes.position;t!==void 0&&(t.applyMatrix4(e),t.needsUpdate=!0);let i=this.attributes.normal;if(i!==void 0){let r=new st().getNormalMatrix(e);i.applyNormalMatrix(r),i.needsUpdate=!0}let s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(e),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(e){return Ii.makeRotationFromQuaternion(e),this.applyMatrix4(Ii),this}rotateX(e){return Ii.makeRotationX(e),this.applyMatrix4(Ii),this}rotateY(e){return Ii.makeRotationY(e),this.applyMatrix4(Ii),this}rotateZ(e){return Ii.makeRotationZ(e),this.applyMatrix4(Ii),this}translate(e,t,i){return Ii.makeTranslation(e,t,i),this.applyMatrix4(Ii),this}scale(e,t,i){return Ii.makeScale(e,t,i),this.applyMatrix4(Ii),this}lookAt(e){return Jd.lookAt(e),Jd.updateMatrix(),this.applyMatrix4(Jd.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(So).negate(),this.translate(So.x,So.y,So.z),this}setFromPoints(e){let t=this.getAttribute("position");if(t===void 0){let i=[];for(let s=0,r=e.length;s<r;s++){let o=e[s];i.push(o.x,o.y,o.z||0)}this.setAttribute("position",new un(i,3))}else{let i=Math.min(e.length,t.count);for(let s=0;s<i;s++){let r=e[s];t.setXYZ(s,r.x,r.y,r.z||0)}e.length>t.count&&Ke("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),t.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new Hi);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){it("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new B(-1/0,-1/0,-1/0),new B(1/0,1/0,1/0));return}if(e!==void 0){if(this.boundingBox.setFromBufferAttribute(e),t)for(let i=0,s=t.length;i<s;i++){let r=t[i];yi.setFromBufferAttribute(r),this.morphTargetsRelative?(kn.addVectors(this.boundingBox.min,yi.min),this.boundingBox.expandByPoint(kn),kn.addVectors(this.boundingBox.max,yi.max),this.boundingBox.expandByPoint(kn)):(this.boundingBox.expandByPoint(yi.min),this.boundingBox.expandByPoint(yi.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&it('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new sr);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){it("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new B,1/0);return}if(e){let i=this.boundingSphere.center;if(yi.setFromBufferAttribute(e),t)for(let r=0,o=t.length;r<o;r++){let a=t[r];La.setFromBufferAttribute(a),this.morphTargetsRelative?(kn.addVectors(yi.min,La.min),yi.expandByPoint(kn),kn.addVectors(yi.max,La.max),yi.expandByPoint(kn)):(yi.expandByPoint(La.min),yi.expandByPoint(La.max))}yi.getCenter(i);let s=0;for(let r=0,o=e.count;r<o;r++)kn.fromBufferAttribute(e,r),s=Math.max(s,i.distanceToSquared(kn));if(t)for(let r=0,o=t.length;r<o;r++){let a=t[r],l=this.morphTargetsRelative;for(let c=0,h=a.count;c<h;c++)kn.fromBufferAttribute(a,c),l&&(So.fromBufferAttribute(e,c),kn.add(So)),s=Math.max(s,i.distanceToSquared(kn))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&it('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let e=this.index,t=this.attributes;if(e===null||t.position===void 0||t.normal===void 0||t.uv===void 0){it("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let i=t.position,s=t.normal,r=t.uv,o=this.getAttribute("tangent");(o===void 0||o.count!==i.count)&&(o=new hn(new Float32Array(4*i.count),4),this.setAttribute("tangent",o));let a=[],l=[],c=new Uint8Array(i.count);for(let k=0;k<i.count;k++)a[k]=new B,l[k]=new B;let h=new B,u=new B,d=new B,f=new $e,g=new $e,v=new $e,m=new B,p=new B;function y(k,N,L){c[k]=c[N]=c[L]=1,h.fromBufferAttribute(i,k),u.fromBufferAttribute(i,N),d.fromBufferAttribute(i,L),f.fromBufferAttribute(r,k),g.fromBufferAttribute(r,N),v.fromBufferAttribute(r,L),u.sub(h),d.sub(h),g.sub(f),v.sub(f);let z=1/(g.x*v.y-v.x*g.y);isFinite(z)&&(m.copy(u).multiplyScalar(v.y).addScaledVector(d,-g.y).multiplyScalar(z),p.copy(d).multiplyScalar(g.x).addScaledVector(u,-v.x).multiplyScalar(z),a[k].add(m),a[N].add(m),a[L].add(m),l[k].add(p),l[N].add(p),l[L].add(p))}let C=this.groups;C.length===0&&(C=[{start:0,count:e.count}]);for(let k=0,N=C.length;k<N;++k){let L=C[k],z=L.start,W=L.count;for(let D=z,X=z+W;D<X;D+=3)y(e.getX(D+0),e.getX(D+1),e.getX(D+2))}let w=new B,P=new B,E=new B,x=new B;function T(k){E.fromBufferAttribute(s,k),x.copy(E);let N=a[k];w.copy(N),w.sub(E.multiplyScalar(E.dot(N))).normalize(),P.crossVectors(x,N);let z=P.dot(l[k])<0?-1:1;o.setXYZW(k,w.x,w.y,w.z,z)}for(let k=0,N=i.count;k<N;++k)c[k]&&T(k);this._transformed=!0}computeVertexNormals(){let e=this.index,t=this.getAttribute("position");if(t!==void 0){let i=this.getAttribute("normal");if(i===void 0||i.count!==t.count)i=new hn(new Float32Array(t.count*3),3),this.setAttribute("normal",i);else for(let d=0,f=i.count;d<f;d++)i.setXYZ(d,0,0,0);let s=new B,r=new B,o=new B,a=new B,l=new B,c=new B,h=new B,u=new B;if(e)for(let d=0,f=e.count;d<f;d+=3){let g=e.getX(d+0),v=e.getX(d+1),m=e.getX(d+2);s.fromBufferAttribute(t,g),r.fromBufferAttribute(t,v),o.fromBufferAttribute(t,m),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),a.fromBufferAttribute(i,g),l.fromBufferAttribute(i,v),c.fromBufferAttribute(i,m),a.add(h),l.add(h),c.add(h),i.setXYZ(g,a.x,a.y,a.z),i.setXYZ(v,l.x,l.y,l.z),i.setXYZ(m,c.x,c.y,c.z)}else for(let d=0,f=t.count;d<f;d+=3)s.fromBufferAttribute(t,d+0),r.fromBufferAttribute(t,d+1),o.fromBufferAttribute(t,d+2),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),i.setXYZ(d+0,h.x,h.y,h.z),i.setXYZ(d+1,h.x,h.y,h.z),i.setXYZ(d+2,h.x,h.y,h.z);this.normalizeNormals(),i.needsUpdate=!0}}normalizeNormals(){let e=this.attributes.normal;for(let t=0,i=e.count;t<i;t++)kn.fromBufferAttribute(e,t),kn.normalize(),e.setXYZ(t,kn.x,kn.y,kn.z)}toNonIndexed(){function e(a,l){let c=a.array,h=a.itemSize,u=a.normalized,d=new c.constructor(l.length*h),f=0,g=0;for(let v=0,m=l.length;v<m;v++){a.isInterleavedBufferAttribute?f=l[v]*a.data.stride+a.offset:f=l[v]*h;for(let p=0;p<h;p++)d[g++]=c[f++]}return new hn(d,h,u)}if(this.index===null)return Ke("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let t=new n,i=this.index.array,s=this.attributes;for(let a in s){let l=s[a],c=e(l,i);t.setAttribute(a,c)}let r=this.morphAttributes;for(let a in r){let l=[],c=r[a];for(let h=0,u=c.length;h<u;h++){let d=c[h],f=e(d,i);l.push(f)}t.morphAttributes[a]=l}t.morphTargetsRelative=this.morphTargetsRelative;let o=this.groups;for(let a=0,l=o.length;a<l;a++){let c=o[a];t.addGroup(c.start,c.count,c.materialIndex)}return t}toJSON(){let e={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(e.uuid=this.uuid,e.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,e.name=this.name,Object.keys(this.userData).length>0&&(e.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let l=this.parameters;for(let c in l)l[c]!==void 0&&(e[c]=l[c]);return e}e.data={attributes:{}};let t=this.index;t!==null&&(e.data.index={type:t.array.constructor.name,array:Array.prototype.slice.call(t.array)});let i=this.attributes;for(let l in i){let c=i[l];e.data.attributes[l]=c.toJSON(e.data)}let s={},r=!1;for(let l in this.morphAttributes){let c=this.morphAttributes[l],h=[];for(let u=0,d=c.length;u<d;u++){let f=c[u];h.push(f.toJSON(e.data))}h.length>0&&(s[l]=h,r=!0)}r&&(e.data.morphAttributes=s,e.data.morphTargetsRelative=this.morphTargetsRelative);let o=this.groups;o.length>0&&(e.data.groups=JSON.parse(JSON.stringify(o)));let a=this.boundingSphere;return a!==null&&(e.data.boundingSphere=a.toJSON()),e}clone(){return new this.constructor().copy(this)}copy(e){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let t={};this.name=e.name;let i=e.index;i!==null&&this.setIndex(i.clone());let s=e.attributes;for(let c in s){let h=s[c];this.setAttribute(c,h.clone(t))}let r=e.morphAttributes;for(let c in r){let h=[],u=r[c];for(let d=0,f=u.length;d<f;d++)h.push(u[d].clone(t));this.morphAttributes[c]=h}this.morphTargetsRelative=e.morphTargetsRelative;let o=e.groups;for(let c=0,h=o.length;c<h;c++){let u=o[c];this.addGroup(u.start,u.count,u.materialIndex)}let a=e.boundingBox;a!==null&&(this.boundingBox=a.clone());let l=e.boundingSphere;return l!==null&&(this.boundingSphere=l.clone()),this.drawRange.start=e.drawRange.start,this.drawRange.count=e.drawRange.count,this.userData=e.userData,this._transformed=e._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}},th=class{constructor(e,t){this.isInterleavedBuffer=!0,this.array=e,this.stride=t,this.count=e!==void 0?e.length/t:0,this.usage=Of,this.updateRanges=[],this.version=0,this.uuid=gr()}onUploadCallback(){}set needsUpdate(e){e===!0&&this.version++}setUsage(e){return this.usage=e,this}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}copy(e){return this.array=new e.array.constructor(e.array),this.count=e.count,this.stride=e.stride,this.usage=e.usage,this}copyAt(e,t,i){e*=this.stride,i*=t.stride;for(let s=0,r=this.stride;s<r;s++)this.array[e+s]=t.array[i+s];return this}set(e,t=0){return this.array.set(e,t),this}clone(e){e.arrayBuffers===void 0&&(e.arrayBuffers={});let t=gg(this.array);e.arrayBuffers[t]===void 0&&(e.arrayBuffers[t]=this.array.slice(0).buffer);let i=new this.array.constructor(e.arrayBuffers[t]),s=new this.constructor(i,this.stride);return s.setUsage(this.usage),s}onUpload(e){return this.onUploadCallback=e,this}toJSON(e){e.arrayBuffers===void 0&&(e.arrayBuffers={});let t=gg(this.array);e.arrayBuffers[t]===void 0&&(e.arrayBuffers[t]=Array.from(new Uint32Array(this.array.slice(0).buffer)));let i={uuid:this.uuid,buffer:t,type:this.array.constructor.name,stride:this.stride};return i.usage=this.usage,i}};function gg(n){return n.buffer._uuid===void 0&&(n.buffer._uuid=gr()),n.byteOffset===0&&n.byteLength===n.buffer.byteLength?n.buffer._uuid:n.buffer._uuid+":"+n.byteOffset+":"+n.byteLength}var ei=new B,Ja=class n{constructor(e,t,i,s=!1){this.isInterleavedBufferAttribute=!0,this.name="",this.data=e,this.itemSize=t,this.offset=i,this.normalized=s,this._normalizationScale=e!==void 0?lu(e.array):void 0}get count(){return this.data.count}get array(){return this.data.array}set needsUpdate(e){this.data.needsUpdate=e}applyMatrix4(e){for(let t=0,i=this.data.count;t<i;t++)ei.fromBufferAttribute(this,t),ei.applyMatrix4(e),this.setXYZ(t,ei.x,ei.y,ei.z);return this}applyNormalMatrix(e){for(let t=0,i=this.count;t<i;t++)ei.fromBufferAttribute(this,t),ei.applyNormalMatrix(e),this.setXYZ(t,ei.x,ei.y,ei.z);return this}transformDirection(e){for(let t=0,i=this.count;t<i;t++)ei.fromBufferAttribute(this,t),ei.transformDirection(e),this.setXYZ(t,ei.x,ei.y,ei.z);return this}getComponent(e,t){let i=this.array[e*this.data.stride+this.offset+t];return this.normalized&&(i=this._denormalize(i)),i}setComponent(e,t,i){return this.normalized&&(i=this._normalize(i)),this.data.array[e*this.data.stride+this.offset+t]=i,this}setX(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset]=t,this}setY(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+1]=t,this}setZ(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+2]=t,this}setW(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+3]=t,this}getX(e){let t=this.data.array[e*this.data.stride+this.offset];return this.normalized&&(t=this._denormalize(t)),t}getY(e){let t=this.data.array[e*this.data.stride+this.offset+1];return this.normalized&&(t=this._denormalize(t)),t}getZ(e){let t=this.data.array[e*this.data.stride+this.offset+2];return this.normalized&&(t=this._denormalize(t)),t}getW(e){let t=this.data.array[e*this.data.stride+this.offset+3];return this.normalized&&(t=this._denormalize(t)),t}setXY(e,t,i){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),i=this._normalize(i)),this.data.array[e+0]=t,this.data.array[e+1]=i,this}setXYZ(e,t,i,s){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),i=this._normalize(i),s=this._normalize(s)),this.data.array[e+0]=t,this.data.array[e+1]=i,this.data.array[e+2]=s,this}setXYZW(e,t,i,s,r){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),i=this._normalize(i),s=this._normalize(s),r=this._normalize(r)),this.data.array[e+0]=t,this.data.array[e+1]=i,this.data.array[e+2]=s,this.data.array[e+3]=r,this}clone(e){if(e===void 0){Xa("InterleavedBufferAttribute.clone(): Cloning an interleaved buffer attribute will de-interleave buffer data.");let t=[];for(let i=0;i<this.count;i++){let s=i*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)t.push(this.data.array[s+r])}return new hn(new this.array.constructor(t),this.itemSize,this.normalized)}else return e.interleavedBuffers===void 0&&(e.interleavedBuffers={}),e.interleavedBuffers[this.data.uuid]===void 0&&(e.interleavedBuffers[this.data.uuid]=this.data.clone(e)),new n(e.interleavedBuffers[this.data.uuid],this.itemSize,this.offset,this.normalized)}toJSON(e){if(e===void 0){Xa("InterleavedBufferAttribute.toJSON(): Serializing an interleaved buffer attribute will de-interleave buffer data.");let t=[];for(let i=0;i<this.count;i++){let s=i*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)t.push(this.data.array[s+r])}return{itemSize:this.itemSize,type:this.array.constructor.name,array:t,normalized:this.normalized}}else return e.interleavedBuffers===void 0&&(e.interleavedBuffers={}),e.interleavedBuffers[this.data.uuid]===void 0&&(e.interleavedBuffers[this.data.uuid]=this.data.toJSON(e)),{isInterleavedBufferAttribute:!0,itemSize:this.itemSize,data:this.data.uuid,offset:this.offset,normalized:this.normalized}}_denormalize(e){let t=this._normalizationScale;return t!==void 0?Math.max(e/t,-1):Vf(e,this.data.array)}_normalize(e){let t=this._normalizationScale;return t!==void 0?Math.round(e*t):Gf(e,this.data.array)}},jd=new B,LS=new B,NS=new st,Si=class{constructor(e=new B(1,0,0),t=0){this.isPlane=!0,this.normal=e,this.constant=t}set(e,t){return this.normal.copy(e),this.constant=t,this}setComponents(e,t,i,s){return this.normal.set(e,t,i),this.constant=s,this}setFromNormalAndCoplanarPoint(e,t){return this.normal.copy(e),this.constant=-t.dot(this.normal),this}setFromCoplanarPoints(e,t,i){let s=jd.subVectors(i,t).cross(LS.subVectors(e,t)).normalize();return this.setFromNormalAndCoplanarPoint(s,e),this}copy(e){return this.normal.copy(e.normal),this.constant=e.constant,this}normalize(){let e=1/this.normal.length();return this.normal.multiplyScalar(e),this.constant*=e,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(e){return this.normal.dot(e)+this.constant}distanceToSphere(e){return this.distanceToPoint(e.center)-e.radius}projectPoint(e,t){return t.copy(e).addScaledVector(this.normal,-this.distanceToPoint(e))}intersectLine(e,t,i=!0){let s=e.delta(jd),r=this.normal.dot(s);if(r===0)return this.distanceToPoint(e.start)===0?t.copy(e.start):null;let o=-(e.start.dot(this.normal)+this.constant)/r;return i===!0&&(o<0||o>1)?null:t.copy(e.start).addScaledVector(s,o)}intersectsLine(e){let t=this.distanceToPoint(e.start),i=this.distanceToPoint(e.end);return t<0&&i>0||i<0&&t>0}intersectsBox(e){return e.intersectsPlane(this)}intersectsSphere(e){return e.intersectsPlane(this)}coplanarPoint(e){return e.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(e,t){let i=t||NS.getNormalMatrix(e),s=this.coplanarPoint(jd).applyMatrix4(e),r=this.normal.applyMatrix3(i).normalize();return this.constant=-s.dot(r),this}translate(e){return this.constant-=e.dot(this.normal),this}equals(e){return e.normal.equals(this.normal)&&e.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(e){return this.normal.fromArray(e.normal),this.constant=e.constant,this}},US=0,Wi=class extends Gi{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:US++}),this.uuid=gr(),this.name="",this.type="Material",this.blending=Go,this.side=pr,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=_f,this.blendDst=xf,this.blendEquation=kr,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new je(0,0,0),this.blendAlpha=0,this.depthFunc=Po,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=l0,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=Vc,this.stencilZFail=Vc,this.stencilZPass=Vc,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(e){this._alphaTest>0!=e>0&&this.version++,this._alphaTest=e}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(e){if(e!==void 0)for(let t in e){let i=e[t];if(i===void 0){Ke(`Material: parameter '${t}' has value of undefined.`);continue}let s=this[t];if(s===void 0){Ke(`Material: '${t}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(i):s&&s.isVector2&&i&&i.isVector2||s&&s.isEuler&&i&&i.isEuler||s&&s.isVector3&&i&&i.isVector3?s.copy(i):this[t]=i}}toJSON(e){let t=e===void 0||typeof e=="string";t&&(e={textures:{},images:{}});let i={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};i.uuid=this.uuid,i.type=this.type,i.blending=this.blending,i.side=this.side,i.shadowSide=this.shadowSide,i.vertexColors=this.vertexColors,i.opacity=this.opacity,i.transparent=this.transparent,i.blendSrc=this.blendSrc,i.blendDst=this.blendDst,i.blendEquation=this.blendEquation,i.blendSrcAlpha=this.blendSrcAlpha,i.blendDstAlpha=this.blendDstAlpha,i.blendEquationAlpha=this.blendEquationAlpha,i.blendColor=this.blendColor.getHex(),i.blendAlpha=this.blendAlpha,i.depthFunc=this.depthFunc,i.depthTest=this.depthTest,i.depthWrite=this.depthWrite,i.colorWrite=this.colorWrite,i.clipIntersection=this.clipIntersection,i.clipShadows=this.clipShadows,i.stencilWriteMask=this.stencilWriteMask,i.stencilFunc=this.stencilFunc,i.stencilRef=this.stencilRef,i.stencilFuncMask=this.stencilFuncMask,i.stencilFail=this.stencilFail,i.stencilZFail=this.stencilZFail,i.stencilZPass=this.stencilZPass,i.stencilWrite=this.stencilWrite,i.polygonOffset=this.polygonOffset,i.polygonOffsetFactor=this.polygonOffsetFactor,i.polygonOffsetUnits=this.polygonOffsetUnits,i.dithering=this.dithering,i.alphaTest=this.alphaTest,i.alphaHash=this.alphaHash,i.alphaToCoverage=this.alphaToCoverage,i.premultipliedAlpha=this.premultipliedAlpha,i.forceSinglePass=this.forceSinglePass,i.allowOverride=this.allowOverride,i.visible=this.visible,i.toneMapped=this.toneMapped,i.name=this.name,this.color&&this.color.isColor&&(i.color=this.color.getHex()),this.roughness!==void 0&&(i.roughness=this.roughness),this.metalness!==void 0&&(i.metalness=this.metalness),this.sheen!==void 0&&(i.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(i.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(i.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(i.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(i.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(i.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(i.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(i.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(i.shininess=this.shininess),this.clearcoat!==void 0&&(i.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(i.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(i.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(i.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(e).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(i.clearcoatMap=this.clearcoatMap.toJSON(e).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(i.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(e).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(i.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(e).uuid,i.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(i.sheenColorMap=this.sheenColorMap.toJSON(e).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(i.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(e).uuid),this.dispersion!==void 0&&(i.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(i.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(i.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(i.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(i.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(i.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(i.iridescenceMap=this.iridescenceMap.toJSON(e).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(i.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(e).uuid),this.anisotropy!==void 0&&(i.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(i.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(i.anisotropyMap=this.anisotropyMap.toJSON(e).uuid),this.map&&this.map.isTexture&&(i.map=this.map.toJSON(e).uuid),this.matcap&&this.matcap.isTexture&&(i.matcap=this.matcap.toJSON(e).uuid),this.alphaMap&&this.alphaMap.isTexture&&(i.alphaMap=this.alphaMap.toJSON(e).uuid),this.lightMap&&this.lightMap.isTexture&&(i.lightMap=this.lightMap.toJSON(e).uuid,i.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(i.aoMap=this.aoMap.toJSON(e).uuid,i.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(i.bumpMap=this.bumpMap.toJSON(e).uuid,i.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(i.normalMap=this.normalMap.toJSON(e).uuid,i.normalMapType=this.normalMapType,i.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(i.displacementMap=this.displacementMap.toJSON(e).uuid,i.displacementScale=this.displacementScale,i.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(i.roughnessMap=this.roughnessMap.toJSON(e).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(i.metalnessMap=this.metalnessMap.toJSON(e).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(i.emissiveMap=this.emissiveMap.toJSON(e).uuid),this.specularMap&&this.specularMap.isTexture&&(i.specularMap=this.specularMap.toJSON(e).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(i.specularIntensityMap=this.specularIntensityMap.toJSON(e).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(i.specularColorMap=this.specularColorMap.toJSON(e).uuid),this.envMap&&this.envMap.isTexture&&(i.envMap=this.envMap.toJSON(e).uuid,this.combine!==void 0&&(i.combine=this.combine)),this.envMapRotation!==void 0&&(i.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(i.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(i.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(i.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(i.gradientMap=this.gradientMap.toJSON(e).uuid),this.transmission!==void 0&&(i.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(i.transmissionMap=this.transmissionMap.toJSON(e).uuid),this.thickness!==void 0&&(i.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(i.thicknessMap=this.thicknessMap.toJSON(e).uuid),this.attenuationDistance!==void 0&&(i.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(i.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(i.size=this.size),this.sizeAttenuation!==void 0&&(i.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(i.clippingPlanes=this.clippingPlanes.map(r=>r.toJSON())),this.rotation!==void 0&&(i.rotation=this.rotation),this.depthPacking!==void 0&&(i.depthPacking=this.depthPacking),this.linewidth!==void 0&&(i.linewidth=this.linewidth),this.linecap!==void 0&&(i.linecap=this.linecap),this.linejoin!==void 0&&(i.linejoin=this.linejoin),this.dashSize!==void 0&&(i.dashSize=this.dashSize),this.gapSize!==void 0&&(i.gapSize=this.gapSize),this.scale!==void 0&&(i.scale=this.scale),this.wireframe!==void 0&&(i.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(i.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(i.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(i.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(i.flatShading=this.flatShading),this.fog!==void 0&&(i.fog=this.fog),Object.keys(this.userData).length>0&&(i.userData=this.userData);function s(r){let o=[];for(let a in r){let l=r[a];delete l.metadata,o.push(l)}return o}if(t){let r=s(e.textures),o=s(e.images);r.length>0&&(i.textures=r),o.length>0&&(i.images=o)}return i}fromJSON(e,t){if(e.uuid!==void 0&&(this.uuid=e.uuid),e.name!==void 0&&(this.name=e.name),e.color!==void 0&&this.color!==void 0&&this.color.setHex(e.color),e.roughness!==void 0&&(this.roughness=e.roughness),e.metalness!==void 0&&(this.metalness=e.metalness),e.sheen!==void 0&&(this.sheen=e.sheen),e.sheenColor!==void 0&&(this.sheenColor=new je().setHex(e.sheenColor)),e.sheenRoughness!==void 0&&(this.sheenRoughness=e.sheenRoughness),e.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(e.emissive),e.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(e.specular),e.specularIntensity!==void 0&&(this.specularIntensity=e.specularIntensity),e.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(e.specularColor),e.shininess!==void 0&&(this.shininess=e.shininess),e.clearcoat!==void 0&&(this.clearcoat=e.clearcoat),e.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=e.clearcoatRoughness),e.diffuseRoughness!==void 0&&(this.diffuseRoughness=e.diffuseRoughness),e.dispersion!==void 0&&(this.dispersion=e.dispersion),e.retroreflectivity!==void 0&&(this.retroreflectivity=e.retroreflectivity),e.iridescence!==void 0&&(this.iridescence=e.iridescence),e.iridescenceIOR!==void 0&&(this.iridescenceIOR=e.iridescenceIOR),e.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessMinimum),e.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=e.iridescenceThicknessMaximum),e.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=e.iridescenceThicknessRange[1]),e.transmission!==void 0&&(this.transmission=e.transmission),e.thickness!==void 0&&(this.thickness=e.thickness),e.attenuationDistance!==void 0&&(this.attenuationDistance=e.attenuationDistance),e.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(e.attenuationColor),e.anisotropy!==void 0&&(this.anisotropy=e.anisotropy),e.anisotropyRotation!==void 0&&(this.anisotropyRotation=e.anisotropyRotation),e.fog!==void 0&&(this.fog=e.fog),e.flatShading!==void 0&&(this.flatShading=e.flatShading),e.blending!==void 0&&(this.blending=e.blending),e.combine!==void 0&&(this.combine=e.combine),e.side!==void 0&&(this.side=e.side),e.shadowSide!==void 0&&(this.shadowSide=e.shadowSide),e.opacity!==void 0&&(this.opacity=e.opacity),e.transparent!==void 0&&(this.transparent=e.transparent),e.alphaTest!==void 0&&(this.alphaTest=e.alphaTest),e.alphaHash!==void 0&&(this.alphaHash=e.alphaHash),e.depthFunc!==void 0&&(this.depthFunc=e.depthFunc),e.depthTest!==void 0&&(this.depthTest=e.depthTest),e.depthWrite!==void 0&&(this.depthWrite=e.depthWrite),e.colorWrite!==void 0&&(this.colorWrite=e.colorWrite),e.clippingPlanes!==void 0&&(this.clippingPlanes=e.clippingPlanes.map(i=>new Si().fromJSON(i))),e.clipIntersection!==void 0&&(this.clipIntersection=e.clipIntersection),e.clipShadows!==void 0&&(this.clipShadows=e.clipShadows),e.depthPacking!==void 0&&(this.depthPacking=e.depthPacking),e.blendSrc!==void 0&&(this.blendSrc=e.blendSrc),e.blendDst!==void 0&&(this.blendDst=e.blendDst),e.blendEquation!==void 0&&(this.blendEquation=e.blendEquation),e.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=e.blendSrcAlpha),e.blendDstAlpha!==void 0&&(this.blendDstAlpha=e.blendDstAlpha),e.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=e.blendEquationAlpha),e.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(e.blendColor),e.blendAlpha!==void 0&&(this.blendAlpha=e.blendAlpha),e.stencilWriteMask!==void 0&&(this.stencilWriteMask=e.stencilWriteMask),e.stencilFunc!==void 0&&(this.stencilFunc=e.stencilFunc),e.stencilRef!==void 0&&(this.stencilRef=e.stencilRef),e.stencilFuncMask!==void 0&&(this.stencilFuncMask=e.stencilFuncMask),e.stencilFail!==void 0&&(this.stencilFail=e.stencilFail),e.stencilZFail!==void 0&&(this.stencilZFail=e.stencilZFail),e.stencilZPass!==void 0&&(this.stencilZPass=e.stencilZPass),e.stencilWrite!==void 0&&(this.stencilWrite=e.stencilWrite),e.wireframe!==void 0&&(this.wireframe=e.wireframe),e.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=e.wireframeLinewidth),e.wireframeLinecap!==void 0&&(this.wireframeLinecap=e.wireframeLinecap),e.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=e.wireframeLinejoin),e.rotation!==void 0&&(this.rotation=e.rotation),e.linewidth!==void 0&&(this.linewidth=e.linewidth),e.linecap!==void 0&&(this.linecap=e.linecap),e.linejoin!==void 0&&(this.linejoin=e.linejoin),e.dashSize!==void 0&&(this.dashSize=e.dashSize),e.gapSize!==void 0&&(this.gapSize=e.gapSize),e.scale!==void 0&&(this.scale=e.scale),e.polygonOffset!==void 0&&(this.polygonOffset=e.polygonOffset),e.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=e.polygonOffsetFactor),e.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=e.polygonOffsetUnits),e.dithering!==void 0&&(this.dithering=e.dithering),e.alphaToCoverage!==void 0&&(this.alphaToCoverage=e.alphaToCoverage),e.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=e.premultipliedAlpha),e.forceSinglePass!==void 0&&(this.forceSinglePass=e.forceSinglePass),e.allowOverride!==void 0&&(this.allowOverride=e.allowOverride),e.visible!==void 0&&(this.visible=e.visible),e.toneMapped!==void 0&&(this.toneMapped=e.toneMapped),e.userData!==void 0&&(this.userData=e.userData),e.vertexColors!==void 0&&(typeof e.vertexColors=="number"?this.vertexColors=e.vertexColors>0:this.vertexColors=e.vertexColors),e.size!==void 0&&(this.size=e.size),e.sizeAttenuation!==void 0&&(this.sizeAttenuation=e.sizeAttenuation),e.map!==void 0&&(this.map=t[e.map]||null),e.matcap!==void 0&&(this.matcap=t[e.matcap]||null),e.alphaMap!==void 0&&(this.alphaMap=t[e.alphaMap]||null),e.bumpMap!==void 0&&(this.bumpMap=t[e.bumpMap]||null),e.bumpScale!==void 0&&(this.bumpScale=e.bumpScale),e.normalMap!==void 0&&(this.normalMap=t[e.normalMap]||null),e.normalMapType!==void 0&&(this.normalMapType=e.normalMapType),e.normalScale!==void 0){let i=e.normalScale;Array.isArray(i)===!1&&(i=[i,i]),this.normalScale=new $e().fromArray(i)}return e.displacementMap!==void 0&&(this.displacementMap=t[e.displacementMap]||null),e.displacementScale!==void 0&&(this.displacementScale=e.displacementScale),e.displacementBias!==void 0&&(this.displacementBias=e.displacementBias),e.roughnessMap!==void 0&&(this.roughnessMap=t[e.roughnessMap]||null),e.metalnessMap!==void 0&&(this.metalnessMap=t[e.metalnessMap]||null),e.emissiveMap!==void 0&&(this.emissiveMap=t[e.emissiveMap]||null),e.emissiveIntensity!==void 0&&(this.emissiveIntensity=e.emissiveIntensity),e.specularMap!==void 0&&(this.specularMap=t[e.specularMap]||null),e.specularIntensityMap!==void 0&&(this.specularIntensityMap=t[e.specularIntensityMap]||null),e.specularColorMap!==void 0&&(this.specularColorMap=t[e.specularColorMap]||null),e.envMap!==void 0&&(this.envMap=t[e.envMap]||null),e.envMapRotation!==void 0&&this.envMapRotation.fromArray(e.envMapRotation),e.envMapIntensity!==void 0&&(this.envMapIntensity=e.envMapIntensity),e.reflectivity!==void 0&&(this.reflectivity=e.reflectivity),e.refractionRatio!==void 0&&(this.refractionRatio=e.refractionRatio),e.lightMap!==void 0&&(this.lightMap=t[e.lightMap]||null),e.lightMapIntensity!==void 0&&(this.lightMapIntensity=e.lightMapIntensity),e.aoMap!==void 0&&(this.aoMap=t[e.aoMap]||null),e.aoMapIntensity!==void 0&&(this.aoMapIntensity=e.aoMapIntensity),e.gradientMap!==void 0&&(this.gradientMap=t[e.gradientMap]||null),e.clearcoatMap!==void 0&&(this.clearcoatMap=t[e.clearcoatMap]||null),e.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=t[e.clearcoatRoughnessMap]||null),e.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=t[e.clearcoatNormalMap]||null),e.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new $e().fromArray(e.clearcoatNormalScale)),e.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=t[e.diffuseRoughnessMap]||null),e.iridescenceMap!==void 0&&(this.iridescenceMap=t[e.iridescenceMap]||null),e.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=t[e.iridescenceThicknessMap]||null),e.transmissionMap!==void 0&&(this.transmissionMap=t[e.transmissionMap]||null),e.thicknessMap!==void 0&&(this.thicknessMap=t[e.thicknessMap]||null),e.anisotropyMap!==void 0&&(this.anisotropyMap=t[e.anisotropyMap]||null),e.sheenColorMap!==void 0&&(this.sheenColorMap=t[e.sheenColorMap]||null),e.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=t[e.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(e){this.name=e.name,this.blending=e.blending,this.side=e.side,this.vertexColors=e.vertexColors,this.opacity=e.opacity,this.transparent=e.transparent,this.blendSrc=e.blendSrc,this.blendDst=e.blendDst,this.blendEquation=e.blendEquation,this.blendSrcAlpha=e.blendSrcAlpha,this.blendDstAlpha=e.blendDstAlpha,this.blendEquationAlpha=e.blendEquationAlpha,this.blendColor.copy(e.blendColor),this.blendAlpha=e.blendAlpha,this.depthFunc=e.depthFunc,this.depthTest=e.depthTest,this.depthWrite=e.depthWrite,this.stencilWriteMask=e.stencilWriteMask,this.stencilFunc=e.stencilFunc,this.stencilRef=e.stencilRef,this.stencilFuncMask=e.stencilFuncMask,this.stencilFail=e.stencilFail,this.stencilZFail=e.stencilZFail,this.stencilZPass=e.stencilZPass,this.stencilWrite=e.stencilWrite;let t=e.clippingPlanes,i=null;if(t!==null){let s=t.length;i=new Array(s);for(let r=0;r!==s;++r)i[r]=t[r].clone()}return this.clippingPlanes=i,this.clipIntersection=e.clipIntersection,this.clipShadows=e.clipShadows,this.shadowSide=e.shadowSide,this.colorWrite=e.colorWrite,this.precision=e.precision,this.polygonOffset=e.polygonOffset,this.polygonOffsetFactor=e.polygonOffsetFactor,this.polygonOffsetUnits=e.polygonOffsetUnits,this.dithering=e.dithering,this.alphaTest=e.alphaTest,this.alphaHash=e.alphaHash,this.alphaToCoverage=e.alphaToCoverage,this.premultipliedAlpha=e.premultipliedAlpha,this.forceSinglePass=e.forceSinglePass,this.allowOverride=e.allowOverride,this.visible=e.visible,this.toneMapped=e.toneMapped,this.userData=JSON.parse(JSON.stringify(e.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(e){e===!0&&this.version++}},Fo=class extends Wi{constructor(e){super(),this.isSpriteMaterial=!0,this.type="SpriteMaterial",this.color=new je(16777215),this.map=null,this.alphaMap=null,this.rotation=0,this.sizeAttenuation=!0,this.transparent=!0,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.alphaMap=e.alphaMap,this.rotation=e.rotation,this.sizeAttenuation=e.sizeAttenuation,this.fog=e.fog,this}},bo,Na=new B,Mo=new B,wo=new B,To=new $e,Ua=new $e,y0=new Pt,vc=new B,Fa=new B,Sc=new B,_g=new $e,Qd=new $e,xg=new $e,Ur=class extends En{constructor(e=new Fo){if(super(),this.isSprite=!0,this.type="Sprite",bo===void 0){bo=new Xt;let t=new Float32Array([-.5,-.5,0,0,0,.5,-.5,0,1,0,.5,.5,0,1,1,-.5,.5,0,0,1]),i=new th(t,5);bo.setIndex([0,1,2,0,2,3]),bo.setAttribute("position",new Ja(i,3,0,!1)),bo.setAttribute("uv",new Ja(i,2,3,!1))}this.geometry=bo,this.material=e,this.center=new $e(.5,.5),this.count=1}intersectsFrustum(e){return e.intersectsSprite(this)}raycast(e,t){e.camera===null&&it('Sprite: "Raycaster.camera" needs to be set in order to raycast against sprites.'),Mo.setFromMatrixScale(this.matrixWorld),y0.copy(e.camera.matrixWorld),this.modelViewMatrix.multiplyMatrices(e.camera.matrixWorldInverse,this.matrixWorld),wo.setFromMatrixPosition(this.modelViewMatrix),e.camera.isPerspectiveCamera&&this.material.sizeAttenuation===!1&&Mo.multiplyScalar(-wo.z);let i=this.material.rotation,s,r;i!==0&&(r=Math.cos(i),s=Math.sin(i));let o=this.center;bc(vc.set(-.5,-.5,0),wo,o,Mo,s,r),bc(Fa.set(.5,-.5,0),wo,o,Mo,s,r),bc(Sc.set(.5,.5,0),wo,o,Mo,s,r),_g.set(0,0),Qd.set(1,0),xg.set(1,1);let a=e.ray.intersectTriangle(vc,Fa,Sc,!1,Na);if(a===null&&(bc(Fa.set(-.5,.5,0),wo,o,Mo,s,r),Qd.set(0,1),a=e.ray.intersectTriangle(vc,Sc,Fa,!1,Na),a===null))return;let l=e.ray.origin.distanceTo(Na);l<e.near||l>e.far||t.push({distance:l,point:Na.clone(),uv:Is.getInterpolation(Na,vc,Fa,Sc,_g,Qd,xg,new $e),face:null,object:this})}copy(e,t){return super.copy(e,t),e.center!==void 0&&this.center.copy(e.center),this.material=e.material,this}toJSON(e){let t=super.toJSON(e);return t.object.center=this.center.toArray(),t}};function bc(n,e,t,i,s,r){To.subVectors(n,t).addScalar(.5).multiply(i),s!==void 0?(Ua.x=r*To.x-s*To.y,Ua.y=s*To.x+r*To.y):Ua.copy(To),n.copy(e),n.x+=Ua.x,n.y+=Ua.y,n.applyMatrix4(y0)}var Ps=new B,ef=new B,Mc=new B,wc=new B,rr=class{constructor(e=new B,t=new B(0,0,-1)){this.origin=e,this.direction=t}set(e,t){return this.origin.copy(e),this.direction.copy(t),this}copy(e){return this.origin.copy(e.origin),this.direction.copy(e.direction),this}at(e,t){return t.copy(this.origin).addScaledVector(this.direction,e)}lookAt(e){return this.direction.copy(e).sub(this.origin).normalize(),this}recast(e){return this.origin.copy(this.at(e,Ps)),this}closestPointToPoint(e,t){t.subVectors(e,this.origin);let i=t.dot(this.direction);return i<0?t.copy(this.origin):t.copy(this.origin).addScaledVector(this.direction,i)}distanceToPoint(e){return Math.sqrt(this.distanceSqToPoint(e))}distanceSqToPoint(e){let t=Ps.subVectors(e,this.origin).dot(this.direction);return t<0?this.origin.distanceToSquared(e):(Ps.copy(this.origin).addScaledVector(this.direction,t),Ps.distanceToSquared(e))}distanceSqToSegment(e,t,i,s){ef.copy(e).add(t).multiplyScalar(.5),Mc.copy(t).sub(e).normalize(),wc.copy(this.origin).sub(ef);let r=e.distanceTo(t)*.5,o=-this.direction.dot(Mc),a=wc.dot(this.direction),l=-wc.dot(Mc),c=wc.lengthSq(),h=Math.abs(1-o*o),u,d,f,g;if(h>0)if(u=o*l-a,d=o*a-l,g=r*h,u>=0)if(d>=-g)if(d<=g){let v=1/h;u*=v,d*=v,f=u*(u+o*d+2*a)+d*(o*u+d+2*l)+c}else d=r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;else d=-r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;else d<=-g?(u=Math.max(0,-(-o*r+a)),d=u>0?-r:Math.min(Math.max(-r,-l),r),f=-u*u+d*(d+2*l)+c):d<=g?(u=0,d=Math.min(Math.max(-r,-l),r),f=d*(d+2*l)+c):(u=Math.max(0,-(o*r+a)),d=u>0?r:Math.min(Math.max(-r,-l),r),f=-u*u+d*(d+2*l)+c);else d=o>0?-r:r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;return i&&i.copy(this.origin).addScaledVector(this.direction,u),s&&s.copy(ef).addScaledVector(Mc,d),f}intersectSphere(e,t){if(e.radius<0)return null;Ps.subVectors(e.center,this.origin);let i=Ps.dot(this.direction),s=Ps.dot(Ps)-i*i,r=e.radius*e.radius;if(s>r)return null;let o=Math.sqrt(r-s),a=i-o,l=i+o;return l<0?null:a<0?this.at(l,t):this.at(a,t)}intersectsSphere(e){return e.radius<0?!1:this.distanceSqToPoint(e.center)<=e.radius*e.radius}distanceToPlane(e){let t=e.normal.dot(this.direction);if(t===0)return e.distanceToPoint(this.origin)===0?0:null;let i=-(this.origin.dot(e.normal)+e.constant)/t;return i>=0?i:null}intersectPlane(e,t){let i=this.distanceToPlane(e);return i===null?null:this.at(i,t)}intersectsPlane(e){let t=e.distanceToPoint(this.origin);return t===0||e.normal.dot(this.direction)*t<0}intersectBox(e,t){let i,s,r,o,a,l,c=1/this.direction.x,h=1/this.direction.y,u=1/this.direction.z,d=this.origin;return c>=0?(i=(e.min.x-d.x)*c,s=(e.max.x-d.x)*c):(i=(e.max.x-d.x)*c,s=(e.min.x-d.x)*c),h>=0?(r=(e.min.y-d.y)*h,o=(e.max.y-d.y)*h):(r=(e.max.y-d.y)*h,o=(e.min.y-d.y)*h),i>o||r>s||((r>i||isNaN(i))&&(i=r),(o<s||isNaN(s))&&(s=o),u>=0?(a=(e.min.z-d.z)*u,l=(e.max.z-d.z)*u):(a=(e.max.z-d.z)*u,l=(e.min.z-d.z)*u),i>l||a>s)||((a>i||i!==i)&&(i=a),(l<s||s!==s)&&(s=l),s<0)?null:this.at(i>=0?i:s,t)}intersectsBox(e){return this.intersectBox(e,Ps)!==null}intersectTriangle(e,t,i,s,r){let o=this.origin,a=this.direction,l=a.x,c=a.y,h=a.z,u=e.x-o.x,d=e.y-o.y,f=e.z-o.z,g=t.x-o.x,v=t.y-o.y,m=t.z-o.z,p=i.x-o.x,y=i.y-o.y,C=i.z-o.z,w=Math.abs(l),P=Math.abs(c),E=Math.abs(h),x,T,k,N,L,z,W,D,X,$,H,he;if(w>=P&&w>=E?(k=l,z=u,X=g,he=p,l>=0?(x=c,T=h,N=d,L=f,W=v,D=m,$=y,H=C):(x=h,T=c,N=f,L=d,W=m,D=v,$=C,H=y)):P>=E?(k=c,z=d,X=v,he=y,c>=0?(x=h,T=l,N=f,L=u,W=m,D=g,$=C,H=p):(x=l,T=h,N=u,L=f,W=g,D=m,$=p,H=C)):(k=h,z=f,X=m,he=C,h>=0?(x=l,T=c,N=u,L=d,W=g,D=v,$=p,H=y):(x=c,T=l,N=d,L=u,W=v,D=g,$=y,H=p)),k===0)return null;let J=x/k,Q=T/k,re=1/k,fe=N-J*z,de=L-Q*z,te=W-J*X,ge=D-Q*X,ye=$-J*he,Ce=H-Q*he,Me=ye*ge-Ce*te,Xe=fe*Ce-de*ye,lt=te*de-ge*fe;if(s){if(Me<0||Xe<0||lt<0)return null}else if((Me<0||Xe<0||lt<0)&&(Me>0||Xe>0||lt>0))return null;let He=Me+Xe+lt;if(He===0)return null;let mt=re*(Me*z+Xe*X+lt*he);return(He>0?mt<0:mt>0)?null:this.at(mt/He,r)}applyMatrix4(e){return this.origin.applyMatrix4(e),this.direction.transformDirection(e),this}equals(e){return e.origin.equals(this.origin)&&e.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},Us=class extends Wi{constructor(e){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new je(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new Ns,this.combine=Sh,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.specularMap=e.specularMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.combine=e.combine,this.reflectivity=e.reflectivity,this.refractionRatio=e.refractionRatio,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.fog=e.fog,this}},yg=new Pt,Lr=new rr,Tc=new sr,vg=new B,Ec=new B,Ac=new B,Cc=new B,tf=new B,Rc=new B,Sg=new B,Pc=new B,Vn=class extends En{constructor(e=new Xt,t=new Us){super(),this.isMesh=!0,this.type="Mesh",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}updateMorphTargets(){let t=this.geometry.morphAttributes,i=Object.keys(t);if(i.length>0){let s=t[i[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}getVertexPosition(e,t){let i=this.geometry,s=i.attributes.position,r=i.morphAttributes.position,o=i.morphTargetsRelative;t.fromBufferAttribute(s,e);let a=this.morphTargetInfluences;if(r&&a){Rc.set(0,0,0);for(let l=0,c=r.length;l<c;l++){let h=a[l],u=r[l];h!==0&&(tf.fromBufferAttribute(u,e),o?Rc.addScaledVector(tf,h):Rc.addScaledVector(tf.sub(t),h))}t.add(Rc)}return t}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let i=this.geometry,s=this.material,r=this.matrixWorld;s!==void 0&&(i.boundingSphere===null&&i.computeBoundingSphere(),Tc.copy(i.boundingSphere),Tc.applyMatrix4(r),Lr.copy(e.ray).recast(e.near),!(Tc.containsPoint(Lr.origin)===!1&&(Lr.intersectSphere(Tc,vg)===null||Lr.origin.distanceToSquared(vg)>(e.far-e.near)**2))&&(yg.copy(r).invert(),Lr.copy(e.ray).applyMatrix4(yg),!(i.boundingBox!==null&&Lr.intersectsBox(i.boundingBox)===!1)&&this._computeIntersections(e,t,Lr)))}_computeIntersections(e,t,i){let s,r=this.geometry,o=this.material,a=r.index,l=r.attributes.position,c=r.attributes.uv,h=r.attributes.uv1,u=r.attributes.normal,d=r.groups,f=r.drawRange;if(a!==null)if(Array.isArray(o))for(let g=0,v=d.length;g<v;g++){let m=d[g],p=o[m.materialIndex],y=Math.max(m.start,f.start),C=Math.min(a.count,Math.min(m.start+m.count,f.start+f.count));for(let w=y,P=C;w<P;w+=3){let E=a.getX(w),x=a.getX(w+1),T=a.getX(w+2);s=Ic(this,p,e,i,c,h,u,E,x,T),s&&(s.faceIndex=Math.floor(w/3),s.face.materialIndex=m.materialIndex,t.push(s))}}else{let g=Math.max(0,f.start),v=Math.min(a.count,f.start+f.count);for(let m=g,p=v;m<p;m+=3){let y=a.getX(m),C=a.getX(m+1),w=a.getX(m+2);s=Ic(this,o,e,i,c,h,u,y,C,w),s&&(s.faceIndex=Math.floor(m/3),t.push(s))}}else if(l!==void 0)if(Array.isArray(o))for(let g=0,v=d.length;g<v;g++){let m=d[g],p=o[m.materialIndex],y=Math.max(m.start,f.start),C=Math.min(l.count,Math.min(m.start+m.count,f.start+f.count));for(let w=y,P=C;w<P;w+=3){let E=w,x=w+1,T=w+2;s=Ic(this,p,e,i,c,h,u,E,x,T),s&&(s.faceIndex=Math.floor(w/3),s.face.materialIndex=m.materialIndex,t.push(s))}}else{let g=Math.max(0,f.start),v=Math.min(l.count,f.start+f.count);for(let m=g,p=v;m<p;m+=3){let y=m,C=m+1,w=m+2;s=Ic(this,o,e,i,c,h,u,y,C,w),s&&(s.faceIndex=Math.floor(m/3),t.push(s))}}}};function FS(n,e,t,i,s,r,o,a){let l;if(e.side===ri?l=i.intersectTriangle(o,r,s,!0,a):l=i.intersectTriangle(s,r,o,e.side===pr,a),l===null)return null;Pc.copy(a),Pc.applyMatrix4(n.matrixWorld);let c=t.ray.origin.distanceTo(Pc);return c<t.near||c>t.far?null:{distance:c,point:Pc.clone(),object:n}}function Ic(n,e,t,i,s,r,o,a,l,c){n.getVertexPosition(a,Ec),n.getVertexPosition(l,Ac),n.getVertexPosition(c,Cc);let h=FS(n,e,t,i,Ec,Ac,Cc,Sg);if(h){let u=new B;Is.getBarycoord(Sg,Ec,Ac,Cc,u),s&&(h.uv=Is.getInterpolatedAttribute(s,a,l,c,u,new $e)),r&&(h.uv1=Is.getInterpolatedAttribute(r,a,l,c,u,new $e)),o&&(h.normal=Is.getInterpolatedAttribute(o,a,l,c,u,new B),h.normal.dot(i.direction)>0&&h.normal.multiplyScalar(-1));let d={a,b:l,c,normal:new B,materialIndex:0};Is.getNormal(Ec,Ac,Cc,d.normal),h.face=d,h.barycoord=u}return h}var Oo=class extends si{constructor(e=null,t=1,i=1,s,r,o,a,l,c=zn,h=zn,u,d){super(null,o,a,l,c,h,s,r,u,d),this.isDataTexture=!0,this.image={data:e,width:t,height:i},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}};var Nr=new sr,OS=new $e(.5,.5),Dc=new B,or=class{constructor(e=new Si,t=new Si,i=new Si,s=new Si,r=new Si,o=new Si){this.planes=[e,t,i,s,r,o]}set(e,t,i,s,r,o){let a=this.planes;return a[0].copy(e),a[1].copy(t),a[2].copy(i),a[3].copy(s),a[4].copy(r),a[5].copy(o),this}copy(e){let t=this.planes;for(let i=0;i<6;i++)t[i].copy(e.planes[i]);return this}setFromProjectionMatrix(e,t=Di,i=!1){let s=this.planes,r=e.elements,o=r[0],a=r[1],l=r[2],c=r[3],h=r[4],u=r[5],d=r[6],f=r[7],g=r[8],v=r[9],m=r[10],p=r[11],y=r[12],C=r[13],w=r[14],P=r[15];if(s[0].setComponents(c-o,f-h,p-g,P-y).normalize(),s[1].setComponents(c+o,f+h,p+g,P+y).normalize(),s[2].setComponents(c+a,f+u,p+v,P+C).normalize(),s[3].setComponents(c-a,f-u,p-v,P-C).normalize(),i)s[4].setComponents(l,d,m,w).normalize(),s[5].setComponents(c-l,f-d,p-m,P-w).normalize();else if(s[4].setComponents(c-l,f-d,p-m,P-w).normalize(),t===Di)s[5].setComponents(c+l,f+d,p+m,P+w).normalize();else if(t===Io)s[5].setComponents(l,d,m,w).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+t);return this}intersectsObject(e){if(e.boundingSphere!==void 0)e.boundingSphere===null&&e.computeBoundingSphere(),Nr.copy(e.boundingSphere).applyMatrix4(e.matrixWorld);else{let t=e.geometry;t.boundingSphere===null&&t.computeBoundingSphere(),Nr.copy(t.boundingSphere).applyMatrix4(e.matrixWorld)}return this.intersectsSphere(Nr)}intersectsSprite(e){Nr.center.set(0,0,0);let t=OS.distanceTo(e.center);return Nr.radius=.7071067811865476+t,Nr.applyMatrix4(e.matrixWorld),this.intersectsSphere(Nr)}intersectsSphere(e){let t=this.planes,i=e.center,s=-e.radius;for(let r=0;r<6;r++)if(t[r].distanceToPoint(i)<s)return!1;return!0}intersectsBox(e){let t=this.planes;for(let i=0;i<6;i++){let s=t[i];if(Dc.x=s.normal.x>0?e.max.x:e.min.x,Dc.y=s.normal.y>0?e.max.y:e.min.y,Dc.z=s.normal.z>0?e.max.z:e.min.z,s.distanceToPoint(Dc)<0)return!1}return!0}containsPoint(e){let t=this.planes;for(let i=0;i<6;i++)if(t[i].distanceToPoint(e)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},bg=new Pt,nh=class n{constructor(){this.coordinateSystem=Di,this._frustums=[],this._count=0}setFromArrayCamera(e){let t=e.cameras,i=this._frustums;for(let s=0;s<t.length;s++){let r=t[s];bg.multiplyMatrices(r.projectionMatrix,r.matrixWorldInverse),i[s]===void 0&&(i[s]=new or),i[s].setFromProjectionMatrix(bg,r.coordinateSystem,r.reversedDepth)}return this._count=t.length,this}getFrustum(e){return this._frustums[e]}intersectsObject(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].intersectsObject(e))return!0;return!1}intersectsSprite(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].intersectsSprite(e))return!0;return!1}intersectsSphere(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].intersectsSphere(e))return!0;return!1}intersectsBox(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].intersectsBox(e))return!0;return!1}containsPoint(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].containsPoint(e))return!0;return!1}copy(e){this.coordinateSystem=e.coordinateSystem;let t=this._frustums,i=e._frustums;for(let s=0;s<e._count;s++)t[s]===void 0&&(t[s]=new or),t[s].copy(i[s]);return this._count=e._count,this}clone(){return new n().copy(this)}};var Xi=class extends Wi{constructor(e){super(),this.isLineBasicMaterial=!0,this.type="LineBasicMaterial",this.color=new je(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.linewidth=e.linewidth,this.linecap=e.linecap,this.linejoin=e.linejoin,this.fog=e.fog,this}},ih=new B,sh=new B,Mg=new Pt,Oa=new rr,Lc=new sr,nf=new B,wg=new B,rh=class extends En{constructor(e=new Xt,t=new Xi){super(),this.isLine=!0,this.type="Line",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}computeLineDistances(){let e=this.geometry;if(e.index===null){let t=e.attributes.position,i=[0];for(let s=1,r=t.count;s<r;s++)ih.fromBufferAttribute(t,s-1),sh.fromBufferAttribute(t,s),i[s]=i[s-1],i[s]+=ih.distanceTo(sh);e.setAttribute("lineDistance",new un(i,1))}else Ke("Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let i=this.geometry,s=this.matrixWorld,r=e.params.Line.threshold,o=i.drawRange;if(i.boundingSphere===null&&i.computeBoundingSphere(),Lc.copy(i.boundingSphere),Lc.applyMatrix4(s),Lc.radius+=r,e.ray.intersectsSphere(Lc)===!1)return;Mg.copy(s).invert(),Oa.copy(e.ray).applyMatrix4(Mg);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=this.isLineSegments?2:1,h=i.index,d=i.attributes.position;if(h!==null){let f=Math.max(0,o.start),g=Math.min(h.count,o.start+o.count);for(let v=f,m=g-1;v<m;v+=c){let p=h.getX(v),y=h.getX(v+1),C=Nc(this,e,Oa,l,p,y,v);C&&t.push(C)}if(this.isLineLoop){let v=h.getX(g-1),m=h.getX(f),p=Nc(this,e,Oa,l,v,m,g-1);p&&t.push(p)}}else{let f=Math.max(0,o.start),g=Math.min(d.count,o.start+o.count);for(let v=f,m=g-1;v<m;v+=c){let p=Nc(this,e,Oa,l,v,v+1,v);p&&t.push(p)}if(this.isLineLoop){let v=Nc(this,e,Oa,l,g-1,f,g-1);v&&t.push(v)}}}updateMorphTargets(){let t=this.geometry.morphAttributes,i=Object.keys(t);if(i.length>0){let s=t[i[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function Nc(n,e,t,i,s,r,o){let a=n.geometry.attributes.position;if(ih.fromBufferAttribute(a,s),sh.fromBufferAttribute(a,r),t.distanceSqToSegment(ih,sh,nf,wg)>i)return;nf.applyMatrix4(n.matrixWorld);let c=e.ray.origin.distanceTo(nf);if(!(c<e.near||c>e.far))return{distance:c,point:wg.clone().applyMatrix4(n.matrixWorld),index:o,face:null,faceIndex:null,barycoord:null,object:n}}var Tg=new B,Eg=new B,fs=class extends rh{constructor(e,t){super(e,t),this.isLineSegments=!0,this.type="LineSegments"}computeLineDistances(){let e=this.geometry;if(e.index===null){let t=e.attributes.position,i=[];for(let s=0,r=t.count;s<r;s+=2)Tg.fromBufferAttribute(t,s),Eg.fromBufferAttribute(t,s+1),i[s]=s===0?0:i[s-1],i[s+1]=i[s]+Tg.distanceTo(Eg);e.setAttribute("lineDistance",new un(i,1))}else Ke("LineSegments.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}};var Fr=class extends Wi{constructor(e){super(),this.isPointsMaterial=!0,this.type="PointsMaterial",this.color=new je(16777215),this.map=null,this.alphaMap=null,this.size=1,this.sizeAttenuation=!0,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.alphaMap=e.alphaMap,this.size=e.size,this.sizeAttenuation=e.sizeAttenuation,this.fog=e.fog,this}},Ag=new Pt,cf=new rr,Uc=new sr,Fc=new B,Bo=class extends En{constructor(e=new Xt,t=new Fr){super(),this.isPoints=!0,this.type="Points",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let i=this.geometry,s=this.matrixWorld,r=e.params.Points.threshold,o=i.drawRange;if(i.boundingSphere===null&&i.computeBoundingSphere(),Uc.copy(i.boundingSphere),Uc.applyMatrix4(s),Uc.radius+=r,e.ray.intersectsSphere(Uc)===!1)return;Ag.copy(s).invert(),cf.copy(e.ray).applyMatrix4(Ag);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=i.index,u=i.attributes.position;if(c!==null){let d=Math.max(0,o.start),f=Math.min(c.count,o.start+o.count);for(let g=d,v=f;g<v;g++){let m=c.getX(g);Fc.fromBufferAttribute(u,m),Cg(Fc,m,l,s,e,t,this)}}else{let d=Math.max(0,o.start),f=Math.min(u.count,o.start+o.count);for(let g=d,v=f;g<v;g++)Fc.fromBufferAttribute(u,g),Cg(Fc,g,l,s,e,t,this)}}updateMorphTargets(){let t=this.geometry.morphAttributes,i=Object.keys(t);if(i.length>0){let s=t[i[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function Cg(n,e,t,i,s,r,o){let a=cf.distanceSqToPoint(n);if(a<t){let l=new B;cf.closestPointToPoint(n,l),l.applyMatrix4(i);let c=s.ray.origin.distanceTo(l);if(c<s.near||c>s.far)return;r.push({distance:c,distanceToRay:Math.sqrt(a),point:l,index:e,face:null,faceIndex:null,barycoord:null,object:o})}}var ja=class extends si{constructor(e=[],t=zr,i,s,r,o,a,l,c,h){super(e,t,i,s,r,o,a,l,c,h),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(e){this.image=e}},Qa=class extends si{constructor(e,t,i,s,r,o,a,l,c){super(e,t,i,s,r,o,a,l,c),this.isCanvasTexture=!0,this.needsUpdate=!0}};var Fs=class extends si{constructor(e,t,i=qi,s,r,o,a=zn,l=zn,c,h=Ls,u=1){if(h!==Ls&&h!==Bs)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let d={width:e,height:t,depth:u};super(d,s,r,o,a,l,h,i,c),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(e){return super.copy(e),this.source=new No(Object.assign({},e.image)),this.compareFunction=e.compareFunction,this}toJSON(e){let t=super.toJSON(e);return t.compareFunction=this.compareFunction,t}},el=class extends Fs{constructor(e,t=qi,i=zr,s,r,o=zn,a=zn,l,c=Ls){let h={width:e,height:e,depth:1},u=[h,h,h,h,h,h];super(e,e,t,i,s,r,o,a,l,c),this.image=u,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(e){this.image=e}},tl=class extends si{constructor(e=null){super(),this.sourceTexture=e,this.isExternalTexture=!0}copy(e){return super.copy(e),this.sourceTexture=e.sourceTexture,this}},ar=class n extends Xt{constructor(e=1,t=1,i=1,s=1,r=1,o=1){super(),this.type="BoxGeometry",this.parameters={width:e,height:t,depth:i,widthSegments:s,heightSegments:r,depthSegments:o};let a=this;s=Math.floor(s),r=Math.floor(r),o=Math.floor(o);let l=[],c=[],h=[],u=[],d=0,f=0;g("z","y","x",-1,-1,i,t,e,o,r,0),g("z","y","x",1,-1,i,t,-e,o,r,1),g("x","z","y",1,1,e,i,t,s,o,2),g("x","z","y",1,-1,e,i,-t,s,o,3),g("x","y","z",1,-1,e,t,i,s,r,4),g("x","y","z",-1,-1,e,t,-i,s,r,5),this.setIndex(l),this.setAttribute("position",new un(c,3)),this.setAttribute("normal",new un(h,3)),this.setAttribute("uv",new un(u,2));function g(v,m,p,y,C,w,P,E,x,T,k){let N=w/x,L=P/T,z=w/2,W=P/2,D=E/2,X=x+1,$=T+1,H=0,he=0,J=new B;for(let Q=0;Q<$;Q++){let re=Q*L-W;for(let fe=0;fe<X;fe++){let de=fe*N-z;J[v]=de*y,J[m]=re*C,J[p]=D,c.push(J.x,J.y,J.z),J[v]=0,J[m]=0,J[p]=E>0?1:-1,h.push(J.x,J.y,J.z),u.push(fe/x),u.push(1-Q/T),H+=1}}for(let Q=0;Q<T;Q++)for(let re=0;re<x;re++){let fe=d+re+X*Q,de=d+re+X*(Q+1),te=d+(re+1)+X*(Q+1),ge=d+(re+1)+X*Q;l.push(fe,de,ge),l.push(de,te,ge),he+=6}a.addGroup(f,he,k),f+=he,d+=H}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new n(e.width,e.height,e.depth,e.widthSegments,e.heightSegments,e.depthSegments)}};var lr=class n extends Xt{constructor(e=1,t=1,i=1,s=32,r=1,o=!1,a=0,l=Math.PI*2){super(),this.type="CylinderGeometry",this.parameters={radiusTop:e,radiusBottom:t,height:i,radialSegments:s,heightSegments:r,openEnded:o,thetaStart:a,thetaLength:l};let c=this;s=Math.floor(s),r=Math.floor(r);let h=[],u=[],d=[],f=[],g=0,v=[],m=i/2,p=0;y(),o===!1&&(e>0&&C(!0),t>0&&C(!1)),this.setIndex(h),this.setAttribute("position",new un(u,3)),this.setAttribute("normal",new un(d,3)),this.setAttribute("uv",new un(f,2));function y(){let w=new B,P=new B,E=0,x=(t-e)/i;for(let T=0;T<=r;T++){let k=[],N=T/r,L=N*(t-e)+e;for(let z=0;z<=s;z++){let W=z/s,D=W*l+a,X=Math.sin(D),$=Math.cos(D);P.x=L*X,P.y=-N*i+m,P.z=L*$,u.push(P.x,P.y,P.z),w.set(X,x,$).normalize(),d.push(w.x,w.y,w.z),f.push(W,1-N),k.push(g++)}v.push(k)}for(let T=0;T<s;T++)for(let k=0;k<r;k++){let N=v[k][T],L=v[k+1][T],z=v[k+1][T+1],W=v[k][T+1];(e>0||k!==0)&&(h.push(N,L,W),E+=3),(t>0||k!==r-1)&&(h.push(L,z,W),E+=3)}c.addGroup(p,E,0),p+=E}function C(w){let P=g,E=new $e,x=new B,T=0,k=w===!0?e:t,N=w===!0?1:-1;for(let z=1;z<=s;z++)u.push(0,m*N,0),d.push(0,N,0),f.push(.5,.5),g++;let L=g;for(let z=0;z<=s;z++){let D=z/s*l+a,X=Math.cos(D),$=Math.sin(D);x.x=k*$,x.y=m*N,x.z=k*X,u.push(x.x,x.y,x.z),d.push(0,N,0),E.x=X*.5+.5,E.y=$*.5*N+.5,f.push(E.x,E.y),g++}for(let z=0;z<s;z++){let W=P+z,D=L+z;w===!0?h.push(D,D+1,W):h.push(D+1,D,W),T+=3}c.addGroup(p,T,w===!0?1:2),p+=T}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new n(e.radiusTop,e.radiusBottom,e.height,e.radialSegments,e.heightSegments,e.openEnded,e.thetaStart,e.thetaLength)}},nl=class n extends lr{constructor(e=1,t=1,i=32,s=1,r=!1,o=0,a=Math.PI*2){super(0,e,t,i,s,r,o,a),this.type="ConeGeometry",this.parameters={radius:e,height:t,radialSegments:i,heightSegments:s,openEnded:r,thetaStart:o,thetaLength:a}}static fromJSON(e){return new n(e.radius,e.height,e.radialSegments,e.heightSegments,e.openEnded,e.thetaStart,e.thetaLength)}};var il=class n extends Xt{constructor(e=1,t=1,i=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:e,height:t,widthSegments:i,heightSegments:s};let r=e/2,o=t/2,a=Math.floor(i),l=Math.floor(s),c=a+1,h=l+1,u=e/a,d=t/l,f=[],g=[],v=[],m=[];for(let p=0;p<h;p++){let y=p*d-o;for(let C=0;C<c;C++){let w=C*u-r;g.push(w,-y,0),v.push(0,0,1),m.push(C/a),m.push(1-p/l)}}for(let p=0;p<l;p++)for(let y=0;y<a;y++){let C=y+c*p,w=y+c*(p+1),P=y+1+c*(p+1),E=y+1+c*p;f.push(C,w,E),f.push(w,P,E)}this.setIndex(f),this.setAttribute("position",new un(g,3)),this.setAttribute("normal",new un(v,3)),this.setAttribute("uv",new un(m,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new n(e.width,e.height,e.widthSegments,e.heightSegments)}};var Or=class n extends Xt{constructor(e=1,t=32,i=16,s=0,r=Math.PI*2,o=0,a=Math.PI){super(),this.type="SphereGeometry",this.parameters={radius:e,widthSegments:t,heightSegments:i,phiStart:s,phiLength:r,thetaStart:o,thetaLength:a},t=Math.max(3,Math.floor(t)),i=Math.max(2,Math.floor(i));let l=Math.min(o+a,Math.PI),c=0,h=[],u=new B,d=new B,f=[],g=[],v=[],m=[];for(let p=0;p<=i;p++){let y=[],C=p/i,w=o+C*a,P=e*Math.cos(w),E=Math.sqrt(e*e-P*P),x=0;p===0&&o===0?x=.5/t:p===i&&l===Math.PI&&(x=-.5/t);for(let T=0;T<=t;T++){let k=T/t,N=s+k*r;u.x=-E*Math.cos(N),u.y=P,u.z=E*Math.sin(N),g.push(u.x,u.y,u.z),d.copy(u).normalize(),v.push(d.x,d.y,d.z),m.push(k+x,1-C),y.push(c++)}h.push(y)}for(let p=0;p<i;p++)for(let y=0;y<t;y++){let C=h[p][y+1],w=h[p][y],P=h[p+1][y],E=h[p+1][y+1];(p!==0||o>0)&&f.push(C,w,E),(p!==i-1||l<Math.PI)&&f.push(w,P,E)}this.setIndex(f),this.setAttribute("position",new un(g,3)),this.setAttribute("normal",new un(v,3)),this.setAttribute("uv",new un(m,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new n(e.radius,e.widthSegments,e.heightSegments,e.phiStart,e.phiLength,e.thetaStart,e.thetaLength)}};function Gr(n){let e={};for(let t in n){e[t]={};for(let i in n[t]){let s=n[t][i];if(Rg(s))s.isRenderTargetTexture?(Ke("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),e[t][i]=null):e[t][i]=s.clone();else if(Array.isArray(s))if(Rg(s[0])){let r=[];for(let o=0,a=s.length;o<a;o++)r[o]=s[o].clone();e[t][i]=r}else e[t][i]=s.slice();else e[t][i]=s}}return e}function $n(n){let e={};for(let t=0;t<n.length;t++){let i=Gr(n[t]);for(let s in i)e[s]=i[s]}return e}function Rg(n){return n&&(n.isColor||n.isMatrix3||n.isMatrix4||n.isVector2||n.isVector3||n.isVector4||n.isTexture||n.isQuaternion)}function BS(n){let e=[];for(let t=0;t<n.length;t++)e.push(n[t].clone());return e}function Wf(n){let e=n.getRenderTarget();return e===null?n.outputColorSpace:e.isXRRenderTarget===!0?e.texture.colorSpace:bt.workingColorSpace}var v0={clone:Gr,merge:$n},kS=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,zS=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,ps=class extends Wi{constructor(e){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=kS,this.fragmentShader=zS,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,e!==void 0&&this.setValues(e)}copy(e){return super.copy(e),this.fragmentShader=e.fragmentShader,this.vertexShader=e.vertexShader,this.uniforms=Gr(e.uniforms),this.uniformsGroups=BS(e.uniformsGroups),this.defines=Object.assign({},e.defines),this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.fog=e.fog,this.lights=e.lights,this.clipping=e.clipping,this.extensions=Object.assign({},e.extensions),this.glslVersion=e.glslVersion,this.defaultAttributeValues=Object.assign({},e.defaultAttributeValues),this.index0AttributeName=e.index0AttributeName,this.uniformsNeedUpdate=e.uniformsNeedUpdate,this}toJSON(e){let t=super.toJSON(e);t.glslVersion=this.glslVersion,t.uniforms={};for(let s in this.uniforms){let o=this.uniforms[s].value;o&&o.isTexture?t.uniforms[s]={type:"t",value:o.toJSON(e).uuid}:o&&o.isColor?t.uniforms[s]={type:"c",value:o.getHex()}:o&&o.isVector2?t.uniforms[s]={type:"v2",value:o.toArray()}:o&&o.isVector3?t.uniforms[s]={type:"v3",value:o.toArray()}:o&&o.isVector4?t.uniforms[s]={type:"v4",value:o.toArray()}:o&&o.isMatrix3?t.uniforms[s]={type:"m3",value:o.toArray()}:o&&o.isMatrix4?t.uniforms[s]={type:"m4",value:o.toArray()}:t.uniforms[s]={value:o}}Object.keys(this.defines).length>0&&(t.defines=this.defines),t.vertexShader=this.vertexShader,t.fragmentShader=this.fragmentShader,t.lights=this.lights,t.clipping=this.clipping;let i={};for(let s in this.extensions)this.extensions[s]===!0&&(i[s]=!0);return Object.keys(i).length>0&&(t.extensions=i),t}fromJSON(e,t){if(super.fromJSON(e,t),e.uniforms!==void 0)for(let i in e.uniforms){let s=e.uniforms[i];switch(this.uniforms[i]={},s.type){case"t":this.uniforms[i].value=t[s.value]||null;break;case"c":this.uniforms[i].value=new je().setHex(s.value);break;case"v2":this.uniforms[i].value=new $e().fromArray(s.value);break;case"v3":this.uniforms[i].value=new B().fromArray(s.value);break;case"v4":this.uniforms[i].value=new tn().fromArray(s.value);break;case"m3":this.uniforms[i].value=new st().fromArray(s.value);break;case"m4":this.uniforms[i].value=new Pt().fromArray(s.value);break;default:this.uniforms[i].value=s.value}}if(e.defines!==void 0&&(this.defines=e.defines),e.vertexShader!==void 0&&(this.vertexShader=e.vertexShader),e.fragmentShader!==void 0&&(this.fragmentShader=e.fragmentShader),e.glslVersion!==void 0&&(this.glslVersion=e.glslVersion),e.extensions!==void 0)for(let i in e.extensions)this.extensions[i]=e.extensions[i];return e.lights!==void 0&&(this.lights=e.lights),e.clipping!==void 0&&(this.clipping=e.clipping),this}},oh=class extends ps{constructor(e){super(e),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}};var sl=class extends Wi{constructor(e){super(),this.isMeshLambertMaterial=!0,this.type="MeshLambertMaterial",this.color=new je(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new je(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=au,this.normalScale=new $e(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new Ns,this.combine=Sh,this.reflectivity=1,this.envMapIntensity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.emissive.copy(e.emissive),this.emissiveMap=e.emissiveMap,this.emissiveIntensity=e.emissiveIntensity,this.bumpMap=e.bumpMap,this.bumpScale=e.bumpScale,this.normalMap=e.normalMap,this.normalMapType=e.normalMapType,this.normalScale.copy(e.normalScale),this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.specularMap=e.specularMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.combine=e.combine,this.reflectivity=e.reflectivity,this.envMapIntensity=e.envMapIntensity,this.refractionRatio=e.refractionRatio,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.flatShading=e.flatShading,this.fog=e.fog,this}},ah=class extends Wi{constructor(e){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=o0,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(e)}copy(e){return super.copy(e),this.depthPacking=e.depthPacking,this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this}},lh=class extends Wi{constructor(e){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(e)}copy(e){return super.copy(e),this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this}};function Eo(n,e){return!n||n.constructor===e?n:typeof e.BYTES_PER_ELEMENT=="number"?new e(n):Array.prototype.slice.call(n)}function Oc(n){return n!==void 0&&n.inTangents!==void 0&&n.outTangents!==void 0}var cr=class{constructor(e,t,i,s){this.parameterPositions=e,this._cachedIndex=0,this.resultBuffer=s!==void 0?s:new t.constructor(i),this.sampleValues=t,this.valueSize=i,this.settings=null,this.DefaultSettings_={}}evaluate(e){let t=this.parameterPositions,i=this._cachedIndex,s=t[i],r=t[i-1];n:{e:{let o;t:{i:if(!(e<s)){for(let a=i+2;;){if(s===void 0){if(e<r)break i;return i=t.length,this._cachedIndex=i,this.copySampleValue_(i-1)}if(i===a)break;if(r=s,s=t[++i],e<s)break e}o=t.length;break t}if(!(e>=r)){let a=t[1];e<a&&(i=2,r=a);for(let l=i-2;;){if(r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(i===l)break;if(s=r,r=t[--i-1],e>=r)break e}o=i,i=0;break t}break n}for(;i<o;){let a=i+o>>>1;e<t[a]?o=a:i=a+1}if(s=t[i],r=t[i-1],r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(s===void 0)return i=t.length,this._cachedIndex=i,this.copySampleValue_(i-1)}this._cachedIndex=i,this.intervalChanged_(i,r,s)}return this.interpolate_(i,r,e,s)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(e){let t=this.resultBuffer,i=this.sampleValues,s=this.valueSize,r=e*s;for(let o=0;o!==s;++o)t[o]=i[r+o];return t}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},ch=class extends cr{constructor(e,t,i,s){super(e,t,i,s),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:of,endingEnd:of}}intervalChanged_(e,t,i){let s=this.parameterPositions,r=e-2,o=e+1,a=s[r],l=s[o];if(a===void 0)switch(this.getSettings_().endingStart){case af:r=e,a=2*t-i;break;case lf:r=s.length-2,a=t+s[r]-s[r+1];break;default:r=e,a=i}if(l===void 0)switch(this.getSettings_().endingEnd){case af:o=e,l=2*i-t;break;case lf:o=1,l=i+s[1]-s[0];break;default:o=e-1,l=t}let c=(i-t)*.5,h=this.valueSize;this._weightPrev=c/(t-a),this._weightNext=c/(l-i),this._offsetPrev=r*h,this._offsetNext=o*h}interpolate_(e,t,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=this._offsetPrev,u=this._offsetNext,d=this._weightPrev,f=this._weightNext,g=(i-t)/(s-t),v=g*g,m=v*g,p=-d*m+2*d*v-d*g,y=(1+d)*m+(-1.5-2*d)*v+(-.5+d)*g+1,C=(-1-f)*m+(1.5+f)*v+.5*g,w=f*m-f*v;for(let P=0;P!==a;++P)r[P]=p*o[h+P]+y*o[c+P]+C*o[l+P]+w*o[u+P];return r}},hh=class extends cr{constructor(e,t,i,s){super(e,t,i,s)}interpolate_(e,t,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=(i-t)/(s-t),u=1-h;for(let d=0;d!==a;++d)r[d]=o[c+d]*u+o[l+d]*h;return r}},uh=class extends cr{constructor(e,t,i,s){super(e,t,i,s)}interpolate_(e){return this.copySampleValue_(e-1)}},dh=class extends cr{interpolate_(e,t,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=this.inTangents,u=this.outTangents;if(!h||!u){let g=(i-t)/(s-t),v=1-g;for(let m=0;m!==a;++m)r[m]=o[c+m]*v+o[l+m]*g;return r}let d=a*2,f=e-1;for(let g=0;g!==a;++g){let v=o[c+g],m=o[l+g],p=f*d+g*2,y=u[p],C=u[p+1],w=e*d+g*2,P=h[w],E=h[w+1],x=GS(i,t,y,P,s);r[g]=S0(x,v,C,E,m)}return r}};function S0(n,e,t,i,s){let r=1-n;return r*r*r*e+3*r*r*n*t+3*r*n*n*i+n*n*n*s}function VS(n,e,t,i,s){let r=1-n;return 3*r*r*(t-e)+6*r*n*(i-t)+3*n*n*(s-i)}function GS(n,e,t,i,s){let r=(n-e)/(s-e);for(let o=0;o<8;o++){let a=S0(r,e,t,i,s)-n;if(Math.abs(a)<1e-10)break;let l=VS(r,e,t,i,s);if(Math.abs(l)<1e-10)break;r=Math.max(0,Math.min(1,r-a/l))}return r}var Mi=class{constructor(e,t,i,s){if(e===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(t===void 0||t.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+e);this.name=e,this.times=Eo(t,this.TimeBufferType),this.values=Eo(i,this.ValueBufferType),this.setInterpolation(s||this.DefaultInterpolation)}static toJSON(e){let t=e.constructor,i;if(t.toJSON!==this.toJSON)i=t.toJSON(e);else{i={name:e.name,times:Eo(e.times,Array),values:Eo(e.values,Array)};let s=e.getInterpolation();s!==e.DefaultInterpolation&&(i.interpolation=s),Oc(e.settings)&&(i.settings={inTangents:Eo(e.settings.inTangents,Array),outTangents:Eo(e.settings.outTangents,Array)})}return i.type=e.ValueTypeName,i}InterpolantFactoryMethodDiscrete(e){return new uh(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodLinear(e){return new hh(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodSmooth(e){return new ch(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodBezier(e){let t=new dh(this.times,this.values,this.getValueSize(),e);return this.settings&&(t.inTangents=this.settings.inTangents,t.outTangents=this.settings.outTangents),t}setInterpolation(e){let t;switch(e){case Va:t=this.InterpolantFactoryMethodDiscrete;break;case Jc:t=this.InterpolantFactoryMethodLinear;break;case zc:t=this.InterpolantFactoryMethodSmooth;break;case rf:t=this.InterpolantFactoryMethodBezier;break}if(t===void 0){let i="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(e!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(i);return Ke("KeyframeTrack:",i),this}return this.createInterpolant=t,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return Va;case this.InterpolantFactoryMethodLinear:return Jc;case this.InterpolantFactoryMethodSmooth:return zc;case this.InterpolantFactoryMethodBezier:return rf}}getValueSize(){return this.values.length/this.times.length}shift(e){if(e!==0){let t=this.times;for(let i=0,s=t.length;i!==s;++i)t[i]+=e;Oc(this.settings)&&(Pg(this.settings.inTangents,e),Pg(this.settings.outTangents,e))}return this}scale(e){if(e!==1){let t=this.times;for(let i=0,s=t.length;i!==s;++i)t[i]*=e;Oc(this.settings)&&(Ig(this.settings.inTangents,e),Ig(this.settings.outTangents,e))}return this}trim(e,t){let i=this.times,s=i.length,r=0,o=s-1;for(;r!==s&&i[r]<e;)++r;for(;o!==-1&&i[o]>t;)--o;if(++o,r!==0||o!==s){r>=o&&(o=Math.max(o,1),r=o-1);let a=this.getValueSize();this.times=i.slice(r,o),this.values=this.values.slice(r*a,o*a)}return this}validate(){let e=!0,t=this.getValueSize();t-Math.floor(t)!==0&&(it("KeyframeTrack: Invalid value size in track.",this),e=!1);let i=this.times,s=this.values,r=i.length;r===0&&(it("KeyframeTrack: Track is empty.",this),e=!1);let o=null;for(let a=0;a!==r;a++){let l=i[a];if(typeof l=="number"&&isNaN(l)){it("KeyframeTrack: Time is not a valid number.",this,a,l),e=!1;break}if(o!==null&&o>l){it("KeyframeTrack: Out of order keys.",this,a,l,o),e=!1;break}o=l}if(s!==void 0&&sS(s))for(let a=0,l=s.length;a!==l;++a){let c=s[a];if(isNaN(c)){it("KeyframeTrack: Value is not a valid number.",this,a,c),e=!1;break}}return e}optimize(){let e=this.times.slice(),t=this.values.slice(),i=this.getValueSize(),s=this.getInterpolation()===zc,r=e.length-1,o=1;for(let a=1;a<r;++a){let l=!1,c=e[a],h=e[a+1];if(c!==h&&(a!==1||c!==e[0]))if(s)l=!0;else{let u=a*i,d=u-i,f=u+i;for(let g=0;g!==i;++g){let v=t[u+g];if(v!==t[d+g]||v!==t[f+g]){l=!0;break}}}if(l){if(a!==o){e[o]=e[a];let u=a*i,d=o*i;for(let f=0;f!==i;++f)t[d+f]=t[u+f]}++o}}if(r>0){e[o]=e[r];for(let a=r*i,l=o*i,c=0;c!==i;++c)t[l+c]=t[a+c];++o}return o!==e.length?(this.times=e.slice(0,o),this.values=t.slice(0,o*i)):(this.times=e,this.values=t),this}clone(){let e=this.times.slice(),t=this.values.slice(),i=this.constructor,s=new i(this.name,e,t);return s.createInterpolant=this.createInterpolant,Oc(this.settings)&&(s.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),s}};function Pg(n,e){for(let t=0,i=n.length;t!==i;t+=2)n[t]+=e}function Ig(n,e){for(let t=0,i=n.length;t!==i;t+=2)n[t]*=e}Mi.prototype.ValueTypeName="";Mi.prototype.TimeBufferType=Float32Array;Mi.prototype.ValueBufferType=Float32Array;Mi.prototype.DefaultInterpolation=Jc;var hr=class extends Mi{constructor(e,t,i){super(e,t,i)}};hr.prototype.ValueTypeName="bool";hr.prototype.ValueBufferType=Array;hr.prototype.DefaultInterpolation=Va;hr.prototype.InterpolantFactoryMethodLinear=void 0;hr.prototype.InterpolantFactoryMethodSmooth=void 0;var fh=class extends Mi{constructor(e,t,i,s){super(e,t,i,s)}};fh.prototype.ValueTypeName="color";var ph=class extends Mi{constructor(e,t,i,s){super(e,t,i,s)}};ph.prototype.ValueTypeName="number";var mh=class extends cr{constructor(e,t,i,s){super(e,t,i,s)}interpolate_(e,t,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=(i-t)/(s-t),c=e*a;for(let h=c+a;c!==h;c+=4)ii.slerpFlat(r,0,o,c-a,o,c,l);return r}},rl=class extends Mi{constructor(e,t,i,s){super(e,t,i,s)}InterpolantFactoryMethodLinear(e){return new mh(this.times,this.values,this.getValueSize(),e)}};rl.prototype.ValueTypeName="quaternion";rl.prototype.InterpolantFactoryMethodSmooth=void 0;var ur=class extends Mi{constructor(e,t,i){super(e,t,i)}};ur.prototype.ValueTypeName="string";ur.prototype.ValueBufferType=Array;ur.prototype.DefaultInterpolation=Va;ur.prototype.InterpolantFactoryMethodLinear=void 0;ur.prototype.InterpolantFactoryMethodSmooth=void 0;var gh=class extends Mi{constructor(e,t,i,s){super(e,t,i,s)}};gh.prototype.ValueTypeName="vector";var _h=class{constructor(e,t,i){let s=this,r=!1,o=0,a=0,l,c=[];this.onStart=void 0,this.onLoad=e,this.onProgress=t,this.onError=i,this._abortController=null,this.itemStart=function(h){a++,r===!1&&s.onStart!==void 0&&s.onStart(h,o,a),r=!0},this.itemEnd=function(h){o++,s.onProgress!==void 0&&s.onProgress(h,o,a),o===a&&(r=!1,s.onLoad!==void 0&&s.onLoad())},this.itemError=function(h){s.onError!==void 0&&s.onError(h)},this.resolveURL=function(h){return h=h.normalize("NFC"),l?l(h):h},this.setURLModifier=function(h){return l=h,this},this.addHandler=function(h,u){return c.push(h,u),this},this.removeHandler=function(h){let u=c.indexOf(h);return u!==-1&&c.splice(u,2),this},this.getHandler=function(h){for(let u=0,d=c.length;u<d;u+=2){let f=c[u],g=c[u+1];if(f.global&&(f.lastIndex=0),f.test(h))return g}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},b0=new _h,xh=class{constructor(e){this.manager=e!==void 0?e:b0,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(e,t){let i=this;return new Promise(function(s,r){i.load(e,s,t,r)})}parse(){}setCrossOrigin(e){return this.crossOrigin=e,this}setWithCredentials(e){return this.withCredentials=e,this}setPath(e){return this.path=e,this}setResourcePath(e){return this.resourcePath=e,this}setRequestHeader(e){return this.requestHeader=e,this}setPriority(e){return this.priority=e,this}setCache(e){return this.cache=e,this}abort(){return this}};xh.DEFAULT_MATERIAL_NAME="__DEFAULT";var ol=class extends En{static registerNode(e){this.prototype._lightNode=e}constructor(e,t=1){super(),this.isLight=!0,this.type="Light",this.color=new je(e),this.intensity=t}copy(e,t){return super.copy(e,t),this.color.copy(e.color),this.intensity=e.intensity,this}toJSON(e){let t=super.toJSON(e);return t.object.color=this.color.getHex(),t.object.intensity=this.intensity,t}},al=class extends ol{constructor(e,t,i){super(e,i),this.isHemisphereLight=!0,this.type="HemisphereLight",this.position.copy(En.DEFAULT_UP),this.updateMatrix(),this.groundColor=new je(t)}copy(e,t){return super.copy(e,t),this.groundColor.copy(e.groundColor),this}toJSON(e){let t=super.toJSON(e);return t.object.groundColor=this.groundColor.getHex(),t}},sf=new Pt,Dg=new B,Lg=new B,yh=class{constructor(e){this.camera=e,this.intensity=1,this.bias=0,this.biasNode=null,this.normalBias=0,this.radius=1,this.blurSamples=8,this.mapSize=new $e(512,512),this.mapType=hi,this.map=null,this.mapPass=null,this.matrix=new Pt,this.autoUpdate=!0,this.needsUpdate=!1,this._frustum=new or,this._frameExtents=new $e(1,1),this._viewportCount=1,this._viewports=[new tn(0,0,1,1)]}getViewportCount(){return this._viewportCount}getCamera(){return this.camera}getFrustum(){return this._frustum}updateMatrices(e){let t=this.camera;Dg.setFromMatrixPosition(e.matrixWorld),t.position.copy(Dg),Lg.setFromMatrixPosition(e.target.matrixWorld),t.lookAt(Lg),t.updateMatrixWorld(),this._updateMatrix(t,this.matrix,this._frustum)}_updateMatrix(e,t,i,s){sf.multiplyMatrices(e.projectionMatrix,e.matrixWorldInverse),i.setFromProjectionMatrix(sf,e.coordinateSystem,e.reversedDepth);let r=this._frameExtents,o=s?s.z/r.x:1,a=s?s.w/r.y:1,l=s?s.x/r.x:0,c=s?s.y/r.y:0;e.coordinateSystem===Io||e.reversedDepth?t.set(.5*o,0,0,.5*o+l,0,.5*a,0,.5*a+c,0,0,1,0,0,0,0,1):t.set(.5*o,0,0,.5*o+l,0,.5*a,0,.5*a+c,0,0,.5,.5,0,0,0,1),t.multiply(sf)}getViewport(e){return this._viewports[e]}getFrameExtents(){return this._frameExtents}dispose(){this.map&&this.map.dispose(),this.mapPass&&this.mapPass.dispose()}copy(e){return this.camera=e.camera.clone(),this.intensity=e.intensity,this.bias=e.bias,this.radius=e.radius,this.autoUpdate=e.autoUpdate,this.needsUpdate=e.needsUpdate,this.normalBias=e.normalBias,this.blurSamples=e.blurSamples,this.mapSize.copy(e.mapSize),this.mapType=e.mapType,this.biasNode=e.biasNode,this}clone(){return new this.constructor().copy(this)}toJSON(){let e={};return e.intensity=this.intensity,e.bias=this.bias,e.normalBias=this.normalBias,e.radius=this.radius,e.blurSamples=this.blurSamples,e.mapSize=this.mapSize.toArray(),e.mapType=this.mapType,e.camera=this.camera.toJSON(!1).object,delete e.camera.matrix,e}},Bc=new B,kc=new ii,us=new B,ll=class extends En{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new Pt,this.projectionMatrix=new Pt,this.projectionMatrixInverse=new Pt,this.coordinateSystem=Di,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(e,t){return super.copy(e,t),this.matrixWorldInverse.copy(e.matrixWorldInverse),this.projectionMatrix.copy(e.projectionMatrix),this.projectionMatrixInverse.copy(e.projectionMatrixInverse),this.coordinateSystem=e.coordinateSystem,this}getWorldDirection(e){return super.getWorldDirection(e).negate()}updateMatrixWorld(e){super.updateMatrixWorld(e),this.matrixWorld.decompose(Bc,kc,us),us.x===1&&us.y===1&&us.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Bc,kc,us.set(1,1,1)).invert()}updateWorldMatrix(e,t,i=!1){super.updateWorldMatrix(e,t,i),this.matrixWorld.decompose(Bc,kc,us),us.x===1&&us.y===1&&us.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Bc,kc,us.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},ir=new B,Ng=new $e,Ug=new $e,ti=class extends ll{constructor(e=50,t=1,i=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=e,this.zoom=1,this.near=i,this.far=s,this.focus=10,this.aspect=t,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.fov=e.fov,this.zoom=e.zoom,this.near=e.near,this.far=e.far,this.focus=e.focus,this.aspect=e.aspect,this.view=e.view===null?null:Object.assign({},e.view),this.filmGauge=e.filmGauge,this.filmOffset=e.filmOffset,this}setFocalLength(e){let t=.5*this.getFilmHeight()/e;this.fov=Lo*2*Math.atan(t),this.updateProjectionMatrix()}getFocalLength(){let e=Math.tan(ka*.5*this.fov);return .5*this.getFilmHeight()/e}getEffectiveFOV(){return Lo*2*Math.atan(Math.tan(ka*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(e,t,i){ir.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),t.set(ir.x,ir.y).multiplyScalar(-e/ir.z),ir.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),i.set(ir.x,ir.y).multiplyScalar(-e/ir.z)}getViewSize(e,t){return this.getViewBounds(e,Ng,Ug),t.subVectors(Ug,Ng)}setViewOffset(e,t,i,s,r,o){this.aspect=e/t,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=i,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=this.near,t=e*Math.tan(ka*.5*this.fov)/this.zoom,i=2*t,s=this.aspect*i,r=-.5*s,o=this.view;if(this.view!==null&&this.view.enabled){let l=o.fullWidth,c=o.fullHeight;r+=o.offsetX*s/l,t-=o.offsetY*i/c,s*=o.width/l,i*=o.height/c}let a=this.filmOffset;a!==0&&(r+=e*a/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+s,t,t-i,e,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.fov=this.fov,t.object.zoom=this.zoom,t.object.near=this.near,t.object.far=this.far,t.object.focus=this.focus,t.object.aspect=this.aspect,this.view!==null&&(t.object.view=Object.assign({},this.view)),t.object.filmGauge=this.filmGauge,t.object.filmOffset=this.filmOffset,t}};var cl=class extends ll{constructor(e=-1,t=1,i=1,s=-1,r=.1,o=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=e,this.right=t,this.top=i,this.bottom=s,this.near=r,this.far=o,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.left=e.left,this.right=e.right,this.top=e.top,this.bottom=e.bottom,this.near=e.near,this.far=e.far,this.zoom=e.zoom,this.view=e.view===null?null:Object.assign({},e.view),this}setViewOffset(e,t,i,s,r,o){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=i,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=(this.right-this.left)/(2*this.zoom),t=(this.top-this.bottom)/(2*this.zoom),i=(this.right+this.left)/2,s=(this.top+this.bottom)/2,r=i-e,o=i+e,a=s+t,l=s-t;if(this.view!==null&&this.view.enabled){let c=(this.right-this.left)/this.view.fullWidth/this.zoom,h=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=c*this.view.offsetX,o=r+c*this.view.width,a-=h*this.view.offsetY,l=a-h*this.view.height}this.projectionMatrix.makeOrthographic(r,o,a,l,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.zoom=this.zoom,t.object.left=this.left,t.object.right=this.right,t.object.top=this.top,t.object.bottom=this.bottom,t.object.near=this.near,t.object.far=this.far,this.view!==null&&(t.object.view=Object.assign({},this.view)),t}},hf=class extends yh{constructor(){super(new cl(-5,5,5,-5,.5,500)),this.isDirectionalLightShadow=!0}},hl=class extends ol{constructor(e,t){super(e,t),this.isDirectionalLight=!0,this.type="DirectionalLight",this.position.copy(En.DEFAULT_UP),this.updateMatrix(),this.target=new En,this.shadow=new hf}dispose(){super.dispose(),this.shadow.dispose()}copy(e){return super.copy(e),this.target=e.target.clone(),this.shadow=e.shadow.clone(),this}toJSON(e){let t=super.toJSON(e);return t.object.shadow=this.shadow.toJSON(),t.object.target=this.target.uuid,t}};var Ao=-90,Co=1,ko=class extends En{constructor(e,t,i){super(),this.type="CubeCamera",this.renderTarget=i,this.coordinateSystem=null,this.activeMipmapLevel=0;let s=new ti(Ao,Co,e,t);s.layers=this.layers,this.add(s);let r=new ti(Ao,Co,e,t);r.layers=this.layers,this.add(r);let o=new ti(Ao,Co,e,t);o.layers=this.layers,this.add(o);let a=new ti(Ao,Co,e,t);a.layers=this.layers,this.add(a);let l=new ti(Ao,Co,e,t);l.layers=this.layers,this.add(l);let c=new ti(Ao,Co,e,t);c.layers=this.layers,this.add(c)}updateCoordinateSystem(){let e=this.coordinateSystem,t=this.children.concat(),[i,s,r,o,a,l]=t;for(let c of t)this.remove(c);if(e===Di)i.up.set(0,1,0),i.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),o.up.set(0,0,1),o.lookAt(0,-1,0),a.up.set(0,1,0),a.lookAt(0,0,1),l.up.set(0,1,0),l.lookAt(0,0,-1);else if(e===Io)i.up.set(0,-1,0),i.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),o.up.set(0,0,-1),o.lookAt(0,-1,0),a.up.set(0,-1,0),a.lookAt(0,0,1),l.up.set(0,-1,0),l.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+e);for(let c of t)this.add(c),c.updateMatrixWorld()}update(e,t){this.parent===null&&this.updateMatrixWorld();let{renderTarget:i,activeMipmapLevel:s}=this;this.coordinateSystem!==e.coordinateSystem&&(this.coordinateSystem=e.coordinateSystem,this.updateCoordinateSystem());let[r,o,a,l,c,h]=this.children,u=e.getRenderTarget(),d=e.getActiveCubeFace(),f=e.getActiveMipmapLevel(),g=e.xr.enabled;e.xr.enabled=!1;let v=i.texture.mipmapsAutoUpdate;i.texture.mipmapsAutoUpdate=!1;let m=!1;e.isWebGLRenderer===!0?m=e.state.buffers.depth.getReversed():m=e.reversedDepthBuffer,e.setRenderTarget(i,0,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,r),e.setRenderTarget(i,1,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,o),e.setRenderTarget(i,2,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,a),e.setRenderTarget(i,3,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,l),e.setRenderTarget(i,4,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,c),i.texture.mipmapsAutoUpdate=v,e.setRenderTarget(i,5,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,h),e.setRenderTarget(u,d,f),e.xr.enabled=g,i.texture.needsPMREMUpdate=!0}},vh=class extends ti{constructor(e=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=e,this.perCameraFrustumCulled=!1}};var Xf="\\[\\]\\.:\\/",HS=new RegExp("["+Xf+"]","g"),qf="[^"+Xf+"]",WS="[^"+Xf.replace("\\.","")+"]",XS=/((?:WC+[\/:])*)/.source.replace("WC",qf),qS=/(WCOD+)?/.source.replace("WCOD",WS),YS=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",qf),$S=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",qf),ZS=new RegExp("^"+XS+qS+YS+$S+"$"),KS=["material","materials","bones","map"],uf=class{constructor(e,t,i){let s=i||Jt.parseTrackName(t);this._targetGroup=e,this._bindings=e.subscribe_(t,s)}getValue(e,t){this.bind();let i=this._targetGroup.nCachedObjects_,s=this._bindings[i];s!==void 0&&s.getValue(e,t)}setValue(e,t){let i=this._bindings;for(let s=this._targetGroup.nCachedObjects_,r=i.length;s!==r;++s)i[s].setValue(e,t)}bind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,i=e.length;t!==i;++t)e[t].bind()}unbind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,i=e.length;t!==i;++t)e[t].unbind()}},Jt=class n{constructor(e,t,i){this.path=t,this.parsedPath=i||n.parseTrackName(t),this.node=n.findNode(e,this.parsedPath.nodeName),this.rootNode=e,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(e,t,i){return e&&e.isAnimationObjectGroup?new n.Composite(e,t,i):new n(e,t,i)}static sanitizeNodeName(e){return e.replace(/\s/g,"_").replace(HS,"")}static parseTrackName(e){let t=ZS.exec(e);if(t===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+e);let i={nodeName:t[2],objectName:t[3],objectIndex:t[4],propertyName:t[5],propertyIndex:t[6]},s=i.nodeName&&i.nodeName.lastIndexOf(".");if(s!==void 0&&s!==-1){let r=i.nodeName.substring(s+1);KS.indexOf(r)!==-1&&(i.nodeName=i.nodeName.substring(0,s),i.objectName=r)}if(i.propertyName===null||i.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+e);return i}static findNode(e,t){if(t===void 0||t===""||t==="."||t===-1||t===e.name||t===e.uuid)return e;if(e.skeleton){let i=e.skeleton.getBoneByName(t);if(i!==void 0)return i}if(e.children){let i=function(r){for(let o=0;o<r.length;o++){let a=r[o];if(a.name===t||a.uuid===t)return a;let l=i(a.children);if(l)return l}return null},s=i(e.children);if(s)return s}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(e,t){e[t]=this.targetObject[this.propertyName]}_getValue_array(e,t){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)e[t++]=i[s]}_getValue_arrayElement(e,t){e[t]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(e,t){this.resolvedProperty.toArray(e,t)}_setValue_direct(e,t){this.targetObject[this.propertyName]=e[t]}_setValue_direct_setNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(e,t){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=e[t++]}_setValue_array_setNeedsUpdate(e,t){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=e[t++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(e,t){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=e[t++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(e,t){this.resolvedProperty[this.propertyIndex]=e[t]}_setValue_arrayElement_setNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(e,t){this.resolvedProperty.fromArray(e,t)}_setValue_fromArray_setNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(e,t){this.bind(),this.getValue(e,t)}_setValue_unbound(e,t){this.bind(),this.setValue(e,t)}bind(){let e=this.node,t=this.parsedPath,i=t.objectName,s=t.propertyName,r=t.propertyIndex;if(e||(e=n.findNode(this.rootNode,t.nodeName),this.node=e),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!e){Ke("PropertyBinding: No target node found for track: "+this.path+".");return}if(i){let c=t.objectIndex;switch(i){case"materials":if(!e.material){it("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.materials){it("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}e=e.material.materials;break;case"bones":if(!e.skeleton){it("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}e=e.skeleton.bones;for(let h=0;h<e.length;h++)if(e[h].name===c){c=h;break}break;case"map":if("map"in e){e=e.map;break}if(!e.material){it("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.map){it("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}e=e.material.map;break;default:if(e[i]===void 0){it("PropertyBinding: Can not bind to objectName of node undefined.",this);return}e=e[i]}if(c!==void 0){if(e[c]===void 0){it("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,e);return}e=e[c]}}let o=e[s];if(o===void 0){let c=t.nodeName;it("PropertyBinding: Trying to update property for track: "+c+"."+s+" but it wasn't found.",e);return}let a=this.Versioning.None;this.targetObject=e,e.isMaterial===!0?a=this.Versioning.NeedsUpdate:e.isObject3D===!0&&(a=this.Versioning.MatrixWorldNeedsUpdate);let l=this.BindingType.Direct;if(r!==void 0){if(s==="morphTargetInfluences"){if(!e.geometry){it("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!e.geometry.morphAttributes){it("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}e.morphTargetDictionary[r]!==void 0&&(r=e.morphTargetDictionary[r])}l=this.BindingType.ArrayElement,this.resolvedProperty=o,this.propertyIndex=r}else o.fromArray!==void 0&&o.toArray!==void 0?(l=this.BindingType.HasFromToArray,this.resolvedProperty=o):Array.isArray(o)?(l=this.BindingType.EntireArray,this.resolvedProperty=o):this.propertyName=s;this.getValue=this.GetterByBindingType[l],this.setValue=this.SetterByBindingTypeAndVersioning[l][a]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};Jt.Composite=uf;Jt.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};Jt.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};Jt.prototype.GetterByBindingType=[Jt.prototype._getValue_direct,Jt.prototype._getValue_array,Jt.prototype._getValue_arrayElement,Jt.prototype._getValue_toArray];Jt.prototype.SetterByBindingTypeAndVersioning=[[Jt.prototype._setValue_direct,Jt.prototype._setValue_direct_setNeedsUpdate,Jt.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[Jt.prototype._setValue_array,Jt.prototype._setValue_array_setNeedsUpdate,Jt.prototype._setValue_array_setMatrixWorldNeedsUpdate],[Jt.prototype._setValue_arrayElement,Jt.prototype._setValue_arrayElement_setNeedsUpdate,Jt.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[Jt.prototype._setValue_fromArray,Jt.prototype._setValue_fromArray_setNeedsUpdate,Jt.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var SR=new Float32Array(1);var zo=class{constructor(e=1,t=0,i=0){this.radius=e,this.phi=t,this.theta=i}set(e,t,i){return this.radius=e,this.phi=t,this.theta=i,this}copy(e){return this.radius=e.radius,this.phi=e.phi,this.theta=e.theta,this}makeSafe(){return this.phi=xt(this.phi,1e-6,Math.PI-1e-6),this}setFromVector3(e){return this.setFromCartesianCoords(e.x,e.y,e.z)}setFromCartesianCoords(e,t,i){return this.radius=Math.sqrt(e*e+t*t+i*i),this.radius===0?(this.theta=0,this.phi=0):(this.theta=Math.atan2(e,i),this.phi=Math.acos(xt(t/this.radius,-1,1))),this}clone(){return new this.constructor().copy(this)}};var df=class{static{this.prototype.isMatrix2=!0}constructor(e,t,i,s){this.elements=[1,0,0,1],e!==void 0&&this.set(e,t,i,s)}identity(){return this.set(1,0,0,1),this}fromArray(e,t=0){for(let i=0;i<4;i++)this.elements[i]=e[i+t];return this}set(e,t,i,s){let r=this.elements;return r[0]=e,r[2]=t,r[1]=i,r[3]=s,this}};var ul=class extends fs{constructor(e=10,t=10,i=4473924,s=8947848){i=new je(i),s=new je(s);let r=t/2,o=e/t,a=e/2,l=[],c=[];for(let d=0,f=0,g=-a;d<=t;d++,g+=o){l.push(-a,0,g,a,0,g),l.push(g,0,-a,g,0,a);let v=d===r?i:s;v.toArray(c,f),f+=3,v.toArray(c,f),f+=3,v.toArray(c,f),f+=3,v.toArray(c,f),f+=3}let h=new Xt;h.setAttribute("position",new un(l,3)),h.setAttribute("color",new un(c,3));let u=new Xi({vertexColors:!0,toneMapped:!1});super(h,u),this.type="GridHelper"}dispose(){super.dispose(),this.geometry.dispose(),this.material.dispose()}};var dl=class extends Gi{constructor(e,t=null){super(),this.object=e,this.domElement=t,this.enabled=!0,this.state=-1,this.keys={},this.mouseButtons={LEFT:null,MIDDLE:null,RIGHT:null},this.touches={ONE:null,TWO:null}}connect(e){this.domElement!==null&&this.disconnect(),this.domElement=e}disconnect(){}dispose(){}update(){}};function Yf(n,e,t,i){let s=JS(i);switch(t){case If:return n*e;case Lf:return n*e/s.components*s.byteLength;case Ch:return n*e/s.components*s.byteLength;case mr:return n*e*2/s.components*s.byteLength;case Rh:return n*e*2/s.components*s.byteLength;case Df:return n*e*3/s.components*s.byteLength;case Zi:return n*e*4/s.components*s.byteLength;case Ph:return n*e*4/s.components*s.byteLength;case ml:case gl:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*8;case _l:case xl:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*16;case Dh:case Nh:return Math.max(n,16)*Math.max(e,8)/4;case Ih:case Lh:return Math.max(n,8)*Math.max(e,8)/2;case Uh:case Fh:case Bh:case kh:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*8;case Oh:case yl:case zh:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*16;case Vh:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*16;case Gh:return Math.floor((n+4)/5)*Math.floor((e+3)/4)*16;case Hh:return Math.floor((n+4)/5)*Math.floor((e+4)/5)*16;case Wh:return Math.floor((n+5)/6)*Math.floor((e+4)/5)*16;case Xh:return Math.floor((n+5)/6)*Math.floor((e+5)/6)*16;case qh:return Math.floor((n+7)/8)*Math.floor((e+4)/5)*16;case Yh:return Math.floor((n+7)/8)*Math.floor((e+5)/6)*16;case $h:return Math.floor((n+7)/8)*Math.floor((e+7)/8)*16;case Zh:return Math.floor((n+9)/10)*Math.floor((e+4)/5)*16;case Kh:return Math.floor((n+9)/10)*Math.floor((e+5)/6)*16;case Jh:return Math.floor((n+9)/10)*Math.floor((e+7)/8)*16;case jh:return Math.floor((n+9)/10)*Math.floor((e+9)/10)*16;case Qh:return Math.floor((n+11)/12)*Math.floor((e+9)/10)*16;case eu:return Math.floor((n+11)/12)*Math.floor((e+11)/12)*16;case tu:case nu:case iu:return Math.ceil(n/4)*Math.ceil(e/4)*16;case su:case ru:return Math.ceil(n/4)*Math.ceil(e/4)*8;case vl:case ou:return Math.ceil(n/4)*Math.ceil(e/4)*16}throw new Error(`Unable to determine texture byte length for ${t} format.`)}function JS(n){switch(n){case hi:case Af:return{byteLength:1,components:1};case Wo:case Cf:case $i:return{byteLength:2,components:1};case Eh:case Ah:return{byteLength:2,components:4};case qi:case Th:case Yi:return{byteLength:4,components:1};case Rf:case Pf:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${n}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?Ke("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");function W0(){let n=null,e=!1,t=null,i=null;function s(r,o){i=n.requestAnimationFrame(s),t(r,o)}return{start:function(){e!==!0&&t!==null&&n!==null&&(i=n.requestAnimationFrame(s),e=!0)},stop:function(){n!==null&&n.cancelAnimationFrame(i),e=!1},setAnimationLoop:function(r){t=r},setContext:function(r){n=r}}}function QS(n){let e=new WeakMap;function t(a,l){let c=a.array,h=a.usage,u=c.byteLength,d=n.createBuffer();n.bindBuffer(l,d),n.bufferData(l,c,h),a.onUploadCallback();let f;if(c instanceof Float32Array)f=n.FLOAT;else if(typeof Float16Array<"u"&&c instanceof Float16Array)f=n.HALF_FLOAT;else if(c instanceof Uint16Array)a.isFloat16BufferAttribute?f=n.HALF_FLOAT:f=n.UNSIGNED_SHORT;else if(c instanceof Int16Array)f=n.SHORT;else if(c instanceof Uint32Array)f=n.UNSIGNED_INT;else if(c instanceof Int32Array)f=n.INT;else if(c instanceof Int8Array)f=n.BYTE;else if(c instanceof Uint8Array)f=n.UNSIGNED_BYTE;else if(c instanceof Uint8ClampedArray)f=n.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+c);return{buffer:d,type:f,bytesPerElement:c.BYTES_PER_ELEMENT,version:a.version,size:u}}function i(a,l,c){let h=l.array,u=l.updateRanges;if(n.bindBuffer(c,a),u.length===0)n.bufferSubData(c,0,h);else{u.sort((f,g)=>f.start-g.start);let d=0;for(let f=1;f<u.length;f++){let g=u[d],v=u[f];v.start<=g.start+g.count+1?g.count=Math.max(g.count,v.start+v.count-g.start):(++d,u[d]=v)}u.length=d+1;for(let f=0,g=u.length;f<g;f++){let v=u[f];n.bufferSubData(c,v.start*h.BYTES_PER_ELEMENT,h,v.start,v.count)}l.clearUpdateRanges()}l.onUploadCallback()}function s(a){return a.isInterleavedBufferAttribute&&(a=a.data),e.get(a)}function r(a){a.isInterleavedBufferAttribute&&(a=a.data);let l=e.get(a);l&&(n.deleteBuffer(l.buffer),e.delete(a))}function o(a,l){if(a.isInterleavedBufferAttribute&&(a=a.data),a.isGLBufferAttribute){let h=e.get(a);(!h||h.version<a.version)&&e.set(a,{buffer:a.buffer,type:a.type,bytesPerElement:a.elementSize,version:a.version});return}let c=e.get(a);if(c===void 0)e.set(a,t(a,l));else if(c.version<a.version){if(c.size!==a.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");i(c.buffer,a,l),c.version=a.version}}return{get:s,remove:r,update:o}}var eb=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,tb=`#ifdef USE_ALPHAHASH
	const float ALPHA_HASH_SCALE = 0.05;
	float hash2D( vec2 value ) {
		return fract( 1.0e4 * sin( 17.0 * value.x + 0.1 * value.y ) * ( 0.1 + abs( sin( 13.0 * value.y + value.x ) ) ) );
	}
	float hash3D( vec3 value ) {
		return hash2D( vec2( hash2D( value.xy ), value.z ) );
	}
	float getAlphaHashThreshold( vec3 position ) {
		float maxDeriv = max(
			length( dFdx( position.xyz ) ),
			length( dFdy( position.xyz ) )
		);
		float pixScale = 1.0 / ( ALPHA_HASH_SCALE * maxDeriv );
		vec2 pixScales = vec2(
			exp2( floor( log2( pixScale ) ) ),
			exp2( ceil( log2( pixScale ) ) )
		);
		vec2 alpha = vec2(
			hash3D( floor( pixScales.x * position.xyz ) ),
			hash3D( floor( pixScales.y * position.xyz ) )
		);
		float lerpFactor = fract( log2( pixScale ) );
		float x = ( 1.0 - lerpFactor ) * alpha.x + lerpFactor * alpha.y;
		float a = min( lerpFactor, 1.0 - lerpFactor );
		vec3 cases = vec3(
			x * x / ( 2.0 * a * ( 1.0 - a ) ),
			( x - 0.5 * a ) / ( 1.0 - a ),
			1.0 - ( ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * ( 1.0 - a ) ) )
		);
		float threshold = ( x < ( 1.0 - a ) )
			? ( ( x < a ) ? cases.x : cases.y )
			: cases.z;
		return clamp( threshold , 1.0e-6, 1.0 );
	}
#endif`,nb=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,ib=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,sb=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,rb=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,ob=`#ifdef USE_AOMAP
	float ambientOcclusion = ( texture2D( aoMap, vAoMapUv ).r - 1.0 ) * aoMapIntensity + 1.0;
	reflectedLight.indirectDiffuse *= ambientOcclusion;
	#if defined( USE_CLEARCOAT ) 
		clearcoatSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_SHEEN ) 
		sheenSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_ENVMAP ) && defined( STANDARD )
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		reflectedLight.indirectSpecular *= computeSpecularOcclusion( dotNV, ambientOcclusion, material.roughness );
	#endif
#endif`,ab=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,lb=`#ifdef USE_BATCHING
	#if ! defined( GL_ANGLE_multi_draw )
	#define gl_DrawID _gl_DrawID
	uniform int _gl_DrawID;
	#endif
	uniform highp sampler2D batchingTexture;
	uniform highp usampler2D batchingIdTexture;
	mat4 getBatchingMatrix( const in float i ) {
		int size = textureSize( batchingTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( batchingTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( batchingTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( batchingTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( batchingTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
	float getIndirectIndex( const in int i ) {
		int size = textureSize( batchingIdTexture, 0 ).x;
		int x = i % size;
		int y = i / size;
		return float( texelFetch( batchingIdTexture, ivec2( x, y ), 0 ).r );
	}
#endif
#ifdef USE_BATCHING_COLOR
	uniform sampler2D batchingColorTexture;
	vec4 getBatchingColor( const in float i ) {
		int size = textureSize( batchingColorTexture, 0 ).x;
		int j = int( i );
		int x = j % size;
		int y = j / size;
		return texelFetch( batchingColorTexture, ivec2( x, y ), 0 );
	}
#endif`,cb=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,hb=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,ub=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,db=`float G_BlinnPhong_Implicit( ) {
	return 0.25;
}
float D_BlinnPhong( const in float shininess, const in float dotNH ) {
	return RECIPROCAL_PI * ( shininess * 0.5 + 1.0 ) * pow( dotNH, shininess );
}
vec3 BRDF_BlinnPhong( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 specularColor, const in float shininess ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( specularColor, 1.0, dotVH );
	float G = G_BlinnPhong_Implicit( );
	float D = D_BlinnPhong( shininess, dotNH );
	return F * ( G * D );
} // validated`,fb=`#ifdef USE_IRIDESCENCE
	const mat3 XYZ_TO_REC709 = mat3(
		 3.2404542, -0.9692660,  0.0556434,
		-1.5371385,  1.8760108, -0.2040259,
		-0.4985314,  0.0415560,  1.0572252
	);
	vec3 Fresnel0ToIor( vec3 fresnel0 ) {
		vec3 sqrtF0 = sqrt( fresnel0 );
		return ( vec3( 1.0 ) + sqrtF0 ) / ( vec3( 1.0 ) - sqrtF0 );
	}
	vec3 IorToFresnel0( vec3 transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - vec3( incidentIor ) ) / ( transmittedIor + vec3( incidentIor ) ) );
	}
	float IorToFresnel0( float transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - incidentIor ) / ( transmittedIor + incidentIor ));
	}
	vec3 evalSensitivity( float OPD, vec3 shift ) {
		float phase = 2.0 * PI * OPD * 1.0e-9;
		vec3 val = vec3( 5.4856e-13, 4.4201e-13, 5.2481e-13 );
		vec3 pos = vec3( 1.6810e+06, 1.7953e+06, 2.2084e+06 );
		vec3 var = vec3( 4.3278e+09, 9.3046e+09, 6.6121e+09 );
		vec3 xyz = val * sqrt( 2.0 * PI * var ) * cos( pos * phase + shift ) * exp( - pow2( phase ) * var );
		xyz.x += 9.7470e-14 * sqrt( 2.0 * PI * 4.5282e+09 ) * cos( 2.2399e+06 * phase + shift[ 0 ] ) * exp( - 4.5282e+09 * pow2( phase ) );
		xyz /= 1.0685e-7;
		vec3 rgb = XYZ_TO_REC709 * xyz;
		return rgb;
	}
	vec3 evalIridescence( float outsideIOR, float eta2, float cosTheta1, float thinFilmThickness, vec3 baseF0 ) {
		vec3 I;
		float iridescenceIOR = mix( outsideIOR, eta2, smoothstep( 0.0, 0.03, thinFilmThickness ) );
		float sinTheta2Sq = pow2( outsideIOR / iridescenceIOR ) * ( 1.0 - pow2( cosTheta1 ) );
		float cosTheta2Sq = 1.0 - sinTheta2Sq;
		if ( cosTheta2Sq < 0.0 ) {
			return vec3( 1.0 );
		}
		float cosTheta2 = sqrt( cosTheta2Sq );
		float R0 = IorToFresnel0( iridescenceIOR, outsideIOR );
		float R12 = F_Schlick( R0, 1.0, cosTheta1 );
		float T121 = 1.0 - R12;
		float phi12 = 0.0;
		if ( iridescenceIOR < outsideIOR ) phi12 = PI;
		float phi21 = PI - phi12;
		vec3 baseIOR = Fresnel0ToIor( clamp( baseF0, 0.0, 0.9999 ) );		vec3 R1 = IorToFresnel0( baseIOR, iridescenceIOR );
		vec3 R23 = F_Schlick( R1, 1.0, cosTheta2 );
		vec3 phi23 = vec3( 0.0 );
		if ( baseIOR[ 0 ] < iridescenceIOR ) phi23[ 0 ] = PI;
		if ( baseIOR[ 1 ] < iridescenceIOR ) phi23[ 1 ] = PI;
		if ( baseIOR[ 2 ] < iridescenceIOR ) phi23[ 2 ] = PI;
		float OPD = 2.0 * iridescenceIOR * thinFilmThickness * cosTheta2;
		vec3 phi = vec3( phi21 ) + phi23;
		vec3 R123 = clamp( R12 * R23, 1e-5, 0.9999 );
		vec3 r123 = sqrt( R123 );
		vec3 Rs = pow2( T121 ) * R23 / ( vec3( 1.0 ) - R123 );
		vec3 C0 = R12 + Rs;
		I = C0;
		vec3 Cm = Rs - T121;
		for ( int m = 1; m <= 2; ++ m ) {
			Cm *= r123;
			vec3 Sm = 2.0 * evalSensitivity( float( m ) * OPD, float( m ) * phi );
			I += Cm * Sm;
		}
		return max( I, vec3( 0.0 ) );
	}
#endif`,pb=`#ifdef USE_BUMPMAP
	uniform sampler2D bumpMap;
	uniform float bumpScale;
	vec2 dHdxy_fwd() {
		vec2 dSTdx = dFdx( vBumpMapUv );
		vec2 dSTdy = dFdy( vBumpMapUv );
		float Hll = bumpScale * texture2D( bumpMap, vBumpMapUv ).x;
		float dBx = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdx ).x - Hll;
		float dBy = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdy ).x - Hll;
		return vec2( dBx, dBy );
	}
	vec3 perturbNormalArb( vec3 surf_pos, vec3 surf_norm, vec2 dHdxy, float faceDirection ) {
		vec3 vSigmaX = normalize( dFdx( surf_pos.xyz ) );
		vec3 vSigmaY = normalize( dFdy( surf_pos.xyz ) );
		vec3 vN = surf_norm;
		vec3 R1 = cross( vSigmaY, vN );
		vec3 R2 = cross( vN, vSigmaX );
		float fDet = dot( vSigmaX, R1 ) * faceDirection;
		vec3 vGrad = sign( fDet ) * ( dHdxy.x * R1 + dHdxy.y * R2 );
		return normalize( abs( fDet ) * surf_norm - vGrad );
	}
#endif`,mb=`#if NUM_CLIPPING_PLANES > 0
	vec4 plane;
	#ifdef ALPHA_TO_COVERAGE
		float distanceToPlane, distanceGradient;
		float clipOpacity = 1.0;
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
			distanceGradient = fwidth( distanceToPlane ) / 2.0;
			clipOpacity *= smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			if ( clipOpacity == 0.0 ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			float unionClipOpacity = 1.0;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
				distanceGradient = fwidth( distanceToPlane ) / 2.0;
				unionClipOpacity *= 1.0 - smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			}
			#pragma unroll_loop_end
			clipOpacity *= 1.0 - unionClipOpacity;
		#endif
		diffuseColor.a *= clipOpacity;
		if ( diffuseColor.a == 0.0 ) discard;
	#else
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			if ( dot( vClipPosition, plane.xyz ) > plane.w ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			bool clipped = true;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				clipped = ( dot( vClipPosition, plane.xyz ) > plane.w ) && clipped;
			}
			#pragma unroll_loop_end
			if ( clipped ) discard;
		#endif
	#endif
#endif`,gb=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,_b=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,xb=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,yb=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#endif`,vb=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#endif`,Sb=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec4 vColor;
#endif`,bb=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	vColor = vec4( 1.0 );
#endif
#ifdef USE_COLOR_ALPHA
	vColor *= color;
#elif defined( USE_COLOR )
	vColor.rgb *= color;
#endif
#ifdef USE_INSTANCING_COLOR
	vColor.rgb *= instanceColor.rgb;
#endif
#ifdef USE_BATCHING_COLOR
	vColor *= getBatchingColor( getIndirectIndex( gl_DrawID ) );
#endif`,Mb=`#define PI 3.141592653589793
#define PI2 6.283185307179586
#define PI_HALF 1.5707963267948966
#define RECIPROCAL_PI 0.3183098861837907
#define RECIPROCAL_PI2 0.15915494309189535
#define EPSILON 1e-6
#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
#define whiteComplement( a ) ( 1.0 - saturate( a ) )
float pow2( const in float x ) { return x*x; }
vec3 pow2( const in vec3 x ) { return x*x; }
float pow3( const in float x ) { return x*x*x; }
float pow4( const in float x ) { float x2 = x*x; return x2*x2; }
float max3( const in vec3 v ) { return max( max( v.x, v.y ), v.z ); }
float average( const in vec3 v ) { return dot( v, vec3( 0.3333333 ) ); }
highp float rand( const in vec2 uv ) {
	const highp float a = 12.9898, b = 78.233, c = 43758.5453;
	highp float dt = dot( uv.xy, vec2( a,b ) ), sn = mod( dt, PI );
	return fract( sin( sn ) * c );
}
#ifdef HIGH_PRECISION
	float precisionSafeLength( vec3 v ) { return length( v ); }
#else
	float precisionSafeLength( vec3 v ) {
		float maxComponent = max3( abs( v ) );
		return length( v / maxComponent ) * maxComponent;
	}
#endif
struct IncidentLight {
	vec3 color;
	vec3 direction;
	bool visible;
};
struct ReflectedLight {
	vec3 directDiffuse;
	vec3 directSpecular;
	vec3 indirectDiffuse;
	vec3 indirectSpecular;
};
#ifdef USE_ALPHAHASH
	varying vec3 vPosition;
#endif
vec3 transformDirection( in vec3 dir, in mat4 matrix ) {
	return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );
}
#define inverseTransformDirection transformDirectionByInverseViewMatrix
vec3 transformNormalByInverseViewMatrix( in vec3 normal, in mat4 viewMatrix ) {
	return normalize( ( vec4( normal, 0.0 ) * viewMatrix ).xyz );
}
vec3 transformDirectionByInverseViewMatrix( in vec3 dir, in mat4 viewMatrix ) {
	return normalize( ( vec4( dir, 0.0 ) * viewMatrix ).xyz );
}
bool isPerspectiveMatrix( mat4 m ) {
	return m[ 2 ][ 3 ] == - 1.0;
}
vec2 equirectUv( in vec3 dir ) {
	float u = atan( dir.z, dir.x ) * RECIPROCAL_PI2 + 0.5;
	float v = asin( clamp( dir.y, - 1.0, 1.0 ) ) * RECIPROCAL_PI + 0.5;
	return vec2( u, v );
}
vec3 BRDF_Lambert( const in vec3 diffuseColor ) {
	return RECIPROCAL_PI * diffuseColor;
}
vec3 F_Schlick( const in vec3 f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
}
float F_Schlick( const in float f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
} // validated`,wb=`vec3 transformedNormal = objectNormal;
#ifdef USE_TANGENT
	vec3 transformedTangent = objectTangent;
#endif
#ifdef USE_BATCHING
	mat3 bm = mat3( batchingMatrix );
	transformedNormal /= vec3( dot( bm[ 0 ], bm[ 0 ] ), dot( bm[ 1 ], bm[ 1 ] ), dot( bm[ 2 ], bm[ 2 ] ) );
	transformedNormal = bm * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = bm * transformedTangent;
	#endif
#endif
#ifdef USE_INSTANCING
	mat3 im = mat3( instanceMatrix );
	transformedNormal /= vec3( dot( im[ 0 ], im[ 0 ] ), dot( im[ 1 ], im[ 1 ] ), dot( im[ 2 ], im[ 2 ] ) );
	transformedNormal = im * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = im * transformedTangent;
	#endif
#endif
transformedNormal = normalMatrix * transformedNormal;
#ifdef FLIP_SIDED
	transformedNormal = - transformedNormal;
#endif
#ifdef USE_TANGENT
	transformedTangent = ( modelViewMatrix * vec4( transformedTangent, 0.0 ) ).xyz;
#endif`,Tb=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,Eb=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,Ab=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,Cb=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,Rb="gl_FragColor = linearToOutputTexel( gl_FragColor );",Pb=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,Ib=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vec3 cameraToFrag;
		if ( isOrthographic ) {
			cameraToFrag = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToFrag = normalize( vWorldPosition - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vec3 reflectVec = reflect( cameraToFrag, worldNormal );
		#else
			vec3 reflectVec = refract( cameraToFrag, worldNormal, refractionRatio );
		#endif
	#else
		vec3 reflectVec = vReflect;
	#endif
	#ifdef ENVMAP_TYPE_CUBE
		vec4 envColor = textureCube( envMap, envMapRotation * reflectVec );
		#ifdef ENVMAP_BLENDING_MULTIPLY
			outgoingLight = mix( outgoingLight, outgoingLight * envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_MIX )
			outgoingLight = mix( outgoingLight, envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_ADD )
			outgoingLight += envColor.xyz * specularStrength * reflectivity;
		#endif
	#endif
#endif`,Db=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform mat3 envMapRotation;
	uniform samplerCube envMap;
	#ifdef ENVMAP_TYPE_PMREM
		float roughnessToMip( const in float roughness ) {
			float r = clamp( roughness, 0.0, 1.0 );
			return ENVMAP_MAX_LOD * r * ( 2.0 - r );
		}
	#endif
#endif`,Lb=`#ifdef USE_ENVMAP
	uniform float reflectivity;
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		varying vec3 vWorldPosition;
		uniform float refractionRatio;
	#else
		varying vec3 vReflect;
	#endif
#endif`,Nb=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,Ub=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vWorldPosition = worldPosition.xyz;
	#else
		vec3 cameraToVertex;
		if ( isOrthographic ) {
			cameraToVertex = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToVertex = normalize( worldPosition.xyz - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vReflect = reflect( cameraToVertex, worldNormal );
		#else
			vReflect = refract( cameraToVertex, worldNormal, refractionRatio );
		#endif
	#endif
#endif`,Fb=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,Ob=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,Bb=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,kb=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,zb=`#ifdef USE_GRADIENTMAP
	uniform sampler2D gradientMap;
#endif
vec3 getGradientIrradiance( vec3 normal, vec3 lightDirection ) {
	float dotNL = dot( normal, lightDirection );
	vec2 coord = vec2( dotNL * 0.5 + 0.5, 0.0 );
	#ifdef USE_GRADIENTMAP
		return vec3( texture2D( gradientMap, coord ).r );
	#else
		vec2 fw = fwidth( coord ) * 0.5;
		return mix( vec3( 0.7 ), vec3( 1.0 ), smoothstep( 0.7 - fw.x, 0.7 + fw.x, coord.x ) );
	#endif
}`,Vb=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,Gb=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,Hb=`varying vec3 vViewPosition;
struct LambertMaterial {
	vec3 diffuseColor;
	float specularStrength;
};
void RE_Direct_Lambert( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Lambert( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Lambert
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,Wb=`uniform bool receiveShadow;
uniform vec3 ambientLightColor;
#if defined( USE_LIGHT_PROBES )
	uniform vec3 lightProbe[ 9 ];
#endif
vec3 shGetIrradianceAt( in vec3 normal, in vec3 shCoefficients[ 9 ] ) {
	float x = normal.x, y = normal.y, z = normal.z;
	vec3 result = shCoefficients[ 0 ] * 0.886227;
	result += shCoefficients[ 1 ] * 2.0 * 0.511664 * y;
	result += shCoefficients[ 2 ] * 2.0 * 0.511664 * z;
	result += shCoefficients[ 3 ] * 2.0 * 0.511664 * x;
	result += shCoefficients[ 4 ] * 2.0 * 0.429043 * x * y;
	result += shCoefficients[ 5 ] * 2.0 * 0.429043 * y * z;
	result += shCoefficients[ 6 ] * ( 0.743125 * z * z - 0.247708 );
	result += shCoefficients[ 7 ] * 2.0 * 0.429043 * x * z;
	result += shCoefficients[ 8 ] * 0.429043 * ( x * x - y * y );
	return result;
}
vec3 getLightProbeIrradiance( const in vec3 lightProbe[ 9 ], const in vec3 normal ) {
	vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec3 irradiance = shGetIrradianceAt( worldNormal, lightProbe );
	return irradiance;
}
vec3 getAmbientLightIrradiance( const in vec3 ambientLightColor ) {
	vec3 irradiance = ambientLightColor;
	return irradiance;
}
float getDistanceAttenuation( const in float lightDistance, const in float cutoffDistance, const in float decayExponent ) {
	float distanceFalloff = 1.0 / max( pow( lightDistance, decayExponent ), 0.01 );
	if ( cutoffDistance > 0.0 ) {
		distanceFalloff *= pow2( saturate( 1.0 - pow4( lightDistance / cutoffDistance ) ) );
	}
	return distanceFalloff;
}
float getSpotAttenuation( const in float coneCosine, const in float penumbraCosine, const in float angleCosine ) {
	return smoothstep( coneCosine, penumbraCosine, angleCosine );
}
#if NUM_SUN_LIGHTS > 0
	struct SunLight {
		vec3 direction;
		vec3 color;
	};
	uniform SunLight sunLights[ NUM_SUN_LIGHTS ];
	void getSunLightInfo( const in SunLight sunLight, out IncidentLight light ) {
		light.color = sunLight.color;
		light.direction = sunLight.direction;
		light.visible = true;
	}
#endif
#if NUM_DIR_LIGHTS > 0
	struct DirectionalLight {
		vec3 direction;
		vec3 color;
	};
	uniform DirectionalLight directionalLights[ NUM_DIR_LIGHTS ];
	void getDirectionalLightInfo( const in DirectionalLight directionalLight, out IncidentLight light ) {
		light.color = directionalLight.color;
		light.direction = directionalLight.direction;
		light.visible = true;
	}
#endif
#if NUM_POINT_LIGHTS > 0
	struct PointLight {
		vec3 position;
		vec3 color;
		float distance;
		float decay;
	};
	uniform PointLight pointLights[ NUM_POINT_LIGHTS ];
	void getPointLightInfo( const in PointLight pointLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = pointLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float lightDistance = length( lVector );
		light.color = pointLight.color;
		light.color *= getDistanceAttenuation( lightDistance, pointLight.distance, pointLight.decay );
		light.visible = ( light.color != vec3( 0.0 ) );
	}
#endif
#if NUM_SPOT_LIGHTS > 0
	struct SpotLight {
		vec3 position;
		vec3 direction;
		vec3 color;
		float distance;
		float decay;
		float coneCos;
		float penumbraCos;
	};
	uniform SpotLight spotLights[ NUM_SPOT_LIGHTS ];
	void getSpotLightInfo( const in SpotLight spotLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = spotLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float angleCos = dot( light.direction, spotLight.direction );
		float spotAttenuation = getSpotAttenuation( spotLight.coneCos, spotLight.penumbraCos, angleCos );
		if ( spotAttenuation > 0.0 ) {
			float lightDistance = length( lVector );
			light.color = spotLight.color * spotAttenuation;
			light.color *= getDistanceAttenuation( lightDistance, spotLight.distance, spotLight.decay );
			light.visible = ( light.color != vec3( 0.0 ) );
		} else {
			light.color = vec3( 0.0 );
			light.visible = false;
		}
	}
#endif
#if NUM_RECT_AREA_LIGHTS > 0
	struct RectAreaLight {
		vec3 color;
		vec3 position;
		vec3 halfWidth;
		vec3 halfHeight;
	};
	uniform sampler2D ltc_1;	uniform sampler2D ltc_2;
	uniform RectAreaLight rectAreaLights[ NUM_RECT_AREA_LIGHTS ];
#endif
#if NUM_HEMI_LIGHTS > 0
	struct HemisphereLight {
		vec3 direction;
		vec3 skyColor;
		vec3 groundColor;
	};
	uniform HemisphereLight hemisphereLights[ NUM_HEMI_LIGHTS ];
	vec3 getHemisphereLightIrradiance( const in HemisphereLight hemiLight, const in vec3 normal ) {
		float dotNL = dot( normal, hemiLight.direction );
		float hemiDiffuseWeight = 0.5 * dotNL + 0.5;
		vec3 irradiance = mix( hemiLight.groundColor, hemiLight.skyColor, hemiDiffuseWeight );
		return irradiance;
	}
#endif
#include <lightprobes_pars_fragment>`,Xb=`#ifdef USE_ENVMAP
	vec3 getIBLIrradiance( const in vec3 normal ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * worldNormal, ENVMAP_MAX_LOD );
			return PI * envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	vec3 getIBLRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 reflectVec = reflect( - viewDir, normal );
			reflectVec = normalize( mix( reflectVec, normal, pow4( roughness ) ) );
			reflectVec = transformDirectionByInverseViewMatrix( reflectVec, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * reflectVec, roughnessToMip( roughness ) );
			return envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	#ifdef USE_RETROREFLECTION
		vec3 getIBLRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 retroVec = normalize( mix( viewDir, normal, pow4( roughness ) ) );
				retroVec = transformDirectionByInverseViewMatrix( retroVec, viewMatrix );
				vec4 envMapColor = textureLod( envMap, envMapRotation * retroVec, roughnessToMip( roughness ) );
				return envMapColor.rgb * envMapIntensity;
			#else
				return vec3( 0.0 );
			#endif
		}
	#endif
	#ifdef USE_ANISOTROPY
		vec3 getIBLAnisotropyRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 bentNormal = cross( bitangent, viewDir );
				bentNormal = normalize( cross( bentNormal, bitangent ) );
				bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
				return getIBLRadiance( viewDir, bentNormal, roughness );
			#else
				return vec3( 0.0 );
			#endif
		}
		#ifdef USE_RETROREFLECTION
			vec3 getIBLAnisotropyRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
				#ifdef ENVMAP_TYPE_PMREM
					vec3 bentNormal = cross( bitangent, viewDir );
					bentNormal = normalize( cross( bentNormal, bitangent ) );
					bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
					return getIBLRetroRadiance( viewDir, bentNormal, roughness );
				#else
					return vec3( 0.0 );
				#endif
			}
		#endif
	#endif
#endif`,qb=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,Yb=`varying vec3 vViewPosition;
struct ToonMaterial {
	vec3 diffuseColor;
};
void RE_Direct_Toon( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 irradiance = getGradientIrradiance( geometryNormal, directLight.direction ) * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Toon( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Toon
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,$b=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,Zb=`varying vec3 vViewPosition;
struct BlinnPhongMaterial {
	vec3 diffuseColor;
	vec3 specularColor;
	float specularShininess;
	float specularStrength;
};
void RE_Direct_BlinnPhong( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
	reflectedLight.directSpecular += irradiance * BRDF_BlinnPhong( directLight.direction, geometryViewDir, geometryNormal, material.specularColor, material.specularShininess ) * material.specularStrength;
}
void RE_IndirectDiffuse_BlinnPhong( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_BlinnPhong
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,Kb=`PhysicalMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.diffuseContribution = diffuseColor.rgb * ( 1.0 - metalnessFactor );
material.metalness = metalnessFactor;
vec3 dxy = max( abs( dFdx( nonPerturbedNormal ) ), abs( dFdy( nonPerturbedNormal ) ) );
float geometryRoughness = max( max( dxy.x, dxy.y ), dxy.z );
material.roughness = max( roughnessFactor, 0.045 );
material.roughness += geometryRoughness;
material.roughness = min( material.roughness, 1.0 );
#ifdef USE_DIFFUSE_ROUGHNESS
	float diffuseRoughnessFactor = diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		diffuseRoughnessFactor *= texture2D( diffuseRoughnessMap, vDiffuseRoughnessMapUv ).r;
	#endif
	material.diffuseRoughness = saturate( diffuseRoughnessFactor );
#endif
#ifdef IOR
	material.ior = ior;
	#ifdef USE_SPECULAR
		float specularIntensityFactor = specularIntensity;
		vec3 specularColorFactor = specularColor;
		#ifdef USE_SPECULAR_COLORMAP
			specularColorFactor *= texture2D( specularColorMap, vSpecularColorMapUv ).rgb;
		#endif
		#ifdef USE_SPECULAR_INTENSITYMAP
			specularIntensityFactor *= texture2D( specularIntensityMap, vSpecularIntensityMapUv ).a;
		#endif
		material.specularF90 = mix( specularIntensityFactor, 1.0, metalnessFactor );
	#else
		float specularIntensityFactor = 1.0;
		vec3 specularColorFactor = vec3( 1.0 );
		material.specularF90 = 1.0;
	#endif
	material.specularColor = min( pow2( ( material.ior - 1.0 ) / ( material.ior + 1.0 ) ) * specularColorFactor, vec3( 1.0 ) ) * specularIntensityFactor;
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
#else
	material.specularColor = vec3( 0.04 );
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
	material.specularF90 = 1.0;
#endif
#ifdef USE_CLEARCOAT
	material.clearcoat = clearcoat;
	material.clearcoatRoughness = clearcoatRoughness;
	material.clearcoatF0 = vec3( 0.04 );
	material.clearcoatF90 = 1.0;
	#ifdef USE_CLEARCOATMAP
		material.clearcoat *= texture2D( clearcoatMap, vClearcoatMapUv ).x;
	#endif
	#ifdef USE_CLEARCOAT_ROUGHNESSMAP
		material.clearcoatRoughness *= texture2D( clearcoatRoughnessMap, vClearcoatRoughnessMapUv ).y;
	#endif
	material.clearcoat = saturate( material.clearcoat );	material.clearcoatRoughness = max( material.clearcoatRoughness, 0.045 );
	material.clearcoatRoughness += geometryRoughness;
	material.clearcoatRoughness = min( material.clearcoatRoughness, 1.0 );
#endif
#ifdef USE_DISPERSION
	material.dispersion = dispersion;
#endif
#ifdef USE_RETROREFLECTION
	material.retroreflectivity = retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	material.iridescence = iridescence;
	material.iridescenceIOR = iridescenceIOR;
	#ifdef USE_IRIDESCENCEMAP
		material.iridescence *= texture2D( iridescenceMap, vIridescenceMapUv ).r;
	#endif
	#ifdef USE_IRIDESCENCE_THICKNESSMAP
		material.iridescenceThickness = (iridescenceThicknessMaximum - iridescenceThicknessMinimum) * texture2D( iridescenceThicknessMap, vIridescenceThicknessMapUv ).g + iridescenceThicknessMinimum;
	#else
		material.iridescenceThickness = iridescenceThicknessMaximum;
	#endif
#endif
#ifdef USE_SHEEN
	material.sheenColor = sheenColor;
	#ifdef USE_SHEEN_COLORMAP
		material.sheenColor *= texture2D( sheenColorMap, vSheenColorMapUv ).rgb;
	#endif
	material.sheenRoughness = clamp( sheenRoughness, 0.0001, 1.0 );
	#ifdef USE_SHEEN_ROUGHNESSMAP
		material.sheenRoughness *= texture2D( sheenRoughnessMap, vSheenRoughnessMapUv ).a;
	#endif
#endif
#ifdef USE_ANISOTROPY
	#ifdef USE_ANISOTROPYMAP
		mat2 anisotropyMat = mat2( anisotropyVector.x, anisotropyVector.y, - anisotropyVector.y, anisotropyVector.x );
		vec3 anisotropyPolar = texture2D( anisotropyMap, vAnisotropyMapUv ).rgb;
		vec2 anisotropyV = anisotropyMat * normalize( 2.0 * anisotropyPolar.rg - vec2( 1.0 ) ) * anisotropyPolar.b;
	#else
		vec2 anisotropyV = anisotropyVector;
	#endif
	material.anisotropy = length( anisotropyV );
	if( material.anisotropy == 0.0 ) {
		anisotropyV = vec2( 1.0, 0.0 );
	} else {
		anisotropyV /= material.anisotropy;
		material.anisotropy = saturate( material.anisotropy );
	}
	material.alphaT = mix( pow2( material.roughness ), 1.0, pow2( material.anisotropy ) );
	material.anisotropyT = tbn[ 0 ] * anisotropyV.x + tbn[ 1 ] * anisotropyV.y;
	material.anisotropyB = tbn[ 1 ] * anisotropyV.x - tbn[ 0 ] * anisotropyV.y;
#endif`,Jb=`uniform sampler2D dfgLUT;
struct PhysicalMaterial {
	vec3 diffuseColor;
	vec3 diffuseContribution;
	vec3 specularColor;
	vec3 specularColorBlended;
	float roughness;
	float metalness;
	float specularF90;
	float dispersion;
	vec2 dfg;
	vec3 multiScatteringCompensation;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float diffuseRoughness;
	#endif
	#ifdef USE_RETROREFLECTION
		float retroreflectivity;
	#endif
	#ifdef USE_CLEARCOAT
		float clearcoat;
		float clearcoatRoughness;
		vec3 clearcoatF0;
		float clearcoatF90;
	#endif
	#ifdef USE_IRIDESCENCE
		float iridescence;
		float iridescenceIOR;
		float iridescenceThickness;
		vec3 iridescenceFresnel;
		vec3 iridescenceF0Dielectric;
		vec3 iridescenceF0Metallic;
	#endif
	#ifdef USE_SHEEN
		vec3 sheenColor;
		float sheenRoughness;
	#endif
	#ifdef IOR
		float ior;
	#endif
	#ifdef USE_TRANSMISSION
		float transmission;
		float transmissionAlpha;
		float thickness;
		float attenuationDistance;
		vec3 attenuationColor;
	#endif
	#ifdef USE_ANISOTROPY
		float anisotropy;
		float alphaT;
		vec3 anisotropyT;
		vec3 anisotropyB;
	#endif
};
vec3 clearcoatSpecularDirect = vec3( 0.0 );
vec3 clearcoatSpecularIndirect = vec3( 0.0 );
vec3 sheenSpecularDirect = vec3( 0.0 );
vec3 sheenSpecularIndirect = vec3(0.0 );
vec3 Schlick_to_F0( const in vec3 f, const in float f90, const in float dotVH ) {
    float x = clamp( 1.0 - dotVH, 0.0, 1.0 );
    float x2 = x * x;
    float x5 = clamp( x * x2 * x2, 0.0, 0.9999 );
    return ( f - vec3( f90 ) * x5 ) / ( 1.0 - x5 );
}
#ifdef USE_DIFFUSE_ROUGHNESS
	const float EON_EPSILON = 1e-7;
	float FON_DirectionalAlbedo( const in float mu, const in float roughness, const in float A ) {
		float muComp = 1.0 - mu;
		float gOverPi = muComp * ( 0.0571085289 + muComp * ( 0.491881867 + muComp * ( - 0.332181442 + muComp * 0.0714429953 ) ) );
		return A * ( 1.0 + roughness * gOverPi );
	}
	vec3 BRDF_EON( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 diffuseColor, const in float roughness ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return BRDF_Lambert( rho );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float s = dot( lightDir, viewDir ) - dotNL * dotNV;
		float sOverT = ( s > 0.0 ) ? s / max( max( dotNL, dotNV ), EON_EPSILON ) : s;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		vec3 singleScatter = rho * RECIPROCAL_PI * A * ( 1.0 + roughness * sOverT );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		float albedoV = FON_DirectionalAlbedo( dotNV, roughness, A );
		float albedoL = FON_DirectionalAlbedo( dotNL, roughness, A );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		vec3 multiScatter = rhoMultiScatter * RECIPROCAL_PI
			* max( EON_EPSILON, 1.0 - albedoV )
			* max( EON_EPSILON, 1.0 - albedoL )
			/ max( EON_EPSILON, 1.0 - averageAlbedo );
		return singleScatter + multiScatter;
	}
	vec3 EON_DirectionalAlbedo( const in vec3 diffuseColor, const in float roughness, const in float dotNV ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return rho;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		float directionalAlbedo = FON_DirectionalAlbedo( dotNV, roughness, A );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		return rho * directionalAlbedo + rhoMultiScatter * ( 1.0 - directionalAlbedo );
	}
#endif
float V_GGX_SmithCorrelated( const in float alpha, const in float dotNL, const in float dotNV ) {
	float a2 = pow2( alpha );
	float gv = dotNL * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNV ) );
	float gl = dotNV * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNL ) );
	return 0.5 / max( gv + gl, EPSILON );
}
float D_GGX( const in float alpha, const in float dotNH ) {
	float a2 = pow2( alpha );
	float denom = pow2( dotNH ) * ( a2 - 1.0 ) + 1.0;
	return RECIPROCAL_PI * a2 / pow2( denom );
}
#ifdef USE_ANISOTROPY
	float V_GGX_SmithCorrelated_Anisotropic( const in float alphaT, const in float alphaB, const in float dotTV, const in float dotBV, const in float dotTL, const in float dotBL, const in float dotNV, const in float dotNL ) {
		float gv = dotNL * length( vec3( alphaT * dotTV, alphaB * dotBV, dotNV ) );
		float gl = dotNV * length( vec3( alphaT * dotTL, alphaB * dotBL, dotNL ) );
		return 0.5 / max( gv + gl, EPSILON );
	}
	float D_GGX_Anisotropic( const in float alphaT, const in float alphaB, const in float dotNH, const in float dotTH, const in float dotBH ) {
		float a2 = alphaT * alphaB;
		highp vec3 v = vec3( alphaB * dotTH, alphaT * dotBH, a2 * dotNH );
		highp float v2 = dot( v, v );
		float w2 = a2 / v2;
		return RECIPROCAL_PI * a2 * pow2 ( w2 );
	}
#endif
#ifdef USE_CLEARCOAT
	vec3 BRDF_GGX_Clearcoat( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material) {
		vec3 f0 = material.clearcoatF0;
		float f90 = material.clearcoatF90;
		float roughness = max( material.clearcoatRoughness, 0.045 );
		float alpha = pow2( roughness );
		vec3 halfDir = normalize( lightDir + viewDir );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float dotNH = saturate( dot( normal, halfDir ) );
		float dotVH = saturate( dot( viewDir, halfDir ) );
		vec3 F = F_Schlick( f0, f90, dotVH );
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
		return F * ( V * D );
	}
#endif
vec3 BRDF_GGX( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material ) {
	vec3 f0 = material.specularColorBlended;
	float f90 = material.specularF90;
	float roughness = max( material.roughness, 0.045 );
	float alpha = pow2( roughness );
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( f0, f90, dotVH );
	#ifdef USE_IRIDESCENCE
		F = mix( F, material.iridescenceFresnel, material.iridescence );
	#endif
	#ifdef USE_ANISOTROPY
		float dotTL = dot( material.anisotropyT, lightDir );
		float dotTV = dot( material.anisotropyT, viewDir );
		float dotTH = dot( material.anisotropyT, halfDir );
		float dotBL = dot( material.anisotropyB, lightDir );
		float dotBV = dot( material.anisotropyB, viewDir );
		float dotBH = dot( material.anisotropyB, halfDir );
		float alphaT = max( material.alphaT, alpha );
		float V = V_GGX_SmithCorrelated_Anisotropic( alphaT, alpha, dotTV, dotBV, dotTL, dotBL, dotNV, dotNL );
		float D = D_GGX_Anisotropic( alphaT, alpha, dotNH, dotTH, dotBH );
	#else
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
	#endif
	return F * ( V * D );
}
vec2 LTC_Uv( const in vec3 N, const in vec3 V, const in float roughness ) {
	const float LUT_SIZE = 64.0;
	const float LUT_SCALE = ( LUT_SIZE - 1.0 ) / LUT_SIZE;
	const float LUT_BIAS = 0.5 / LUT_SIZE;
	float dotNV = saturate( dot( N, V ) );
	vec2 uv = vec2( roughness, sqrt( 1.0 - dotNV ) );
	uv = uv * LUT_SCALE + LUT_BIAS;
	return uv;
}
float LTC_ClippedSphereFormFactor( const in vec3 f ) {
	float l = length( f );
	return max( ( l * l + f.z ) / ( l + 1.0 ), 0.0 );
}
vec3 LTC_EdgeVectorFormFactor( const in vec3 v1, const in vec3 v2 ) {
	float x = dot( v1, v2 );
	float y = abs( x );
	float a = 0.8543985 + ( 0.4965155 + 0.0145206 * y ) * y;
	float b = 3.4175940 + ( 4.1616724 + y ) * y;
	float v = a / b;
	float theta_sintheta = ( x > 0.0 ) ? v : 0.5 * inversesqrt( max( 1.0 - x * x, 1e-7 ) ) - v;
	return cross( v1, v2 ) * theta_sintheta;
}
vec3 LTC_Evaluate( const in vec3 N, const in vec3 V, const in vec3 P, const in mat3 mInv, const in vec3 rectCoords[ 4 ] ) {
	vec3 v1 = rectCoords[ 1 ] - rectCoords[ 0 ];
	vec3 v2 = rectCoords[ 3 ] - rectCoords[ 0 ];
	vec3 lightNormal = cross( v1, v2 );
	if( dot( lightNormal, P - rectCoords[ 0 ] ) < 0.0 ) return vec3( 0.0 );
	vec3 T1, T2;
	T1 = normalize( V - N * dot( V, N ) );
	T2 = - cross( N, T1 );
	mat3 mat = mInv * transpose( mat3( T1, T2, N ) );
	vec3 coords[ 4 ];
	coords[ 0 ] = mat * ( rectCoords[ 0 ] - P );
	coords[ 1 ] = mat * ( rectCoords[ 1 ] - P );
	coords[ 2 ] = mat * ( rectCoords[ 2 ] - P );
	coords[ 3 ] = mat * ( rectCoords[ 3 ] - P );
	coords[ 0 ] = normalize( coords[ 0 ] );
	coords[ 1 ] = normalize( coords[ 1 ] );
	coords[ 2 ] = normalize( coords[ 2 ] );
	coords[ 3 ] = normalize( coords[ 3 ] );
	vec3 vectorFormFactor = vec3( 0.0 );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 0 ], coords[ 1 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 1 ], coords[ 2 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 2 ], coords[ 3 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 3 ], coords[ 0 ] );
	float result = LTC_ClippedSphereFormFactor( vectorFormFactor );
	return vec3( result );
}
#if defined( USE_SHEEN )
float D_Charlie( float roughness, float dotNH ) {
	float alpha = pow2( roughness );
	float invAlpha = 1.0 / alpha;
	float cos2h = dotNH * dotNH;
	float sin2h = max( 1.0 - cos2h, 0.0078125 );
	return ( 2.0 + invAlpha ) * pow( sin2h, invAlpha * 0.5 ) / ( 2.0 * PI );
}
float V_Neubelt( float dotNV, float dotNL ) {
	return saturate( 1.0 / ( 4.0 * ( dotNL + dotNV - dotNL * dotNV ) ) );
}
vec3 BRDF_Sheen( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, vec3 sheenColor, const in float sheenRoughness ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float D = D_Charlie( sheenRoughness, dotNH );
	float V = V_Neubelt( dotNV, dotNL );
	return sheenColor * ( D * V );
}
#endif
float IBLSheenBRDF( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	float r2 = roughness * roughness;
	float rInv = 1.0 / ( roughness + 0.1 );
	float a = -1.9362 + 1.0678 * roughness + 0.4573 * r2 - 0.8469 * rInv;
	float b = -0.6014 + 0.5538 * roughness - 0.4670 * r2 - 0.1255 * rInv;
	float DG = exp( a * dotNV + b );
	return saturate( DG );
}
vec3 EnvironmentBRDF( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	vec2 fab = texture2D( dfgLUT, vec2( roughness, dotNV ) ).rg;
	return specularColor * fab.x + specularF90 * fab.y;
}
#ifdef USE_IRIDESCENCE
void computeMultiscatteringIridescence( const in vec2 fab, const in vec3 specularColor, const in float specularF90, const in float iridescence, const in vec3 iridescenceF0, inout vec3 singleScatter, inout vec3 multiScatter ) {
#else
void computeMultiscattering( const in vec2 fab, const in vec3 specularColor, const in float specularF90, inout vec3 singleScatter, inout vec3 multiScatter ) {
#endif
	#ifdef USE_IRIDESCENCE
		vec3 Fr = mix( specularColor, iridescenceF0, iridescence );
	#else
		vec3 Fr = specularColor;
	#endif
	vec3 FssEss = Fr * fab.x + specularF90 * fab.y;
	float Ess = fab.x + fab.y;
	float Ems = 1.0 - Ess;
	vec3 Favg = Fr + ( 1.0 - Fr ) * 0.047619;	vec3 Fms = FssEss * Favg / ( 1.0 - Ems * Favg );
	singleScatter += FssEss;
	multiScatter += Fms * Ems;
}
#if NUM_RECT_AREA_LIGHTS > 0
	void RE_Direct_RectArea_Physical( const in RectAreaLight rectAreaLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
		vec3 normal = geometryNormal;
		vec3 viewDir = geometryViewDir;
		vec3 position = geometryPosition;
		vec3 lightPos = rectAreaLight.position;
		vec3 halfWidth = rectAreaLight.halfWidth;
		vec3 halfHeight = rectAreaLight.halfHeight;
		vec3 lightColor = rectAreaLight.color;
		float roughness = material.roughness;
		vec3 rectCoords[ 4 ];
		rectCoords[ 0 ] = lightPos + halfWidth - halfHeight;		rectCoords[ 1 ] = lightPos - halfWidth - halfHeight;
		rectCoords[ 2 ] = lightPos - halfWidth + halfHeight;
		rectCoords[ 3 ] = lightPos + halfWidth + halfHeight;
		vec2 uv = LTC_Uv( normal, viewDir, roughness );
		vec4 t1 = texture2D( ltc_1, uv );
		vec4 t2 = texture2D( ltc_2, uv );
		mat3 mInv = mat3(
			vec3( t1.x, 0, t1.y ),
			vec3(    0, 1,    0 ),
			vec3( t1.z, 0, t1.w )
		);
		vec3 fresnel = ( material.specularColorBlended * t2.x + ( material.specularF90 - material.specularColorBlended ) * t2.y );
		reflectedLight.directSpecular += lightColor * fresnel * LTC_Evaluate( normal, viewDir, position, mInv, rectCoords );
		reflectedLight.directDiffuse += lightColor * material.diffuseContribution * LTC_Evaluate( normal, viewDir, position, mat3( 1.0 ), rectCoords );
		#ifdef USE_CLEARCOAT
			vec3 Ncc = geometryClearcoatNormal;
			vec2 uvClearcoat = LTC_Uv( Ncc, viewDir, material.clearcoatRoughness );
			vec4 t1Clearcoat = texture2D( ltc_1, uvClearcoat );
			vec4 t2Clearcoat = texture2D( ltc_2, uvClearcoat );
			mat3 mInvClearcoat = mat3(
				vec3( t1Clearcoat.x, 0, t1Clearcoat.y ),
				vec3(             0, 1,             0 ),
				vec3( t1Clearcoat.z, 0, t1Clearcoat.w )
			);
			vec3 fresnelClearcoat = material.clearcoatF0 * t2Clearcoat.x + ( material.clearcoatF90 - material.clearcoatF0 ) * t2Clearcoat.y;
			clearcoatSpecularDirect += lightColor * fresnelClearcoat * LTC_Evaluate( Ncc, viewDir, position, mInvClearcoat, rectCoords );
		#endif
	}
#endif
void RE_Direct_Physical( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	#ifdef USE_CLEARCOAT
		float dotNLcc = saturate( dot( geometryClearcoatNormal, directLight.direction ) );
		vec3 ccIrradiance = dotNLcc * directLight.color;
		clearcoatSpecularDirect += ccIrradiance * BRDF_GGX_Clearcoat( directLight.direction, geometryViewDir, geometryClearcoatNormal, material );
	#endif
	#ifdef USE_SHEEN
 
 		sheenSpecularDirect += irradiance * BRDF_Sheen( directLight.direction, geometryViewDir, geometryNormal, material.sheenColor, material.sheenRoughness );
 
 		float sheenAlbedoV = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
 		float sheenAlbedoL = IBLSheenBRDF( geometryNormal, directLight.direction, material.sheenRoughness );
 
 		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * max( sheenAlbedoV, sheenAlbedoL );
 
 		irradiance *= sheenEnergyComp;
 
 	#endif
	vec3 specularBRDF = BRDF_GGX( directLight.direction, geometryViewDir, geometryNormal, material );
	#ifdef USE_RETROREFLECTION
		vec3 retroViewDir = reflect( - geometryViewDir, geometryNormal );
		vec3 retroSpecularBRDF = BRDF_GGX( directLight.direction, retroViewDir, geometryNormal, material );
		specularBRDF = mix( specularBRDF, retroSpecularBRDF, saturate( material.retroreflectivity ) );
	#endif
	reflectedLight.directSpecular += irradiance * specularBRDF * material.multiScatteringCompensation;
	vec3 halfDir = normalize( directLight.direction + geometryViewDir );
	float dotVH = saturate( dot( geometryViewDir, halfDir ) );
	vec3 F = F_Schlick( material.specularColor, material.specularF90, dotVH );
	#ifdef USE_RETROREFLECTION
		vec3 retroHalfDir = normalize( directLight.direction + retroViewDir );
		float dotRetroVH = saturate( dot( retroViewDir, retroHalfDir ) );
		vec3 retroF = F_Schlick( material.specularColor, material.specularF90, dotRetroVH );
		F = mix( F, retroF, saturate( material.retroreflectivity ) );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		vec3 diffuseBRDF = BRDF_EON( directLight.direction, geometryViewDir, geometryNormal, material.diffuseColor, material.diffuseRoughness ) * ( 1.0 - material.metalness );
	#else
		vec3 diffuseBRDF = BRDF_Lambert( material.diffuseContribution );
	#endif
	reflectedLight.directDiffuse += irradiance * diffuseBRDF * ( 1.0 - F );
}
void RE_IndirectDiffuse_Physical( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 singleScattering = vec3( 0.0 );
	vec3 multiScattering = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScattering, multiScattering );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScattering, multiScattering );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuseAlbedo = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness );
		vec3 diffuse = irradiance * RECIPROCAL_PI * diffuseAlbedo * ( 1.0 - singleScattering - multiScattering );
	#else
		vec3 diffuse = irradiance * BRDF_Lambert( material.diffuseContribution ) * ( 1.0 - singleScattering - multiScattering );
	#endif
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		sheenSpecularIndirect += irradiance * material.sheenColor * sheenAlbedo * RECIPROCAL_PI;
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		diffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectDiffuse += diffuse;
}
void RE_IndirectSpecular_Physical( const in vec3 radiance, const in vec3 irradiance, const in vec3 clearcoatRadiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight) {
	#ifdef USE_CLEARCOAT
		clearcoatSpecularIndirect += clearcoatRadiance * EnvironmentBRDF( geometryClearcoatNormal, geometryViewDir, material.clearcoatF0, material.clearcoatF90, material.clearcoatRoughness );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularIndirect += irradiance * material.sheenColor * IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness ) * RECIPROCAL_PI;
 	#endif
	vec3 singleScatteringDielectric = vec3( 0.0 );
	vec3 multiScatteringDielectric = vec3( 0.0 );
	vec3 singleScatteringMetallic = vec3( 0.0 );
	vec3 multiScatteringMetallic = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscatteringIridescence( material.dfg, material.diffuseColor, material.specularF90, material.iridescence, material.iridescenceF0Metallic, singleScatteringMetallic, multiScatteringMetallic );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscattering( material.dfg, material.diffuseColor, material.specularF90, singleScatteringMetallic, multiScatteringMetallic );
	#endif
	vec3 singleScattering = mix( singleScatteringDielectric, singleScatteringMetallic, material.metalness );
	vec3 multiScattering = mix( multiScatteringDielectric, multiScatteringMetallic, material.metalness );
	vec3 totalScatteringDielectric = singleScatteringDielectric + multiScatteringDielectric;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuse = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness ) * ( 1.0 - totalScatteringDielectric );
	#else
		vec3 diffuse = material.diffuseContribution * ( 1.0 - totalScatteringDielectric );
	#endif
	vec3 cosineWeightedIrradiance = irradiance * RECIPROCAL_PI;
	vec3 indirectSpecular = radiance * singleScattering;
	indirectSpecular += multiScattering * cosineWeightedIrradiance;
	vec3 indirectDiffuse = diffuse * cosineWeightedIrradiance;
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		indirectSpecular *= sheenEnergyComp;
		indirectDiffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectSpecular += indirectSpecular;
	reflectedLight.indirectDiffuse += indirectDiffuse;
}
#define RE_Direct				RE_Direct_Physical
#define RE_Direct_RectArea		RE_Direct_RectArea_Physical
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Physical
#define RE_IndirectSpecular		RE_IndirectSpecular_Physical
float computeSpecularOcclusion( const in float dotNV, const in float ambientOcclusion, const in float roughness ) {
	return saturate( pow( dotNV + ambientOcclusion, exp2( - 16.0 * roughness - 1.0 ) ) - 1.0 + ambientOcclusion );
}`,jb=`
vec3 geometryPosition = - vViewPosition;
vec3 geometryNormal = normal;
vec3 geometryViewDir = ( isOrthographic ) ? vec3( 0, 0, 1 ) : normalize( vViewPosition );
vec3 geometryClearcoatNormal = vec3( 0.0 );
#ifdef USE_CLEARCOAT
	geometryClearcoatNormal = clearcoatNormal;
#endif
#ifdef USE_IRIDESCENCE
	float dotNVi = saturate( dot( normal, geometryViewDir ) );
	if ( material.iridescenceThickness == 0.0 ) {
		material.iridescence = 0.0;
	} else {
		material.iridescence = saturate( material.iridescence );
	}
	if ( material.iridescence > 0.0 ) {
		vec3 iridescenceFresnelDielectric = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.specularColor );
		vec3 iridescenceFresnelMetallic = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.diffuseColor );
		material.iridescenceFresnel = mix( iridescenceFresnelDielectric, iridescenceFresnelMetallic, material.metalness );
		material.iridescenceF0Dielectric = Schlick_to_F0( iridescenceFresnelDielectric, 1.0, dotNVi );
		material.iridescenceF0Metallic = Schlick_to_F0( iridescenceFresnelMetallic, 1.0, dotNVi );
	}
#endif
#ifdef STANDARD
	float dotNVms = saturate( dot( geometryNormal, geometryViewDir ) );
	material.dfg = texture2D( dfgLUT, vec2( material.roughness, dotNVms ) ).rg;
	#if ( NUM_SUN_LIGHTS > 0 || NUM_DIR_LIGHTS > 0 || NUM_POINT_LIGHTS > 0 || NUM_SPOT_LIGHTS > 0 )
		float EssMs = material.dfg.x + material.dfg.y;
		material.multiScatteringCompensation = 1.0 + material.specularColorBlended * ( 1.0 / EssMs - 1.0 );
	#endif
#endif
IncidentLight directLight;
#if ( NUM_POINT_LIGHTS > 0 ) && defined( RE_Direct )
	PointLight pointLight;
	#if defined( USE_SHADOWMAP ) && NUM_POINT_LIGHT_SHADOWS > 0
	PointLightShadow pointLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHTS; i ++ ) {
		pointLight = pointLights[ i ];
		getPointLightInfo( pointLight, geometryPosition, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_POINT_LIGHT_SHADOWS ) && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
		pointLightShadow = pointLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getPointShadow( pointShadowMap[ i ], pointLightShadow.shadowMapSize, pointLightShadow.shadowIntensity, pointLightShadow.shadowBias, pointLightShadow.shadowRadius, vPointShadowCoord[ i ], pointLightShadow.shadowCameraNear, pointLightShadow.shadowCameraFar ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SPOT_LIGHTS > 0 ) && defined( RE_Direct )
	SpotLight spotLight;
	vec4 spotColor;
	vec3 spotLightCoord;
	bool inSpotLightMap;
	#if defined( USE_SHADOWMAP ) && NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHTS; i ++ ) {
		spotLight = spotLights[ i ];
		getSpotLightInfo( spotLight, geometryPosition, directLight );
		#if ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#define SPOT_LIGHT_MAP_INDEX UNROLLED_LOOP_INDEX
		#elif ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		#define SPOT_LIGHT_MAP_INDEX NUM_SPOT_LIGHT_MAPS
		#else
		#define SPOT_LIGHT_MAP_INDEX ( UNROLLED_LOOP_INDEX - NUM_SPOT_LIGHT_SHADOWS + NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#endif
		#if ( SPOT_LIGHT_MAP_INDEX < NUM_SPOT_LIGHT_MAPS )
			spotLightCoord = vSpotLightCoord[ i ].xyz / vSpotLightCoord[ i ].w;
			inSpotLightMap = all( lessThan( abs( spotLightCoord * 2. - 1. ), vec3( 1.0 ) ) );
			spotColor = texture2D( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], spotLightCoord.xy );
			directLight.color = inSpotLightMap ? directLight.color * spotColor.rgb : directLight.color;
		#endif
		#undef SPOT_LIGHT_MAP_INDEX
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		spotLightShadow = spotLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( spotShadowMap[ i ], spotLightShadow.shadowMapSize, spotLightShadow.shadowIntensity, spotLightShadow.shadowBias, spotLightShadow.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SUN_LIGHTS > 0 ) && defined( RE_Direct )
	SunLight sunLight;
	#if defined( USE_SHADOWMAP ) && NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHTS; i ++ ) {
		sunLight = sunLights[ i ];
		getSunLightInfo( sunLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SUN_LIGHT_SHADOWS )
		sunLightShadow = sunLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getSunShadow( sunShadowMap[ i ], sunLightShadow, UNROLLED_LOOP_INDEX ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_DIR_LIGHTS > 0 ) && defined( RE_Direct )
	DirectionalLight directionalLight;
	#if defined( USE_SHADOWMAP ) && NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHTS; i ++ ) {
		directionalLight = directionalLights[ i ];
		getDirectionalLightInfo( directionalLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS )
		directionalLightShadow = directionalLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( directionalShadowMap[ i ], directionalLightShadow.shadowMapSize, directionalLightShadow.shadowIntensity, directionalLightShadow.shadowBias, directionalLightShadow.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_RECT_AREA_LIGHTS > 0 ) && defined( RE_Direct_RectArea )
	RectAreaLight rectAreaLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_RECT_AREA_LIGHTS; i ++ ) {
		rectAreaLight = rectAreaLights[ i ];
		RE_Direct_RectArea( rectAreaLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if defined( RE_IndirectDiffuse )
	vec3 iblIrradiance = vec3( 0.0 );
	vec3 irradiance = getAmbientLightIrradiance( ambientLightColor );
	#if defined( USE_LIGHT_PROBES )
		irradiance += getLightProbeIrradiance( lightProbe, geometryNormal );
	#endif
	#if ( NUM_HEMI_LIGHTS > 0 )
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_HEMI_LIGHTS; i ++ ) {
			irradiance += getHemisphereLightIrradiance( hemisphereLights[ i ], geometryNormal );
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_LIGHT_PROBE_GRIDS > 0
		vec3 probeWorldPos = ( ( vec4( geometryPosition, 1.0 ) - viewMatrix[ 3 ] ) * viewMatrix ).xyz;
		vec3 probeWorldNormal = transformNormalByInverseViewMatrix( geometryNormal, viewMatrix );
		int probeGrid = - 1;
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( isInsideLightProbeGrid( probeWorldPos, probeWorldNormal, probesMin[ i ], probesMax[ i ], probesResolution[ i ] ) ) probeGrid = UNROLLED_LOOP_INDEX;
		}
		#pragma unroll_loop_end
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( probeGrid == UNROLLED_LOOP_INDEX ) irradiance += getLightProbeGridIrradiance( probesSH[ i ], probesMin[ i ], probesMax[ i ], probesResolution[ i ], probeWorldPos, probeWorldNormal );
		}
		#pragma unroll_loop_end
	#endif
#endif
#if defined( RE_IndirectSpecular )
	vec3 radiance = vec3( 0.0 );
	vec3 clearcoatRadiance = vec3( 0.0 );
#endif`,Qb=`#if defined( RE_IndirectDiffuse )
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		vec3 lightMapIrradiance = lightMapTexel.rgb * lightMapIntensity;
		irradiance += lightMapIrradiance;
	#endif
	#if defined( USE_ENVMAP ) && defined( ENVMAP_TYPE_PMREM )
		#if defined( STANDARD ) || defined( LAMBERT ) || defined( PHONG )
			iblIrradiance += getIBLIrradiance( geometryNormal );
		#endif
	#endif
#endif
#if defined( USE_ENVMAP ) && defined( RE_IndirectSpecular )
	#ifdef USE_ANISOTROPY
		vec3 iblRadiance = getIBLAnisotropyRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
	#else
		vec3 iblRadiance = getIBLRadiance( geometryViewDir, geometryNormal, material.roughness );
	#endif
	#ifdef USE_RETROREFLECTION
		#ifdef USE_ANISOTROPY
			vec3 retroIBLRadiance = getIBLAnisotropyRetroRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
		#else
			vec3 retroIBLRadiance = getIBLRetroRadiance( geometryViewDir, geometryNormal, material.roughness );
		#endif
		iblRadiance = mix( iblRadiance, retroIBLRadiance, saturate( material.retroreflectivity ) );
	#endif
	radiance += iblRadiance;
	#ifdef USE_CLEARCOAT
		clearcoatRadiance += getIBLRadiance( geometryViewDir, geometryClearcoatNormal, material.clearcoatRoughness );
	#endif
#endif`,eM=`#if defined( RE_IndirectDiffuse )
	#if defined( LAMBERT ) || defined( PHONG )
		irradiance += iblIrradiance;
	#endif
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,tM=`#if NUM_LIGHT_PROBE_GRIDS > 0
uniform highp sampler3D probesSH[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMin[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMax[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesResolution[ NUM_LIGHT_PROBE_GRIDS ];
bool isInsideLightProbeGrid( vec3 worldPos, vec3 worldNormal, vec3 probesMin, vec3 probesMax, vec3 probesResolution ) {
	vec3 spacing = ( probesMax - probesMin ) / probesResolution;
	vec3 samplePos = worldPos + worldNormal * spacing * 0.5;
	vec3 margin = spacing * 0.01;
	return all( greaterThanEqual( samplePos, probesMin - margin ) ) && all( lessThanEqual( samplePos, probesMax + margin ) );
}
vec3 getLightProbeGridIrradiance( highp sampler3D probesSH, vec3 probesMin, vec3 probesMax, vec3 probesResolution, vec3 worldPos, vec3 worldNormal ) {
	vec3 res = probesResolution;
	vec3 gridRange = probesMax - probesMin;
	vec3 probeSpacing = gridRange / res;
	vec3 samplePos = worldPos + worldNormal * probeSpacing * 0.5;
	vec3 uvw = clamp( ( samplePos - probesMin ) / gridRange, 0.5 / res, 1.0 - 0.5 / res );
	float nz          = res.z;
	float paddedSlices = nz + 2.0;
	float atlasDepth  = 7.0 * paddedSlices;
	float uvZBase     = uvw.z * nz + 1.0;
	vec4 s0 = texture( probesSH, vec3( uvw.xy, ( uvZBase                       ) / atlasDepth ) );
	vec4 s1 = texture( probesSH, vec3( uvw.xy, ( uvZBase +       paddedSlices   ) / atlasDepth ) );
	vec4 s2 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 2.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s3 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 3.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s4 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 4.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s5 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 5.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s6 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 6.0 * paddedSlices   ) / atlasDepth ) );
	vec3 c0 = s0.xyz;
	vec3 c1 = vec3( s0.w, s1.xy );
	vec3 c2 = vec3( s1.zw, s2.x );
	vec3 c3 = s2.yzw;
	vec3 c4 = s3.xyz;
	vec3 c5 = vec3( s3.w, s4.xy );
	vec3 c6 = vec3( s4.zw, s5.x );
	vec3 c7 = s5.yzw;
	vec3 c8 = s6.xyz;
	float x = worldNormal.x, y = worldNormal.y, z = worldNormal.z;
	vec3 result = c0 * 0.886227;
	result += c1 * 2.0 * 0.511664 * y;
	result += c2 * 2.0 * 0.511664 * z;
	result += c3 * 2.0 * 0.511664 * x;
	result += c4 * 2.0 * 0.429043 * x * y;
	result += c5 * 2.0 * 0.429043 * y * z;
	result += c6 * ( 0.743125 * z * z - 0.247708 );
	result += c7 * 2.0 * 0.429043 * x * z;
	result += c8 * 0.429043 * ( x * x - y * y );
	return max( result, vec3( 0.0 ) );
}
#endif`,nM=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,iM=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,sM=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,rM=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,oM=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,aM=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,lM=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
	#if defined( USE_POINTS_UV )
		vec2 uv = vUv;
	#else
		vec2 uv = ( uvTransform * vec3( gl_PointCoord.x, 1.0 - gl_PointCoord.y, 1 ) ).xy;
	#endif
#endif
#ifdef USE_MAP
	diffuseColor *= texture2D( map, uv );
#endif
#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, uv ).g;
#endif`,cM=`#if defined( USE_POINTS_UV )
	varying vec2 vUv;
#else
	#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
		uniform mat3 uvTransform;
	#endif
#endif
#ifdef USE_MAP
	uniform sampler2D map;
#endif
#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,hM=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,uM=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,dM=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,fM=`#if defined( USE_MORPHCOLORS )
	#if defined( USE_COLOR_ALPHA )
		vColor *= morphTargetBaseInfluence;
	#elif defined( USE_COLOR )
		vColor.rgb *= morphTargetBaseInfluence;
	#endif
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		#if defined( USE_COLOR_ALPHA )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ) * morphTargetInfluences[ i ];
		#elif defined( USE_COLOR )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor.rgb += getMorph( gl_VertexID, i, 2 ).rgb * morphTargetInfluences[ i ];
		#endif
	}
#endif`,pM=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,mM=`#ifdef USE_MORPHTARGETS
	#ifndef USE_INSTANCING_MORPH
		uniform float morphTargetBaseInfluence;
		uniform float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	#endif
	uniform sampler2DArray morphTargetsTexture;
	uniform ivec2 morphTargetsTextureSize;
	vec4 getMorph( const in int vertexIndex, const in int morphTargetIndex, const in int offset ) {
		int texelIndex = vertexIndex * MORPHTARGETS_TEXTURE_STRIDE + offset;
		int y = texelIndex / morphTargetsTextureSize.x;
		int x = texelIndex - y * morphTargetsTextureSize.x;
		ivec3 morphUV = ivec3( x, y, morphTargetIndex );
		return texelFetch( morphTargetsTexture, morphUV, 0 );
	}
#endif`,gM=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,_M=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
#ifdef FLAT_SHADED
	vec3 fdx = dFdx( vViewPosition );
	vec3 fdy = dFdy( vViewPosition );
	vec3 normal = normalize( cross( fdx, fdy ) );
#else
	vec3 normal = normalize( vNormal );
	#ifdef DOUBLE_SIDED
		normal *= faceDirection;
	#endif
#endif
#if defined( USE_NORMALMAP_TANGENTSPACE ) || defined( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY )
	#ifdef USE_TANGENT
		mat3 tbn = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn = getTangentFrame( - vViewPosition, normal,
		#if defined( USE_NORMALMAP )
			vNormalMapUv
		#elif defined( USE_CLEARCOAT_NORMALMAP )
			vClearcoatNormalMapUv
		#else
			vUv
		#endif
		);
	#endif
	#ifdef DOUBLE_SIDED
		tbn[0] *= faceDirection;
		tbn[1] *= faceDirection;
	#endif
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	#ifdef USE_TANGENT
		mat3 tbn2 = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn2 = getTangentFrame( - vViewPosition, normal, vClearcoatNormalMapUv );
	#endif
	#ifdef DOUBLE_SIDED
		tbn2[0] *= faceDirection;
		tbn2[1] *= faceDirection;
	#endif
#endif
vec3 nonPerturbedNormal = normal;`,xM=`#ifdef USE_NORMALMAP_OBJECTSPACE
	normal = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#ifdef FLIP_SIDED
		normal = - normal;
	#endif
	#ifdef DOUBLE_SIDED
		normal = normal * faceDirection;
	#endif
	normal = normalize( normalMatrix * normal );
#elif defined( USE_NORMALMAP_TANGENTSPACE )
	vec3 mapN = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#if defined( USE_PACKED_NORMALMAP )
		mapN = vec3( mapN.xy, sqrt( saturate( 1.0 - dot( mapN.xy, mapN.xy ) ) ) );
	#endif
	mapN.xy *= normalScale;
	normal = normalize( tbn * mapN );
#elif defined( USE_BUMPMAP )
	normal = perturbNormalArb( - vViewPosition, normal, dHdxy_fwd(), faceDirection );
#endif`,yM=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,vM=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,SM=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
		#ifdef FLIP_SIDED
			vBitangent = - vBitangent;
		#endif
	#endif
#endif`,bM=`#ifdef USE_NORMALMAP
	uniform sampler2D normalMap;
	uniform vec2 normalScale;
#endif
#ifdef USE_NORMALMAP_OBJECTSPACE
	uniform mat3 normalMatrix;
#endif
#if ! defined ( USE_TANGENT ) && ( defined ( USE_NORMALMAP_TANGENTSPACE ) || defined ( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY ) )
	mat3 getTangentFrame( vec3 eye_pos, vec3 surf_norm, vec2 uv ) {
		vec3 q0 = dFdx( eye_pos.xyz );
		vec3 q1 = dFdy( eye_pos.xyz );
		vec2 st0 = dFdx( uv.st );
		vec2 st1 = dFdy( uv.st );
		vec3 N = surf_norm;
		vec3 q1perp = cross( q1, N );
		vec3 q0perp = cross( N, q0 );
		vec3 T = q1perp * st0.x + q0perp * st1.x;
		vec3 B = q1perp * st0.y + q0perp * st1.y;
		float det = max( dot( T, T ), dot( B, B ) );
		float scale = ( det == 0.0 ) ? 0.0 : inversesqrt( det );
		return mat3( T * scale, B * scale, N );
	}
#endif`,MM=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,wM=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,TM=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,EM=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,AM=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,CM=`vec3 packNormalToRGB( const in vec3 normal ) {
	return normalize( normal ) * 0.5 + 0.5;
}
vec3 unpackRGBToNormal( const in vec3 rgb ) {
	return 2.0 * rgb.xyz - 1.0;
}
const float PackUpscale = 256. / 255.;const float UnpackDownscale = 255. / 256.;const float ShiftRight8 = 1. / 256.;
const float Inv255 = 1. / 255.;
const vec4 PackFactors = vec4( 1.0, 256.0, 256.0 * 256.0, 256.0 * 256.0 * 256.0 );
const vec2 UnpackFactors2 = vec2( UnpackDownscale, 1.0 / PackFactors.g );
const vec3 UnpackFactors3 = vec3( UnpackDownscale / PackFactors.rg, 1.0 / PackFactors.b );
const vec4 UnpackFactors4 = vec4( UnpackDownscale / PackFactors.rgb, 1.0 / PackFactors.a );
vec4 packDepthToRGBA( const in float v ) {
	if( v <= 0.0 )
		return vec4( 0., 0., 0., 0. );
	if( v >= 1.0 )
		return vec4( 1., 1., 1., 1. );
	float vuf;
	float af = modf( v * PackFactors.a, vuf );
	float bf = modf( vuf * ShiftRight8, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec4( vuf * Inv255, gf * PackUpscale, bf * PackUpscale, af );
}
vec3 packDepthToRGB( const in float v ) {
	if( v <= 0.0 )
		return vec3( 0., 0., 0. );
	if( v >= 1.0 )
		return vec3( 1., 1., 1. );
	float vuf;
	float bf = modf( v * PackFactors.b, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec3( vuf * Inv255, gf * PackUpscale, bf );
}
vec2 packDepthToRG( const in float v ) {
	if( v <= 0.0 )
		return vec2( 0., 0. );
	if( v >= 1.0 )
		return vec2( 1., 1. );
	float vuf;
	float gf = modf( v * 256., vuf );
	return vec2( vuf * Inv255, gf );
}
float unpackRGBAToDepth( const in vec4 v ) {
	return dot( v, UnpackFactors4 );
}
float unpackRGBToDepth( const in vec3 v ) {
	return dot( v, UnpackFactors3 );
}
float unpackRGToDepth( const in vec2 v ) {
	return v.r * UnpackFactors2.r + v.g * UnpackFactors2.g;
}
vec4 pack2HalfToRGBA( const in vec2 v ) {
	vec4 r = vec4( v.x, fract( v.x * 255.0 ), v.y, fract( v.y * 255.0 ) );
	return vec4( r.x - r.y / 255.0, r.y, r.z - r.w / 255.0, r.w );
}
vec2 unpackRGBATo2Half( const in vec4 v ) {
	return vec2( v.x + ( v.y / 255.0 ), v.z + ( v.w / 255.0 ) );
}
float viewZToOrthographicDepth( const in float viewZ, const in float near, const in float far ) {
	return ( viewZ + near ) / ( near - far );
}
float orthographicDepthToViewZ( const in float depth, const in float near, const in float far ) {
	#ifdef USE_REVERSED_DEPTH_BUFFER
	
		return depth * ( far - near ) - far;
	#else
		return depth * ( near - far ) - near;
	#endif
}
float viewZToPerspectiveDepth( const in float viewZ, const in float near, const in float far ) {
	return ( ( near + viewZ ) * far ) / ( ( far - near ) * viewZ );
}
float perspectiveDepthToViewZ( const in float depth, const in float near, const in float far ) {
	
	#ifdef USE_REVERSED_DEPTH_BUFFER
		return ( near * far ) / ( ( near - far ) * depth - near );
	#else
		return ( near * far ) / ( ( far - near ) * depth - far );
	#endif
}`,RM=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,PM=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,IM=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,DM=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,LM=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,NM=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,UM=`#if NUM_SPOT_LIGHT_COORDS > 0
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#if NUM_SPOT_LIGHT_MAPS > 0
	uniform sampler2D spotLightMap[ NUM_SPOT_LIGHT_MAPS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		#define SUN_LIGHT_CASCADES 2
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#else
			uniform sampler2D sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#endif
		uniform mat4 sunShadowMatrix[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		uniform vec4 sunShadowCascade[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
		struct SunLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SunLightShadow sunLightShadows[ NUM_SUN_LIGHT_SHADOWS ];
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#else
			uniform sampler2D directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#endif
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#else
			uniform sampler2D spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#endif
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform samplerCubeShadow pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#elif defined( SHADOWMAP_TYPE_BASIC )
			uniform samplerCube pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#endif
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float interleavedGradientNoise( vec2 position ) {
			return fract( 52.9829189 * fract( dot( position, vec2( 0.06711056, 0.00583715 ) ) ) );
		}
		vec2 vogelDiskSample( int sampleIndex, int samplesCount, float phi ) {
			const float goldenAngle = 2.399963229728653;
			float r = sqrt( ( float( sampleIndex ) + 0.5 ) / float( samplesCount ) );
			float theta = float( sampleIndex ) * goldenAngle + phi;
			return vec2( cos( theta ), sin( theta ) ) * r;
		}
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float getShadow( sampler2DShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
				vec2 radius = shadowRadius * texelSize;
				float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
				shadow = (
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 0, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 1, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 2, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 3, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 4, 5, phi ) * radius, shadowCoord.z ) )
				) * 0.2;
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#elif defined( SHADOWMAP_TYPE_VSM )
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 distribution = texture2D( shadowMap, shadowCoord.xy ).rg;
				float mean = distribution.x;
				float variance = distribution.y * distribution.y;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					float hard_shadow = step( mean, shadowCoord.z );
				#else
					float hard_shadow = step( shadowCoord.z, mean );
				#endif
				
				if ( hard_shadow == 1.0 ) {
					shadow = 1.0;
				} else {
					variance = max( variance, 0.0000001 );
					float d = shadowCoord.z - mean;
					float p_max = variance / ( variance + d * d );
					p_max = clamp( ( p_max - 0.3 ) / 0.65, 0.0, 1.0 );
					shadow = max( hard_shadow, p_max );
				}
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#else
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				float depth = texture2D( shadowMap, shadowCoord.xy ).r;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					shadow = step( depth, shadowCoord.z );
				#else
					shadow = step( shadowCoord.z, depth );
				#endif
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#endif
	#if NUM_SUN_LIGHT_SHADOWS > 0
		float getSunShadow(
			#if defined( SHADOWMAP_TYPE_PCF )
				sampler2DShadow shadowMap,
			#else
				sampler2D shadowMap,
			#endif
			SunLightShadow sunLightShadow,
			int shadowIndex
		) {
			vec4 shadowWorldPosition = vec4( vSunShadowWorldPosition.xyz + vSunShadowWorldNormal * sunLightShadow.shadowNormalBias, 1.0 );
			float viewDepth = vSunShadowWorldPosition.w;
			int cascadeOffset = shadowIndex * SUN_LIGHT_CASCADES;
			float shadow = 1.0;
			for ( int i = SUN_LIGHT_CASCADES - 1; i >= 0; i -- ) {
				vec4 cascade = sunShadowCascade[ cascadeOffset + i ];
				if ( viewDepth >= cascade.x && viewDepth < cascade.y ) {
					float cascadeShadow = getShadow(
						shadowMap,
						sunLightShadow.shadowMapSize,
						sunLightShadow.shadowIntensity,
						sunLightShadow.shadowBias,
						sunLightShadow.shadowRadius,
						sunShadowMatrix[ cascadeOffset + i ] * shadowWorldPosition
					);
					shadow = mix( cascadeShadow, shadow, smoothstep( cascade.z, cascade.y, viewDepth ) );
				}
			}
			return shadow;
		}
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
	#if defined( SHADOWMAP_TYPE_PCF )
	float getPointShadow( samplerCubeShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 bd3D = normalize( lightToPosition );
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float lightDistance = length( lightToPosition );
			float depthRange = shadowCameraFar - shadowCameraNear;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				float depthA = - shadowCameraNear / depthRange - shadowBias;
				float depthB = shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#else
				float depthA = shadowCameraFar / depthRange + shadowBias;
				float depthB = - shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#endif
			float texelSize = shadowRadius / shadowMapSize.x;
			vec3 absDir = abs( bd3D );
			vec3 tangent = absDir.x > absDir.z ? vec3( 0.0, 1.0, 0.0 ) : vec3( 1.0, 0.0, 0.0 );
			tangent = normalize( cross( bd3D, tangent ) );
			vec3 bitangent = cross( bd3D, tangent );
			float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
			shadow = 0.0;
			for ( int i = 0; i < 5; i ++ ) {
				vec2 offset = vogelDiskSample( i, 5, phi );
				vec3 direction = bd3D + ( tangent * offset.x + bitangent * offset.y ) * texelSize;
				vec3 absDirection = abs( direction );
				float dp = depthA + depthB / max( max( absDirection.x, absDirection.y ), absDirection.z );
				shadow += texture( shadowMap, vec4( direction, dp ) );
			}
			shadow *= 0.2;
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#elif defined( SHADOWMAP_TYPE_BASIC )
	float getPointShadow( samplerCube shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float dp = ( shadowCameraFar * ( viewSpaceZ - shadowCameraNear ) ) / ( viewSpaceZ * ( shadowCameraFar - shadowCameraNear ) );
			dp += shadowBias;
			vec3 bd3D = normalize( lightToPosition );
			float depth = textureCube( shadowMap, bd3D ).r;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				depth = 1.0 - depth;
			#endif
			shadow = step( dp, depth );
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#endif
	#endif
#endif`,FM=`#if NUM_SPOT_LIGHT_COORDS > 0
	uniform mat4 spotLightMatrix[ NUM_SPOT_LIGHT_COORDS ];
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform mat4 directionalShadowMatrix[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		uniform mat4 pointShadowMatrix[ NUM_POINT_LIGHT_SHADOWS ];
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
#endif`,OM=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
	#ifdef HAS_NORMAL
		vec3 shadowWorldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
	#else
		vec3 shadowWorldNormal = vec3( 0.0 );
	#endif
	vec4 shadowWorldPosition;
#endif
#if defined( USE_SHADOWMAP )
	#if NUM_SUN_LIGHT_SHADOWS > 0
		vSunShadowWorldPosition = vec4( worldPosition.xyz, - mvPosition.z );
		vSunShadowWorldNormal = shadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * directionalLightShadows[ i ].shadowNormalBias, 0 );
			vDirectionalShadowCoord[ i ] = directionalShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * pointLightShadows[ i ].shadowNormalBias, 0 );
			vPointShadowCoord[ i ] = pointShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
#endif
#if NUM_SPOT_LIGHT_COORDS > 0
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_COORDS; i ++ ) {
		shadowWorldPosition = worldPosition;
		#if ( defined( USE_SHADOWMAP ) && UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
			shadowWorldPosition.xyz += shadowWorldNormal * spotLightShadows[ i ].shadowNormalBias;
		#endif
		vSpotLightCoord[ i ] = spotLightMatrix[ i ] * shadowWorldPosition;
	}
	#pragma unroll_loop_end
#endif`,BM=`float getShadowMask() {
	float shadow = 1.0;
	#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHT_SHADOWS; i ++ ) {
		sunLight = sunLightShadows[ i ];
		shadow *= receiveShadow ? getSunShadow( sunShadowMap[ i ], sunLight, UNROLLED_LOOP_INDEX ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
		directionalLight = directionalLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( directionalShadowMap[ i ], directionalLight.shadowMapSize, directionalLight.shadowIntensity, directionalLight.shadowBias, directionalLight.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_SHADOWS; i ++ ) {
		spotLight = spotLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( spotShadowMap[ i ], spotLight.shadowMapSize, spotLight.shadowIntensity, spotLight.shadowBias, spotLight.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0 && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
	PointLightShadow pointLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
		pointLight = pointLightShadows[ i ];
		shadow *= receiveShadow ? getPointShadow( pointShadowMap[ i ], pointLight.shadowMapSize, pointLight.shadowIntensity, pointLight.shadowBias, pointLight.shadowRadius, vPointShadowCoord[ i ], pointLight.shadowCameraNear, pointLight.shadowCameraFar ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#endif
	return shadow;
}`,kM=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,zM=`#ifdef USE_SKINNING
	uniform mat4 bindMatrix;
	uniform mat4 bindMatrixInverse;
	uniform highp sampler2D boneTexture;
	mat4 getBoneMatrix( const in float i ) {
		int size = textureSize( boneTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( boneTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( boneTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( boneTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( boneTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
#endif`,VM=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,GM=`#ifdef USE_SKINNING
	mat4 skinMatrix = mat4( 0.0 );
	skinMatrix += skinWeight.x * boneMatX;
	skinMatrix += skinWeight.y * boneMatY;
	skinMatrix += skinWeight.z * boneMatZ;
	skinMatrix += skinWeight.w * boneMatW;
	skinMatrix = bindMatrixInverse * skinMatrix * bindMatrix;
	objectNormal = vec4( skinMatrix * vec4( objectNormal, 0.0 ) ).xyz;
	#ifdef USE_TANGENT
		objectTangent = vec4( skinMatrix * vec4( objectTangent, 0.0 ) ).xyz;
	#endif
#endif`,HM=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,WM=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,XM=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,qM=`#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
uniform float toneMappingExposure;
vec3 LinearToneMapping( vec3 color ) {
	return saturate( toneMappingExposure * color );
}
vec3 ReinhardToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	return saturate( color / ( vec3( 1.0 ) + color ) );
}
vec3 CineonToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	color = max( vec3( 0.0 ), color - 0.004 );
	return pow( ( color * ( 6.2 * color + 0.5 ) ) / ( color * ( 6.2 * color + 1.7 ) + 0.06 ), vec3( 2.2 ) );
}
vec3 RRTAndODTFit( vec3 v ) {
	vec3 a = v * ( v + 0.0245786 ) - 0.000090537;
	vec3 b = v * ( 0.983729 * v + 0.4329510 ) + 0.238081;
	return a / b;
}
vec3 ACESFilmicToneMapping( vec3 color ) {
	const mat3 ACESInputMat = mat3(
		vec3( 0.59719, 0.07600, 0.02840 ),		vec3( 0.35458, 0.90834, 0.13383 ),
		vec3( 0.04823, 0.01566, 0.83777 )
	);
	const mat3 ACESOutputMat = mat3(
		vec3(  1.60475, -0.10208, -0.00327 ),		vec3( -0.53108,  1.10813, -0.07276 ),
		vec3( -0.07367, -0.00605,  1.07602 )
	);
	color *= toneMappingExposure / 0.6;
	color = ACESInputMat * color;
	color = RRTAndODTFit( color );
	color = ACESOutputMat * color;
	return saturate( color );
}
const mat3 LINEAR_REC2020_TO_LINEAR_SRGB = mat3(
	vec3( 1.6605, - 0.1246, - 0.0182 ),
	vec3( - 0.5876, 1.1329, - 0.1006 ),
	vec3( - 0.0728, - 0.0083, 1.1187 )
);
const mat3 LINEAR_SRGB_TO_LINEAR_REC2020 = mat3(
	vec3( 0.6274, 0.0691, 0.0164 ),
	vec3( 0.3293, 0.9195, 0.0880 ),
	vec3( 0.0433, 0.0113, 0.8956 )
);
vec3 agxDefaultContrastApprox( vec3 x ) {
	vec3 x2 = x * x;
	vec3 x4 = x2 * x2;
	return + 15.5 * x4 * x2
		- 40.14 * x4 * x
		+ 31.96 * x4
		- 6.868 * x2 * x
		+ 0.4298 * x2
		+ 0.1191 * x
		- 0.00232;
}
vec3 AgXToneMapping( vec3 color ) {
	const mat3 AgXInsetMatrix = mat3(
		vec3( 0.856627153315983, 0.137318972929847, 0.11189821299995 ),
		vec3( 0.0951212405381588, 0.761241990602591, 0.0767994186031903 ),
		vec3( 0.0482516061458583, 0.101439036467562, 0.811302368396859 )
	);
	const mat3 AgXOutsetMatrix = mat3(
		vec3( 1.1271005818144368, - 0.1413297634984383, - 0.14132976349843826 ),
		vec3( - 0.11060664309660323, 1.157823702216272, - 0.11060664309660294 ),
		vec3( - 0.016493938717834573, - 0.016493938717834257, 1.2519364065950405 )
	);
	const float AgxMinEv = - 12.47393;	const float AgxMaxEv = 4.026069;
	color *= toneMappingExposure;
	color = LINEAR_SRGB_TO_LINEAR_REC2020 * color;
	color = AgXInsetMatrix * color;
	color = max( color, 1e-10 );	color = log2( color );
	color = ( color - AgxMinEv ) / ( AgxMaxEv - AgxMinEv );
	color = clamp( color, 0.0, 1.0 );
	color = agxDefaultContrastApprox( color );
	color = AgXOutsetMatrix * color;
	color = pow( max( vec3( 0.0 ), color ), vec3( 2.2 ) );
	color = LINEAR_REC2020_TO_LINEAR_SRGB * color;
	color = clamp( color, 0.0, 1.0 );
	return color;
}
vec3 NeutralToneMapping( vec3 color ) {
	const float StartCompression = 0.8 - 0.04;
	const float Desaturation = 0.15;
	color *= toneMappingExposure;
	float x = min( color.r, min( color.g, color.b ) );
	float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
	color -= offset;
	float peak = max( color.r, max( color.g, color.b ) );
	if ( peak < StartCompression ) return color;
	float d = 1. - StartCompression;
	float newPeak = 1. - d * d / ( peak + d - StartCompression );
	color *= newPeak / peak;
	float g = 1. - 1. / ( Desaturation * ( peak - newPeak ) + 1. );
	return mix( color, vec3( newPeak ), g );
}
vec3 CustomToneMapping( vec3 color ) { return color; }`,YM=`#ifdef USE_TRANSMISSION
	material.transmission = transmission;
	material.transmissionAlpha = 1.0;
	material.thickness = thickness;
	material.attenuationDistance = attenuationDistance;
	material.attenuationColor = attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		material.transmission *= texture2D( transmissionMap, vTransmissionMapUv ).r;
	#endif
	#ifdef USE_THICKNESSMAP
		material.thickness *= texture2D( thicknessMap, vThicknessMapUv ).g;
	#endif
	vec3 pos = vWorldPosition;
	vec3 v = normalize( cameraPosition - pos );
	vec3 n = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec4 transmitted = getIBLVolumeRefraction(
		n, v, material.roughness, material.diffuseContribution, material.specularColorBlended, material.specularF90,
		pos, modelMatrix, viewMatrix, projectionMatrix, material.dispersion, material.ior, material.thickness,
		material.attenuationColor, material.attenuationDistance );
	material.transmissionAlpha = mix( material.transmissionAlpha, transmitted.a, material.transmission );
	totalDiffuse = mix( totalDiffuse, transmitted.rgb, material.transmission );
#endif`,$M=`#ifdef USE_TRANSMISSION
	uniform float transmission;
	uniform float thickness;
	uniform float attenuationDistance;
	uniform vec3 attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		uniform sampler2D transmissionMap;
	#endif
	#ifdef USE_THICKNESSMAP
		uniform sampler2D thicknessMap;
	#endif
	uniform vec2 transmissionSamplerSize;
	uniform sampler2D transmissionSamplerMap;
	uniform mat4 modelMatrix;
	uniform mat4 projectionMatrix;
	varying vec3 vWorldPosition;
	float w0( float a ) {
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - a + 3.0 ) - 3.0 ) + 1.0 );
	}
	float w1( float a ) {
		return ( 1.0 / 6.0 ) * ( a *  a * ( 3.0 * a - 6.0 ) + 4.0 );
	}
	float w2( float a ){
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - 3.0 * a + 3.0 ) + 3.0 ) + 1.0 );
	}
	float w3( float a ) {
		return ( 1.0 / 6.0 ) * ( a * a * a );
	}
	float g0( float a ) {
		return w0( a ) + w1( a );
	}
	float g1( float a ) {
		return w2( a ) + w3( a );
	}
	float h0( float a ) {
		return - 1.0 + w1( a ) / ( w0( a ) + w1( a ) );
	}
	float h1( float a ) {
		return 1.0 + w3( a ) / ( w2( a ) + w3( a ) );
	}
	vec4 bicubic( sampler2D tex, vec2 uv, vec4 texelSize, float lod ) {
		uv = uv * texelSize.zw + 0.5;
		vec2 iuv = floor( uv );
		vec2 fuv = fract( uv );
		float g0x = g0( fuv.x );
		float g1x = g1( fuv.x );
		float h0x = h0( fuv.x );
		float h1x = h1( fuv.x );
		float h0y = h0( fuv.y );
		float h1y = h1( fuv.y );
		vec2 p0 = ( vec2( iuv.x + h0x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p1 = ( vec2( iuv.x + h1x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p2 = ( vec2( iuv.x + h0x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		vec2 p3 = ( vec2( iuv.x + h1x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		return g0( fuv.y ) * ( g0x * textureLod( tex, p0, lod ) + g1x * textureLod( tex, p1, lod ) ) +
			g1( fuv.y ) * ( g0x * textureLod( tex, p2, lod ) + g1x * textureLod( tex, p3, lod ) );
	}
	vec4 textureBicubic( sampler2D sampler, vec2 uv, float lod ) {
		vec2 fLodSize = vec2( textureSize( sampler, int( lod ) ) );
		vec2 cLodSize = vec2( textureSize( sampler, int( lod + 1.0 ) ) );
		vec2 fLodSizeInv = 1.0 / fLodSize;
		vec2 cLodSizeInv = 1.0 / cLodSize;
		vec4 fSample = bicubic( sampler, uv, vec4( fLodSizeInv, fLodSize ), floor( lod ) );
		vec4 cSample = bicubic( sampler, uv, vec4( cLodSizeInv, cLodSize ), ceil( lod ) );
		return mix( fSample, cSample, fract( lod ) );
	}
	vec3 getVolumeTransmissionRay( const in vec3 n, const in vec3 v, const in float thickness, const in float ior, const in mat4 modelMatrix ) {
		vec3 refractionVector = refract( - v, normalize( n ), 1.0 / ior );
		vec3 modelScale;
		modelScale.x = length( vec3( modelMatrix[ 0 ].xyz ) );
		modelScale.y = length( vec3( modelMatrix[ 1 ].xyz ) );
		modelScale.z = length( vec3( modelMatrix[ 2 ].xyz ) );
		return normalize( refractionVector ) * thickness * modelScale;
	}
	float applyIorToRoughness( const in float roughness, const in float ior ) {
		return roughness * clamp( ior * 2.0 - 2.0, 0.0, 1.0 );
	}
	vec4 getTransmissionSample( const in vec2 fragCoord, const in float roughness, const in float ior ) {
		float lod = log2( transmissionSamplerSize.x ) * applyIorToRoughness( roughness, ior );
		return textureBicubic( transmissionSamplerMap, fragCoord.xy, lod );
	}
	vec3 volumeAttenuation( const in float transmissionDistance, const in vec3 attenuationColor, const in float attenuationDistance ) {
		if ( isinf( attenuationDistance ) ) {
			return vec3( 1.0 );
		} else {
			vec3 attenuationCoefficient = -log( attenuationColor ) / attenuationDistance;
			vec3 transmittance = exp( - attenuationCoefficient * transmissionDistance );			return transmittance;
		}
	}
	vec4 getIBLVolumeRefraction( const in vec3 n, const in vec3 v, const in float roughness, const in vec3 diffuseColor,
		const in vec3 specularColor, const in float specularF90, const in vec3 position, const in mat4 modelMatrix,
		const in mat4 viewMatrix, const in mat4 projMatrix, const in float dispersion, const in float ior, const in float thickness,
		const in vec3 attenuationColor, const in float attenuationDistance ) {
		vec4 transmittedLight;
		vec3 transmittance;
		#ifdef USE_DISPERSION
			float halfSpread = ( ior - 1.0 ) * 0.025 * dispersion;
			vec3 iors = vec3( ior - halfSpread, ior, ior + halfSpread );
			for ( int i = 0; i < 3; i ++ ) {
				vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, iors[ i ], modelMatrix );
				vec3 refractedRayExit = position + transmissionRay;
				vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
				vec2 refractionCoords = ndcPos.xy / ndcPos.w;
				refractionCoords += 1.0;
				refractionCoords /= 2.0;
				vec4 transmissionSample = getTransmissionSample( refractionCoords, roughness, iors[ i ] );
				transmittedLight[ i ] = transmissionSample[ i ];
				transmittedLight.a += transmissionSample.a;
				transmittance[ i ] = diffuseColor[ i ] * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance )[ i ];
			}
			transmittedLight.a /= 3.0;
		#else
			vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, ior, modelMatrix );
			vec3 refractedRayExit = position + transmissionRay;
			vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
			vec2 refractionCoords = ndcPos.xy / ndcPos.w;
			refractionCoords += 1.0;
			refractionCoords /= 2.0;
			transmittedLight = getTransmissionSample( refractionCoords, roughness, ior );
			transmittance = diffuseColor * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance );
		#endif
		vec3 attenuatedColor = transmittance * transmittedLight.rgb;
		vec3 F = EnvironmentBRDF( n, v, specularColor, specularF90, roughness );
		float transmittanceFactor = ( transmittance.r + transmittance.g + transmittance.b ) / 3.0;
		return vec4( ( 1.0 - F ) * attenuatedColor, 1.0 - ( 1.0 - transmittedLight.a ) * transmittanceFactor );
	}
#endif`,ZM=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_SPECULARMAP
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,KM=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	uniform mat3 mapTransform;
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	uniform mat3 alphaMapTransform;
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	uniform mat3 lightMapTransform;
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	uniform mat3 aoMapTransform;
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	uniform mat3 bumpMapTransform;
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	uniform mat3 normalMapTransform;
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_DISPLACEMENTMAP
	uniform mat3 displacementMapTransform;
	varying vec2 vDisplacementMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	uniform mat3 emissiveMapTransform;
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	uniform mat3 metalnessMapTransform;
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	uniform mat3 roughnessMapTransform;
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	uniform mat3 diffuseRoughnessMapTransform;
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	uniform mat3 anisotropyMapTransform;
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	uniform mat3 clearcoatMapTransform;
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform mat3 clearcoatNormalMapTransform;
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform mat3 clearcoatRoughnessMapTransform;
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	uniform mat3 sheenColorMapTransform;
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	uniform mat3 sheenRoughnessMapTransform;
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	uniform mat3 iridescenceMapTransform;
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform mat3 iridescenceThicknessMapTransform;
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SPECULARMAP
	uniform mat3 specularMapTransform;
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	uniform mat3 specularColorMapTransform;
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	uniform mat3 specularIntensityMapTransform;
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,JM=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	vUv = vec3( uv, 1 ).xy;
#endif
#ifdef USE_MAP
	vMapUv = ( mapTransform * vec3( MAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ALPHAMAP
	vAlphaMapUv = ( alphaMapTransform * vec3( ALPHAMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_LIGHTMAP
	vLightMapUv = ( lightMapTransform * vec3( LIGHTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_AOMAP
	vAoMapUv = ( aoMapTransform * vec3( AOMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_BUMPMAP
	vBumpMapUv = ( bumpMapTransform * vec3( BUMPMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_NORMALMAP
	vNormalMapUv = ( normalMapTransform * vec3( NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DISPLACEMENTMAP
	vDisplacementMapUv = ( displacementMapTransform * vec3( DISPLACEMENTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_EMISSIVEMAP
	vEmissiveMapUv = ( emissiveMapTransform * vec3( EMISSIVEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_METALNESSMAP
	vMetalnessMapUv = ( metalnessMapTransform * vec3( METALNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ROUGHNESSMAP
	vRoughnessMapUv = ( roughnessMapTransform * vec3( ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	vDiffuseRoughnessMapUv = ( diffuseRoughnessMapTransform * vec3( DIFFUSE_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ANISOTROPYMAP
	vAnisotropyMapUv = ( anisotropyMapTransform * vec3( ANISOTROPYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOATMAP
	vClearcoatMapUv = ( clearcoatMapTransform * vec3( CLEARCOATMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	vClearcoatNormalMapUv = ( clearcoatNormalMapTransform * vec3( CLEARCOAT_NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	vClearcoatRoughnessMapUv = ( clearcoatRoughnessMapTransform * vec3( CLEARCOAT_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCEMAP
	vIridescenceMapUv = ( iridescenceMapTransform * vec3( IRIDESCENCEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	vIridescenceThicknessMapUv = ( iridescenceThicknessMapTransform * vec3( IRIDESCENCE_THICKNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_COLORMAP
	vSheenColorMapUv = ( sheenColorMapTransform * vec3( SHEEN_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	vSheenRoughnessMapUv = ( sheenRoughnessMapTransform * vec3( SHEEN_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULARMAP
	vSpecularMapUv = ( specularMapTransform * vec3( SPECULARMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_COLORMAP
	vSpecularColorMapUv = ( specularColorMapTransform * vec3( SPECULAR_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	vSpecularIntensityMapUv = ( specularIntensityMapTransform * vec3( SPECULAR_INTENSITYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_TRANSMISSIONMAP
	vTransmissionMapUv = ( transmissionMapTransform * vec3( TRANSMISSIONMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_THICKNESSMAP
	vThicknessMapUv = ( thicknessMapTransform * vec3( THICKNESSMAP_UV, 1 ) ).xy;
#endif`,jM=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,QM=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,ew=`uniform sampler2D t2D;
uniform float backgroundIntensity;
varying vec2 vUv;
void main() {
	vec4 texColor = texture2D( t2D, vUv );
	#ifdef DECODE_VIDEO_TEXTURE
		texColor = vec4( mix( pow( texColor.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), texColor.rgb * 0.0773993808, vec3( lessThanEqual( texColor.rgb, vec3( 0.04045 ) ) ) ), texColor.w );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,tw=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,nw=`uniform float backgroundBlurriness;
uniform float backgroundIntensity;
uniform mat3 backgroundRotation;
varying vec3 vWorldDirection;
#include <envmap_common_pars_fragment>
void main() {
	#ifdef ENVMAP_TYPE_PMREM
		vec4 texColor = textureLod( envMap, backgroundRotation * vWorldDirection, roughnessToMip( backgroundBlurriness ) );
	#else
		vec4 texColor = textureCube( envMap, backgroundRotation * vWorldDirection );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,iw=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,sw=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,rw=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
varying vec2 vHighPrecisionZW;
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vHighPrecisionZW = gl_Position.zw;
}`,ow=`#if DEPTH_PACKING == 3200
	uniform float opacity;
#endif
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
varying vec2 vHighPrecisionZW;
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#if DEPTH_PACKING == 3200
		diffuseColor.a = opacity;
	#endif
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <logdepthbuf_fragment>
	#ifdef USE_REVERSED_DEPTH_BUFFER
		float fragCoordZ = vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ];
	#else
		float fragCoordZ = 0.5 * vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ] + 0.5;
	#endif
	#if DEPTH_PACKING == 3200
		gl_FragColor = vec4( vec3( 1.0 - fragCoordZ ), opacity );
	#elif DEPTH_PACKING == 3201
		gl_FragColor = packDepthToRGBA( fragCoordZ );
	#elif DEPTH_PACKING == 3202
		gl_FragColor = vec4( packDepthToRGB( fragCoordZ ), 1.0 );
	#elif DEPTH_PACKING == 3203
		gl_FragColor = vec4( packDepthToRG( fragCoordZ ), 0.0, 1.0 );
	#endif
}`,aw=`#define DISTANCE
varying vec3 vWorldPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <worldpos_vertex>
	#include <clipping_planes_vertex>
	vWorldPosition = worldPosition.xyz;
}`,lw=`#define DISTANCE
uniform vec3 referencePosition;
uniform float nearDistance;
uniform float farDistance;
varying vec3 vWorldPosition;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	float dist = length( vWorldPosition - referencePosition );
	dist = ( dist - nearDistance ) / ( farDistance - nearDistance );
	dist = saturate( dist );
	gl_FragColor = vec4( dist, 0.0, 0.0, 1.0 );
}`,cw=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,hw=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,uw=`uniform float scale;
attribute float lineDistance;
varying float vLineDistance;
#include <common>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	vLineDistance = scale * lineDistance;
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,dw=`uniform vec3 diffuse;
uniform float opacity;
uniform float dashSize;
uniform float totalSize;
varying float vLineDistance;
#include <common>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	if ( mod( vLineDistance, totalSize ) > dashSize ) {
		discard;
	}
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,fw=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#if defined ( USE_ENVMAP ) || defined ( USE_SKINNING )
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinbase_vertex>
		#include <skinnormal_vertex>
		#include <defaultnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <fog_vertex>
}`,pw=`uniform vec3 diffuse;
uniform float opacity;
#ifndef FLAT_SHADED
	varying vec3 vNormal;
#endif
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		reflectedLight.indirectDiffuse += lightMapTexel.rgb * lightMapIntensity * RECIPROCAL_PI;
	#else
		reflectedLight.indirectDiffuse += vec3( 1.0 );
	#endif
	#include <aomap_fragment>
	reflectedLight.indirectDiffuse *= diffuseColor.rgb;
	vec3 outgoingLight = reflectedLight.indirectDiffuse;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,mw=`#define LAMBERT
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,gw=`#define LAMBERT
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_lambert_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_lambert_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,_w=`#define MATCAP
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <displacementmap_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
	vViewPosition = - mvPosition.xyz;
}`,xw=`#define MATCAP
uniform vec3 diffuse;
uniform float opacity;
uniform sampler2D matcap;
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	vec3 viewDir = normalize( vViewPosition );
	vec3 x = normalize( vec3( viewDir.z, 0.0, - viewDir.x ) );
	vec3 y = cross( viewDir, x );
	vec2 uv = vec2( dot( x, normal ), dot( y, normal ) ) * 0.495 + 0.5;
	#ifdef USE_MATCAP
		vec4 matcapColor = texture2D( matcap, uv );
	#else
		vec4 matcapColor = vec4( vec3( mix( 0.2, 0.8, uv.y ) ), 1.0 );
	#endif
	vec3 outgoingLight = diffuseColor.rgb * matcapColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,yw=`#define NORMAL
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	vViewPosition = - mvPosition.xyz;
#endif
}`,vw=`#define NORMAL
uniform float opacity;
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <uv_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 0.0, 0.0, 0.0, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	gl_FragColor = vec4( normalize( normal ) * 0.5 + 0.5, diffuseColor.a );
	#ifdef OPAQUE
		gl_FragColor.a = 1.0;
	#endif
}`,Sw=`#define PHONG
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,bw=`#define PHONG
uniform vec3 diffuse;
uniform vec3 emissive;
uniform vec3 specular;
uniform float shininess;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_phong_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_phong_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + reflectedLight.directSpecular + reflectedLight.indirectSpecular + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Mw=`#define STANDARD
varying vec3 vViewPosition;
#ifdef USE_TRANSMISSION
	varying vec3 vWorldPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
#ifdef USE_TRANSMISSION
	vWorldPosition = worldPosition.xyz;
#endif
}`,ww=`#define STANDARD
#ifdef PHYSICAL
	#define IOR
	#define USE_SPECULAR
#endif
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float roughness;
uniform float metalness;
uniform float opacity;
#ifdef IOR
	uniform float ior;
#endif
#ifdef USE_SPECULAR
	uniform float specularIntensity;
	uniform vec3 specularColor;
	#ifdef USE_SPECULAR_COLORMAP
		uniform sampler2D specularColorMap;
	#endif
	#ifdef USE_SPECULAR_INTENSITYMAP
		uniform sampler2D specularIntensityMap;
	#endif
#endif
#ifdef USE_CLEARCOAT
	uniform float clearcoat;
	uniform float clearcoatRoughness;
#endif
#ifdef USE_DIFFUSE_ROUGHNESS
	uniform float diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		uniform sampler2D diffuseRoughnessMap;
	#endif
#endif
#ifdef USE_DISPERSION
	uniform float dispersion;
#endif
#ifdef USE_RETROREFLECTION
	uniform float retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	uniform float iridescence;
	uniform float iridescenceIOR;
	uniform float iridescenceThicknessMinimum;
	uniform float iridescenceThicknessMaximum;
#endif
#ifdef USE_SHEEN
	uniform vec3 sheenColor;
	uniform float sheenRoughness;
	#ifdef USE_SHEEN_COLORMAP
		uniform sampler2D sheenColorMap;
	#endif
	#ifdef USE_SHEEN_ROUGHNESSMAP
		uniform sampler2D sheenRoughnessMap;
	#endif
#endif
#ifdef USE_ANISOTROPY
	uniform vec2 anisotropyVector;
	#ifdef USE_ANISOTROPYMAP
		uniform sampler2D anisotropyMap;
	#endif
#endif
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <iridescence_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_physical_pars_fragment>
#include <transmission_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <clearcoat_pars_fragment>
#include <iridescence_pars_fragment>
#include <roughnessmap_pars_fragment>
#include <metalnessmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <roughnessmap_fragment>
	#include <metalnessmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <clearcoat_normal_fragment_begin>
	#include <clearcoat_normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_physical_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 totalDiffuse = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse;
	vec3 totalSpecular = reflectedLight.directSpecular + reflectedLight.indirectSpecular;
	#include <transmission_fragment>
	vec3 outgoingLight = totalDiffuse + totalSpecular + totalEmissiveRadiance;
	#ifdef USE_SHEEN
 
		outgoingLight = outgoingLight + sheenSpecularDirect + sheenSpecularIndirect;
 
 	#endif
	#ifdef USE_CLEARCOAT
		float dotNVcc = saturate( dot( geometryClearcoatNormal, geometryViewDir ) );
		vec3 Fcc = F_Schlick( material.clearcoatF0, material.clearcoatF90, dotNVcc );
		outgoingLight = outgoingLight * ( 1.0 - material.clearcoat * Fcc ) + ( clearcoatSpecularDirect + clearcoatSpecularIndirect ) * material.clearcoat;
	#endif
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Tw=`#define TOON
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Ew=`#define TOON
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <gradientmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_toon_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_toon_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Aw=`uniform float size;
uniform float scale;
#include <common>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
#ifdef USE_POINTS_UV
	varying vec2 vUv;
	uniform mat3 uvTransform;
#endif
void main() {
	#ifdef USE_POINTS_UV
		vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	#endif
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	gl_PointSize = size;
	#ifdef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) gl_PointSize *= ( scale / - mvPosition.z );
	#endif
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <fog_vertex>
}`,Cw=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <color_pars_fragment>
#include <map_particle_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_particle_fragment>
	#include <color_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,Rw=`#include <common>
#include <batching_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <shadowmap_pars_vertex>
void main() {
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Pw=`uniform vec3 color;
uniform float opacity;
#include <common>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <logdepthbuf_pars_fragment>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>
void main() {
	#include <logdepthbuf_fragment>
	gl_FragColor = vec4( color, opacity * ( 1.0 - getShadowMask() ) );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,Iw=`uniform float rotation;
uniform vec2 center;
#include <common>
#include <uv_pars_vertex>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	vec4 mvPosition = modelViewMatrix[ 3 ];
	vec2 scale = vec2( length( modelMatrix[ 0 ].xyz ), length( modelMatrix[ 1 ].xyz ) );
	#ifndef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) scale *= - mvPosition.z;
	#endif
	vec2 alignedPosition = ( position.xy - ( center - vec2( 0.5 ) ) ) * scale;
	vec2 rotatedPosition;
	rotatedPosition.x = cos( rotation ) * alignedPosition.x - sin( rotation ) * alignedPosition.y;
	rotatedPosition.y = sin( rotation ) * alignedPosition.x + cos( rotation ) * alignedPosition.y;
	mvPosition.xy += rotatedPosition;
	gl_Position = projectionMatrix * mvPosition;
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,Dw=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
}`,pt={alphahash_fragment:eb,alphahash_pars_fragment:tb,alphamap_fragment:nb,alphamap_pars_fragment:ib,alphatest_fragment:sb,alphatest_pars_fragment:rb,aomap_fragment:ob,aomap_pars_fragment:ab,batching_pars_vertex:lb,batching_vertex:cb,begin_vertex:hb,beginnormal_vertex:ub,bsdfs:db,iridescence_fragment:fb,bumpmap_pars_fragment:pb,clipping_planes_fragment:mb,clipping_planes_pars_fragment:gb,clipping_planes_pars_vertex:_b,clipping_planes_vertex:xb,color_fragment:yb,color_pars_fragment:vb,color_pars_vertex:Sb,color_vertex:bb,common:Mb,defaultnormal_vertex:wb,displacementmap_pars_vertex:Tb,displacementmap_vertex:Eb,emissivemap_fragment:Ab,emissivemap_pars_fragment:Cb,colorspace_fragment:Rb,colorspace_pars_fragment:Pb,envmap_fragment:Ib,envmap_common_pars_fragment:Db,envmap_pars_fragment:Lb,envmap_pars_vertex:Nb,envmap_physical_pars_fragment:Xb,envmap_vertex:Ub,fog_vertex:Fb,fog_pars_vertex:Ob,fog_fragment:Bb,fog_pars_fragment:kb,gradientmap_pars_fragment:zb,lightmap_pars_fragment:Vb,lights_lambert_fragment:Gb,lights_lambert_pars_fragment:Hb,lights_pars_begin:Wb,lights_toon_fragment:qb,lights_toon_pars_fragment:Yb,lights_phong_fragment:$b,lights_phong_pars_fragment:Zb,lights_physical_fragment:Kb,lights_physical_pars_fragment:Jb,lights_fragment_begin:jb,lights_fragment_maps:Qb,lights_fragment_end:eM,lightprobes_pars_fragment:tM,logdepthbuf_fragment:nM,logdepthbuf_pars_fragment:iM,logdepthbuf_pars_vertex:sM,logdepthbuf_vertex:rM,map_fragment:oM,map_pars_fragment:aM,map_particle_fragment:lM,map_particle_pars_fragment:cM,metalnessmap_fragment:hM,metalnessmap_pars_fragment:uM,morphinstance_vertex:dM,morphcolor_vertex:fM,morphnormal_vertex:pM,morphtarget_pars_vertex:mM,morphtarget_vertex:gM,normal_fragment_begin:_M,normal_fragment_maps:xM,normal_pars_fragment:yM,normal_pars_vertex:vM,normal_vertex:SM,normalmap_pars_fragment:bM,clearcoat_normal_fragment_begin:MM,clearcoat_normal_fragment_maps:wM,clearcoat_pars_fragment:TM,iridescence_pars_fragment:EM,opaque_fragment:AM,packing:CM,premultiplied_alpha_fragment:RM,project_vertex:PM,dithering_fragment:IM,dithering_pars_fragment:DM,roughnessmap_fragment:LM,roughnessmap_pars_fragment:NM,shadowmap_pars_fragment:UM,shadowmap_pars_vertex:FM,shadowmap_vertex:OM,shadowmask_pars_fragment:BM,skinbase_vertex:kM,skinning_pars_vertex:zM,skinning_vertex:VM,skinnormal_vertex:GM,specularmap_fragment:HM,specularmap_pars_fragment:WM,tonemapping_fragment:XM,tonemapping_pars_fragment:qM,transmission_fragment:YM,transmission_pars_fragment:$M,uv_pars_fragment:ZM,uv_pars_vertex:KM,uv_vertex:JM,worldpos_vertex:jM,background_vert:QM,background_frag:ew,backgroundCube_vert:tw,backgroundCube_frag:nw,cube_vert:iw,cube_frag:sw,depth_vert:rw,depth_frag:ow,distance_vert:aw,distance_frag:lw,equirect_vert:cw,equirect_frag:hw,linedashed_vert:uw,linedashed_frag:dw,meshbasic_vert:fw,meshbasic_frag:pw,meshlambert_vert:mw,meshlambert_frag:gw,meshmatcap_vert:_w,meshmatcap_frag:xw,meshnormal_vert:yw,meshnormal_frag:vw,meshphong_vert:Sw,meshphong_frag:bw,meshphysical_vert:Mw,meshphysical_frag:ww,meshtoon_vert:Tw,meshtoon_frag:Ew,points_vert:Aw,points_frag:Cw,shadow_vert:Rw,shadow_frag:Pw,sprite_vert:Iw,sprite_frag:Dw},Le={common:{diffuse:{value:new je(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new st},alphaMap:{value:null},alphaMapTransform:{value:new st},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new st}},envmap:{envMap:{value:null},envMapRotation:{value:new st},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new st}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new st}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new st},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new st},normalScale:{value:new $e(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new st},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new st}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new st}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new st}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new je(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new je(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new st},alphaTest:{value:0},uvTransform:{value:new st}},sprite:{diffuse:{value:new je(16777215)},opacity:{value:1},center:{value:new $e(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new st},alphaMap:{value:null},alphaMapTransform:{value:new st},alphaTest:{value:0}}},_s={basic:{uniforms:$n([Le.common,Le.specularmap,Le.envmap,Le.aomap,Le.lightmap,Le.fog]),vertexShader:pt.meshbasic_vert,fragmentShader:pt.meshbasic_frag},lambert:{uniforms:$n([Le.common,Le.specularmap,Le.envmap,Le.aomap,Le.lightmap,Le.emissivemap,Le.bumpmap,Le.normalmap,Le.displacementmap,Le.fog,Le.lights,{emissive:{value:new je(0)},envMapIntensity:{value:1}}]),vertexShader:pt.meshlambert_vert,fragmentShader:pt.meshlambert_frag},phong:{uniforms:$n([Le.common,Le.specularmap,Le.envmap,Le.aomap,Le.lightmap,Le.emissivemap,Le.bumpmap,Le.normalmap,Le.displacementmap,Le.fog,Le.lights,{emissive:{value:new je(0)},specular:{value:new je(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:pt.meshphong_vert,fragmentShader:pt.meshphong_frag},standard:{uniforms:$n([Le.common,Le.envmap,Le.aomap,Le.lightmap,Le.emissivemap,Le.bumpmap,Le.normalmap,Le.displacementmap,Le.roughnessmap,Le.metalnessmap,Le.fog,Le.lights,{emissive:{value:new je(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:pt.meshphysical_vert,fragmentShader:pt.meshphysical_frag},toon:{uniforms:$n([Le.common,Le.aomap,Le.lightmap,Le.emissivemap,Le.bumpmap,Le.normalmap,Le.displacementmap,Le.gradientmap,Le.fog,Le.lights,{emissive:{value:new je(0)}}]),vertexShader:pt.meshtoon_vert,fragmentShader:pt.meshtoon_frag},matcap:{uniforms:$n([Le.common,Le.bumpmap,Le.normalmap,Le.displacementmap,Le.fog,{matcap:{value:null}}]),vertexShader:pt.meshmatcap_vert,fragmentShader:pt.meshmatcap_frag},points:{uniforms:$n([Le.points,Le.fog]),vertexShader:pt.points_vert,fragmentShader:pt.points_frag},dashed:{uniforms:$n([Le.common,Le.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:pt.linedashed_vert,fragmentShader:pt.linedashed_frag},depth:{uniforms:$n([Le.common,Le.displacementmap]),vertexShader:pt.depth_vert,fragmentShader:pt.depth_frag},normal:{uniforms:$n([Le.common,Le.bumpmap,Le.normalmap,Le.displacementmap,{opacity:{value:1}}]),vertexShader:pt.meshnormal_vert,fragmentShader:pt.meshnormal_frag},sprite:{uniforms:$n([Le.sprite,Le.fog]),vertexShader:pt.sprite_vert,fragmentShader:pt.sprite_frag},background:{uniforms:{uvTransform:{value:new st},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:pt.background_vert,fragmentShader:pt.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new st}},vertexShader:pt.backgroundCube_vert,fragmentShader:pt.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:pt.cube_vert,fragmentShader:pt.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:pt.equirect_vert,fragmentShader:pt.equirect_frag},distance:{uniforms:$n([Le.common,Le.displacementmap,{referencePosition:{value:new B},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:pt.distance_vert,fragmentShader:pt.distance_frag},shadow:{uniforms:$n([Le.lights,Le.fog,{color:{value:new je(0)},opacity:{value:1}}]),vertexShader:pt.shadow_vert,fragmentShader:pt.shadow_frag}};_s.physical={uniforms:$n([_s.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new st},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new st},clearcoatNormalScale:{value:new $e(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new st},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new st},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new st},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new st},sheen:{value:0},sheenColor:{value:new je(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new st},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new st},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new st},transmissionSamplerSize:{value:new $e},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new st},attenuationDistance:{value:0},attenuationColor:{value:new je(0)},specularColor:{value:new je(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new st},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new st},anisotropyVector:{value:new $e},anisotropyMap:{value:null},anisotropyMapTransform:{value:new st}}]),vertexShader:pt.meshphysical_vert,fragmentShader:pt.meshphysical_frag};var cu={r:0,b:0,g:0},Lw=new Pt,X0=new st;X0.set(-1,0,0,0,1,0,0,0,1);function Nw(n,e,t,i,s,r){let o=new je(0),a=s===!0?0:1,l,c,h=null,u=0,d=null;function f(y){let C=y.isScene===!0?y.background:null;if(C&&C.isTexture){let w=y.backgroundBlurriness>0;C=e.get(C,w)}return C}function g(y){let C=!1,w=f(y);w===null?m(o,a):w&&w.isColor&&(m(w,1),C=!0);let P=n.xr.getEnvironmentBlendMode();P==="additive"?t.buffers.color.setClear(0,0,0,1,r):P==="alpha-blend"&&t.buffers.color.setClear(0,0,0,0,r),(n.autoClear||C)&&(t.buffers.depth.setTest(!0),t.buffers.depth.setMask(!0),t.buffers.color.setMask(!0),n.clear(n.autoClearColor,n.autoClearDepth,n.autoClearStencil))}function v(y,C){let w=f(C);w&&w.isCubeTexture?(c===void 0&&(c=new Vn(new ar(1,1,1),new ps({name:"BackgroundCubeMaterial",uniforms:Gr(_s.backgroundCube.uniforms),vertexShader:_s.backgroundCube.vertexShader,fragmentShader:_s.backgroundCube.fragmentShader,side:ri,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),c.geometry.deleteAttribute("normal"),c.geometry.deleteAttribute("uv"),c.onBeforeRender=function(P,E,x){this.matrixWorld.copyPosition(x.matrixWorld)},Object.defineProperty(c.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),i.update(c)),c.material.uniforms.envMap.value=w,c.material.uniforms.backgroundBlurriness.value=C.backgroundBlurriness,c.material.uniforms.backgroundIntensity.value=C.backgroundIntensity,c.material.uniforms.backgroundRotation.value.setFromMatrix4(Lw.makeRotationFromEuler(C.backgroundRotation)).transpose(),w.isRenderTargetTexture===!1&&c.material.uniforms.backgroundRotation.value.premultiply(X0),c.material.toneMapped=bt.getTransfer(w.colorSpace)!==Lt,(h!==w||u!==w.version||d!==n.toneMapping)&&(c.material.needsUpdate=!0,h=w,u=w.version,d=n.toneMapping),c.layers.enableAll(),y.unshift(c,c.geometry,c.material,0,0,null)):w&&w.isTexture&&(l===void 0&&(l=new Vn(new il(2,2),new ps({name:"BackgroundMaterial",uniforms:Gr(_s.background.uniforms),vertexShader:_s.background.vertexShader,fragmentShader:_s.background.fragmentShader,side:pr,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),l.geometry.deleteAttribute("normal"),Object.defineProperty(l.material,"map",{get:function(){return this.uniforms.t2D.value}}),i.update(l)),l.material.uniforms.t2D.value=w,l.material.uniforms.backgroundIntensity.value=C.backgroundIntensity,l.material.toneMapped=bt.getTransfer(w.colorSpace)!==Lt,w.matrixAutoUpdate===!0&&w.updateMatrix(),l.material.uniforms.uvTransform.value.copy(w.matrix),(h!==w||u!==w.version||d!==n.toneMapping)&&(l.material.needsUpdate=!0,h=w,u=w.version,d=n.toneMapping),l.layers.enableAll(),y.unshift(l,l.geometry,l.material,0,0,null))}function m(y,C){y.getRGB(cu,Wf(n)),t.buffers.color.setClear(cu.r,cu.g,cu.b,C,r)}function p(){c!==void 0&&(c.geometry.dispose(),c.material.dispose(),c=void 0),l!==void 0&&(l.geometry.dispose(),l.material.dispose(),l=void 0)}return{getClearColor:function(){return o},setClearColor:function(y,C=1){o.set(y),a=C,m(o,a)},getClearAlpha:function(){return a},setClearAlpha:function(y){a=y,m(o,a)},render:g,addToRenderList:v,dispose:p}}function Uw(n,e){let t=n.getParameter(n.MAX_VERTEX_ATTRIBS),i={},s=d(null),r=s,o=!1;function a(L,z,W,D,X){let $=!1,H=u(L,D,W,z);r!==H&&(r=H,c(r.object)),$=f(L,D,W,X),$&&g(L,D,W,X),X!==null&&e.update(X,n.ELEMENT_ARRAY_BUFFER),($||o)&&(o=!1,w(L,z,W,D),X!==null&&n.bindBuffer(n.ELEMENT_ARRAY_BUFFER,e.get(X).buffer))}function l(){return n.createVertexArray()}function c(L){return n.bindVertexArray(L)}function h(L){return n.deleteVertexArray(L)}function u(L,z,W,D){let X=D.wireframe===!0,$=i[z.id];$===void 0&&($={},i[z.id]=$);let H=L.isInstancedMesh===!0?L.id:0,he=$[H];he===void 0&&(he={},$[H]=he);let J=he[W.id];J===void 0&&(J={},he[W.id]=J);let Q=J[X];return Q===void 0&&(Q=d(l()),J[X]=Q),Q}function d(L){let z=[],W=[],D=[];for(let X=0;X<t;X++)z[X]=0,W[X]=0,D[X]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:z,enabledAttributes:W,attributeDivisors:D,object:L,attributes:{},index:null}}function f(L,z,W,D){let X=r.attributes,$=z.attributes,H=0,he=W.getAttributes();for(let J in he)if(he[J].location>=0){let re=X[J],fe=$[J];if(fe===void 0&&(J==="instanceMatrix"&&L.instanceMatrix&&(fe=L.instanceMatrix),J==="instanceColor"&&L.instanceColor&&(fe=L.instanceColor)),re===void 0||re.attribute!==fe||fe&&re.data!==fe.data)return!0;H++}return r.attributesNum!==H||r.index!==D}function g(L,z,W,D){let X={},$=z.attributes,H=0,he=W.getAttributes();for(let J in he)if(he[J].location>=0){let re=$[J];re===void 0&&(J==="instanceMatrix"&&L.instanceMatrix&&(re=L.instanceMatrix),J==="instanceColor"&&L.instanceColor&&(re=L.instanceColor));let fe={};fe.attribute=re,re&&re.data&&(fe.data=re.data),X[J]=fe,H++}r.attributes=X,r.attributesNum=H,r.index=D}function v(){let L=r.newAttributes;for(let z=0,W=L.length;z<W;z++)L[z]=0}function m(L){p(L,0)}function p(L,z){let W=r.newAttributes,D=r.enabledAttributes,X=r.attributeDivisors;W[L]=1,D[L]===0&&(n.enableVertexAttribArray(L),D[L]=1),X[L]!==z&&(n.vertexAttribDivisor(L,z),X[L]=z)}function y(){let L=r.newAttributes,z=r.enabledAttributes;for(let W=0,D=z.length;W<D;W++)z[W]!==L[W]&&(n.disableVertexAttribArray(W),z[W]=0)}function C(L,z,W,D,X,$,H){H===!0?n.vertexAttribIPointer(L,z,W,X,$):n.vertexAttribPointer(L,z,W,D,X,$)}function w(L,z,W,D){v();let X=D.attributes,$=W.getAttributes(),H=z.defaultAttributeValues;for(let he in $){let J=$[he];if(J.location>=0){let Q=X[he];if(Q===void 0&&(he==="instanceMatrix"&&L.instanceMatrix&&(Q=L.instanceMatrix),he==="instanceColor"&&L.instanceColor&&(Q=L.instanceColor)),Q!==void 0){let re=Q.normalized,fe=Q.itemSize,de=e.get(Q);if(de===void 0)continue;let te=de.buffer,ge=de.type,ye=de.bytesPerElement,Ce=ge===n.INT||ge===n.UNSIGNED_INT||Q.gpuType===Th;if(Q.isInterleavedBufferAttribute){let Me=Q.data,Xe=Me.isInterleavedBuffer===!0?Me.stride:Me.itemSize,lt=Q.offset;if(Me.isInstancedInterleavedBuffer||Me.isInstancedBufferAttribute){for(let He=0;He<J.locationSize;He++)p(J.location+He,Me.meshPerAttribute);L.isInstancedMesh!==!0&&D._maxInstanceCount===void 0&&(D._maxInstanceCount=Me.meshPerAttribute*Me.count)}else for(let He=0;He<J.locationSize;He++)m(J.location+He);n.bindBuffer(n.ARRAY_BUFFER,te);for(let He=0;He<J.locationSize;He++)C(J.location+He,fe/J.locationSize,ge,re,Xe*ye,(lt+fe/J.locationSize*He)*ye,Ce)}else{if(Q.isInstancedBufferAttribute){for(let Me=0;Me<J.locationSize;Me++)p(J.location+Me,Q.meshPerAttribute);L.isInstancedMesh!==!0&&D._maxInstanceCount===void 0&&(D._maxInstanceCount=Q.meshPerAttribute*Q.count)}else for(let Me=0;Me<J.locationSize;Me++)m(J.location+Me);n.bindBuffer(n.ARRAY_BUFFER,te);for(let Me=0;Me<J.locationSize;Me++)C(J.location+Me,fe/J.locationSize,ge,re,fe*ye,fe/J.locationSize*Me*ye,Ce)}}else if(H!==void 0){let re=H[he];if(re!==void 0)switch(re.length){case 2:n.vertexAttrib2fv(J.location,re);break;case 3:n.vertexAttrib3fv(J.location,re);break;case 4:n.vertexAttrib4fv(J.location,re);break;default:n.vertexAttrib1fv(J.location,re)}}}}y()}function P(){k();for(let L in i){let z=i[L];for(let W in z){let D=z[W];for(let X in D){let $=D[X];for(let H in $)h($[H].object),delete $[H];delete D[X]}}delete i[L]}}function E(L){if(i[L.id]===void 0)return;let z=i[L.id];for(let W in z){let D=z[W];for(let X in D){let $=D[X];for(let H in $)h($[H].object),delete $[H];delete D[X]}}delete i[L.id]}function x(L){for(let z in i){let W=i[z];for(let D in W){let X=W[D];if(X[L.id]===void 0)continue;let $=X[L.id];for(let H in $)h($[H].object),delete $[H];delete X[L.id]}}}function T(L){for(let z in i){let W=i[z],D=L.isInstancedMesh===!0?L.id:0,X=W[D];if(X!==void 0){for(let $ in X){let H=X[$];for(let he in H)h(H[he].object),delete H[he];delete X[$]}delete W[D],Object.keys(W).length===0&&delete i[z]}}}function k(){N(),o=!0,r!==s&&(r=s,c(r.object))}function N(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:a,reset:k,resetDefaultState:N,dispose:P,releaseStatesOfGeometry:E,releaseStatesOfObject:T,releaseStatesOfProgram:x,initAttributes:v,enableAttribute:m,disableUnusedAttributes:y}}function Fw(n,e,t){let i;function s(l){i=l}function r(l,c){n.drawArrays(i,l,c),t.update(c,i,1)}function o(l,c,h){h!==0&&(n.drawArraysInstanced(i,l,c,h),t.update(c,i,h))}function a(l,c,h){if(h===0)return;e.get("WEBGL_multi_draw").multiDrawArraysWEBGL(i,l,0,c,0,h);let d=0;for(let f=0;f<h;f++)d+=c[f];t.update(d,i,1)}this.setMode=s,this.render=r,this.renderInstances=o,this.renderMultiDraw=a}function Ow(n,e,t,i){let s;function r(){if(s!==void 0)return s;if(e.has("EXT_texture_filter_anisotropic")===!0){let x=e.get("EXT_texture_filter_anisotropic");s=n.getParameter(x.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function o(x){return!(x!==Zi&&i.convert(x)!==n.getParameter(n.IMPLEMENTATION_COLOR_READ_FORMAT))}function a(x){let T=x===$i&&(e.has("EXT_color_buffer_half_float")||e.has("EXT_color_buffer_float"));return!(x!==hi&&x!==Yi&&!T&&i.convert(x)!==n.getParameter(n.IMPLEMENTATION_COLOR_READ_TYPE))}function l(x){if(x==="highp"){if(n.getShaderPrecisionFormat(n.VERTEX_SHADER,n.HIGH_FLOAT).precision>0&&n.getShaderPrecisionFormat(n.FRAGMENT_SHADER,n.HIGH_FLOAT).precision>0)return"highp";x="mediump"}return x==="mediump"&&n.getShaderPrecisionFormat(n.VERTEX_SHADER,n.MEDIUM_FLOAT).precision>0&&n.getShaderPrecisionFormat(n.FRAGMENT_SHADER,n.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let c=t.precision!==void 0?t.precision:"highp",h=l(c);h!==c&&(Ke("WebGLRenderer:",c,"not supported, using",h,"instead."),c=h);let u=t.reversedDepthBuffer===!0&&e.has("EXT_clip_control"),d=t.logarithmicDepthBuffer===!0&&u===!1;t.reversedDepthBuffer===!0&&u===!1&&Ke("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),t.logarithmicDepthBuffer===!0&&u===!0&&Ke("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let f=n.getParameter(n.MAX_TEXTURE_IMAGE_UNITS),g=n.getParameter(n.MAX_VERTEX_TEXTURE_IMAGE_UNITS),v=n.getParameter(n.MAX_TEXTURE_SIZE),m=n.getParameter(n.MAX_CUBE_MAP_TEXTURE_SIZE),p=n.getParameter(n.MAX_VERTEX_ATTRIBS),y=n.getParameter(n.MAX_VERTEX_UNIFORM_VECTORS),C=n.getParameter(n.MAX_VARYING_VECTORS),w=n.getParameter(n.MAX_FRAGMENT_UNIFORM_VECTORS),P=n.getParameter(n.MAX_SAMPLES),E=n.getParameter(n.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:l,textureFormatReadable:o,textureTypeReadable:a,precision:c,logarithmicDepthBuffer:d,reversedDepthBuffer:u,maxTextures:f,maxVertexTextures:g,maxTextureSize:v,maxCubemapSize:m,maxAttributes:p,maxVertexUniforms:y,maxVaryings:C,maxFragmentUniforms:w,maxSamples:P,samples:E}}function Bw(n){let e=this,t=null,i=0,s=!1,r=!1,o=new Si,a=new st,l={value:null,needsUpdate:!1};this.uniform=l,this.numPlanes=0,this.numIntersection=0,this.init=function(u,d){let f=u.length!==0||d||i!==0||s;return s=d,i=u.length,f},this.beginShadows=function(){r=!0,h(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(u,d){t=h(u,d,0)},this.setState=function(u,d,f){let g=u.clippingPlanes,v=u.clipIntersection,m=u.clipShadows,p=n.get(u);if(!s||g===null||g.length===0||r&&!m)r?h(null):c();else{let y=r?0:i,C=y*4,w=p.clippingState||null;l.value=w,w=h(g,d,C,f);for(let P=0;P!==C;++P)w[P]=t[P];p.clippingState=w,this.numIntersection=v?this.numPlanes:0,this.numPlanes+=y}};function c(){l.value!==t&&(l.value=t,l.needsUpdate=i>0),e.numPlanes=i,e.numIntersection=0}function h(u,d,f,g){let v=u!==null?u.length:0,m=null;if(v!==0){if(m=l.value,g!==!0||m===null){let p=f+v*4,y=d.matrixWorldInverse;a.getNormalMatrix(y),(m===null||m.length<p)&&(m=new Float32Array(p));for(let C=0,w=f;C!==v;++C,w+=4)o.copy(u[C]).applyMatrix4(y,a),o.normal.toArray(m,w),m[w+3]=o.constant}l.value=m,l.needsUpdate=!0}return e.numPlanes=v,e.numIntersection=0,m}}var Ml=class extends bi{constructor(e=1,t={}){super(e,e,t),this.isWebGLCubeRenderTarget=!0;let i={width:e,height:e,depth:1},s=[i,i,i,i,i,i];this.texture=new ja(s),this._setTextureOptions(t),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(e,t){this.texture.type=t.type,this.texture.colorSpace=t.colorSpace,this.texture.generateMipmaps=t.generateMipmaps,this.texture.minFilter=t.minFilter,this.texture.magFilter=t.magFilter;let i={uniforms:{tEquirect:{value:null}},vertexShader:`

				varying vec3 vWorldDirection;

				vec3 transformDirection( in vec3 dir, in mat4 matrix ) {

					return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );

				}

				void main() {

					vWorldDirection = transformDirection( position, modelMatrix );

					#include <begin_vertex>
					#include <project_vertex>

				}
			`,fragmentShader:`

				uniform sampler2D tEquirect;

				varying vec3 vWorldDirection;

				#include <common>

				void main() {

					vec3 direction = normalize( vWorldDirection );

					vec2 sampleUV = equirectUv( direction );

					gl_FragColor = texture2D( tEquirect, sampleUV );

				}
			`},s=new ar(5,5,5),r=new ps({name:"CubemapFromEquirect",uniforms:Gr(i.uniforms),vertexShader:i.vertexShader,fragmentShader:i.fragmentShader,side:ri,blending:Br});r.uniforms.tEquirect.value=t;let o=new Vn(s,r),a=t.minFilter;return t.minFilter===Os&&(t.minFilter=ni),new ko(1,10,this).update(e,o),t.minFilter=a,o.geometry.dispose(),o.material.dispose(),this}clear(e,t=!0,i=!0,s=!0){let r=e.getRenderTarget();for(let o=0;o<6;o++)e.setRenderTarget(this,o),e.clear(t,i,s);e.setRenderTarget(r)}},M0=256,kw=3,zw=20,q0=256,Y0=16,Vw=3,Gw=new B,Hw=new je,uu=class n{constructor(e){this._renderer=e,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new ko(1,10,null),this._boxMesh=new Vn(new ar(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(e,t=0,i=.1,s=100,r={}){let{size:o=256,position:a=Gw}=r,l=this._renderer;this._setSize(o);let c=this._allocateTarget(),h=this._getSourceTarget(!0);t>0&&(h.texture.mipmapsAutoUpdate=!1);let u=l.autoClear,d=l.autoClearColor,f=l.autoClearDepth,g=l.autoClearStencil,v=e.background;l.autoClear=!0,l.autoClearColor=!0,l.autoClearDepth=!0,l.autoClearStencil=!0,v===null&&(e.background=l.getClearColor(Hw));let m=new ko(i,s,h);return m.position.copy(a),m.update(l,e),l.autoClear=u,l.autoClearColor=d,l.autoClearDepth=f,l.autoClearStencil=g,e.background=v,t>0&&(h.texture.mipmapsAutoUpdate=!0,this._blur(c,t)),this._applyPMREM(c),c}fromEquirectangular(e,t=null){return this._fromTexture(e,t)}fromCubemap(e,t=null){return this._fromTexture(e,t)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=E0(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=T0(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(e,t){return t>0?1-Math.sqrt(1-e/t):0}_setSize(e){this._cubeSize=Math.max(M0,zf(e))}_fromTexture(e,t){e.mapping===zr||e.mapping===Ho?this._setSize(e.image.length===0?M0:e.image[0].width||e.image[0].image.width):this._setSize(e.image.width/4);let i=t||this._allocateTarget();return this._textureToCubemap(e),this._applyPMREM(i),i}_allocateTarget(){let e=this._cubeSize,t=w0(e,!1,!1),i=Math.log2(e)-kw;for(let s=0;s<=i;s++)t.texture.mipmaps.push({width:e>>s,height:e>>s});return t.texture.name="PMREM",t.texture.isPMREMTexture=!0,t}_getSourceTarget(e=!1){let t=this._cubeSize,i=this._sourceTarget;return(i===null||i.width!==t||e&&i.depthBuffer===!1)&&(i!==null&&i.dispose(),this._sourceTarget=w0(t,!0,e)),this._sourceTarget}_compileMaterial(e){this._boxMesh.material=e,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(e,t,i){let s=this._boxMesh,r=this._cubeCamera;s.material=i,r.renderTarget=e,r.activeMipmapLevel=t;let o=e.width>>t;e.viewport.set(0,0,o,o),r.update(this._renderer,s),e.viewport.set(0,0,e.width,e.height)}_textureToCubemap(e){let t;e.mapping===zr||e.mapping===Ho?(this._cubemapMaterial===null&&(this._cubemapMaterial=E0()),t=this._cubemapMaterial,t.uniforms.flipEnvMap.value=e.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=T0()),t=this._equirectMaterial),t.uniforms.envMap.value=e,this._renderCube(this._getSourceTarget(),0,t)}_applyPMREM(e){this._ggxMaterial===null&&(this._ggxMaterial=Ww(),this._integrationMaterial=Xw());let t=this._cubeSize,i=e.texture.mipmaps.length-1,s=this._ggxMaterial.uniforms;s.envMap.value=this._sourceTarget.texture;let r=this._integrationMaterial.uniforms;r.envMap.value=this._sourceTarget.texture,r.sourceLod.value=Math.log2(t/Y0);for(let o=0;o<=i;o++){let a=n.lodToRoughness(o,i);if(o>i-Vw)r.roughness.value=a,this._renderCube(e,o,this._integrationMaterial);else{let l=a>0?Math.log2(t)+.5*Math.log2(6/(q0*Math.pow(a,4)))+.5:0;s.roughness.value=a,s.lodBias.value=l,this._renderCube(e,o,this._ggxMaterial)}}}_blur(e,t){this._blurMaterial===null&&(this._blurMaterial=qw());let i=this._blurMaterial,s=i.uniforms,r=this._sourceTarget;s.sigma.value=Math.min(t,Math.PI)/Math.SQRT2,s.envMap.value=r.texture,this._renderCube(e,0,i),s.envMap.value=e.texture,this._renderCube(r,0,i)}};function w0(n,e,t){return new Ml(n,{minFilter:Os,generateMipmaps:e,type:$i,colorSpace:Ga,depthBuffer:t})}function wl(n,e,t){return new ps({name:n,uniforms:e,vertexShader:pt.cube_vert,fragmentShader:t,side:ri,blending:Br,depthTest:!1,depthWrite:!1})}function Ww(){return wl("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${q0}u

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float lodBias;

		#include <common>

		// Van der Corput radical inverse
		float radicalInverse_VdC( uint bits ) {

			bits = ( bits << 16u ) | ( bits >> 16u );
			bits = ( ( bits & 0x55555555u ) << 1u ) | ( ( bits & 0xAAAAAAAAu ) >> 1u );
			bits = ( ( bits & 0x33333333u ) << 2u ) | ( ( bits & 0xCCCCCCCCu ) >> 2u );
			bits = ( ( bits & 0x0F0F0F0Fu ) << 4u ) | ( ( bits & 0xF0F0F0F0u ) >> 4u );
			bits = ( ( bits & 0x00FF00FFu ) << 8u ) | ( ( bits & 0xFF00FF00u ) >> 8u );
			return float( bits ) * 2.3283064365386963e-10; // / 0x100000000

		}

		// Hammersley sequence
		vec2 hammersley( uint i, uint N ) {

			return vec2( float( i ) / float( N ), radicalInverse_VdC( i ) );

		}

		void main() {

			vec3 N = normalize( vWorldDirection );

			// For very low roughness, just sample the environment directly
			if ( roughness < 0.001 ) {

				gl_FragColor = vec4( textureLod( envMap, N, 0.0 ).rgb, 1.0 );
				return;

			}

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			// Tangent space basis for VNDF sampling
			vec3 up = abs( N.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, N ) );
			vec3 bitangent = cross( N, tangent );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			for ( uint i = 0u; i < GGX_SAMPLES; i ++ ) {

				vec2 Xi = hammersley( i, GGX_SAMPLES );

				// With V = N, sample the reflected direction directly.
				float invQ = 1.0 / ( 1.0 - Xi.x + alpha2 * Xi.x );
				float NdotL = ( 1.0 - Xi.x - alpha2 * Xi.x ) * invQ;

				if ( NdotL > 0.0 ) {

					float phi = 2.0 * PI * Xi.y;
					float sinTheta = 2.0 * alpha * sqrt( Xi.x * ( 1.0 - Xi.x ) ) * invQ;
					vec3 L = N * NdotL + ( tangent * cos( phi ) + bitangent * sin( phi ) ) * sinTheta;

					// Match the source mip to the sample's solid angle. The terms
					// independent of the sample are precomputed in lodBias.
					float d = alpha2 * invQ;
					float lod = max( log2( d ) + lodBias, 0.0 );

					// Weight by NdotL for the split-sum approximation
					prefilteredColor += textureLod( envMap, L, lod ).rgb * NdotL;
					totalWeight += NdotL;

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function Xw(){return wl("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:Y0}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float sourceLod;
		uniform int sourceSize;

		void main() {

			vec3 N = normalize( vWorldDirection );

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			float texelSize = 2.0 / float( sourceSize );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			// Pair opposite texels: only the one in N's hemisphere contributes.
			for ( int face = 0; face < 3; face ++ ) {

				for ( int y = 0; y < sourceSize; y ++ ) {

					for ( int x = 0; x < sourceSize; x ++ ) {

						vec2 uv = ( vec2( x, y ) + 0.5 ) * texelSize - 1.0;
						vec3 texelDirection = face == 0 ? vec3( 1.0, uv ) : ( face == 1 ? vec3( uv.x, 1.0, uv.y ) : vec3( uv, 1.0 ) );

						float invDistance = inversesqrt( 1.0 + dot( uv, uv ) );
						float NdotL = dot( N, texelDirection );
						texelDirection *= NdotL < 0.0 ? - 1.0 : 1.0;
						NdotL = abs( NdotL ) * invDistance;

						// With V = N, NdotH squared is ( 1 + NdotL ) / 2. Common factors
						// in the GGX distribution and texel solid angle cancel when normalized.
						float d = 1.0 + alpha2 + ( alpha2 - 1.0 ) * NdotL;
						float weight = NdotL * invDistance * invDistance * invDistance / ( d * d );

						prefilteredColor += textureLod( envMap, texelDirection, sourceLod ).rgb * weight;
						totalWeight += weight;

					}

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function qw(){return wl("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${zw}
		#define GOLDEN_ANGLE 2.39996322973

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float sigma;

		#include <common>

		void main() {

			vec3 outputDirection = normalize( vWorldDirection );

			vec3 up = abs( outputDirection.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, outputDirection ) );
			vec3 bitangent = cross( outputDirection, tangent );

			// Truncate the kernel at three standard deviations or at the antipode.
			float thetaMax = min( 3.0 * sigma, PI );
			float truncation = 1.0 - exp( - 0.5 * thetaMax * thetaMax / ( sigma * sigma ) );

			vec3 accumColor = vec3( 0.0 );
			float accumWeight = 0.0;

			for ( int i = 0; i < SAMPLES; i ++ ) {

				// Stratified inverse-CDF sampling of the Gaussian, placed on a golden-angle spiral.
				float stratum = ( float( i ) + 0.5 ) / float( SAMPLES );
				float theta = sigma * sqrt( - 2.0 * log( 1.0 - stratum * truncation ) );
				float phi = float( i ) * GOLDEN_ANGLE;

				vec3 offset = cos( phi ) * tangent + sin( phi ) * bitangent;
				vec3 sampleDirection = cos( theta ) * outputDirection + sin( theta ) * offset;

				// Correct the planar sample density to solid angle.
				float weight = sin( theta ) / theta;

				accumColor += weight * textureLod( envMap, sampleDirection, 0.0 ).rgb;
				accumWeight += weight;

			}

			gl_FragColor = vec4( accumColor / accumWeight, 1.0 );

		}
	`)}function T0(){return wl("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

		varying vec3 vWorldDirection;

		uniform sampler2D envMap;

		#include <common>

		void main() {

			// Average four subpixel samples to preserve small, bright features.
			vec3 direction = normalize( vWorldDirection );
			vec3 dx = dFdx( direction ) * 0.25;
			vec3 dy = dFdy( direction ) * 0.25;

			vec3 color = textureLod( envMap, equirectUv( normalize( direction - dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction - dx + dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx + dy ) ), 0.0 ).rgb;
			gl_FragColor = vec4( color * 0.25, 1.0 );

		}
	`)}function E0(){return wl("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function Yw(n){let e=new WeakMap,t=new WeakMap,i=null;function s(d,f=!1){return d==null?null:f?o(d):r(d)}function r(d){if(d&&d.isTexture){let f=d.mapping;if(f===bh||f===Mh)if(e.has(d)){let g=e.get(d).texture;return a(g,d.mapping)}else{let g=d.image;if(g&&g.height>0){let v=new Ml(g.height);return v.fromEquirectangularTexture(n,d),e.set(d,v),d.addEventListener("dispose",c),a(v.texture,d.mapping)}else return null}}return d}function o(d){if(d&&d.isTexture&&d.isPMREMTexture!==!0){let f=d.mapping,g=f===bh||f===Mh,v=f===zr||f===Ho;if(g||v){let m=t.get(d),p=m!==void 0?m.texture.pmremVersion:0;if(d.isRenderTargetTexture&&d.pmremVersion!==p)return i===null&&(i=new uu(n)),m=g?i.fromEquirectangular(d,m):i.fromCubemap(d,m),m.texture.pmremVersion=d.pmremVersion,t.set(d,m),m.texture;if(m!==void 0)return m.texture;{let y=d.image;return g&&y&&y.height>0||v&&y&&l(y)?(i===null&&(i=new uu(n)),m=g?i.fromEquirectangular(d):i.fromCubemap(d),m.texture.pmremVersion=d.pmremVersion,t.set(d,m),d.addEventListener("dispose",h),m.texture):null}}}return d}function a(d,f){return f===bh?d.mapping=zr:f===Mh&&(d.mapping=Ho),d}function l(d){let f=0,g=6;for(let v=0;v<g;v++)d[v]!==void 0&&f++;return f===g}function c(d){let f=d.target;f.removeEventListener("dispose",c);let g=e.get(f);g!==void 0&&(e.delete(f),g.dispose())}function h(d){let f=d.target;f.removeEventListener("dispose",h);let g=t.get(f);g!==void 0&&(t.delete(f),g.dispose())}function u(){e=new WeakMap,t=new WeakMap,i!==null&&(i.dispose(),i=null)}return{get:s,dispose:u}}function $w(n){let e={};function t(i){if(e[i]!==void 0)return e[i];let s=n.getExtension(i);return e[i]=s,s}return{has:function(i){return t(i)!==null},init:function(){t("EXT_color_buffer_float"),t("WEBGL_clip_cull_distance"),t("OES_texture_float_linear"),t("EXT_color_buffer_half_float"),t("WEBGL_multisampled_render_to_texture"),t("WEBGL_render_shared_exponent")},get:function(i){let s=t(i);return s===null&&Ba("WebGLRenderer: "+i+" extension not supported."),s}}}function Zw(n,e,t,i){let s={},r=new WeakMap,o=new FinalizationRegistry(g=>delete s[g]);function a(g){l(g.target)}function l(g){g.index!==null&&e.remove(g.index);for(let m in g.attributes)e.remove(g.attributes[m]);g.removeEventListener("dispose",a),delete s[g.id],o.unregister(g);let v=r.get(g);v&&(e.remove(v),r.delete(g)),i.releaseStatesOfGeometry(g),g.isInstancedBufferGeometry===!0&&delete g._maxInstanceCount,t.memory.geometries--}function c(g,v){return s[v.id]!==void 0||(v.addEventListener("dispose",a),s[v.id]=new WeakRef(v),o.register(v,v.id,v),t.memory.geometries++),v}function h(g){let v=g.attributes;for(let m in v)e.update(v[m],n.ARRAY_BUFFER)}function u(g){let v=g.index,m=g.attributes.position,p=0;if(m===void 0)return;let y=v!==null?v.array.length:m.array.length/3-1,C=m.count>=65535?Ka:Za,w=new C(Math.ceil(y/3)*6,1),P=w.array;if(v!==null){let x=v.array;p=v.version;for(let T=0,k=0;T<y;T+=3){let N=x[T+0],L=x[T+1],z=x[T+2];P[k++]=N,P[k++]=L,P[k++]=L,P[k++]=z,P[k++]=z,P[k++]=N}}else{p=m.version;for(let x=0,T=0;x<y;x+=3){let k=x+0,N=x+1,L=x+2;P[T++]=k,P[T++]=N,P[T++]=N,P[T++]=L,P[T++]=L,P[T++]=k}}w.version=p;let E=r.get(g);E&&e.remove(E),r.set(g,w)}function d(g){let v=r.get(g);if(v){let m=g.index;m!==null&&v.version<m.version&&u(g)}else u(g);return r.get(g)}function f(){for(let g in s){let v=s[g].deref();v!==void 0&&l(v)}}return{get:c,update:h,getWireframeAttribute:d,dispose:f}}function Kw(n,e,t){let i;function s(u){i=u}let r,o;function a(u){r=u.type,o=u.bytesPerElement}function l(u,d){n.drawElements(i,d,r,u*o),t.update(d,i,1)}function c(u,d,f){f!==0&&(n.drawElementsInstanced(i,d,r,u*o,f),t.update(d,i,f))}function h(u,d,f){if(f===0)return;e.get("WEBGL_multi_draw").multiDrawElementsWEBGL(i,d,0,r,u,0,f);let v=0;for(let m=0;m<f;m++)v+=d[m];t.update(v,i,1)}this.setMode=s,this.setIndex=a,this.render=l,this.renderInstances=c,this.renderMultiDraw=h}function Jw(n){let e={geometries:0,textures:0},t={frame:0,calls:0,triangles:0,points:0,lines:0};function i(r,o,a){switch(t.calls++,o){case n.TRIANGLES:t.triangles+=a*(r/3);break;case n.LINES:t.lines+=a*(r/2);break;case n.LINE_STRIP:t.lines+=a*(r-1);break;case n.LINE_LOOP:t.lines+=a*r;break;case n.POINTS:t.points+=a*r;break;default:it("WebGLInfo: Unknown draw mode:",o);break}}function s(){t.calls=0,t.triangles=0,t.points=0,t.lines=0}return{memory:e,render:t,programs:null,autoReset:!0,reset:s,update:i}}function jw(n,e,t){let i=new WeakMap,s=new tn;function r(o,a,l){let c=o.morphTargetInfluences,h=a.morphAttributes.position||a.morphAttributes.normal||a.morphAttributes.color,u=h!==void 0?h.length:0,d=i.get(a);if(d===void 0||d.count!==u){let k=function(){x.dispose(),i.delete(a),a.removeEventListener("dispose",k)};d!==void 0&&d.texture.dispose();let f=a.morphAttributes.position!==void 0,g=a.morphAttributes.normal!==void 0,v=a.morphAttributes.color!==void 0,m=a.morphAttributes.position||[],p=a.morphAttributes.normal||[],y=a.morphAttributes.color||[],C=0;f===!0&&(C=1),g===!0&&(C=2),v===!0&&(C=3);let w=a.attributes.position.count*C,P=1;w>e.maxTextureSize&&(P=Math.ceil(w/e.maxTextureSize),w=e.maxTextureSize);let E=new Float32Array(w*P*4*u),x=new qa(E,w,P,u);x.type=Yi,x.needsUpdate=!0;let T=C*4;for(let N=0;N<u;N++){let L=m[N],z=p[N],W=y[N],D=w*P*4*N;for(let X=0;X<L.count;X++){let $=X*T;f===!0&&(s.fromBufferAttribute(L,X),E[D+$+0]=s.x,E[D+$+1]=s.y,E[D+$+2]=s.z,E[D+$+3]=0),g===!0&&(s.fromBufferAttribute(z,X),E[D+$+4]=s.x,E[D+$+5]=s.y,E[D+$+6]=s.z,E[D+$+7]=0),v===!0&&(s.fromBufferAttribute(W,X),E[D+$+8]=s.x,E[D+$+9]=s.y,E[D+$+10]=s.z,E[D+$+11]=W.itemSize===4?s.w:1)}}d={count:u,texture:x,size:new $e(w,P)},i.set(a,d),a.addEventListener("dispose",k)}if(o.isInstancedMesh===!0&&o.morphTexture!==null)l.getUniforms().setValue(n,"morphTexture",o.morphTexture,t);else{let f=0;for(let v=0;v<c.length;v++)f+=c[v];let g=a.morphTargetsRelative?1:1-f;l.getUniforms().setValue(n,"morphTargetBaseInfluence",g),l.getUniforms().setValue(n,"morphTargetInfluences",c)}l.getUniforms().setValue(n,"morphTargetsTexture",d.texture,t),l.getUniforms().setValue(n,"morphTargetsTextureSize",d.size)}return{update:r}}function Qw(n,e,t,i,s){let r=new WeakMap;function o(c){let h=s.render.frame,u=c.geometry,d=e.get(c,u);if(r.get(d)!==h&&(e.update(d),r.set(d,h)),c.isInstancedMesh&&(c.hasEventListener("dispose",l)===!1&&c.addEventListener("dispose",l),r.get(c)!==h&&(t.update(c.instanceMatrix,n.ARRAY_BUFFER),c.instanceColor!==null&&t.update(c.instanceColor,n.ARRAY_BUFFER),r.set(c,h))),c.isSkinnedMesh){let f=c.skeleton;r.get(f)!==h&&(f.update(),r.set(f,h))}return d}function a(){r=new WeakMap}function l(c){let h=c.target;h.removeEventListener("dispose",l),i.releaseStatesOfObject(h),t.remove(h.instanceMatrix),h.instanceColor!==null&&t.remove(h.instanceColor)}return{update:o,dispose:a}}var eT={[yf]:"LINEAR_TONE_MAPPING",[vf]:"REINHARD_TONE_MAPPING",[Sf]:"CINEON_TONE_MAPPING",[bf]:"ACES_FILMIC_TONE_MAPPING",[wf]:"AGX_TONE_MAPPING",[Tf]:"NEUTRAL_TONE_MAPPING",[Mf]:"CUSTOM_TONE_MAPPING"};function tT(n,e,t,i,s,r){let o=new bi(e,t,{type:n,depthBuffer:s,stencilBuffer:r,samples:i?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),a=null,l=null,c=null,h=new Xt;h.setAttribute("position",new un([-1,3,0,-1,-1,0,3,-1,0],3)),h.setAttribute("uv",new un([0,2,0,0,2,0],2));let u=new oh({uniforms:{tDiffuse:{value:null}},vertexShader:`
			precision highp float;

			uniform mat4 modelViewMatrix;
			uniform mat4 projectionMatrix;

			attribute vec3 position;
			attribute vec2 uv;

			varying vec2 vUv;

			void main() {
				vUv = uv;
				gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
			}`,fragmentShader:`
			precision highp float;

			uniform sampler2D tDiffuse;

			varying vec2 vUv;

			#include <tonemapping_pars_fragment>
			#include <colorspace_pars_fragment>

			void main() {
				gl_FragColor = texture2D( tDiffuse, vUv );

				#ifdef LINEAR_TONE_MAPPING
					gl_FragColor.rgb = LinearToneMapping( gl_FragColor.rgb );
				#elif defined( REINHARD_TONE_MAPPING )
					gl_FragColor.rgb = ReinhardToneMapping( gl_FragColor.rgb );
				#elif defined( CINEON_TONE_MAPPING )
					gl_FragColor.rgb = CineonToneMapping( gl_FragColor.rgb );
				#elif defined( ACES_FILMIC_TONE_MAPPING )
					gl_FragColor.rgb = ACESFilmicToneMapping( gl_FragColor.rgb );
				#elif defined( AGX_TONE_MAPPING )
					gl_FragColor.rgb = AgXToneMapping( gl_FragColor.rgb );
				#elif defined( NEUTRAL_TONE_MAPPING )
					gl_FragColor.rgb = NeutralToneMapping( gl_FragColor.rgb );
				#elif defined( CUSTOM_TONE_MAPPING )
					gl_FragColor.rgb = CustomToneMapping( gl_FragColor.rgb );
				#endif

				#ifdef SRGB_TRANSFER
					gl_FragColor = sRGBTransferOETF( gl_FragColor );
				#endif
			}`,depthTest:!1,depthWrite:!1}),d=new Vn(h,u),f=new cl(-1,1,1,-1,0,1),g=null,v=null,m=!1,p,y=null,C=[],w=!1;this.setSize=function(P,E){o.setSize(P,E),a!==null&&a.setSize(P,E),l!==null&&l.setSize(P,E);for(let x=0;x<C.length;x++){let T=C[x];T.setSize&&T.setSize(P,E)}},this.setEffects=function(P){C=P,w=C.length>0&&C[0].isRenderPass===!0;let E=o.width,x=o.height;C.length>0&&a===null&&(a=new bi(E,x,{type:$i,depthBuffer:!1,stencilBuffer:!1}),l=new bi(E,x,{type:$i,depthBuffer:!1,stencilBuffer:!1}));let T=s===!0&&C.some(k=>k.needsDepthTexture===!0);T!==(o.depthTexture!==null)&&(T===!0&&c===null&&(c=new Fs(E,x),r===!0&&(c.format=Bs,c.type=Vr)),o.dispose(),o.depthTexture=T?c:null,o.resolveDepthBuffer=T,o.storeMultisampledDepthBuffer=T);for(let k=0;k<C.length;k++){let N=C[k];N.setSize&&N.setSize(E,x),T&&N.needsDepthTexture===!0&&N.setDepthTexture&&N.setDepthTexture(c)}},this.begin=function(P,E){if(m||P.toneMapping===ms&&C.length===0)return!1;if(y=E,E!==null){let x=E.width,T=E.height;(o.width!==x||o.height!==T)&&this.setSize(x,T)}return w===!1&&P.setRenderTarget(o),p=P.toneMapping,P.toneMapping=ms,!0},this.hasRenderPass=function(){return w},this.end=function(P,E){P.toneMapping=p,m=!0;let x=o,T=a;for(let k=0;k<C.length;k++){let N=C[k];N.enabled!==!1&&(N.render(P,T,x,E),N.needsSwap!==!1&&(x=T,T=T===a?l:a))}if(g!==P.outputColorSpace||v!==P.toneMapping){g=P.outputColorSpace,v=P.toneMapping,u.defines={},bt.getTransfer(g)===Lt&&(u.defines.SRGB_TRANSFER="");let k=eT[v];k&&(u.defines[k]=""),u.needsUpdate=!0}u.uniforms.tDiffuse.value=x.texture,P.setRenderTarget(y),P.render(d,f),y=null,m=!1},this.isCompositing=function(){return m},this.dispose=function(){o.dispose(),a!==null&&a.dispose(),l!==null&&l.dispose(),h.dispose(),u.dispose()}}var $0=new si,Z0=new Fs(1,1),K0=new el(1),J0=new qa,j0=new eh,Q0=new ja,A0=[],C0=[],R0=new Float32Array(16),P0=new Float32Array(9),I0=new Float32Array(4);function qo(n,e,t){let i=n[0];if(i<=0||i>0)return n;let s=e*t,r=A0[s];if(r===void 0&&(r=new Float32Array(s),A0[s]=r),e!==0){i.toArray(r,0);for(let o=1,a=0;o!==e;++o)a+=t,n[o].toArray(r,a)}return r}function An(n,e){if(n.length!==e.length)return!1;for(let t=0,i=n.length;t<i;t++)if(n[t]!==e[t])return!1;return!0}function Cn(n,e){for(let t=0,i=e.length;t<i;t++)n[t]=e[t]}function fu(n,e){let t=C0[e];t===void 0&&(t=new Int32Array(e),C0[e]=t);for(let i=0;i!==e;++i)t[i]=n.allocateTextureUnit();return t}function nT(n,e){let t=this.cache;t[0]!==e&&(n.uniform1f(this.addr,e),t[0]=e)}function iT(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(n.uniform2f(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(An(t,e))return;n.uniform2fv(this.addr,e),Cn(t,e)}}function sT(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(n.uniform3f(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else if(e.r!==void 0)(t[0]!==e.r||t[1]!==e.g||t[2]!==e.b)&&(n.uniform3f(this.addr,e.r,e.g,e.b),t[0]=e.r,t[1]=e.g,t[2]=e.b);else{if(An(t,e))return;n.uniform3fv(this.addr,e),Cn(t,e)}}function rT(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(n.uniform4f(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(An(t,e))return;n.uniform4fv(this.addr,e),Cn(t,e)}}function oT(n,e){let t=this.cache,i=e.elements;if(i===void 0){if(An(t,e))return;n.uniformMatrix2fv(this.addr,!1,e),Cn(t,e)}else{if(An(t,i))return;I0.set(i),n.uniformMatrix2fv(this.addr,!1,I0),Cn(t,i)}}function aT(n,e){let t=this.cache,i=e.elements;if(i===void 0){if(An(t,e))return;n.uniformMatrix3fv(this.addr,!1,e),Cn(t,e)}else{if(An(t,i))return;P0.set(i),n.uniformMatrix3fv(this.addr,!1,P0),Cn(t,i)}}function lT(n,e){let t=this.cache,i=e.elements;if(i===void 0){if(An(t,e))return;n.uniformMatrix4fv(this.addr,!1,e),Cn(t,e)}else{if(An(t,i))return;R0.set(i),n.uniformMatrix4fv(this.addr,!1,R0),Cn(t,i)}}function cT(n,e){let t=this.cache;t[0]!==e&&(n.uniform1i(this.addr,e),t[0]=e)}function hT(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(n.uniform2i(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(An(t,e))return;n.uniform2iv(this.addr,e),Cn(t,e)}}function uT(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(n.uniform3i(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(An(t,e))return;n.uniform3iv(this.addr,e),Cn(t,e)}}function dT(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(n.uniform4i(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(An(t,e))return;n.uniform4iv(this.addr,e),Cn(t,e)}}function fT(n,e){let t=this.cache;t[0]!==e&&(n.uniform1ui(this.addr,e),t[0]=e)}function pT(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(n.uniform2ui(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(An(t,e))return;n.uniform2uiv(this.addr,e),Cn(t,e)}}function mT(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(n.uniform3ui(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(An(t,e))return;n.uniform3uiv(this.addr,e),Cn(t,e)}}function gT(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(n.uniform4ui(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(An(t,e))return;n.uniform4uiv(this.addr,e),Cn(t,e)}}function pu(n){return n.version===0&&(n.compareFunction=Ff,n.needsUpdate=!0),n}function _T(n,e,t){let i=this.cache,s=t.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s);let r;this.type===n.SAMPLER_2D_SHADOW?r=pu(Z0):r=$0,t.setTexture2D(e||r,s)}function xT(n,e,t){let i=this.cache,s=t.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s),t.setTexture3D(e||j0,s)}function yT(n,e,t){let i=this.cache,s=t.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s);let r;this.type===n.SAMPLER_CUBE_SHADOW?r=pu(K0):r=Q0,t.setTextureCube(e||r,s)}function vT(n,e,t){let i=this.cache,s=t.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s),t.setTexture2DArray(e||J0,s)}function ST(n){switch(n){case 5126:return nT;case 35664:return iT;case 35665:return sT;case 35666:return rT;case 35674:return oT;case 35675:return aT;case 35676:return lT;case 5124:case 35670:return cT;case 35667:case 35671:return hT;case 35668:case 35672:return uT;case 35669:case 35673:return dT;case 5125:return fT;case 36294:return pT;case 36295:return mT;case 36296:return gT;case 35678:case 36198:case 36298:case 36306:case 35682:return _T;case 35679:case 36299:case 36307:return xT;case 35680:case 36300:case 36308:case 36293:return yT;case 36289:case 36303:case 36311:case 36292:return vT}}function bT(n,e){n.uniform1fv(this.addr,e)}function MT(n,e){let t=qo(e,this.size,2);n.uniform2fv(this.addr,t)}function wT(n,e){let t=qo(e,this.size,3);n.uniform3fv(this.addr,t)}function TT(n,e){let t=qo(e,this.size,4);n.uniform4fv(this.addr,t)}function ET(n,e){let t=qo(e,this.size,4);n.uniformMatrix2fv(this.addr,!1,t)}function AT(n,e){let t=qo(e,this.size,9);n.uniformMatrix3fv(this.addr,!1,t)}function CT(n,e){let t=qo(e,this.size,16);n.uniformMatrix4fv(this.addr,!1,t)}function RT(n,e){n.uniform1iv(this.addr,e)}function PT(n,e){n.uniform2iv(this.addr,e)}function IT(n,e){n.uniform3iv(this.addr,e)}function DT(n,e){n.uniform4iv(this.addr,e)}function LT(n,e){n.uniform1uiv(this.addr,e)}function NT(n,e){n.uniform2uiv(this.addr,e)}function UT(n,e){n.uniform3uiv(this.addr,e)}function FT(n,e){n.uniform4uiv(this.addr,e)}function OT(n,e,t){let i=this.cache,s=e.length,r=fu(t,s);An(i,r)||(n.uniform1iv(this.addr,r),Cn(i,r));let o;this.type===n.SAMPLER_2D_SHADOW?o=pu(Z0):o=$0;for(let a=0;a!==s;++a)t.setTexture2D(e[a]||o,r[a])}function BT(n,e,t){let i=this.cache,s=e.length,r=fu(t,s);An(i,r)||(n.uniform1iv(this.addr,r),Cn(i,r));for(let o=0;o!==s;++o)t.setTexture3D(e[o]||j0,r[o])}function kT(n,e,t){let i=this.cache,s=e.length,r=fu(t,s);An(i,r)||(n.uniform1iv(this.addr,r),Cn(i,r));let o;this.type===n.SAMPLER_CUBE_SHADOW?o=pu(K0):o=Q0;for(let a=0;a!==s;++a)t.setTextureCube(e[a]||o,r[a])}function zT(n,e,t){let i=this.cache,s=e.length,r=fu(t,s);An(i,r)||(n.uniform1iv(this.addr,r),Cn(i,r));for(let o=0;o!==s;++o)t.setTexture2DArray(e[o]||J0,r[o])}function VT(n){switch(n){case 5126:return bT;case 35664:return MT;case 35665:return wT;case 35666:return TT;case 35674:return ET;case 35675:return AT;case 35676:return CT;case 5124:case 35670:return RT;case 35667:case 35671:return PT;case 35668:case 35672:return IT;case 35669:case 35673:return DT;case 5125:return LT;case 36294:return NT;case 36295:return UT;case 36296:return FT;case 35678:case 36198:case 36298:case 36306:case 35682:return OT;case 35679:case 36299:case 36307:return BT;case 35680:case 36300:case 36308:case 36293:return kT;case 36289:case 36303:case 36311:case 36292:return zT}}var Kf=class{constructor(e,t,i){this.id=e,this.addr=i,this.cache=[],this.type=t.type,this.setValue=ST(t.type)}},Jf=class{constructor(e,t,i){this.id=e,this.addr=i,this.cache=[],this.type=t.type,this.size=t.size,this.setValue=VT(t.type)}},jf=class{constructor(e){this.id=e,this.seq=[],this.map={}}setValue(e,t,i){let s=this.seq;for(let r=0,o=s.length;r!==o;++r){let a=s[r];a.setValue(e,t[a.id],i)}}},$f=/(\w+)(\])?(\[|\.)?/g;function D0(n,e){n.seq.push(e),n.map[e.id]=e}function GT(n,e,t){let i=n.name,s=i.length;for($f.lastIndex=0;;){let r=$f.exec(i),o=$f.lastIndex,a=r[1],l=r[2]==="]",c=r[3];if(l&&(a=a|0),c===void 0||c==="["&&o+2===s){D0(t,c===void 0?new Kf(a,n,e):new Jf(a,n,e));break}else{let u=t.map[a];u===void 0&&(u=new jf(a),D0(t,u)),t=u}}}var Xo=class{constructor(e,t){this.seq=[],this.map={};let i=e.getProgramParameter(t,e.ACTIVE_UNIFORMS);for(let o=0;o<i;++o){let a=e.getActiveUniform(t,o),l=e.getUniformLocation(t,a.name);GT(a,l,this)}let s=[],r=[];for(let o of this.seq)o.type===e.SAMPLER_2D_SHADOW||o.type===e.SAMPLER_CUBE_SHADOW||o.type===e.SAMPLER_2D_ARRAY_SHADOW?s.push(o):r.push(o);s.length>0&&(this.seq=s.concat(r))}setValue(e,t,i,s){let r=this.map[t];r!==void 0&&r.setValue(e,i,s)}setOptional(e,t,i){let s=t[i];s!==void 0&&this.setValue(e,i,s)}static upload(e,t,i,s){for(let r=0,o=t.length;r!==o;++r){let a=t[r],l=i[a.id];l.needsUpdate!==!1&&a.setValue(e,l.value,s)}}static seqWithValue(e,t){let i=[];for(let s=0,r=e.length;s!==r;++s){let o=e[s];o.id in t&&i.push(o)}return i}};function L0(n,e,t){let i=n.createShader(e);return n.shaderSource(i,t),n.compileShader(i),i}var HT=37297,WT=0;function XT(n,e){let t=n.split(`
`),i=[],s=Math.max(e-6,0),r=Math.min(e+6,t.length);for(let o=s;o<r;o++){let a=o+1;i.push(`${a===e?">":" "} ${a}: ${t[o]}`)}return i.join(`
`)}var N0=new st;function qT(n){bt._getMatrix(N0,bt.workingColorSpace,n);let e=`mat3( ${N0.elements.map(t=>t.toFixed(4))} )`;switch(bt.getTransfer(n)){case Ha:return[e,"LinearTransferOETF"];case Lt:return[e,"sRGBTransferOETF"];default:return Ke("WebGLProgram: Unsupported color space: ",n),[e,"LinearTransferOETF"]}}function U0(n,e,t){let i=n.getShaderParameter(e,n.COMPILE_STATUS),r=(n.getShaderInfoLog(e)||"").trim();if(i&&r==="")return"";let o=/ERROR: 0:(\d+)/.exec(r);if(o){let a=parseInt(o[1]);return t.toUpperCase()+`

`+r+`

`+XT(n.getShaderSource(e),a)}else return r}function YT(n,e){let t=qT(e);return[`vec4 ${n}( vec4 value ) {`,`	return ${t[1]}( vec4( ${t[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var $T={[yf]:"Linear",[vf]:"Reinhard",[Sf]:"Cineon",[bf]:"ACESFilmic",[wf]:"AgX",[Tf]:"Neutral",[Mf]:"Custom"};function ZT(n,e){let t=$T[e];return t===void 0?(Ke("WebGLProgram: Unsupported toneMapping:",e),"vec3 "+n+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+n+"( vec3 color ) { return "+t+"ToneMapping( color ); }"}var hu=new B;function KT(){bt.getLuminanceCoefficients(hu);let n=hu.x.toFixed(4),e=hu.y.toFixed(4),t=hu.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${n}, ${e}, ${t} );`,"	return dot( weights, rgb );","}"].join(`
`)}function JT(n){return[n.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",n.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(bl).join(`
`)}function jT(n){let e=[];for(let t in n){let i=n[t];i!==!1&&e.push("#define "+t+" "+i)}return e.join(`
`)}function QT(n,e){let t={},i=n.getProgramParameter(e,n.ACTIVE_ATTRIBUTES);for(let s=0;s<i;s++){let r=n.getActiveAttrib(e,s),o=r.name,a=1;r.type===n.FLOAT_MAT2&&(a=2),r.type===n.FLOAT_MAT3&&(a=3),r.type===n.FLOAT_MAT4&&(a=4),t[o]={type:r.type,location:n.getAttribLocation(e,o),locationSize:a}}return t}function bl(n){return n!==""}function F0(n,e){let t=e.numSpotLightShadows+e.numSpotLightMaps-e.numSpotLightShadowsWithMaps;return n.replace(/NUM_SUN_LIGHTS/g,e.numSunLights).replace(/NUM_DIR_LIGHTS/g,e.numDirLights).replace(/NUM_SPOT_LIGHTS/g,e.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,e.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,t).replace(/NUM_RECT_AREA_LIGHTS/g,e.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,e.numPointLights).replace(/NUM_HEMI_LIGHTS/g,e.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,e.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,e.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,e.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,e.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,e.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,e.numLightProbeGrids)}function O0(n,e){return n.replace(/NUM_CLIPPING_PLANES/g,e.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,e.numClippingPlanes-e.numClipIntersection)}var eE=/^[ \t]*#include +<([\w\d./]+)>/gm;function Qf(n){return n.replace(eE,tE)}function tE(n,e){let t=pt[e];if(t===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+e+">");return Qf(t)}var nE=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function B0(n){return n.replace(nE,iE)}function iE(n,e,t,i){let s="";for(let r=parseInt(e);r<parseInt(t);r++)s+=i.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return s}function k0(n){let e=`precision ${n.precision} float;
	precision ${n.precision} int;
	precision ${n.precision} sampler2D;
	precision ${n.precision} samplerCube;
	precision ${n.precision} sampler3D;
	precision ${n.precision} sampler2DArray;
	precision ${n.precision} sampler2DShadow;
	precision ${n.precision} samplerCubeShadow;
	precision ${n.precision} sampler2DArrayShadow;
	precision ${n.precision} isampler2D;
	precision ${n.precision} isampler3D;
	precision ${n.precision} isamplerCube;
	precision ${n.precision} isampler2DArray;
	precision ${n.precision} usampler2D;
	precision ${n.precision} usampler3D;
	precision ${n.precision} usamplerCube;
	precision ${n.precision} usampler2DArray;
	`;return n.precision==="highp"?e+=`
#define HIGH_PRECISION`:n.precision==="mediump"?e+=`
#define MEDIUM_PRECISION`:n.precision==="lowp"&&(e+=`
#define LOW_PRECISION`),e}var sE={[fl]:"SHADOWMAP_TYPE_PCF",[Vo]:"SHADOWMAP_TYPE_VSM"};function rE(n){return sE[n.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var oE={[Ho]:"ENVMAP_MODE_REFRACTION"};function aE(n){return n.envMap===!1?"ENVMAP_MODE_REFLECTION":oE[n.envMapMode]||"ENVMAP_MODE_REFLECTION"}var lE={[Sh]:"ENVMAP_BLENDING_MULTIPLY",[i0]:"ENVMAP_BLENDING_MIX",[s0]:"ENVMAP_BLENDING_ADD"};function cE(n){return n.envMap===!1?"ENVMAP_BLENDING_NONE":lE[n.combine]||"ENVMAP_BLENDING_NONE"}function hE(n,e,t,i){let s=n.getContext(),r=t.defines,o=t.vertexShader,a=t.fragmentShader,l=rE(t),c=t.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",h=aE(t),u=cE(t),d=JT(t),f=jT(r),g=s.createProgram(),v,m,p=t.glslVersion?"#version "+t.glslVersion+`
`:"";t.isRawShaderMaterial?(v=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f].filter(bl).join(`
`),v.length>0&&(v+=`
`),m=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f].filter(bl).join(`
`),m.length>0&&(m+=`
`)):(v=[k0(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f,t.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",t.batching?"#define USE_BATCHING":"",t.batchingColor?"#define USE_BATCHING_COLOR":"",t.instancing?"#define USE_INSTANCING":"",t.instancingColor?"#define USE_INSTANCING_COLOR":"",t.instancingMorph?"#define USE_INSTANCING_MORPH":"",t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.map?"#define USE_MAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+h:"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.displacementMap?"#define USE_DISPLACEMENTMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.mapUv?"#define MAP_UV "+t.mapUv:"",t.alphaMapUv?"#define ALPHAMAP_UV "+t.alphaMapUv:"",t.lightMapUv?"#define LIGHTMAP_UV "+t.lightMapUv:"",t.aoMapUv?"#define AOMAP_UV "+t.aoMapUv:"",t.emissiveMapUv?"#define EMISSIVEMAP_UV "+t.emissiveMapUv:"",t.bumpMapUv?"#define BUMPMAP_UV "+t.bumpMapUv:"",t.normalMapUv?"#define NORMALMAP_UV "+t.normalMapUv:"",t.displacementMapUv?"#define DISPLACEMENTMAP_UV "+t.displacementMapUv:"",t.metalnessMapUv?"#define METALNESSMAP_UV "+t.metalnessMapUv:"",t.roughnessMapUv?"#define ROUGHNESSMAP_UV "+t.roughnessMapUv:"",t.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+t.anisotropyMapUv:"",t.clearcoatMapUv?"#define CLEARCOATMAP_UV "+t.clearcoatMapUv:"",t.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+t.clearcoatNormalMapUv:"",t.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+t.clearcoatRoughnessMapUv:"",t.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+t.diffuseRoughnessMapUv:"",t.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+t.iridescenceMapUv:"",t.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+t.iridescenceThicknessMapUv:"",t.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+t.sheenColorMapUv:"",t.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+t.sheenRoughnessMapUv:"",t.specularMapUv?"#define SPECULARMAP_UV "+t.specularMapUv:"",t.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+t.specularColorMapUv:"",t.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+t.specularIntensityMapUv:"",t.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+t.transmissionMapUv:"",t.thicknessMapUv?"#define THICKNESSMAP_UV "+t.thicknessMapUv:"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexNormals?"#define HAS_NORMAL":"",t.vertexColors?"#define USE_COLOR":"",t.vertexAlphas?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.flatShading?"#define FLAT_SHADED":"",t.skinning?"#define USE_SKINNING":"",t.morphTargets?"#define USE_MORPHTARGETS":"",t.morphNormals&&t.flatShading===!1?"#define USE_MORPHNORMALS":"",t.morphColors?"#define USE_MORPHCOLORS":"",t.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+t.morphTextureStride:"",t.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+t.morphTargetsCount:"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+l:"",t.sizeAttenuation?"#define USE_SIZEATTENUATION":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(bl).join(`
`),m=[k0(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f,t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",t.map?"#define USE_MAP":"",t.matcap?"#define USE_MATCAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+c:"",t.envMap?"#define "+h:"",t.envMap?"#define "+u:"",t.envMapPMREM?"#define ENVMAP_MAX_LOD "+t.envMapMaxLod+".0":"",t.envMapPMREM?"#define ENVMAP_SIZE "+t.envMapSize+".0":"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoat?"#define USE_CLEARCOAT":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.dispersion?"#define USE_DISPERSION":"",t.retroreflection?"#define USE_RETROREFLECTION":"",t.iridescence?"#define USE_IRIDESCENCE":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaTest?"#define USE_ALPHATEST":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.sheen?"#define USE_SHEEN":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexColors||t.instancingColor?"#define USE_COLOR":"",t.vertexAlphas||t.batchingColor?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.gradientMap?"#define USE_GRADIENTMAP":"",t.flatShading?"#define FLAT_SHADED":"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+l:"",t.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",t.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",t.toneMapping!==ms?"#define TONE_MAPPING":"",t.toneMapping!==ms?pt.tonemapping_pars_fragment:"",t.toneMapping!==ms?ZT("toneMapping",t.toneMapping):"",t.dithering?"#define DITHERING":"",t.opaque?"#define OPAQUE":"",pt.colorspace_pars_fragment,YT("linearToOutputTexel",t.outputColorSpace),KT(),t.useDepthPacking?"#define DEPTH_PACKING "+t.depthPacking:"",`
`].filter(bl).join(`
`)),o=Qf(o),o=F0(o,t),o=O0(o,t),a=Qf(a),a=F0(a,t),a=O0(a,t),o=B0(o),a=B0(a),t.isRawShaderMaterial!==!0&&(p=`#version 300 es
`,v=[d,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+v,m=["#define varying in",t.glslVersion===Bf?"":"layout(location = 0) out highp vec4 pc_fragColor;",t.glslVersion===Bf?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+m);let y=p+v+o,C=p+m+a,w=L0(s,s.VERTEX_SHADER,y),P=L0(s,s.FRAGMENT_SHADER,C);s.attachShader(g,w),s.attachShader(g,P),t.index0AttributeName!==void 0?s.bindAttribLocation(g,0,t.index0AttributeName):t.hasPositionAttribute===!0&&s.bindAttribLocation(g,0,"position"),s.linkProgram(g);function E(N){if(n.debug.checkShaderErrors){let L=s.getProgramInfoLog(g)||"",z=s.getShaderInfoLog(w)||"",W=s.getShaderInfoLog(P)||"",D=L.trim(),X=z.trim(),$=W.trim(),H=!0,he=!0;if(s.getProgramParameter(g,s.LINK_STATUS)===!1)if(H=!1,typeof n.debug.onShaderError=="function")n.debug.onShaderError(s,g,w,P);else{let J=U0(s,w,"vertex"),Q=U0(s,P,"fragment");it("WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(g,s.VALIDATE_STATUS)+`

Material Name: `+N.name+`
Material Type: `+N.type+`

Program Info Log: `+D+`
`+J+`
`+Q)}else D!==""?Ke("WebGLProgram: Program Info Log:",D):(X===""||$==="")&&(he=!1);he&&(N.diagnostics={runnable:H,programLog:D,vertexShader:{log:X,prefix:v},fragmentShader:{log:$,prefix:m}})}s.deleteShader(w),s.deleteShader(P),x=new Xo(s,g),T=QT(s,g)}let x;this.getUniforms=function(){return x===void 0&&E(this),x};let T;this.getAttributes=function(){return T===void 0&&E(this),T};let k=t.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return k===!1&&(k=s.getProgramParameter(g,HT)),k},this.destroy=function(){i.releaseStatesOfProgram(this),s.deleteProgram(g),this.program=void 0},this.type=t.shaderType,this.name=t.shaderName,this.id=WT++,this.cacheKey=e,this.usedTimes=1,this.program=g,this.vertexShader=w,this.fragmentShader=P,this}var uE=0,ep=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(e,t,i){let s=this._getShaderCacheForMaterial(e);return s.has(t)===!1&&(s.add(t),t.usedTimes++),s.has(i)===!1&&(s.add(i),i.usedTimes++),this}remove(e){let t=this.materialCache.get(e);for(let i of t)i.usedTimes--,i.usedTimes===0&&this.shaderCache.delete(i.code);return this.materialCache.delete(e),this}getVertexShaderStage(e){return this._getShaderStage(e.vertexShader)}getFragmentShaderStage(e){return this._getShaderStage(e.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(e){let t=this.materialCache,i=t.get(e);return i===void 0&&(i=new Set,t.set(e,i)),i}_getShaderStage(e){let t=this.shaderCache,i=t.get(e);return i===void 0&&(i=new tp(e),t.set(e,i)),i}},tp=class{constructor(e){this.id=uE++,this.code=e,this.usedTimes=0}};function dE(n){return n===mr||n===yl||n===vl}function fE(n,e,t,i,s,r){let o=new Ya,a=new ep,l=new Set,c=[],h=new Map,u=i.logarithmicDepthBuffer,d={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function f(x){return l.add(x),x===0?"uv":`uv${x}`}function g(x,T,k,N,L,z){let W=N.fog,D=L.geometry,X=x.isMeshStandardMaterial||x.isMeshLambertMaterial||x.isMeshPhongMaterial?N.environment:null,$=x.isMeshStandardMaterial||x.isMeshLambertMaterial&&!x.envMap||x.isMeshPhongMaterial&&!x.envMap,H=e.get(x.envMap||X,$),he=d[x.type],J=i.precision;x.precision!==null&&(J=i.getMaxPrecision(x.precision),J!==x.precision&&Ke("WebGLProgram.getParameters:",x.precision,"not supported, using",J,"instead."));let Q=D.morphAttributes.position||D.morphAttributes.normal||D.morphAttributes.color,re=Q!==void 0?Q.length:0,fe=0;D.morphAttributes.position!==void 0&&(fe=1),D.morphAttributes.normal!==void 0&&(fe=2),D.morphAttributes.color!==void 0&&(fe=3);let de,te,ge,ye;if(he){let Re=_s[he];de=Re.vertexShader,te=Re.fragmentShader}else{de=x.vertexShader,te=x.fragmentShader;let Re=a.getVertexShaderStage(x),ht=a.getFragmentShaderStage(x);a.update(x,Re,ht),ge=Re.id,ye=ht.id}let Ce=n.getRenderTarget(),Me=n.state.buffers.depth.getReversed(),Xe=L.isInstancedMesh===!0,lt=L.isBatchedMesh===!0,He=!!x.map,mt=!!x.matcap,ut=!!H,ot=ut&&H.isPMREMTexture===!0,Qt=!!x.aoMap,Ht=!!x.lightMap,pn=!!x.bumpMap&&x.wireframe===!1,Bt=!!x.normalMap,Dn=!!x.displacementMap,wt=!!x.emissiveMap,Mn=!!x.metalnessMap,sn=!!x.roughnessMap,mn=x.anisotropy>0,F=x.clearcoat>0,Pe=x.diffuseRoughness>0,Je=x.dispersion>0,ct=x.retroreflectivity>0,we=x.iridescence>0,zt=x.sheen>0,Ge=x.transmission>0,Ze=mn&&!!x.anisotropyMap,A=F&&!!x.clearcoatMap,S=F&&!!x.clearcoatNormalMap,q=F&&!!x.clearcoatRoughnessMap,ue=Pe&&!!x.diffuseRoughnessMap,ae=we&&!!x.iridescenceMap,xe=we&&!!x.iridescenceThicknessMap,ve=zt&&!!x.sheenColorMap,ne=zt&&!!x.sheenRoughnessMap,se=!!x.specularMap,me=!!x.specularColorMap,U=!!x.specularIntensityMap,oe=Ge&&!!x.transmissionMap,ie=Ge&&!!x.thicknessMap,Te=!!x.gradientMap,_e=!!x.alphaMap,be=x.alphaTest>0,We=!!x.alphaHash,et=!!x.extensions,ce=ms;x.toneMapped&&(Ce===null||Ce.isXRRenderTarget===!0)&&(ce=n.toneMapping);let ke=ot?H.isCompressedCubeTexture?H.image[0].mipmaps:H.mipmaps:null,tt={shaderID:he,shaderType:x.type,shaderName:x.name,vertexShader:de,fragmentShader:te,defines:x.defines,customVertexShaderID:ge,customFragmentShaderID:ye,isRawShaderMaterial:x.isRawShaderMaterial===!0,glslVersion:x.glslVersion,precision:J,batching:lt,batchingColor:lt&&L._colorsTexture!==null,instancing:Xe,instancingColor:Xe&&L.instanceColor!==null,instancingMorph:Xe&&L.morphTexture!==null,outputColorSpace:Ce===null?n.outputColorSpace:Ce.isXRRenderTarget===!0?Ce.texture.colorSpace:bt.workingColorSpace,alphaToCoverage:!!x.alphaToCoverage,map:He,matcap:mt,envMap:ut,envMapMode:ut&&H.mapping,envMapPMREM:ot,envMapMaxLod:ot?ke.length-1:null,envMapSize:ot?ke[0].width:null,aoMap:Qt,lightMap:Ht,bumpMap:pn,normalMap:Bt,displacementMap:Dn,emissiveMap:wt,normalMapObjectSpace:Bt&&x.normalMapType===a0,normalMapTangentSpace:Bt&&x.normalMapType===au,packedNormalMap:Bt&&x.normalMapType===au&&dE(x.normalMap.format),metalnessMap:Mn,roughnessMap:sn,anisotropy:mn,anisotropyMap:Ze,clearcoat:F,clearcoatMap:A,clearcoatNormalMap:S,clearcoatRoughnessMap:q,diffuseRoughness:Pe,diffuseRoughnessMap:ue,dispersion:Je,retroreflection:ct,iridescence:we,iridescenceMap:ae,iridescenceThicknessMap:xe,sheen:zt,sheenColorMap:ve,sheenRoughnessMap:ne,specularMap:se,specularColorMap:me,specularIntensityMap:U,transmission:Ge,transmissionMap:oe,thicknessMap:ie,gradientMap:Te,opaque:x.transparent===!1&&x.blending===Go&&x.alphaToCoverage===!1,alphaMap:_e,alphaTest:be,alphaHash:We,combine:x.combine,mapUv:He&&f(x.map.channel),aoMapUv:Qt&&f(x.aoMap.channel),lightMapUv:Ht&&f(x.lightMap.channel),bumpMapUv:pn&&f(x.bumpMap.channel),normalMapUv:Bt&&f(x.normalMap.channel),displacementMapUv:Dn&&f(x.displacementMap.channel),emissiveMapUv:wt&&f(x.emissiveMap.channel),metalnessMapUv:Mn&&f(x.metalnessMap.channel),roughnessMapUv:sn&&f(x.roughnessMap.channel),anisotropyMapUv:Ze&&f(x.anisotropyMap.channel),clearcoatMapUv:A&&f(x.clearcoatMap.channel),clearcoatNormalMapUv:S&&f(x.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:q&&f(x.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:ue&&f(x.diffuseRoughnessMap.channel),iridescenceMapUv:ae&&f(x.iridescenceMap.channel),iridescenceThicknessMapUv:xe&&f(x.iridescenceThicknessMap.channel),sheenColorMapUv:ve&&f(x.sheenColorMap.channel),sheenRoughnessMapUv:ne&&f(x.sheenRoughnessMap.channel),specularMapUv:se&&f(x.specularMap.channel),specularColorMapUv:me&&f(x.specularColorMap.channel),specularIntensityMapUv:U&&f(x.specularIntensityMap.channel),transmissionMapUv:oe&&f(x.transmissionMap.channel),thicknessMapUv:ie&&f(x.thicknessMap.channel),alphaMapUv:_e&&f(x.alphaMap.channel),vertexTangents:!!D.attributes.tangent&&(Bt||mn),vertexNormals:!!D.attributes.normal,vertexColors:x.vertexColors,vertexAlphas:x.vertexColors===!0&&!!D.attributes.color&&D.attributes.color.itemSize===4,pointsUvs:L.isPoints===!0&&!!D.attributes.uv&&(He||_e),fog:!!W,useFog:x.fog===!0,fogExp2:!!W&&W.isFogExp2,flatShading:x.wireframe===!1&&(x.flatShading===!0||D.attributes.normal===void 0&&Bt===!1&&(x.isMeshLambertMaterial||x.isMeshPhongMaterial||x.isMeshStandardMaterial||x.isMeshPhysicalMaterial)),sizeAttenuation:x.sizeAttenuation===!0,logarithmicDepthBuffer:u,reversedDepthBuffer:Me,skinning:L.isSkinnedMesh===!0,hasPositionAttribute:D.attributes.position!==void 0,morphTargets:D.morphAttributes.position!==void 0,morphNormals:D.morphAttributes.normal!==void 0,morphColors:D.morphAttributes.color!==void 0,morphTargetsCount:re,morphTextureStride:fe,numSunLights:T.sun.length,numDirLights:T.directional.length,numPointLights:T.point.length,numSpotLights:T.spot.length,numSpotLightMaps:T.spotLightMap.length,numRectAreaLights:T.rectArea.length,numHemiLights:T.hemi.length,numSunLightShadows:T.sunShadowMap.length,numDirLightShadows:T.directionalShadowMap.length,numPointLightShadows:T.pointShadowMap.length,numSpotLightShadows:T.spotShadowMap.length,numSpotLightShadowsWithMaps:T.numSpotLightShadowsWithMaps,numLightProbes:T.numLightProbes,numLightProbeGrids:z.filter(Re=>Re.texture!==null).length,numClippingPlanes:r.numPlanes,numClipIntersection:r.numIntersection,dithering:x.dithering,shadowMapEnabled:n.shadowMap.enabled&&k.length>0,shadowMapType:n.shadowMap.type,toneMapping:ce,decodeVideoTexture:He&&x.map.isVideoTexture===!0&&bt.getTransfer(x.map.colorSpace)===Lt,decodeVideoTextureEmissive:wt&&x.emissiveMap.isVideoTexture===!0&&bt.getTransfer(x.emissiveMap.colorSpace)===Lt,premultipliedAlpha:x.premultipliedAlpha,doubleSided:x.side===oi,flipSided:x.side===ri,useDepthPacking:x.depthPacking>=0,depthPacking:x.depthPacking||0,index0AttributeName:x.index0AttributeName,extensionClipCullDistance:et&&x.extensions.clipCullDistance===!0&&t.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(et&&x.extensions.multiDraw===!0||lt)&&t.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:t.has("KHR_parallel_shader_compile"),customProgramCacheKey:x.customProgramCacheKey()};return tt.vertexUv1s=l.has(1),tt.vertexUv2s=l.has(2),tt.vertexUv3s=l.has(3),l.clear(),tt}function v(x){let T=[];if(x.shaderID?T.push(x.shaderID):(T.push(x.customVertexShaderID),T.push(x.customFragmentShaderID)),x.defines!==void 0)for(let k in x.defines)T.push(k),T.push(x.defines[k]);return x.isRawShaderMaterial===!1&&(m(T,x),p(T,x),T.push(n.outputColorSpace)),T.push(x.customProgramCacheKey),T.join()}function m(x,T){x.push(T.precision),x.push(T.outputColorSpace),x.push(T.envMapMode),x.push(T.envMapPMREM),x.push(T.envMapMaxLod),x.push(T.envMapSize),x.push(T.mapUv),x.push(T.alphaMapUv),x.push(T.lightMapUv),x.push(T.aoMapUv),x.push(T.bumpMapUv),x.push(T.normalMapUv),x.push(T.displacementMapUv),x.push(T.emissiveMapUv),x.push(T.metalnessMapUv),x.push(T.roughnessMapUv),x.push(T.anisotropyMapUv),x.push(T.clearcoatMapUv),x.push(T.clearcoatNormalMapUv),x.push(T.clearcoatRoughnessMapUv),x.push(T.diffuseRoughnessMapUv),x.push(T.iridescenceMapUv),x.push(T.iridescenceThicknessMapUv),x.push(T.sheenColorMapUv),x.push(T.sheenRoughnessMapUv),x.push(T.specularMapUv),x.push(T.specularColorMapUv),x.push(T.specularIntensityMapUv),x.push(T.transmissionMapUv),x.push(T.thicknessMapUv),x.push(T.combine),x.push(T.fogExp2),x.push(T.sizeAttenuation),x.push(T.morphTargetsCount),x.push(T.numSunLights),x.push(T.numDirLights),x.push(T.numPointLights),x.push(T.numSpotLights),x.push(T.numSpotLightMaps),x.push(T.numHemiLights),x.push(T.numRectAreaLights),x.push(T.numSunLightShadows),x.push(T.numDirLightShadows),x.push(T.numPointLightShadows),x.push(T.numSpotLightShadows),x.push(T.numSpotLightShadowsWithMaps),x.push(T.numLightProbes),x.push(T.numLightProbeGrids),x.push(T.shadowMapType),x.push(T.toneMapping),x.push(T.numClippingPlanes),x.push(T.numClipIntersection),x.push(T.depthPacking)}function p(x,T){o.disableAll(),T.instancing&&o.enable(0),T.instancingColor&&o.enable(1),T.instancingMorph&&o.enable(2),T.matcap&&o.enable(3),T.envMap&&o.enable(4),T.normalMapObjectSpace&&o.enable(5),T.normalMapTangentSpace&&o.enable(6),T.clearcoat&&o.enable(7),T.iridescence&&o.enable(8),T.alphaTest&&o.enable(9),T.vertexColors&&o.enable(10),T.vertexAlphas&&o.enable(11),T.vertexUv1s&&o.enable(12),T.vertexUv2s&&o.enable(13),T.vertexUv3s&&o.enable(14),T.vertexTangents&&o.enable(15),T.anisotropy&&o.enable(16),T.alphaHash&&o.enable(17),T.batching&&o.enable(18),T.dispersion&&o.enable(19),T.retroreflection&&o.enable(24),T.diffuseRoughness&&o.enable(25),T.batchingColor&&o.enable(20),T.gradientMap&&o.enable(21),T.packedNormalMap&&o.enable(22),T.vertexNormals&&o.enable(23),x.push(o.mask),o.disableAll(),T.fog&&o.enable(0),T.useFog&&o.enable(1),T.flatShading&&o.enable(2),T.logarithmicDepthBuffer&&o.enable(3),T.reversedDepthBuffer&&o.enable(4),T.skinning&&o.enable(5),T.morphTargets&&o.enable(6),T.morphNormals&&o.enable(7),T.morphColors&&o.enable(8),T.premultipliedAlpha&&o.enable(9),T.shadowMapEnabled&&o.enable(10),T.doubleSided&&o.enable(11),T.flipSided&&o.enable(12),T.useDepthPacking&&o.enable(13),T.dithering&&o.enable(14),T.transmission&&o.enable(15),T.sheen&&o.enable(16),T.opaque&&o.enable(17),T.pointsUvs&&o.enable(18),T.decodeVideoTexture&&o.enable(19),T.decodeVideoTextureEmissive&&o.enable(20),T.alphaToCoverage&&o.enable(21),T.numLightProbeGrids>0&&o.enable(22),T.hasPositionAttribute&&o.enable(23),x.push(o.mask)}function y(x){let T=d[x.type],k;if(T){let N=_s[T];k=v0.clone(N.uniforms)}else k=x.uniforms;return k}function C(x,T){let k=h.get(T);return k!==void 0?++k.usedTimes:(k=new hE(n,T,x,s),c.push(k),h.set(T,k)),k}function w(x){if(--x.usedTimes===0){let T=c.indexOf(x);c[T]=c[c.length-1],c.pop(),h.delete(x.cacheKey),x.destroy()}}function P(x){a.remove(x)}function E(){a.dispose()}return{getParameters:g,getProgramCacheKey:v,getUniforms:y,acquireProgram:C,releaseProgram:w,releaseShaderCache:P,programs:c,dispose:E}}function pE(){let n=new WeakMap;function e(o){return n.has(o)}function t(o){let a=n.get(o);return a===void 0&&(a={},n.set(o,a)),a}function i(o){n.delete(o)}function s(o,a,l){n.get(o)[a]=l}function r(){n=new WeakMap}return{has:e,get:t,remove:i,update:s,dispose:r}}function mE(n,e){return n.groupOrder!==e.groupOrder?n.groupOrder-e.groupOrder:n.renderOrder!==e.renderOrder?n.renderOrder-e.renderOrder:n.material.id!==e.material.id?n.material.id-e.material.id:n.materialVariant!==e.materialVariant?n.materialVariant-e.materialVariant:n.z!==e.z?n.z-e.z:n.id-e.id}function z0(n,e){return n.groupOrder!==e.groupOrder?n.groupOrder-e.groupOrder:n.renderOrder!==e.renderOrder?n.renderOrder-e.renderOrder:n.z!==e.z?e.z-n.z:n.id-e.id}function V0(){let n=[],e=0,t=[],i=[],s=[];function r(){e=0,t.length=0,i.length=0,s.length=0}function o(d){let f=0;return d.isInstancedMesh&&(f+=2),d.isSkinnedMesh&&(f+=1),f}function a(d,f,g,v,m,p){let y=n[e];return y===void 0?(y={id:d.id,object:d,geometry:f,material:g,materialVariant:o(d),groupOrder:v,renderOrder:d.renderOrder,z:m,group:p},n[e]=y):(y.id=d.id,y.object=d,y.geometry=f,y.material=g,y.materialVariant=o(d),y.groupOrder=v,y.renderOrder=d.renderOrder,y.z=m,y.group=p),e++,y}function l(d,f,g,v,m,p,y){y.reversedDepth===!0&&(m=-m);let C=a(d,f,g,v,m,p);g.transmission>0?i.push(C):g.transparent===!0?s.push(C):t.push(C)}function c(d,f,g,v,m,p){let y=a(d,f,g,v,m,p);g.transmission>0?i.unshift(y):g.transparent===!0?s.unshift(y):t.unshift(y)}function h(d,f){t.length>1&&t.sort(d||mE),i.length>1&&i.sort(f||z0),s.length>1&&s.sort(f||z0)}function u(){for(let d=e,f=n.length;d<f;d++){let g=n[d];if(g.id===null)break;g.id=null,g.object=null,g.geometry=null,g.material=null,g.group=null}}return{opaque:t,transmissive:i,transparent:s,init:r,push:l,unshift:c,finish:u,sort:h}}function gE(){let n=new WeakMap;function e(i,s){let r=n.get(i),o;return r===void 0?(o=new V0,n.set(i,[o])):s>=r.length?(o=new V0,r.push(o)):o=r[s],o}function t(){n=new WeakMap}return{get:e,dispose:t}}function _E(){let n={};return{get:function(e){if(n[e.id]!==void 0)return n[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={direction:new B,color:new je};break;case"SpotLight":t={position:new B,direction:new B,color:new je,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":t={position:new B,color:new je,distance:0,decay:0};break;case"HemisphereLight":t={direction:new B,skyColor:new je,groundColor:new je};break;case"RectAreaLight":t={color:new je,position:new B,halfWidth:new B,halfHeight:new B};break}return n[e.id]=t,t}}}function xE(){let n={};return{get:function(e){if(n[e.id]!==void 0)return n[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new $e};break;case"SpotLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new $e};break;case"PointLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new $e,shadowCameraNear:1,shadowCameraFar:1e3};break}return n[e.id]=t,t}}}var yE=0;function vE(n,e){return(e.castShadow?2:0)-(n.castShadow?2:0)+(e.map?1:0)-(n.map?1:0)}function SE(n){let e=new _E,t=xE(),i={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let c=0;c<9;c++)i.probe.push(new B);let s=new B,r=new Pt,o=new Pt;function a(c){let h=0,u=0,d=0;for(let z=0;z<9;z++)i.probe[z].set(0,0,0);let f=0,g=0,v=0,m=0,p=0,y=0,C=0,w=0,P=0,E=0,x=0,T=0,k=0,N=0;c.sort(vE);for(let z=0,W=c.length;z<W;z++){let D=c[z],X=D.color,$=D.intensity,H=D.distance,he=null;if(D.shadow&&D.shadow.map&&(D.shadow.map.texture.format===mr?he=D.shadow.map.texture:he=D.shadow.map.depthTexture||D.shadow.map.texture),D.isAmbientLight)h+=X.r*$,u+=X.g*$,d+=X.b*$;else if(D.isLightProbe){for(let J=0;J<9;J++)i.probe[J].addScaledVector(D.sh.coefficients[J],$);N++}else if(D.isSunLight){let J=e.get(D);if(J.color.copy(D.color).multiplyScalar(D.intensity),D.castShadow){let Q=D.shadow,re=t.get(D);re.shadowIntensity=Q.intensity,re.shadowBias=Q.bias,re.shadowNormalBias=Q.normalBias,re.shadowRadius=Q.radius,re.shadowMapSize.copy(Q.mapSize).multiply(Q.getFrameExtents()),i.sunShadow[g]=re,i.sunShadowMap[g]=he;let fe=Q.getViewportCount();for(let de=0;de<fe;de++)i.sunShadowMatrix[v+de]=Q.getMatrix(de),i.sunShadowCascade[v+de]=Q._cascadeData[de];v+=fe,g++}i.sun[f]=J,f++}else if(D.isDirectionalLight){let J=e.get(D);if(J.color.copy(D.color).multiplyScalar(D.intensity),D.castShadow){let Q=D.shadow,re=t.get(D);re.shadowIntensity=Q.intensity,re.shadowBias=Q.bias,re.shadowNormalBias=Q.normalBias,re.shadowRadius=Q.radius,re.shadowMapSize=Q.mapSize,i.directionalShadow[m]=re,i.directionalShadowMap[m]=he,i.directionalShadowMatrix[m]=D.shadow.matrix,P++}i.directional[m]=J,m++}else if(D.isSpotLight){let J=e.get(D);J.position.setFromMatrixPosition(D.matrixWorld),J.color.copy(X).multiplyScalar($),J.distance=H,J.coneCos=Math.cos(D.angle),J.penumbraCos=Math.cos(D.angle*(1-D.penumbra)),J.decay=D.decay,i.spot[y]=J;let Q=D.shadow;if(D.map&&(i.spotLightMap[T]=D.map,T++,Q.updateMatrices(D),D.castShadow&&k++),i.spotLightMatrix[y]=Q.matrix,D.castShadow){let re=t.get(D);re.shadowIntensity=Q.intensity,re.shadowBias=Q.bias,re.shadowNormalBias=Q.normalBias,re.shadowRadius=Q.radius,re.shadowMapSize=Q.mapSize,i.spotShadow[y]=re,i.spotShadowMap[y]=he,x++}y++}else if(D.isRectAreaLight){let J=e.get(D);J.color.copy(X).multiplyScalar($),J.halfWidth.set(D.width*.5,0,0),J.halfHeight.set(0,D.height*.5,0),i.rectArea[C]=J,C++}else if(D.isPointLight){let J=e.get(D);if(J.color.copy(D.color).multiplyScalar(D.intensity),J.distance=D.distance,J.decay=D.decay,D.castShadow){let Q=D.shadow,re=t.get(D);re.shadowIntensity=Q.intensity,re.shadowBias=Q.bias,re.shadowNormalBias=Q.normalBias,re.shadowRadius=Q.radius,re.shadowMapSize=Q.mapSize,re.shadowCameraNear=Q.camera.near,re.shadowCameraFar=Q.camera.far,i.pointShadow[p]=re,i.pointShadowMap[p]=he,i.pointShadowMatrix[p]=D.shadow.matrix,E++}i.point[p]=J,p++}else if(D.isHemisphereLight){let J=e.get(D);J.skyColor.copy(D.color).multiplyScalar($),J.groundColor.copy(D.groundColor).multiplyScalar($),i.hemi[w]=J,w++}}C>0&&(n.has("OES_texture_float_linear")===!0?(i.rectAreaLTC1=Le.LTC_FLOAT_1,i.rectAreaLTC2=Le.LTC_FLOAT_2):(i.rectAreaLTC1=Le.LTC_HALF_1,i.rectAreaLTC2=Le.LTC_HALF_2)),i.ambient[0]=h,i.ambient[1]=u,i.ambient[2]=d;let L=i.hash;(L.sunLength!==f||L.directionalLength!==m||L.pointLength!==p||L.spotLength!==y||L.rectAreaLength!==C||L.hemiLength!==w||L.numSunShadows!==g||L.numDirectionalShadows!==P||L.numPointShadows!==E||L.numSpotShadows!==x||L.numSpotMaps!==T||L.numLightProbes!==N)&&(i.sun.length=f,i.directional.length=m,i.spot.length=y,i.rectArea.length=C,i.point.length=p,i.hemi.length=w,i.sunShadow.length=g,i.sunShadowMap.length=g,i.sunShadowMatrix.length=v,i.sunShadowCascade.length=v,i.directionalShadow.length=P,i.directionalShadowMap.length=P,i.directionalShadowMatrix.length=P,i.pointShadow.length=E,i.pointShadowMap.length=E,i.pointShadowMatrix.length=E,i.spotShadow.length=x,i.spotShadowMap.length=x,i.spotLightMatrix.length=x+T-k,i.spotLightMap.length=T,i.numSpotLightShadowsWithMaps=k,i.numLightProbes=N,L.sunLength=f,L.directionalLength=m,L.pointLength=p,L.spotLength=y,L.rectAreaLength=C,L.hemiLength=w,L.numSunShadows=g,L.numDirectionalShadows=P,L.numPointShadows=E,L.numSpotShadows=x,L.numSpotMaps=T,L.numLightProbes=N,i.version=yE++)}function l(c,h){let u=0,d=0,f=0,g=0,v=0,m=0,p=h.matrixWorldInverse;for(let y=0,C=c.length;y<C;y++){let w=c[y];if(w.isSunLight){let P=i.sun[u];P.direction.setFromMatrixPosition(w.matrixWorld),P.direction.transformDirection(p),u++}else if(w.isDirectionalLight){let P=i.directional[d];P.direction.setFromMatrixPosition(w.matrixWorld),s.setFromMatrixPosition(w.target.matrixWorld),P.direction.sub(s),P.direction.transformDirection(p),d++}else if(w.isSpotLight){let P=i.spot[g];P.position.setFromMatrixPosition(w.matrixWorld),P.position.applyMatrix4(p),P.direction.setFromMatrixPosition(w.matrixWorld),s.setFromMatrixPosition(w.target.matrixWorld),P.direction.sub(s),P.direction.transformDirection(p),g++}else if(w.isRectAreaLight){let P=i.rectArea[v];P.position.setFromMatrixPosition(w.matrixWorld),P.position.applyMatrix4(p),o.identity(),r.copy(w.matrixWorld),r.premultiply(p),o.extractRotation(r),P.halfWidth.set(w.width*.5,0,0),P.halfHeight.set(0,w.height*.5,0),P.halfWidth.applyMatrix4(o),P.halfHeight.applyMatrix4(o),v++}else if(w.isPointLight){let P=i.point[f];P.position.setFromMatrixPosition(w.matrixWorld),P.position.applyMatrix4(p),f++}else if(w.isHemisphereLight){let P=i.hemi[m];P.direction.setFromMatrixPosition(w.matrixWorld),P.direction.transformDirection(p),m++}}}return{setup:a,setupView:l,state:i}}function G0(n){let e=new SE(n),t=[],i=[],s=[];function r(u){h.camera=u,t.length=0,i.length=0,s.length=0}function o(u){u.isLightProbeGrid?s.push(u):t.push(u)}function a(u){i.push(u)}function l(){e.setup(t),s.sort((u,d)=>u.priority-d.priority||u.id-d.id)}function c(u){e.setupView(t,u)}let h={lightsArray:t,shadowsArray:i,lightProbeGridArray:s,camera:null,lights:e,transmissionRenderTarget:{},textureUnits:0};return{init:r,state:h,setupLights:l,setupLightsView:c,pushLight:o,pushShadow:a}}function bE(n){let e=new WeakMap;function t(s,r=0){let o=e.get(s),a;return o===void 0?(a=new G0(n),e.set(s,[a])):r>=o.length?(a=new G0(n),o.push(a)):a=o[r],a}function i(){e=new WeakMap}return{get:t,dispose:i}}var ME=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,wE=`uniform sampler2D shadow_pass;
uniform vec2 resolution;
uniform float radius;
void main() {
	const float samples = float( VSM_SAMPLES );
	float mean = 0.0;
	float squared_mean = 0.0;
	float uvStride = samples <= 1.0 ? 0.0 : 2.0 / ( samples - 1.0 );
	float uvStart = samples <= 1.0 ? 0.0 : - 1.0;
	for ( float i = 0.0; i < samples; i ++ ) {
		float uvOffset = uvStart + i * uvStride;
		#ifdef HORIZONTAL_PASS
			vec2 distribution = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( uvOffset, 0.0 ) * radius ) / resolution ).rg;
			mean += distribution.x;
			squared_mean += distribution.y * distribution.y + distribution.x * distribution.x;
		#else
			float depth = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( 0.0, uvOffset ) * radius ) / resolution ).r;
			mean += depth;
			squared_mean += depth * depth;
		#endif
	}
	mean = mean / samples;
	squared_mean = squared_mean / samples;
	float std_dev = sqrt( max( 0.0, squared_mean - mean * mean ) );
	gl_FragColor = vec4( mean, std_dev, 0.0, 1.0 );
}`,TE=[new B(1,0,0),new B(-1,0,0),new B(0,1,0),new B(0,-1,0),new B(0,0,1),new B(0,0,-1)],EE=[new B(0,-1,0),new B(0,-1,0),new B(0,0,1),new B(0,0,-1),new B(0,-1,0),new B(0,-1,0)],H0=new Pt,Sl=new B,Zf=new B;function AE(n,e,t){let i=new or,s=new $e,r=new $e,o=new tn,a=new ah,l=new lh,c={},h=t.maxTextureSize,u={[pr]:ri,[ri]:pr,[oi]:oi},d=new ps({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new $e},radius:{value:4}},vertexShader:ME,fragmentShader:wE}),f=d.clone();f.defines.HORIZONTAL_PASS=1;let g=new Xt;g.setAttribute("position",new hn(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let v=new Vn(g,d),m=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=fl;let p=this.type;this.render=function(E,x,T){if(m.enabled===!1||m.autoUpdate===!1&&m.needsUpdate===!1||E.length===0)return;this.type===Bg&&(Ke("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=fl);let k=n.getRenderTarget(),N=n.getActiveCubeFace(),L=n.getActiveMipmapLevel(),z=n.state;z.setBlending(Br),z.buffers.depth.getReversed()===!0?z.buffers.color.setClear(0,0,0,0):z.buffers.color.setClear(1,1,1,1),z.buffers.depth.setTest(!0),z.setScissorTest(!1);let W=p!==this.type;W&&x.traverse(function(D){D.material&&(Array.isArray(D.material)?D.material.forEach(X=>X.needsUpdate=!0):D.material.needsUpdate=!0)});for(let D=0,X=E.length;D<X;D++){let $=E[D],H=$.shadow;if(H===void 0){Ke("WebGLShadowMap:",$,"has no shadow.");continue}if(H.autoUpdate===!1&&H.needsUpdate===!1)continue;s.copy(H.mapSize);let he=H.getFrameExtents();s.multiply(he),r.copy(H.mapSize),(s.x>h||s.y>h)&&(s.x>h&&(r.x=Math.floor(h/he.x),s.x=r.x*he.x,H.mapSize.x=r.x),s.y>h&&(r.y=Math.floor(h/he.y),s.y=r.y*he.y,H.mapSize.y=r.y));let J=n.state.buffers.depth.getReversed();if(H.camera._reversedDepth=J,H.map===null||W===!0){if(H.map!==null&&(H.map.depthTexture!==null&&(H.map.depthTexture.dispose(),H.map.depthTexture=null),H.map.dispose()),this.type===Vo){if($.isPointLight){Ke("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}H.map=new bi(s.x,s.y,{format:mr,type:$i,minFilter:ni,magFilter:ni,generateMipmaps:!1}),H.map.texture.name=$.name+".shadowMap",H.map.depthTexture=new Fs(s.x,s.y,Yi),H.map.depthTexture.name=$.name+".shadowMapDepth",H.map.depthTexture.format=Ls,H.map.depthTexture.compareFunction=null,H.map.depthTexture.minFilter=zn,H.map.depthTexture.magFilter=zn}else $.isPointLight?(H.map=new Ml(s.x),H.map.depthTexture=new el(s.x,qi)):(H.map=new bi(s.x,s.y),H.map.depthTexture=new Fs(s.x,s.y,qi)),H.map.depthTexture.name=$.name+".shadowMap",H.map.depthTexture.format=Ls,this.type===fl?(H.map.depthTexture.compareFunction=J?Uf:Nf,H.map.depthTexture.minFilter=ni,H.map.depthTexture.magFilter=ni):(H.map.depthTexture.compareFunction=null,H.map.depthTexture.minFilter=zn,H.map.depthTexture.magFilter=zn);H.camera.updateProjectionMatrix()}H.map.isWebGLCubeRenderTarget!==!0&&(H.map.width!==s.x||H.map.height!==s.y)&&H.map.setSize(s.x,s.y);let Q=H.map.isWebGLCubeRenderTarget?6:H.getViewportCount();$.isPointLight!==!0&&H.updateMatrices($,T);let re=(H.camera.layers.mask&4294967294)!==0?H.camera.layers:T.layers;for(let fe=0;fe<Q;fe++){let de=H.getCamera(fe);if($.isPointLight){let te=H.camera,ge=H.matrix,ye=$.distance||te.far;ye!==te.far&&(te.far=ye,te.updateProjectionMatrix()),Sl.setFromMatrixPosition($.matrixWorld),te.position.copy(Sl),Zf.copy(te.position),Zf.add(TE[fe]),te.up.copy(EE[fe]),te.lookAt(Zf),te.updateMatrixWorld(),ge.makeTranslation(-Sl.x,-Sl.y,-Sl.z),H0.multiplyMatrices(te.projectionMatrix,te.matrixWorldInverse),H._frustum.setFromProjectionMatrix(H0,te.coordinateSystem,te.reversedDepth)}if(H.map.isWebGLCubeRenderTarget)n.setRenderTarget(H.map,fe),n.clear();else{fe===0&&(n.setRenderTarget(H.map),n.clear());let te=H.getViewport(fe);o.set(r.x*te.x,r.y*te.y,r.x*te.z,r.y*te.w),z.viewport(o)}i=H.getFrustum(fe),w(x,T,de,$,re,this.type)}H.isPointLightShadow!==!0&&this.type===Vo&&y(H,T),H.needsUpdate=!1}p=this.type,m.needsUpdate=!1,n.setRenderTarget(k,N,L)};function y(E,x){let T=e.update(v);d.defines.VSM_SAMPLES!==E.blurSamples&&(d.defines.VSM_SAMPLES=E.blurSamples,f.defines.VSM_SAMPLES=E.blurSamples,d.needsUpdate=!0,f.needsUpdate=!0),E.mapPass===null?E.mapPass=new bi(s.x,s.y,{format:mr,type:$i}):(E.mapPass.width!==E.map.width||E.mapPass.height!==E.map.height)&&E.mapPass.setSize(E.map.width,E.map.height),d.uniforms.shadow_pass.value=E.map.depthTexture,d.uniforms.resolution.value.set(E.map.width,E.map.height),d.uniforms.radius.value=E.radius,n.setRenderTarget(E.mapPass),n.clear(),n.renderBufferDirect(x,null,T,d,v,null),f.uniforms.shadow_pass.value=E.mapPass.texture,f.uniforms.resolution.value.set(E.map.width,E.map.height),f.uniforms.radius.value=E.radius,n.setRenderTarget(E.map),n.clear(),n.renderBufferDirect(x,null,T,f,v,null)}function C(E,x,T,k){let N=null,L=T.isPointLight===!0?E.customDistanceMaterial:E.customDepthMaterial;if(L!==void 0)N=L;else if(N=T.isPointLight===!0?l:a,n.localClippingEnabled&&x.clipShadows===!0&&Array.isArray(x.clippingPlanes)&&x.clippingPlanes.length!==0||x.displacementMap&&x.displacementScale!==0||x.alphaMap&&x.alphaTest>0||x.map&&x.alphaTest>0||x.alphaToCoverage===!0){let z=N.uuid,W=x.uuid,D=c[z];D===void 0&&(D={},c[z]=D);let X=D[W];X===void 0&&(X=N.clone(),D[W]=X,x.addEventListener("dispose",P)),N=X}if(N.visible=x.visible,N.wireframe=x.wireframe,k===Vo?N.side=x.shadowSide!==null?x.shadowSide:x.side:N.side=x.shadowSide!==null?x.shadowSide:u[x.side],N.alphaMap=x.alphaMap,N.alphaTest=x.alphaToCoverage===!0?.5:x.alphaTest,N.map=x.map,N.clipShadows=x.clipShadows,N.clippingPlanes=x.clippingPlanes,N.clipIntersection=x.clipIntersection,N.displacementMap=x.displacementMap,N.displacementScale=x.displacementScale,N.displacementBias=x.displacementBias,N.wireframeLinewidth=x.wireframeLinewidth,N.linewidth=x.linewidth,T.isPointLight===!0&&N.isMeshDistanceMaterial===!0){let z=n.properties.get(N);z.light=T}return N}function w(E,x,T,k,N,L){if(E.visible===!1)return;if(E.layers.test(N)&&(E.isMesh||E.isLine||E.isPoints)&&(E.castShadow||E.receiveShadow&&L===Vo)&&(!E.frustumCulled||E.intersectsFrustum(i))){E.modelViewMatrix.multiplyMatrices(T.matrixWorldInverse,E.matrixWorld);let D=e.update(E),X=E.material;if(Array.isArray(X)){let $=D.groups;for(let H=0,he=$.length;H<he;H++){let J=$[H],Q=X[J.materialIndex];if(Q&&Q.visible){let re=C(E,Q,k,L);E.onBeforeShadow(n,E,x,T,D,re,J),n.renderBufferDirect(T,null,D,re,E,J),E.onAfterShadow(n,E,x,T,D,re,J)}}}else if(X.visible){let $=C(E,X,k,L);E.onBeforeShadow(n,E,x,T,D,$,null),n.renderBufferDirect(T,null,D,$,E,null),E.onAfterShadow(n,E,x,T,D,$,null)}}let W=E.children;for(let D=0,X=W.length;D<X;D++)w(W[D],x,T,k,N,L)}function P(E){E.target.removeEventListener("dispose",P);for(let T in c){let k=c[T],N=E.target.uuid;N in k&&(k[N].dispose(),delete k[N])}}}function CE(n,e){function t(){let U=!1,oe=new tn,ie=null,Te=new tn(0,0,0,0);return{setMask:function(_e){ie!==_e&&!U&&(n.colorMask(_e,_e,_e,_e),ie=_e)},setLocked:function(_e){U=_e},setClear:function(_e,be,We,et,ce){ce===!0&&(_e*=et,be*=et,We*=et),oe.set(_e,be,We,et),Te.equals(oe)===!1&&(n.clearColor(_e,be,We,et),Te.copy(oe))},reset:function(){U=!1,ie=null,Te.set(-1,0,0,0)}}}function i(){let U=!1,oe=!1,ie=null,Te=null,_e=null;return{setReversed:function(be){if(oe!==be){let We=e.get("EXT_clip_control");be?We.clipControlEXT(We.LOWER_LEFT_EXT,We.ZERO_TO_ONE_EXT):We.clipControlEXT(We.LOWER_LEFT_EXT,We.NEGATIVE_ONE_TO_ONE_EXT),oe=be;let et=_e;_e=null,this.setClear(et)}},getReversed:function(){return oe},setTest:function(be){be?Me(n.DEPTH_TEST):Xe(n.DEPTH_TEST)},setMask:function(be){ie!==be&&!U&&(n.depthMask(be),ie=be)},setFunc:function(be){if(oe&&(be=_0[be]),Te!==be){switch(be){case Gc:n.depthFunc(n.NEVER);break;case Hc:n.depthFunc(n.ALWAYS);break;case Wc:n.depthFunc(n.LESS);break;case Po:n.depthFunc(n.LEQUAL);break;case Xc:n.depthFunc(n.EQUAL);break;case qc:n.depthFunc(n.GEQUAL);break;case Yc:n.depthFunc(n.GREATER);break;case $c:n.depthFunc(n.NOTEQUAL);break;default:n.depthFunc(n.LEQUAL)}Te=be}},setLocked:function(be){U=be},setClear:function(be){_e!==be&&(_e=be,oe&&(be=1-be),n.clearDepth(be))},reset:function(){U=!1,ie=null,Te=null,_e=null,oe=!1}}}function s(){let U=!1,oe=null,ie=null,Te=null,_e=null,be=null,We=null,et=null,ce=null;return{setTest:function(ke){U||(ke?Me(n.STENCIL_TEST):Xe(n.STENCIL_TEST))},setMask:function(ke){oe!==ke&&!U&&(n.stencilMask(ke),oe=ke)},setFunc:function(ke,tt,Re){(ie!==ke||Te!==tt||_e!==Re)&&(n.stencilFunc(ke,tt,Re),ie=ke,Te=tt,_e=Re)},setOp:function(ke,tt,Re){(be!==ke||We!==tt||et!==Re)&&(n.stencilOp(ke,tt,Re),be=ke,We=tt,et=Re)},setLocked:function(ke){U=ke},setClear:function(ke){ce!==ke&&(n.clearStencil(ke),ce=ke)},reset:function(){U=!1,oe=null,ie=null,Te=null,_e=null,be=null,We=null,et=null,ce=null}}}let r=new t,o=new i,a=new s,l={},c=new WeakMap,h={},u={},d={},f=new WeakMap,g=[],v=null,m=!1,p=null,y=null,C=null,w=null,P=null,E=null,x=null,T=new je(0,0,0),k=0,N=!1,L=null,z=null,W=null,D=null,X=null,$=n.getParameter(n.MAX_COMBINED_TEXTURE_IMAGE_UNITS),H=!1,he=0,J=n.getParameter(n.VERSION);J.indexOf("WebGL")!==-1?(he=parseFloat(/^WebGL (\d)/.exec(J)[1]),H=he>=1):J.indexOf("OpenGL ES")!==-1&&(he=parseFloat(/^OpenGL ES (\d)/.exec(J)[1]),H=he>=2);let Q=null,re={},fe=n.getParameter(n.SCISSOR_BOX),de=n.getParameter(n.VIEWPORT),te=new tn().fromArray(fe),ge=new tn().fromArray(de);function ye(U,oe,ie,Te){let _e=new Uint8Array(4),be=n.createTexture();n.bindTexture(U,be),n.texParameteri(U,n.TEXTURE_MIN_FILTER,n.NEAREST),n.texParameteri(U,n.TEXTURE_MAG_FILTER,n.NEAREST);for(let We=0;We<ie;We++)U===n.TEXTURE_3D||U===n.TEXTURE_2D_ARRAY?n.texImage3D(oe,0,n.RGBA,1,1,Te,0,n.RGBA,n.UNSIGNED_BYTE,_e):n.texImage2D(oe+We,0,n.RGBA,1,1,0,n.RGBA,n.UNSIGNED_BYTE,_e);return be}let Ce={};Ce[n.TEXTURE_2D]=ye(n.TEXTURE_2D,n.TEXTURE_2D,1),Ce[n.TEXTURE_CUBE_MAP]=ye(n.TEXTURE_CUBE_MAP,n.TEXTURE_CUBE_MAP_POSITIVE_X,6),Ce[n.TEXTURE_2D_ARRAY]=ye(n.TEXTURE_2D_ARRAY,n.TEXTURE_2D_ARRAY,1,1),Ce[n.TEXTURE_3D]=ye(n.TEXTURE_3D,n.TEXTURE_3D,1,1),r.setClear(0,0,0,1),o.setClear(1),a.setClear(0),Me(n.DEPTH_TEST),o.setFunc(Po),pn(!1),Bt(ff),Me(n.CULL_FACE),Qt(Br);function Me(U){h[U]!==!0&&(n.enable(U),h[U]=!0)}function Xe(U){h[U]!==!1&&(n.disable(U),h[U]=!1)}function lt(U,oe){return d[U]!==oe?(n.bindFramebuffer(U,oe),d[U]=oe,U===n.DRAW_FRAMEBUFFER&&(d[n.FRAMEBUFFER]=oe),U===n.FRAMEBUFFER&&(d[n.DRAW_FRAMEBUFFER]=oe),!0):!1}function He(U,oe){let ie=g,Te=!1;if(U){ie=f.get(oe),ie===void 0&&(ie=[],f.set(oe,ie));let _e=U.textures;if(ie.length!==_e.length||ie[0]!==n.COLOR_ATTACHMENT0){for(let be=0,We=_e.length;be<We;be++)ie[be]=n.COLOR_ATTACHMENT0+be;ie.length=_e.length,Te=!0}}else ie[0]!==n.BACK&&(ie[0]=n.BACK,Te=!0);Te&&n.drawBuffers(ie)}function mt(U){return v!==U?(n.useProgram(U),v=U,!0):!1}let ut={[kr]:n.FUNC_ADD,[zg]:n.FUNC_SUBTRACT,[Vg]:n.FUNC_REVERSE_SUBTRACT};ut[Gg]=n.MIN,ut[Hg]=n.MAX;let ot={[Wg]:n.ZERO,[Xg]:n.ONE,[qg]:n.SRC_COLOR,[_f]:n.SRC_ALPHA,[jg]:n.SRC_ALPHA_SATURATE,[Kg]:n.DST_COLOR,[$g]:n.DST_ALPHA,[Yg]:n.ONE_MINUS_SRC_COLOR,[xf]:n.ONE_MINUS_SRC_ALPHA,[Jg]:n.ONE_MINUS_DST_COLOR,[Zg]:n.ONE_MINUS_DST_ALPHA,[Qg]:n.CONSTANT_COLOR,[e0]:n.ONE_MINUS_CONSTANT_COLOR,[t0]:n.CONSTANT_ALPHA,[n0]:n.ONE_MINUS_CONSTANT_ALPHA};function Qt(U,oe,ie,Te,_e,be,We,et,ce,ke){if(U===Br){m===!0&&(Xe(n.BLEND),m=!1);return}if(m===!1&&(Me(n.BLEND),m=!0),U!==kg){if(U!==p||ke!==N){if((y!==kr||P!==kr)&&(n.blendEquation(n.FUNC_ADD),y=kr,P=kr),ke)switch(U){case Go:n.blendFuncSeparate(n.ONE,n.ONE_MINUS_SRC_ALPHA,n.ONE,n.ONE_MINUS_SRC_ALPHA);break;case pf:n.blendFunc(n.ONE,n.ONE);break;case mf:n.blendFuncSeparate(n.ZERO,n.ONE_MINUS_SRC_COLOR,n.ZERO,n.ONE);break;case gf:n.blendFuncSeparate(n.DST_COLOR,n.ONE_MINUS_SRC_ALPHA,n.ZERO,n.ONE);break;default:it("WebGLState: Invalid blending: ",U);break}else switch(U){case Go:n.blendFuncSeparate(n.SRC_ALPHA,n.ONE_MINUS_SRC_ALPHA,n.ONE,n.ONE_MINUS_SRC_ALPHA);break;case pf:n.blendFuncSeparate(n.SRC_ALPHA,n.ONE,n.ONE,n.ONE);break;case mf:it("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case gf:it("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:it("WebGLState: Invalid blending: ",U);break}C=null,w=null,E=null,x=null,T.set(0,0,0),k=0,p=U,N=ke}return}_e=_e||oe,be=be||ie,We=We||Te,(oe!==y||_e!==P)&&(n.blendEquationSeparate(ut[oe],ut[_e]),y=oe,P=_e),(ie!==C||Te!==w||be!==E||We!==x)&&(n.blendFuncSeparate(ot[ie],ot[Te],ot[be],ot[We]),C=ie,w=Te,E=be,x=We),(et.equals(T)===!1||ce!==k)&&(n.blendColor(et.r,et.g,et.b,ce),T.copy(et),k=ce),p=U,N=!1}function Ht(U,oe){U.side===oi?Xe(n.CULL_FACE):Me(n.CULL_FACE);let ie=U.side===ri;oe&&(ie=!ie),pn(ie),U.blending===Go&&U.transparent===!1?Qt(Br):Qt(U.blending,U.blendEquation,U.blendSrc,U.blendDst,U.blendEquationAlpha,U.blendSrcAlpha,U.blendDstAlpha,U.blendColor,U.blendAlpha,U.premultipliedAlpha),o.setFunc(U.depthFunc),o.setTest(U.depthTest),o.setMask(U.depthWrite),r.setMask(U.colorWrite);let Te=U.stencilWrite;a.setTest(Te),Te&&(a.setMask(U.stencilWriteMask),a.setFunc(U.stencilFunc,U.stencilRef,U.stencilFuncMask),a.setOp(U.stencilFail,U.stencilZFail,U.stencilZPass)),wt(U.polygonOffset,U.polygonOffsetFactor,U.polygonOffsetUnits),U.alphaToCoverage===!0?Me(n.SAMPLE_ALPHA_TO_COVERAGE):Xe(n.SAMPLE_ALPHA_TO_COVERAGE)}function pn(U){L!==U&&(U?n.frontFace(n.CW):n.frontFace(n.CCW),L=U)}function Bt(U){U!==Fg?(Me(n.CULL_FACE),U!==z&&(U===ff?n.cullFace(n.BACK):U===Og?n.cullFace(n.FRONT):n.cullFace(n.FRONT_AND_BACK))):Xe(n.CULL_FACE),z=U}function Dn(U){U!==W&&(H&&n.lineWidth(U),W=U)}function wt(U,oe,ie){U?(Me(n.POLYGON_OFFSET_FILL),(D!==oe||X!==ie)&&(D=oe,X=ie,o.getReversed()&&(oe=-oe,ie=-ie),n.polygonOffset(oe,ie))):Xe(n.POLYGON_OFFSET_FILL)}function Mn(U){U?Me(n.SCISSOR_TEST):Xe(n.SCISSOR_TEST)}function sn(U){U===void 0&&(U=n.TEXTURE0+$-1),Q!==U&&(n.activeTexture(U),Q=U)}function mn(U,oe,ie){ie===void 0&&(Q===null?ie=n.TEXTURE0+$-1:ie=Q);let Te=re[ie];Te===void 0&&(Te={type:void 0,texture:void 0},re[ie]=Te),(Te.type!==U||Te.texture!==oe)&&(Q!==ie&&(n.activeTexture(ie),Q=ie),n.bindTexture(U,oe||Ce[U]),Te.type=U,Te.texture=oe)}function F(){let U=re[Q];U!==void 0&&U.type!==void 0&&(n.bindTexture(U.type,null),U.type=void 0,U.texture=void 0)}function Pe(){try{n.compressedTexImage2D(...arguments)}catch(U){it("WebGLState:",U)}}function Je(){try{n.compressedTexImage3D(...arguments)}catch(U){it("WebGLState:",U)}}function ct(){try{n.texSubImage2D(...arguments)}catch(U){it("WebGLState:",U)}}function we(){try{n.texSubImage3D(...arguments)}catch(U){it("WebGLState:",U)}}function zt(){try{n.compressedTexSubImage2D(...arguments)}catch(U){it("WebGLState:",U)}}function Ge(){try{n.compressedTexSubImage3D(...arguments)}catch(U){it("WebGLState:",U)}}function Ze(){try{n.texStorage2D(...arguments)}catch(U){it("WebGLState:",U)}}function A(){try{n.texStorage3D(...arguments)}catch(U){it("WebGLState:",U)}}function S(){try{n.texImage2D(...arguments)}catch(U){it("WebGLState:",U)}}function q(){try{n.texImage3D(...arguments)}catch(U){it("WebGLState:",U)}}function ue(U){return u[U]!==void 0?u[U]:n.getParameter(U)}function ae(U,oe){u[U]!==oe&&(n.pixelStorei(U,oe),u[U]=oe)}function xe(U){te.equals(U)===!1&&(n.scissor(U.x,U.y,U.z,U.w),te.copy(U))}function ve(U){ge.equals(U)===!1&&(n.viewport(U.x,U.y,U.z,U.w),ge.copy(U))}function ne(U,oe){let ie=c.get(oe);ie===void 0&&(ie=new WeakMap,c.set(oe,ie));let Te=ie.get(U);Te===void 0&&(Te=n.getUniformBlockIndex(oe,U.name),n.uniformBlockBinding(oe,Te,Te),ie.set(U,Te))}function se(U,oe,ie){let _e=c.get(oe).get(U);l[_e]!==ie&&(n.bindBufferBase(n.UNIFORM_BUFFER,_e,ie),l[_e]=ie)}function me(){n.disable(n.BLEND),n.disable(n.CULL_FACE),n.disable(n.DEPTH_TEST),n.disable(n.POLYGON_OFFSET_FILL),n.disable(n.SCISSOR_TEST),n.disable(n.STENCIL_TEST),n.disable(n.SAMPLE_ALPHA_TO_COVERAGE),n.blendEquation(n.FUNC_ADD),n.blendFunc(n.ONE,n.ZERO),n.blendFuncSeparate(n.ONE,n.ZERO,n.ONE,n.ZERO),n.blendColor(0,0,0,0),n.colorMask(!0,!0,!0,!0),n.clearColor(0,0,0,0),n.depthMask(!0),n.depthFunc(n.LESS),o.setReversed(!1),n.clearDepth(1),n.stencilMask(4294967295),n.stencilFunc(n.ALWAYS,0,4294967295),n.stencilOp(n.KEEP,n.KEEP,n.KEEP),n.clearStencil(0),n.cullFace(n.BACK),n.frontFace(n.CCW),n.polygonOffset(0,0),n.activeTexture(n.TEXTURE0),n.bindFramebuffer(n.FRAMEBUFFER,null),n.bindFramebuffer(n.DRAW_FRAMEBUFFER,null),n.bindFramebuffer(n.READ_FRAMEBUFFER,null),n.useProgram(null),n.lineWidth(1),n.scissor(0,0,n.canvas.width,n.canvas.height),n.viewport(0,0,n.canvas.width,n.canvas.height),n.pixelStorei(n.PACK_ALIGNMENT,4),n.pixelStorei(n.UNPACK_ALIGNMENT,4),n.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,!1),n.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),n.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,n.BROWSER_DEFAULT_WEBGL),n.pixelStorei(n.PACK_ROW_LENGTH,0),n.pixelStorei(n.PACK_SKIP_PIXELS,0),n.pixelStorei(n.PACK_SKIP_ROWS,0),n.pixelStorei(n.UNPACK_ROW_LENGTH,0),n.pixelStorei(n.UNPACK_IMAGE_HEIGHT,0),n.pixelStorei(n.UNPACK_SKIP_PIXELS,0),n.pixelStorei(n.UNPACK_SKIP_ROWS,0),n.pixelStorei(n.UNPACK_SKIP_IMAGES,0),h={},u={},Q=null,re={},d={},l={},f=new WeakMap,g=[],v=null,m=!1,p=null,y=null,C=null,w=null,P=null,E=null,x=null,T=new je(0,0,0),k=0,N=!1,L=null,z=null,W=null,D=null,X=null,te.set(0,0,n.canvas.width,n.canvas.height),ge.set(0,0,n.canvas.width,n.canvas.height),r.reset(),o.reset(),a.reset()}return{buffers:{color:r,depth:o,stencil:a},enable:Me,disable:Xe,bindFramebuffer:lt,drawBuffers:He,useProgram:mt,setBlending:Qt,setMaterial:Ht,setFlipSided:pn,setCullFace:Bt,setLineWidth:Dn,setPolygonOffset:wt,setScissorTest:Mn,activeTexture:sn,bindTexture:mn,unbindTexture:F,compressedTexImage2D:Pe,compressedTexImage3D:Je,texImage2D:S,texImage3D:q,pixelStorei:ae,getParameter:ue,updateUBOMapping:ne,uniformBlockBinding:se,texStorage2D:Ze,texStorage3D:A,texSubImage2D:ct,texSubImage3D:we,compressedTexSubImage2D:zt,compressedTexSubImage3D:Ge,scissor:xe,viewport:ve,reset:me}}function RE(n,e,t,i,s,r,o){let a=e.has("WEBGL_multisampled_render_to_texture")?e.get("WEBGL_multisampled_render_to_texture"):null,l=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),c=new $e,h=new WeakMap,u=new Set,d,f=new WeakMap,g=new Set,v=new FinalizationRegistry(A=>g.delete(A)),m=!1;try{m=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function p(A,S){return m?new OffscreenCanvas(A,S):Wa("canvas")}function y(A,S,q){let ue=1,ae=Ze(A);if((ae.width>q||ae.height>q)&&(ue=q/Math.max(ae.width,ae.height)),ue<1)if(typeof HTMLImageElement<"u"&&A instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&A instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&A instanceof ImageBitmap||typeof VideoFrame<"u"&&A instanceof VideoFrame){let xe=Math.floor(ue*ae.width),ve=Math.floor(ue*ae.height);d===void 0&&(d=p(xe,ve));let ne=S?p(xe,ve):d;return ne.width=xe,ne.height=ve,ne.getContext("2d").drawImage(A,0,0,xe,ve),Ke("WebGLRenderer: Texture has been resized from ("+ae.width+"x"+ae.height+") to ("+xe+"x"+ve+")."),ne}else return"data"in A&&Ke("WebGLRenderer: Image in DataTexture is too big ("+ae.width+"x"+ae.height+")."),A;return A}function C(A){return A.generateMipmaps}function w(A){n.generateMipmap(A)}function P(A){return A.isWebGLCubeRenderTarget?n.TEXTURE_CUBE_MAP:A.isWebGL3DRenderTarget?n.TEXTURE_3D:A.isWebGLArrayRenderTarget||A.isCompressedArrayTexture?n.TEXTURE_2D_ARRAY:n.TEXTURE_2D}function E(A,S,q,ue,ae,xe=!1){if(A!==null){if(n[A]!==void 0)return n[A];Ke("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+A+"'")}let ve;ue&&(ve=e.get("EXT_texture_norm16"),ve||Ke("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let ne=S;if(S===n.RED&&(q===n.FLOAT&&(ne=n.R32F),q===n.HALF_FLOAT&&(ne=n.R16F),q===n.UNSIGNED_BYTE&&(ne=n.R8),q===n.UNSIGNED_SHORT&&ve&&(ne=ve.R16_EXT),q===n.SHORT&&ve&&(ne=ve.R16_SNORM_EXT)),S===n.RED_INTEGER&&(q===n.UNSIGNED_BYTE&&(ne=n.R8UI),q===n.UNSIGNED_SHORT&&(ne=n.R16UI),q===n.UNSIGNED_INT&&(ne=n.R32UI),q===n.BYTE&&(ne=n.R8I),q===n.SHORT&&(ne=n.R16I),q===n.INT&&(ne=n.R32I)),S===n.RG&&(q===n.FLOAT&&(ne=n.RG32F),q===n.HALF_FLOAT&&(ne=n.RG16F),q===n.UNSIGNED_BYTE&&(ne=n.RG8),q===n.UNSIGNED_SHORT&&ve&&(ne=ve.RG16_EXT),q===n.SHORT&&ve&&(ne=ve.RG16_SNORM_EXT)),S===n.RG_INTEGER&&(q===n.UNSIGNED_BYTE&&(ne=n.RG8UI),q===n.UNSIGNED_SHORT&&(ne=n.RG16UI),q===n.UNSIGNED_INT&&(ne=n.RG32UI),q===n.BYTE&&(ne=n.RG8I),q===n.SHORT&&(ne=n.RG16I),q===n.INT&&(ne=n.RG32I)),S===n.RGB_INTEGER&&(q===n.UNSIGNED_BYTE&&(ne=n.RGB8UI),q===n.UNSIGNED_SHORT&&(ne=n.RGB16UI),q===n.UNSIGNED_INT&&(ne=n.RGB32UI),q===n.BYTE&&(ne=n.RGB8I),q===n.SHORT&&(ne=n.RGB16I),q===n.INT&&(ne=n.RGB32I)),S===n.RGBA_INTEGER&&(q===n.UNSIGNED_BYTE&&(ne=n.RGBA8UI),q===n.UNSIGNED_SHORT&&(ne=n.RGBA16UI),q===n.UNSIGNED_INT&&(ne=n.RGBA32UI),q===n.BYTE&&(ne=n.RGBA8I),q===n.SHORT&&(ne=n.RGBA16I),q===n.INT&&(ne=n.RGBA32I)),S===n.RGB&&(q===n.UNSIGNED_SHORT&&ve&&(ne=ve.RGB16_EXT),q===n.SHORT&&ve&&(ne=ve.RGB16_SNORM_EXT),q===n.UNSIGNED_INT_5_9_9_9_REV&&(ne=n.RGB9_E5),q===n.UNSIGNED_INT_10F_11F_11F_REV&&(ne=n.R11F_G11F_B10F)),S===n.RGBA){let se=xe?Ha:bt.getTransfer(ae);q===n.FLOAT&&(ne=n.RGBA32F),q===n.HALF_FLOAT&&(ne=n.RGBA16F),q===n.UNSIGNED_BYTE&&(ne=se===Lt?n.SRGB8_ALPHA8:n.RGBA8),q===n.UNSIGNED_SHORT&&ve&&(ne=ve.RGBA16_EXT),q===n.SHORT&&ve&&(ne=ve.RGBA16_SNORM_EXT),q===n.UNSIGNED_SHORT_4_4_4_4&&(ne=n.RGBA4),q===n.UNSIGNED_SHORT_5_5_5_1&&(ne=n.RGB5_A1)}return(ne===n.R16F||ne===n.R32F||ne===n.RG16F||ne===n.RG32F||ne===n.RGBA16F||ne===n.RGBA32F)&&e.get("EXT_color_buffer_float"),ne}function x(A,S){let q;return A?S===null||S===qi||S===Vr?q=n.DEPTH24_STENCIL8:S===Yi?q=n.DEPTH32F_STENCIL8:S===Wo&&(q=n.DEPTH24_STENCIL8,Ke("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):S===null||S===qi||S===Vr?q=n.DEPTH_COMPONENT24:S===Yi?q=n.DEPTH_COMPONENT32F:S===Wo&&(q=n.DEPTH_COMPONENT16),q}function T(A,S){return C(A)===!0||A.isFramebufferTexture&&A.minFilter!==zn&&A.minFilter!==ni?Math.log2(Math.max(S.width,S.height))+1:A.mipmaps.length>0?A.mipmaps.length:A.isCompressedTexture&&Array.isArray(A.image)?S.mipmaps.length:1}function k(A){let S=new WeakRef(A);i.get(A).__ref=S,g.add(S),v.register(A,S,S)}function N(A){let S=i.get(A).__ref;S!==void 0&&(g.delete(S),v.unregister(S))}function L(A){W(A.target)}function z(A){D(A.target)}function W(A){A.removeEventListener("dispose",L),N(A),$(A),A.isVideoTexture&&h.delete(A),A.isHTMLTexture&&u.delete(A)}function D(A){A.removeEventListener("dispose",z),N(A),he(A)}function X(){for(let A of g){let S=A.deref();S!==void 0&&(S.isRenderTarget===!0?D(S):W(S))}g.clear(),u.clear()}function $(A){let S=i.get(A);if(S.__webglInit===void 0)return;let q=A.source,ue=f.get(q);if(ue){let ae=ue[S.__cacheKey];ae.usedTimes--,ae.usedTimes===0&&H(A),Object.keys(ue).length===0&&f.delete(q)}i.remove(A)}function H(A){let S=i.get(A);n.deleteTexture(S.__webglTexture);let q=A.source,ue=f.get(q);delete ue[S.__cacheKey],o.memory.textures--}function he(A){let S=i.get(A);S.__depthDisposeCallback&&S.__depthDisposeCallback();let q=A.depthTexture;if(q&&q.renderTarget===A&&W(q),A.isWebGLCubeRenderTarget)for(let ae=0;ae<6;ae++){if(Array.isArray(S.__webglFramebuffer[ae]))for(let xe=0;xe<S.__webglFramebuffer[ae].length;xe++)n.deleteFramebuffer(S.__webglFramebuffer[ae][xe]);else n.deleteFramebuffer(S.__webglFramebuffer[ae]);S.__webglDepthbuffer&&n.deleteRenderbuffer(S.__webglDepthbuffer[ae])}else{if(Array.isArray(S.__webglFramebuffer))for(let ae=0;ae<S.__webglFramebuffer.length;ae++)n.deleteFramebuffer(S.__webglFramebuffer[ae]);else n.deleteFramebuffer(S.__webglFramebuffer);if(S.__webglDepthbuffer&&n.deleteRenderbuffer(S.__webglDepthbuffer),S.__webglMultisampledFramebuffer&&n.deleteFramebuffer(S.__webglMultisampledFramebuffer),S.__webglColorRenderbuffer)for(let ae=0;ae<S.__webglColorRenderbuffer.length;ae++)S.__webglColorRenderbuffer[ae]&&n.deleteRenderbuffer(S.__webglColorRenderbuffer[ae]);S.__webglDepthRenderbuffer&&n.deleteRenderbuffer(S.__webglDepthRenderbuffer)}let ue=A.textures;for(let ae=0,xe=ue.length;ae<xe;ae++){let ve=i.get(ue[ae]);ve.__webglTexture&&(n.deleteTexture(ve.__webglTexture),o.memory.textures--),i.remove(ue[ae])}i.remove(A)}let J=0;function Q(){J=0}function re(){return J}function fe(A){J=A}function de(){let A=J;return A>=s.maxTextures&&Ke("WebGLTextures: Trying to use "+(A+1)+" texture units while this GPU supports only "+s.maxTextures),J+=1,A}function te(A){let S=[];return S.push(A.wrapS),S.push(A.wrapT),S.push(A.wrapR||0),S.push(A.magFilter),S.push(A.minFilter),S.push(A.anisotropy),S.push(A.internalFormat),S.push(A.format),S.push(A.type),S.push(A.generateMipmaps),S.push(A.mipmapsAutoUpdate),S.push(A.premultiplyAlpha),S.push(A.flipY),S.push(A.unpackAlignment),S.push(A.colorSpace),S.join()}function ge(A,S){let q=i.get(A);if(A.isVideoTexture&&zt(A),A.isRenderTargetTexture===!1&&A.isExternalTexture!==!0&&A.version>0&&q.__version!==A.version){let ue=A.image;if(ue===null)Ke("WebGLRenderer: Texture marked for update but no image data found.");else if(ue.complete===!1)Ke("WebGLRenderer: Texture marked for update but image is incomplete");else{Ht(q,A,S);return}}else A.isExternalTexture&&(q.__webglTexture=A.sourceTexture?A.sourceTexture:null);t.bindTexture(n.TEXTURE_2D,q.__webglTexture,n.TEXTURE0+S)}function ye(A,S){let q=i.get(A);if(A.isRenderTargetTexture===!1&&A.version>0&&q.__version!==A.version){Ht(q,A,S);return}else A.isExternalTexture&&(q.__webglTexture=A.sourceTexture?A.sourceTexture:null);t.bindTexture(n.TEXTURE_2D_ARRAY,q.__webglTexture,n.TEXTURE0+S)}function Ce(A,S){let q=i.get(A);if(A.isRenderTargetTexture===!1&&A.version>0&&q.__version!==A.version){Ht(q,A,S);return}t.bindTexture(n.TEXTURE_3D,q.__webglTexture,n.TEXTURE0+S)}function Me(A,S){let q=i.get(A);if(A.version>0&&q.__version!==A.version){pn(q,A,S);return}t.bindTexture(n.TEXTURE_CUBE_MAP,q.__webglTexture,n.TEXTURE0+S)}let Xe={[Zc]:n.REPEAT,[ds]:n.CLAMP_TO_EDGE,[Kc]:n.MIRRORED_REPEAT},lt={[zn]:n.NEAREST,[r0]:n.NEAREST_MIPMAP_NEAREST,[pl]:n.NEAREST_MIPMAP_LINEAR,[ni]:n.LINEAR,[wh]:n.LINEAR_MIPMAP_NEAREST,[Os]:n.LINEAR_MIPMAP_LINEAR},He={[c0]:n.NEVER,[Ff]:n.ALWAYS,[h0]:n.LESS,[Nf]:n.LEQUAL,[u0]:n.EQUAL,[Uf]:n.GEQUAL,[d0]:n.GREATER,[f0]:n.NOTEQUAL};function mt(A,S){if(S.type===Yi&&e.has("OES_texture_float_linear")===!1&&(S.magFilter===ni||S.magFilter===wh||S.magFilter===pl||S.magFilter===Os||S.minFilter===ni||S.minFilter===wh||S.minFilter===pl||S.minFilter===Os)&&Ke("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),n.texParameteri(A,n.TEXTURE_WRAP_S,Xe[S.wrapS]),n.texParameteri(A,n.TEXTURE_WRAP_T,Xe[S.wrapT]),(A===n.TEXTURE_3D||A===n.TEXTURE_2D_ARRAY)&&n.texParameteri(A,n.TEXTURE_WRAP_R,Xe[S.wrapR]),n.texParameteri(A,n.TEXTURE_MAG_FILTER,lt[S.magFilter]),n.texParameteri(A,n.TEXTURE_MIN_FILTER,lt[S.minFilter]),S.compareFunction&&(n.texParameteri(A,n.TEXTURE_COMPARE_MODE,n.COMPARE_REF_TO_TEXTURE),n.texParameteri(A,n.TEXTURE_COMPARE_FUNC,He[S.compareFunction])),e.has("EXT_texture_filter_anisotropic")===!0){if(S.magFilter===zn||S.minFilter!==pl&&S.minFilter!==Os||S.type===Yi&&e.has("OES_texture_float_linear")===!1)return;if(S.anisotropy>1||i.get(S).__currentAnisotropy){let q=e.get("EXT_texture_filter_anisotropic");n.texParameterf(A,q.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(S.anisotropy,s.getMaxAnisotropy())),i.get(S).__currentAnisotropy=S.anisotropy}}}function ut(A,S){let q=!1;A.__webglInit===void 0&&(A.__webglInit=!0,S.addEventListener("dispose",L),k(S));let ue=S.source,ae=f.get(ue);ae===void 0&&(ae={},f.set(ue,ae));let xe=te(S);if(xe!==A.__cacheKey){ae[xe]===void 0&&(ae[xe]={texture:n.createTexture(),usedTimes:0},o.memory.textures++,q=!0),ae[xe].usedTimes++;let ve=ae[A.__cacheKey];ve!==void 0&&(ae[A.__cacheKey].usedTimes--,ve.usedTimes===0&&H(S)),A.__cacheKey=xe,A.__webglTexture=ae[xe].texture}return q}function ot(A,S,q){return Math.floor(Math.floor(A/q)/S)}function Qt(A,S,q,ue){let xe=A.updateRanges;if(xe.length===0)t.texSubImage2D(n.TEXTURE_2D,0,0,0,S.width,S.height,q,ue,S.data);else{xe.sort((U,oe)=>U.start-oe.start);let ve=0;for(let U=1;U<xe.length;U++){let oe=xe[ve],ie=xe[U],Te=oe.start+oe.count,_e=ot(ie.start,S.width,4),be=ot(oe.start,S.width,4);ie.start<=Te+1&&_e===be&&ot(ie.start+ie.count-1,S.width,4)===_e?oe.count=Math.max(oe.count,ie.start+ie.count-oe.start):(++ve,xe[ve]=ie)}xe.length=ve+1;let ne=t.getParameter(n.UNPACK_ROW_LENGTH),se=t.getParameter(n.UNPACK_SKIP_PIXELS),me=t.getParameter(n.UNPACK_SKIP_ROWS);t.pixelStorei(n.UNPACK_ROW_LENGTH,S.width);for(let U=0,oe=xe.length;U<oe;U++){let ie=xe[U],Te=Math.floor(ie.start/4),_e=Math.ceil(ie.count/4),be=Te%S.width,We=Math.floor(Te/S.width),et=_e,ce=1;t.pixelStorei(n.UNPACK_SKIP_PIXELS,be),t.pixelStorei(n.UNPACK_SKIP_ROWS,We),t.texSubImage2D(n.TEXTURE_2D,0,be,We,et,ce,q,ue,S.data)}A.clearUpdateRanges(),t.pixelStorei(n.UNPACK_ROW_LENGTH,ne),t.pixelStorei(n.UNPACK_SKIP_PIXELS,se),t.pixelStorei(n.UNPACK_SKIP_ROWS,me)}}function Ht(A,S,q){let ue=n.TEXTURE_2D;(S.isDataArrayTexture||S.isCompressedArrayTexture)&&(ue=n.TEXTURE_2D_ARRAY),S.isData3DTexture&&(ue=n.TEXTURE_3D);let ae=ut(A,S),xe=S.source;t.bindTexture(ue,A.__webglTexture,n.TEXTURE0+q);let ve=i.get(xe);if(xe.version!==ve.__version||ae===!0){if(t.activeTexture(n.TEXTURE0+q),(typeof ImageBitmap<"u"&&S.image instanceof ImageBitmap)===!1){let ce=bt.getPrimaries(bt.workingColorSpace),ke=S.colorSpace===ks?null:bt.getPrimaries(S.colorSpace),tt=S.colorSpace===ks||ce===ke?n.NONE:n.BROWSER_DEFAULT_WEBGL;t.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,S.flipY),t.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,S.premultiplyAlpha),t.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,tt)}t.pixelStorei(n.UNPACK_ALIGNMENT,S.unpackAlignment);let se=y(S.image,!1,s.maxTextureSize);se=Ge(S,se);let me=r.convert(S.format,S.colorSpace),U=r.convert(S.type),oe=E(S.internalFormat,me,U,S.normalized,S.colorSpace,S.isVideoTexture);mt(ue,S);let ie,Te=S.mipmaps,_e=S.isVideoTexture!==!0,be=ve.__version===void 0||ae===!0,We=xe.dataReady,et=T(S,se);if(S.isDepthTexture)oe=x(S.format===Bs,S.type),be&&(_e?t.texStorage2D(n.TEXTURE_2D,1,oe,se.width,se.height):t.texImage2D(n.TEXTURE_2D,0,oe,se.width,se.height,0,me,U,null));else if(S.isDataTexture)if(Te.length>0){_e&&be&&t.texStorage2D(n.TEXTURE_2D,et,oe,Te[0].width,Te[0].height);for(let ce=0,ke=Te.length;ce<ke;ce++)ie=Te[ce],_e?We&&t.texSubImage2D(n.TEXTURE_2D,ce,0,0,ie.width,ie.height,me,U,ie.data):t.texImage2D(n.TEXTURE_2D,ce,oe,ie.width,ie.height,0,me,U,ie.data);S.generateMipmaps=!1}else _e?(be&&t.texStorage2D(n.TEXTURE_2D,et,oe,se.width,se.height),We&&Qt(S,se,me,U)):t.texImage2D(n.TEXTURE_2D,0,oe,se.width,se.height,0,me,U,se.data);else if(S.isCompressedTexture)if(S.isCompressedArrayTexture){_e&&be&&t.texStorage3D(n.TEXTURE_2D_ARRAY,et,oe,Te[0].width,Te[0].height,se.depth);for(let ce=0,ke=Te.length;ce<ke;ce++)if(ie=Te[ce],S.format!==Zi)if(me!==null)if(_e){if(We)if(S.layerUpdates.size>0){let tt=Yf(ie.width,ie.height,S.format,S.type);for(let Re of S.layerUpdates){let ht=ie.data.subarray(Re*tt/ie.data.BYTES_PER_ELEMENT,(Re+1)*tt/ie.data.BYTES_PER_ELEMENT);t.compressedTexSubImage3D(n.TEXTURE_2D_ARRAY,ce,0,0,Re,ie.width,ie.height,1,me,ht)}}else t.compressedTexSubImage3D(n.TEXTURE_2D_ARRAY,ce,0,0,0,ie.width,ie.height,se.depth,me,ie.data)}else t.compressedTexImage3D(n.TEXTURE_2D_ARRAY,ce,oe,ie.width,ie.height,se.depth,0,ie.data,0,0);else Ke("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else _e?We&&t.texSubImage3D(n.TEXTURE_2D_ARRAY,ce,0,0,0,ie.width,ie.height,se.depth,me,U,ie.data):t.texImage3D(n.TEXTURE_2D_ARRAY,ce,oe,ie.width,ie.height,se.depth,0,me,U,ie.data);S.layerUpdates.size>0&&S.clearLayerUpdates()}else{_e&&be&&t.texStorage2D(n.TEXTURE_2D,et,oe,Te[0].width,Te[0].height);for(let ce=0,ke=Te.length;ce<ke;ce++)ie=Te[ce],S.format!==Zi?me!==null?_e?We&&t.compressedTexSubImage2D(n.TEXTURE_2D,ce,0,0,ie.width,ie.height,me,ie.data):t.compressedTexImage2D(n.TEXTURE_2D,ce,oe,ie.width,ie.height,0,ie.data):Ke("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):_e?We&&t.texSubImage2D(n.TEXTURE_2D,ce,0,0,ie.width,ie.height,me,U,ie.data):t.texImage2D(n.TEXTURE_2D,ce,oe,ie.width,ie.height,0,me,U,ie.data)}else if(S.isDataArrayTexture)if(_e){if(be&&t.texStorage3D(n.TEXTURE_2D_ARRAY,et,oe,se.width,se.height,se.depth),We)if(S.layerUpdates.size>0){let ce=Yf(se.width,se.height,S.format,S.type);for(let ke of S.layerUpdates){let tt=se.data.subarray(ke*ce/se.data.BYTES_PER_ELEMENT,(ke+1)*ce/se.data.BYTES_PER_ELEMENT);t.texSubImage3D(n.TEXTURE_2D_ARRAY,0,0,0,ke,se.width,se.height,1,me,U,tt)}S.clearLayerUpdates()}else t.texSubImage3D(n.TEXTURE_2D_ARRAY,0,0,0,0,se.width,se.height,se.depth,me,U,se.data)}else t.texImage3D(n.TEXTURE_2D_ARRAY,0,oe,se.width,se.height,se.depth,0,me,U,se.data);else if(S.isData3DTexture)_e?(be&&t.texStorage3D(n.TEXTURE_3D,et,oe,se.width,se.height,se.depth),We&&t.texSubImage3D(n.TEXTURE_3D,0,0,0,0,se.width,se.height,se.depth,me,U,se.data)):t.texImage3D(n.TEXTURE_3D,0,oe,se.width,se.height,se.depth,0,me,U,se.data);else if(S.isFramebufferTexture){if(be)if(_e)t.texStorage2D(n.TEXTURE_2D,et,oe,se.width,se.height);else{let ce=se.width,ke=se.height;for(let tt=0;tt<et;tt++)t.texImage2D(n.TEXTURE_2D,tt,oe,ce,ke,0,me,U,null),ce>>=1,ke>>=1}}else if(S.isHTMLTexture){if("texElementImage2D"in n){let ce=n.canvas;if(ce.hasAttribute("layoutsubtree")||ce.setAttribute("layoutsubtree","true"),se.parentNode!==ce){ce.appendChild(se),u.add(S),ce.onpaint=ke=>{let tt=ke.changedElements;for(let Re of u)tt.includes(Re.image)&&(Re.needsUpdate=!0)},ce.requestPaint();return}if(n.texElementImage2D.length===3)n.texElementImage2D(n.TEXTURE_2D,n.RGBA8,se);else{let tt=n.RGBA,Re=n.RGBA,ht=n.UNSIGNED_BYTE;n.texElementImage2D(n.TEXTURE_2D,0,tt,Re,ht,se)}n.texParameteri(n.TEXTURE_2D,n.TEXTURE_MIN_FILTER,n.LINEAR),n.texParameteri(n.TEXTURE_2D,n.TEXTURE_WRAP_S,n.CLAMP_TO_EDGE),n.texParameteri(n.TEXTURE_2D,n.TEXTURE_WRAP_T,n.CLAMP_TO_EDGE)}}else if(Te.length>0){if(_e&&be){let ce=Ze(Te[0]);t.texStorage2D(n.TEXTURE_2D,et,oe,ce.width,ce.height)}for(let ce=0,ke=Te.length;ce<ke;ce++)ie=Te[ce],_e?We&&t.texSubImage2D(n.TEXTURE_2D,ce,0,0,me,U,ie):t.texImage2D(n.TEXTURE_2D,ce,oe,me,U,ie);S.generateMipmaps=!1}else if(_e){if(be){let ce=Ze(se);t.texStorage2D(n.TEXTURE_2D,et,oe,ce.width,ce.height)}We&&t.texSubImage2D(n.TEXTURE_2D,0,0,0,me,U,se)}else t.texImage2D(n.TEXTURE_2D,0,oe,me,U,se);C(S)&&S.mipmapsAutoUpdate===!0&&w(ue),ve.__version=xe.version,S.onUpdate&&S.onUpdate(S)}A.__version=S.version}function pn(A,S,q){if(S.image.length!==6)return;let ue=ut(A,S),ae=S.source;t.bindTexture(n.TEXTURE_CUBE_MAP,A.__webglTexture,n.TEXTURE0+q);let xe=i.get(ae);if(ae.version!==xe.__version||ue===!0){t.activeTexture(n.TEXTURE0+q);let ve=bt.getPrimaries(bt.workingColorSpace),ne=S.colorSpace===ks?null:bt.getPrimaries(S.colorSpace),se=S.colorSpace===ks||ve===ne?n.NONE:n.BROWSER_DEFAULT_WEBGL;t.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,S.flipY),t.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,S.premultiplyAlpha),t.pixelStorei(n.UNPACK_ALIGNMENT,S.unpackAlignment),t.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,se);let me=S.isCompressedTexture||S.image[0].isCompressedTexture,U=S.image[0]&&S.image[0].isDataTexture,oe=[];for(let Re=0;Re<6;Re++)!me&&!U?oe[Re]=y(S.image[Re],!0,s.maxCubemapSize):oe[Re]=U?S.image[Re].image:S.image[Re],oe[Re]=Ge(S,oe[Re]);let ie=oe[0],Te=r.convert(S.format,S.colorSpace),_e=r.convert(S.type),be=E(S.internalFormat,Te,_e,S.normalized,S.colorSpace),We=S.isVideoTexture!==!0,et=xe.__version===void 0||ue===!0,ce=ae.dataReady,ke=T(S,ie);mt(n.TEXTURE_CUBE_MAP,S);let tt;if(S.isDepthTexture){if(be=x(S.format===Bs,S.type),et)if(We)t.texStorage2D(n.TEXTURE_CUBE_MAP,1,be,ie.width,ie.height);else for(let Re=0;Re<6;Re++)t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,0,be,ie.width,ie.height,0,Te,_e,null)}else if(me){We&&et&&t.texStorage2D(n.TEXTURE_CUBE_MAP,ke,be,ie.width,ie.height);for(let Re=0;Re<6;Re++){tt=oe[Re].mipmaps;for(let ht=0;ht<tt.length;ht++){let qt=tt[ht];S.format!==Zi?Te!==null?We?ce&&t.compressedTexSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ht,0,0,qt.width,qt.height,Te,qt.data):t.compressedTexImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ht,be,qt.width,qt.height,0,qt.data):Ke("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):We?ce&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ht,0,0,qt.width,qt.height,Te,_e,qt.data):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ht,be,qt.width,qt.height,0,Te,_e,qt.data)}}}else{if(tt=S.mipmaps,We&&et){tt.length>0&&ke++;let Re=Ze(oe[0]);t.texStorage2D(n.TEXTURE_CUBE_MAP,ke,be,Re.width,Re.height)}for(let Re=0;Re<6;Re++)if(U){We?ce&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,0,0,0,oe[Re].width,oe[Re].height,Te,_e,oe[Re].data):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,0,be,oe[Re].width,oe[Re].height,0,Te,_e,oe[Re].data);for(let ht=0;ht<tt.length;ht++){let Zn=tt[ht].image[Re].image;We?ce&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ht+1,0,0,Zn.width,Zn.height,Te,_e,Zn.data):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ht+1,be,Zn.width,Zn.height,0,Te,_e,Zn.data)}}else{We?ce&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,0,0,0,Te,_e,oe[Re]):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,0,be,Te,_e,oe[Re]);for(let ht=0;ht<tt.length;ht++){let qt=tt[ht];We?ce&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ht+1,0,0,Te,_e,qt.image[Re]):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ht+1,be,Te,_e,qt.image[Re])}}}C(S)&&S.mipmapsAutoUpdate===!0&&w(n.TEXTURE_CUBE_MAP),xe.__version=ae.version,S.onUpdate&&S.onUpdate(S)}A.__version=S.version}function Bt(A,S,q,ue,ae,xe){let ve=r.convert(q.format,q.colorSpace),ne=r.convert(q.type),se=E(q.internalFormat,ve,ne,q.normalized,q.colorSpace),me=i.get(S),U=i.get(q);if(U.__renderTarget=S,!me.__hasExternalTextures){let oe=Math.max(1,S.width>>xe),ie=Math.max(1,S.height>>xe);ae===n.TEXTURE_3D||ae===n.TEXTURE_2D_ARRAY?t.texImage3D(ae,xe,se,oe,ie,S.depth,0,ve,ne,null):t.texImage2D(ae,xe,se,oe,ie,0,ve,ne,null)}t.bindFramebuffer(n.FRAMEBUFFER,A),we(S)?a.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,ue,ae,U.__webglTexture,0,ct(S)):(ae===n.TEXTURE_2D||ae>=n.TEXTURE_CUBE_MAP_POSITIVE_X&&ae<=n.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&n.framebufferTexture2D(n.FRAMEBUFFER,ue,ae,U.__webglTexture,xe),t.bindFramebuffer(n.FRAMEBUFFER,null)}function Dn(A,S,q){if(n.bindRenderbuffer(n.RENDERBUFFER,A),S.depthBuffer){let ue=S.depthTexture,ae=ue&&ue.isDepthTexture?ue.type:null,xe=x(S.stencilBuffer,ae),ve=S.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;we(S)?a.renderbufferStorageMultisampleEXT(n.RENDERBUFFER,ct(S),xe,S.width,S.height):q?n.renderbufferStorageMultisample(n.RENDERBUFFER,ct(S),xe,S.width,S.height):n.renderbufferStorage(n.RENDERBUFFER,xe,S.width,S.height),n.framebufferRenderbuffer(n.FRAMEBUFFER,ve,n.RENDERBUFFER,A)}else{let ue=S.textures;for(let ae=0;ae<ue.length;ae++){let xe=ue[ae],ve=r.convert(xe.format,xe.colorSpace),ne=r.convert(xe.type),se=E(xe.internalFormat,ve,ne,xe.normalized,xe.colorSpace);we(S)?a.renderbufferStorageMultisampleEXT(n.RENDERBUFFER,ct(S),se,S.width,S.height):q?n.renderbufferStorageMultisample(n.RENDERBUFFER,ct(S),se,S.width,S.height):n.renderbufferStorage(n.RENDERBUFFER,se,S.width,S.height)}}n.bindRenderbuffer(n.RENDERBUFFER,null)}function wt(A,S,q){let ue=S.isWebGLCubeRenderTarget===!0;if(t.bindFramebuffer(n.FRAMEBUFFER,A),!(S.depthTexture&&S.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let ae=i.get(S.depthTexture);ae.__renderTarget=S;let xe=ue?S.depthTexture.image[0]:S.depthTexture.image;(!ae.__webglTexture||xe.width!==S.width||xe.height!==S.height)&&(xe.width=S.width,xe.height=S.height,S.depthTexture.needsUpdate=!0),ue?Me(S.depthTexture,0):ge(S.depthTexture,0);let ve=ae.__webglTexture,ne=ct(S),se=ue?n.TEXTURE_CUBE_MAP_POSITIVE_X+q:n.TEXTURE_2D,me=S.depthTexture.format===Bs?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;if(S.depthTexture.format===Ls)we(S)?a.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,me,se,ve,0,ne):n.framebufferTexture2D(n.FRAMEBUFFER,me,se,ve,0);else if(S.depthTexture.format===Bs)we(S)?a.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,me,se,ve,0,ne):n.framebufferTexture2D(n.FRAMEBUFFER,me,se,ve,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function Mn(A){let S=i.get(A),q=A.isWebGLCubeRenderTarget===!0;if(S.__boundDepthTexture!==A.depthTexture){let ue=A.depthTexture;if(S.__depthDisposeCallback&&S.__depthDisposeCallback(),ue){let ae=()=>{delete S.__boundDepthTexture,delete S.__depthDisposeCallback,ue.removeEventListener("dispose",ae)};ue.addEventListener("dispose",ae),S.__depthDisposeCallback=ae}S.__boundDepthTexture=ue}if(A.depthTexture&&!S.__autoAllocateDepthBuffer)if(q)for(let ue=0;ue<6;ue++)wt(S.__webglFramebuffer[ue],A,ue);else A.texture.mipmaps.length>0?wt(S.__webglFramebuffer[0],A,0):wt(S.__webglFramebuffer,A,0);else if(q){S.__webglDepthbuffer=[];for(let ue=0;ue<6;ue++)if(t.bindFramebuffer(n.FRAMEBUFFER,S.__webglFramebuffer[ue]),S.__webglDepthbuffer[ue]===void 0)S.__webglDepthbuffer[ue]=n.createRenderbuffer(),Dn(S.__webglDepthbuffer[ue],A,!1);else{let ae=A.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,xe=S.__webglDepthbuffer[ue];n.bindRenderbuffer(n.RENDERBUFFER,xe),n.framebufferRenderbuffer(n.FRAMEBUFFER,ae,n.RENDERBUFFER,xe)}}else if(A.texture.mipmaps.length>0?t.bindFramebuffer(n.FRAMEBUFFER,S.__webglFramebuffer[0]):t.bindFramebuffer(n.FRAMEBUFFER,S.__webglFramebuffer),S.__webglDepthbuffer===void 0)S.__webglDepthbuffer=n.createRenderbuffer(),Dn(S.__webglDepthbuffer,A,!1);else{let ae=A.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,xe=S.__webglDepthbuffer;n.bindRenderbuffer(n.RENDERBUFFER,xe),n.framebufferRenderbuffer(n.FRAMEBUFFER,ae,n.RENDERBUFFER,xe)}t.bindFramebuffer(n.FRAMEBUFFER,null)}function sn(A,S,q){let ue=i.get(A);S!==void 0&&Bt(ue.__webglFramebuffer,A,A.texture,n.COLOR_ATTACHMENT0,n.TEXTURE_2D,0),q!==void 0&&Mn(A)}function mn(A){let S=A.texture,q=i.get(A),ue=i.get(S);A.addEventListener("dispose",z),k(A);let ae=A.textures,xe=A.isWebGLCubeRenderTarget===!0,ve=ae.length>1;if(ve||(ue.__webglTexture===void 0&&(ue.__webglTexture=n.createTexture()),ue.__version=S.version,o.memory.textures++),xe){q.__webglFramebuffer=[];for(let ne=0;ne<6;ne++)if(S.mipmaps.length>0){q.__webglFramebuffer[ne]=[];for(let se=0;se<S.mipmaps.length;se++)q.__webglFramebuffer[ne][se]=n.createFramebuffer()}else q.__webglFramebuffer[ne]=n.createFramebuffer()}else{if(S.mipmaps.length>0){q.__webglFramebuffer=[];for(let ne=0;ne<S.mipmaps.length;ne++)q.__webglFramebuffer[ne]=n.createFramebuffer()}else q.__webglFramebuffer=n.createFramebuffer();if(ve)for(let ne=0,se=ae.length;ne<se;ne++){let me=i.get(ae[ne]);me.__webglTexture===void 0&&(me.__webglTexture=n.createTexture(),o.memory.textures++)}if(A.samples>0&&we(A)===!1){q.__webglMultisampledFramebuffer=n.createFramebuffer(),q.__webglColorRenderbuffer=[],t.bindFramebuffer(n.FRAMEBUFFER,q.__webglMultisampledFramebuffer);for(let ne=0;ne<ae.length;ne++){let se=ae[ne];q.__webglColorRenderbuffer[ne]=n.createRenderbuffer(),n.bindRenderbuffer(n.RENDERBUFFER,q.__webglColorRenderbuffer[ne]);let me=r.convert(se.format,se.colorSpace),U=r.convert(se.type),oe=E(se.internalFormat,me,U,se.normalized,se.colorSpace,A.isXRRenderTarget===!0),ie=ct(A);n.renderbufferStorageMultisample(n.RENDERBUFFER,ie,oe,A.width,A.height),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+ne,n.RENDERBUFFER,q.__webglColorRenderbuffer[ne])}n.bindRenderbuffer(n.RENDERBUFFER,null),A.depthBuffer&&(q.__webglDepthRenderbuffer=n.createRenderbuffer(),Dn(q.__webglDepthRenderbuffer,A,!0)),t.bindFramebuffer(n.FRAMEBUFFER,null)}}if(xe){t.bindTexture(n.TEXTURE_CUBE_MAP,ue.__webglTexture),mt(n.TEXTURE_CUBE_MAP,S);for(let ne=0;ne<6;ne++)if(S.mipmaps.length>0)for(let se=0;se<S.mipmaps.length;se++)Bt(q.__webglFramebuffer[ne][se],A,S,n.COLOR_ATTACHMENT0,n.TEXTURE_CUBE_MAP_POSITIVE_X+ne,se);else Bt(q.__webglFramebuffer[ne],A,S,n.COLOR_ATTACHMENT0,n.TEXTURE_CUBE_MAP_POSITIVE_X+ne,0);C(S)?w(n.TEXTURE_CUBE_MAP):S.mipmaps.length>0&&n.texParameteri(n.TEXTURE_CUBE_MAP,n.TEXTURE_MAX_LEVEL,S.mipmaps.length-1),t.unbindTexture()}else if(ve){for(let ne=0,se=ae.length;ne<se;ne++){let me=ae[ne],U=i.get(me),oe=n.TEXTURE_2D;(A.isWebGL3DRenderTarget||A.isWebGLArrayRenderTarget)&&(oe=A.isWebGL3DRenderTarget?n.TEXTURE_3D:n.TEXTURE_2D_ARRAY),t.bindTexture(oe,U.__webglTexture),mt(oe,me),Bt(q.__webglFramebuffer,A,me,n.COLOR_ATTACHMENT0+ne,oe,0),C(me)&&w(oe)}t.unbindTexture()}else{let ne=n.TEXTURE_2D;if((A.isWebGL3DRenderTarget||A.isWebGLArrayRenderTarget)&&(ne=A.isWebGL3DRenderTarget?n.TEXTURE_3D:n.TEXTURE_2D_ARRAY),t.bindTexture(ne,ue.__webglTexture),mt(ne,S),S.mipmaps.length>0)for(let se=0;se<S.mipmaps.length;se++)Bt(q.__webglFramebuffer[se],A,S,n.COLOR_ATTACHMENT0,ne,se);else Bt(q.__webglFramebuffer,A,S,n.COLOR_ATTACHMENT0,ne,0);C(S)?w(ne):S.mipmaps.length>0&&n.texParameteri(ne,n.TEXTURE_MAX_LEVEL,S.mipmaps.length-1),t.unbindTexture()}A.depthBuffer&&Mn(A)}function F(A){let S=A.textures;for(let q=0,ue=S.length;q<ue;q++){let ae=S[q];if(C(ae)&&ae.mipmapsAutoUpdate===!0){let xe=P(A),ve=i.get(ae).__webglTexture;t.bindTexture(xe,ve),w(xe),t.unbindTexture()}}}let Pe=[];function Je(A){if(A.samples>0){if(we(A)===!1){let S=A.textures,q=A.width,ue=A.height,ae=n.COLOR_BUFFER_BIT,xe=A.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,ve=i.get(A),ne=S.length>1;if(ne)for(let me=0;me<S.length;me++)t.bindFramebuffer(n.FRAMEBUFFER,ve.__webglMultisampledFramebuffer),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+me,n.RENDERBUFFER,null),t.bindFramebuffer(n.FRAMEBUFFER,ve.__webglFramebuffer),n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0+me,n.TEXTURE_2D,null,0);t.bindFramebuffer(n.READ_FRAMEBUFFER,ve.__webglMultisampledFramebuffer),A.texture.mipmaps.length>0?t.bindFramebuffer(n.DRAW_FRAMEBUFFER,ve.__webglFramebuffer[0]):t.bindFramebuffer(n.DRAW_FRAMEBUFFER,ve.__webglFramebuffer);for(let me=0;me<S.length;me++){if(A.resolveDepthBuffer&&(A.depthBuffer&&(ae|=n.DEPTH_BUFFER_BIT),A.stencilBuffer&&A.resolveStencilBuffer&&(ae|=n.STENCIL_BUFFER_BIT)),ne){n.framebufferRenderbuffer(n.READ_FRAMEBUFFER,n.COLOR_ATTACHMENT0,n.RENDERBUFFER,ve.__webglColorRenderbuffer[me]);let U=i.get(S[me]).__webglTexture;n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0,n.TEXTURE_2D,U,0)}n.blitFramebuffer(0,0,q,ue,0,0,q,ue,ae,n.NEAREST),l===!0&&(Pe.length=0,Pe.push(n.COLOR_ATTACHMENT0+me),A.depthBuffer&&A.storeMultisampledDepthBuffer===!1&&Pe.push(xe),n.invalidateFramebuffer(n.READ_FRAMEBUFFER,Pe))}if(t.bindFramebuffer(n.READ_FRAMEBUFFER,null),t.bindFramebuffer(n.DRAW_FRAMEBUFFER,null),ne)for(let me=0;me<S.length;me++){t.bindFramebuffer(n.FRAMEBUFFER,ve.__webglMultisampledFramebuffer),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+me,n.RENDERBUFFER,ve.__webglColorRenderbuffer[me]);let U=i.get(S[me]).__webglTexture;t.bindFramebuffer(n.FRAMEBUFFER,ve.__webglFramebuffer),n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0+me,n.TEXTURE_2D,U,0)}t.bindFramebuffer(n.DRAW_FRAMEBUFFER,ve.__webglMultisampledFramebuffer)}else if(A.depthBuffer&&A.storeMultisampledDepthBuffer===!1&&l){let S=A.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;n.invalidateFramebuffer(n.DRAW_FRAMEBUFFER,[S])}}}function ct(A){return Math.min(s.maxSamples,A.samples)}function we(A){let S=i.get(A);return A.samples>0&&e.has("WEBGL_multisampled_render_to_texture")===!0&&S.__useRenderToTexture!==!1}function zt(A){let S=o.render.frame;h.get(A)!==S&&(h.set(A,S),A.update())}function Ge(A,S){let q=A.colorSpace,ue=A.format,ae=A.type;return A.isCompressedTexture===!0||A.isVideoTexture===!0||q!==Ga&&q!==ks&&(bt.getTransfer(q)===Lt?(ue!==Zi||ae!==hi)&&Ke("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):it("WebGLTextures: Unsupported texture color space:",q)),S}function Ze(A){return typeof HTMLImageElement<"u"&&A instanceof HTMLImageElement?(c.width=A.naturalWidth||A.width,c.height=A.naturalHeight||A.height):typeof VideoFrame<"u"&&A instanceof VideoFrame?(c.width=A.displayWidth,c.height=A.displayHeight):(c.width=A.width,c.height=A.height),c}this.allocateTextureUnit=de,this.resetTextureUnits=Q,this.getTextureUnits=re,this.setTextureUnits=fe,this.setTexture2D=ge,this.setTexture2DArray=ye,this.setTexture3D=Ce,this.setTextureCube=Me,this.rebindTextures=sn,this.setupRenderTarget=mn,this.updateRenderTargetMipmap=F,this.updateMultisampleRenderTarget=Je,this.setupDepthRenderbuffer=Mn,this.setupFrameBufferTexture=Bt,this.useMultisampledRTT=we,this.dispose=X}function PE(n,e){function t(i,s=ks){let r,o=bt.getTransfer(s);if(i===hi)return n.UNSIGNED_BYTE;if(i===Eh)return n.UNSIGNED_SHORT_4_4_4_4;if(i===Ah)return n.UNSIGNED_SHORT_5_5_5_1;if(i===Rf)return n.UNSIGNED_INT_5_9_9_9_REV;if(i===Pf)return n.UNSIGNED_INT_10F_11F_11F_REV;if(i===Af)return n.BYTE;if(i===Cf)return n.SHORT;if(i===Wo)return n.UNSIGNED_SHORT;if(i===Th)return n.INT;if(i===qi)return n.UNSIGNED_INT;if(i===Yi)return n.FLOAT;if(i===$i)return n.HALF_FLOAT;if(i===If)return n.ALPHA;if(i===Df)return n.RGB;if(i===Zi)return n.RGBA;if(i===Ls)return n.DEPTH_COMPONENT;if(i===Bs)return n.DEPTH_STENCIL;if(i===Lf)return n.RED;if(i===Ch)return n.RED_INTEGER;if(i===mr)return n.RG;if(i===Rh)return n.RG_INTEGER;if(i===Ph)return n.RGBA_INTEGER;if(i===ml||i===gl||i===_l||i===xl)if(o===Lt)if(r=e.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(i===ml)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(i===gl)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(i===_l)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(i===xl)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=e.get("WEBGL_compressed_texture_s3tc"),r!==null){if(i===ml)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(i===gl)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(i===_l)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(i===xl)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(i===Ih||i===Dh||i===Lh||i===Nh)if(r=e.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(i===Ih)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(i===Dh)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(i===Lh)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(i===Nh)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(i===Uh||i===Fh||i===Oh||i===Bh||i===kh||i===yl||i===zh)if(r=e.get("WEBGL_compressed_texture_etc"),r!==null){if(i===Uh||i===Fh)return o===Lt?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(i===Oh)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC;if(i===Bh)return r.COMPRESSED_R11_EAC;if(i===kh)return r.COMPRESSED_SIGNED_R11_EAC;if(i===yl)return r.COMPRESSED_RG11_EAC;if(i===zh)return r.COMPRESSED_SIGNED_RG11_EAC}else return null;if(i===Vh||i===Gh||i===Hh||i===Wh||i===Xh||i===qh||i===Yh||i===$h||i===Zh||i===Kh||i===Jh||i===jh||i===Qh||i===eu)if(r=e.get("WEBGL_compressed_texture_astc"),r!==null){if(i===Vh)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(i===Gh)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(i===Hh)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(i===Wh)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(i===Xh)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(i===qh)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(i===Yh)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(i===$h)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(i===Zh)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(i===Kh)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(i===Jh)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(i===jh)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(i===Qh)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(i===eu)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(i===tu||i===nu||i===iu)if(r=e.get("EXT_texture_compression_bptc"),r!==null){if(i===tu)return o===Lt?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(i===nu)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(i===iu)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(i===su||i===ru||i===vl||i===ou)if(r=e.get("EXT_texture_compression_rgtc"),r!==null){if(i===su)return r.COMPRESSED_RED_RGTC1_EXT;if(i===ru)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(i===vl)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(i===ou)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return i===Vr?n.UNSIGNED_INT_24_8:n[i]!==void 0?n[i]:null}return{convert:t}}var IE=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,DE=`
uniform sampler2DArray depthColor;
uniform float depthWidth;
uniform float depthHeight;

void main() {

	vec2 coord = vec2( gl_FragCoord.x / depthWidth, gl_FragCoord.y / depthHeight );

	if ( coord.x >= 1.0 ) {

		gl_FragDepth = texture( depthColor, vec3( coord.x - 1.0, coord.y, 1 ) ).r;

	} else {

		gl_FragDepth = texture( depthColor, vec3( coord.x, coord.y, 0 ) ).r;

	}

}`,np=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(e,t){if(this.texture===null){let i=new tl(e.texture);(e.depthNear!==t.depthNear||e.depthFar!==t.depthFar)&&(this.depthNear=e.depthNear,this.depthFar=e.depthFar),this.texture=i}}getMesh(e){if(this.texture!==null&&this.mesh===null){let t=e.cameras[0].viewport,i=new ps({vertexShader:IE,fragmentShader:DE,uniforms:{depthColor:{value:this.texture},depthWidth:{value:t.z},depthHeight:{value:t.w}}});this.mesh=new Vn(new il(20,20),i)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},ip=class extends Gi{constructor(e,t){super();let i=this,s=null,r=1,o=null,a="local-floor",l=1,c=null,h=null,u=null,d=null,f=null,g=null,v=typeof XRWebGLBinding<"u",m=new np,p={},y=t.getContextAttributes(),C=null,w=null,P=[],E=[],x=new $e,T=null,k=null,N=new ti;N.viewport=new tn;let L=new ti;L.viewport=new tn;let z=[N,L],W=new vh,D=null,X=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(te){let ge=P[te];return ge===void 0&&(ge=new Uo,P[te]=ge),ge.getTargetRaySpace()},this.getControllerGrip=function(te){let ge=P[te];return ge===void 0&&(ge=new Uo,P[te]=ge),ge.getGripSpace()},this.getHand=function(te){let ge=P[te];return ge===void 0&&(ge=new Uo,P[te]=ge),ge.getHandSpace()};function $(te){let ge=E.indexOf(te.inputSource);if(ge===-1)return;let ye=P[ge];ye!==void 0&&(ye.update(te.inputSource,te.frame,c||o),ye.dispatchEvent({type:te.type,data:te.inputSource}))}function H(){s.removeEventListener("select",$),s.removeEventListener("selectstart",$),s.removeEventListener("selectend",$),s.removeEventListener("squeeze",$),s.removeEventListener("squeezestart",$),s.removeEventListener("squeezeend",$),s.removeEventListener("end",H),s.removeEventListener("inputsourceschange",he);for(let te=0;te<P.length;te++){let ge=E[te];ge!==null&&(E[te]=null,P[te].disconnect(ge))}D=null,X=null,m.reset();for(let te in p)delete p[te];if(e.setRenderTarget(C),f=null,d=null,u=null,s=null,w=null,de.stop(),i.isPresenting=!1,e.setPixelRatio(T),e.setSize(x.width,x.height,!1),k!==null){let te=k.camera;te.fov=k.fov,te.zoom=k.zoom,te.updateProjectionMatrix(),k=null}i.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(te){r=te,i.isPresenting===!0&&Ke("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(te){a=te,i.isPresenting===!0&&Ke("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return c||o},this.setReferenceSpace=function(te){c=te},this.getBaseLayer=function(){return d!==null?d:f},this.getBinding=function(){return u===null&&v&&(u=new XRWebGLBinding(s,t)),u},this.getFrame=function(){return g},this.getSession=function(){return s},this.setSession=async function(te){if(s=te,s!==null){if(C=e.getRenderTarget(),s.addEventListener("select",$),s.addEventListener("selectstart",$),s.addEventListener("selectend",$),s.addEventListener("squeeze",$),s.addEventListener("squeezestart",$),s.addEventListener("squeezeend",$),s.addEventListener("end",H),s.addEventListener("inputsourceschange",he),y.xrCompatible!==!0&&await t.makeXRCompatible(),T=e.getPixelRatio(),e.getSize(x),v&&"createProjectionLayer"in XRWebGLBinding.prototype){let ye=null,Ce=null,Me=null;y.depth&&(Me=y.stencil?t.DEPTH24_STENCIL8:t.DEPTH_COMPONENT24,ye=y.stencil?Bs:Ls,Ce=y.stencil?Vr:qi);let Xe={colorFormat:t.RGBA8,depthFormat:Me,scaleFactor:r};u=this.getBinding(),d=u.createProjectionLayer(Xe),s.updateRenderState({layers:[d]}),e.setPixelRatio(1),e.setSize(d.textureWidth,d.textureHeight,!1),w=new bi(d.textureWidth,d.textureHeight,{format:Zi,type:hi,depthTexture:new Fs(d.textureWidth,d.textureHeight,Ce,void 0,void 0,void 0,void 0,void 0,void 0,ye),stencilBuffer:y.stencil,colorSpace:e.outputColorSpace,samples:y.antialias?4:0,resolveDepthBuffer:d.ignoreDepthValues===!1,resolveStencilBuffer:d.ignoreDepthValues===!1,storeMultisampledDepthBuffer:d.ignoreDepthValues===!1,storeMultisampledStencilBuffer:d.ignoreDepthValues===!1})}else{let ye={antialias:y.antialias,alpha:!0,depth:y.depth,stencil:y.stencil,framebufferScaleFactor:r};f=new XRWebGLLayer(s,t,ye),s.updateRenderState({baseLayer:f}),e.setPixelRatio(1),e.setSize(f.framebufferWidth,f.framebufferHeight,!1),w=new bi(f.framebufferWidth,f.framebufferHeight,{format:Zi,type:hi,colorSpace:e.outputColorSpace,stencilBuffer:y.stencil,resolveDepthBuffer:f.ignoreDepthValues===!1,resolveStencilBuffer:f.ignoreDepthValues===!1,storeMultisampledDepthBuffer:f.ignoreDepthValues===!1,storeMultisampledStencilBuffer:f.ignoreDepthValues===!1})}w.isXRRenderTarget=!0,this.setFoveation(l),c=null,o=await s.requestReferenceSpace(a),de.setContext(s),de.start(),i.isPresenting=!0,i.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode},this.getDepthTexture=function(){return m.getDepthTexture()};function he(te){for(let ge=0;ge<te.removed.length;ge++){let ye=te.removed[ge],Ce=E.indexOf(ye);Ce>=0&&(E[Ce]=null,P[Ce].disconnect(ye))}for(let ge=0;ge<te.added.length;ge++){let ye=te.added[ge],Ce=E.indexOf(ye);if(Ce===-1){for(let Xe=0;Xe<P.length;Xe++)if(Xe>=E.length){E.push(ye),Ce=Xe;break}else if(E[Xe]===null){E[Xe]=ye,Ce=Xe;break}if(Ce===-1)break}let Me=P[Ce];Me&&Me.connect(ye)}}function J(te,ge){ge===null?te.matrixWorld.copy(te.matrix):te.matrixWorld.multiplyMatrices(ge.matrixWorld,te.matrix),te.matrixWorldInverse.copy(te.matrixWorld).invert()}this.updateCamera=function(te){if(s===null)return;let ge=te.near,ye=te.far;m.texture!==null&&(m.depthNear>0&&(ge=m.depthNear),m.depthFar>0&&(ye=m.depthFar)),W.near=L.near=N.near=ge,W.far=L.far=N.far=ye,(D!==W.near||X!==W.far)&&(s.updateRenderState({depthNear:W.near,depthFar:W.far}),D=W.near,X=W.far),W.layers.mask=te.layers.mask|6,N.layers.mask=W.layers.mask&-5,L.layers.mask=W.layers.mask&-3;let Ce=te.parent,Me=W.cameras;J(W,Ce);for(let Xe=0;Xe<Me.length;Xe++)J(Me[Xe],Ce);W.projectionMatrix.copy(N.projectionMatrix),W.projectionMatrixInverse.copy(N.projectionMatrixInverse),k===null&&te.isPerspectiveCamera&&(k={camera:te,fov:te.fov,zoom:te.zoom}),Q(te,W,Ce)};function Q(te,ge,ye){ye===null?te.matrix.copy(ge.matrixWorld):(te.matrix.copy(ye.matrixWorld),te.matrix.invert(),te.matrix.multiply(ge.matrixWorld)),te.matrix.decompose(te.position,te.quaternion,te.scale),te.updateMatrixWorld(!0),te.projectionMatrix.copy(ge.projectionMatrix),te.projectionMatrixInverse.copy(ge.projectionMatrixInverse),te.isPerspectiveCamera&&(te.fov=Lo*2*Math.atan(1/te.projectionMatrix.elements[5]),te.zoom=1)}this.getCamera=function(){return W},this.getFoveation=function(){if(!(d===null&&f===null))return l},this.setFoveation=function(te){l=te,d!==null&&(d.fixedFoveation=te),f!==null&&f.fixedFoveation!==void 0&&(f.fixedFoveation=te)},this.hasDepthSensing=function(){return m.texture!==null},this.getDepthSensingMesh=function(){return m.getMesh(W)},this.getCameraTexture=function(te){return p[te]};let re=null;function fe(te,ge){if(h=ge.getViewerPose(c||o),g=ge,h!==null){let ye=h.views;f!==null&&(e.setRenderTargetFramebuffer(w,f.framebuffer),e.setRenderTarget(w));let Ce=!1;ye.length!==W.cameras.length&&(W.cameras.length=0,Ce=!0);for(let He=0;He<ye.length;He++){let mt=ye[He],ut=null;if(f!==null)ut=f.getViewport(mt);else{let Qt=u.getViewSubImage(d,mt);ut=Qt.viewport,He===0&&(e.setRenderTargetTextures(w,Qt.colorTexture,Qt.depthStencilTexture),e.setRenderTarget(w))}let ot=z[He];ot===void 0&&(ot=new ti,ot.layers.enable(He),ot.viewport=new tn,z[He]=ot),ot.matrix.fromArray(mt.transform.matrix),ot.matrix.decompose(ot.position,ot.quaternion,ot.scale),ot.projectionMatrix.fromArray(mt.projectionMatrix),ot.projectionMatrixInverse.copy(ot.projectionMatrix).invert(),ot.viewport.set(ut.x,ut.y,ut.width,ut.height),He===0&&(W.matrix.copy(ot.matrix),W.matrix.decompose(W.position,W.quaternion,W.scale)),Ce===!0&&W.cameras.push(ot)}let Me=s.enabledFeatures;if(Me&&Me.includes("depth-sensing")&&s.depthUsage=="gpu-optimized"&&v){u=i.getBinding();let He=u.getDepthInformation(ye[0]);He&&He.isValid&&He.texture&&m.init(He,s.renderState)}if(Me&&Me.includes("camera-access")&&v){e.state.unbindTexture(),u=i.getBinding();for(let He=0;He<ye.length;He++){let mt=ye[He].camera;if(mt){let ut=p[mt];ut||(ut=new tl,p[mt]=ut);let ot=u.getCameraImage(mt);ut.sourceTexture=ot}}}}for(let ye=0;ye<P.length;ye++){let Ce=E[ye],Me=P[ye];Ce!==null&&Me!==void 0&&Me.update(Ce,ge,c||o)}re&&re(te,ge),ge.detectedPlanes&&i.dispatchEvent({type:"planesdetected",data:ge}),g=null}let de=new W0;de.setAnimationLoop(fe),this.setAnimationLoop=function(te){re=te},this.dispose=function(){}}},LE=new Pt,e_=new st;e_.set(-1,0,0,0,1,0,0,0,1);function NE(n,e){function t(m,p){m.matrixAutoUpdate===!0&&m.updateMatrix(),p.value.copy(m.matrix)}function i(m,p){p.color.getRGB(m.fogColor.value,Wf(n)),p.isFog?(m.fogNear.value=p.near,m.fogFar.value=p.far):p.isFogExp2&&(m.fogDensity.value=p.density)}function s(m,p,y,C,w){p.isNodeMaterial?p.uniformsNeedUpdate=!1:p.isMeshBasicMaterial?r(m,p):p.isMeshLambertMaterial?(r(m,p),p.envMap&&(m.envMapIntensity.value=p.envMapIntensity)):p.isMeshToonMaterial?(r(m,p),u(m,p)):p.isMeshPhongMaterial?(r(m,p),h(m,p),p.envMap&&(m.envMapIntensity.value=p.envMapIntensity)):p.isMeshStandardMaterial?(r(m,p),d(m,p),p.isMeshPhysicalMaterial&&f(m,p,w)):p.isMeshMatcapMaterial?(r(m,p),g(m,p)):p.isMeshDepthMaterial?r(m,p):p.isMeshDistanceMaterial?(r(m,p),v(m,p)):p.isMeshNormalMaterial?r(m,p):p.isLineBasicMaterial?(o(m,p),p.isLineDashedMaterial&&a(m,p)):p.isPointsMaterial?l(m,p,y,C):p.isSpriteMaterial?c(m,p):p.isShadowMaterial?(m.color.value.copy(p.color),m.opacity.value=p.opacity):p.isShaderMaterial&&(p.uniformsNeedUpdate=!1)}function r(m,p){m.opacity.value=p.opacity,p.color&&m.diffuse.value.copy(p.color),p.emissive&&m.emissive.value.copy(p.emissive).multiplyScalar(p.emissiveIntensity),p.map&&(m.map.value=p.map,t(p.map,m.mapTransform)),p.alphaMap&&(m.alphaMap.value=p.alphaMap,t(p.alphaMap,m.alphaMapTransform)),p.bumpMap&&(m.bumpMap.value=p.bumpMap,t(p.bumpMap,m.bumpMapTransform),m.bumpScale.value=p.bumpScale,p.side===ri&&(m.bumpScale.value*=-1)),p.normalMap&&(m.normalMap.value=p.normalMap,t(p.normalMap,m.normalMapTransform),m.normalScale.value.copy(p.normalScale),p.side===ri&&m.normalScale.value.negate()),p.displacementMap&&(m.displacementMap.value=p.displacementMap,t(p.displacementMap,m.displacementMapTransform),m.displacementScale.value=p.displacementScale,m.displacementBias.value=p.displacementBias),p.emissiveMap&&(m.emissiveMap.value=p.emissiveMap,t(p.emissiveMap,m.emissiveMapTransform)),p.specularMap&&(m.specularMap.value=p.specularMap,t(p.specularMap,m.specularMapTransform)),p.alphaTest>0&&(m.alphaTest.value=p.alphaTest);let y=e.get(p),C=y.envMap,w=y.envMapRotation;C&&(m.envMap.value=C,m.envMapRotation.value.setFromMatrix4(LE.makeRotationFromEuler(w)).transpose(),C.isCubeTexture&&C.isRenderTargetTexture===!1&&m.envMapRotation.value.premultiply(e_),m.reflectivity.value=p.reflectivity,m.ior.value=p.ior,m.refractionRatio.value=p.refractionRatio),p.lightMap&&(m.lightMap.value=p.lightMap,m.lightMapIntensity.value=p.lightMapIntensity,t(p.lightMap,m.lightMapTransform)),p.aoMap&&(m.aoMap.value=p.aoMap,m.aoMapIntensity.value=p.aoMapIntensity,t(p.aoMap,m.aoMapTransform))}function o(m,p){m.diffuse.value.copy(p.color),m.opacity.value=p.opacity,p.map&&(m.map.value=p.map,t(p.map,m.mapTransform))}function a(m,p){m.dashSize.value=p.dashSize,m.totalSize.value=p.dashSize+p.gapSize,m.scale.value=p.scale}function l(m,p,y,C){m.diffuse.value.copy(p.color),m.opacity.value=p.opacity,m.size.value=p.size*y,m.scale.value=C*.5,p.map&&(m.map.value=p.map,t(p.map,m.uvTransform)),p.alphaMap&&(m.alphaMap.value=p.alphaMap,t(p.alphaMap,m.alphaMapTransform)),p.alphaTest>0&&(m.alphaTest.value=p.alphaTest)}function c(m,p){m.diffuse.value.copy(p.color),m.opacity.value=p.opacity,m.rotation.value=p.rotation,p.map&&(m.map.value=p.map,t(p.map,m.mapTransform)),p.alphaMap&&(m.alphaMap.value=p.alphaMap,t(p.alphaMap,m.alphaMapTransform)),p.alphaTest>0&&(m.alphaTest.value=p.alphaTest)}function h(m,p){m.specular.value.copy(p.specular),m.shininess.value=Math.max(p.shininess,1e-4)}function u(m,p){p.gradientMap&&(m.gradientMap.value=p.gradientMap)}function d(m,p){m.metalness.value=p.metalness,p.metalnessMap&&(m.metalnessMap.value=p.metalnessMap,t(p.metalnessMap,m.metalnessMapTransform)),m.roughness.value=p.roughness,p.roughnessMap&&(m.roughnessMap.value=p.roughnessMap,t(p.roughnessMap,m.roughnessMapTransform)),p.envMap&&(m.envMapIntensity.value=p.envMapIntensity)}function f(m,p,y){m.ior.value=p.ior,p.diffuseRoughness>0&&(m.diffuseRoughness.value=p.diffuseRoughness,p.diffuseRoughnessMap&&(m.diffuseRoughnessMap.value=p.diffuseRoughnessMap,t(p.diffuseRoughnessMap,m.diffuseRoughnessMapTransform))),p.sheen>0&&(m.sheenColor.value.copy(p.sheenColor).multiplyScalar(p.sheen),m.sheenRoughness.value=p.sheenRoughness,p.sheenColorMap&&(m.sheenColorMap.value=p.sheenColorMap,t(p.sheenColorMap,m.sheenColorMapTransform)),p.sheenRoughnessMap&&(m.sheenRoughnessMap.value=p.sheenRoughnessMap,t(p.sheenRoughnessMap,m.sheenRoughnessMapTransform))),p.clearcoat>0&&(m.clearcoat.value=p.clearcoat,m.clearcoatRoughness.value=p.clearcoatRoughness,p.clearcoatMap&&(m.clearcoatMap.value=p.clearcoatMap,t(p.clearcoatMap,m.clearcoatMapTransform)),p.clearcoatRoughnessMap&&(m.clearcoatRoughnessMap.value=p.clearcoatRoughnessMap,t(p.clearcoatRoughnessMap,m.clearcoatRoughnessMapTransform)),p.clearcoatNormalMap&&(m.clearcoatNormalMap.value=p.clearcoatNormalMap,t(p.clearcoatNormalMap,m.clearcoatNormalMapTransform),m.clearcoatNormalScale.value.copy(p.clearcoatNormalScale),p.side===ri&&m.clearcoatNormalScale.value.negate())),p.dispersion>0&&(m.dispersion.value=p.dispersion),p.retroreflectivity>0&&(m.retroreflectivity.value=p.retroreflectivity),p.iridescence>0&&(m.iridescence.value=p.iridescence,m.iridescenceIOR.value=p.iridescenceIOR,m.iridescenceThicknessMinimum.value=p.iridescenceThicknessMinimum,m.iridescenceThicknessMaximum.value=p.iridescenceThicknessMaximum,p.iridescenceMap&&(m.iridescenceMap.value=p.iridescenceMap,t(p.iridescenceMap,m.iridescenceMapTransform)),p.iridescenceThicknessMap&&(m.iridescenceThicknessMap.value=p.iridescenceThicknessMap,t(p.iridescenceThicknessMap,m.iridescenceThicknessMapTransform))),p.transmission>0&&(m.transmission.value=p.transmission,m.transmissionSamplerMap.value=y.texture,m.transmissionSamplerSize.value.set(y.width,y.height),p.transmissionMap&&(m.transmissionMap.value=p.transmissionMap,t(p.transmissionMap,m.transmissionMapTransform)),m.thickness.value=p.thickness,p.thicknessMap&&(m.thicknessMap.value=p.thicknessMap,t(p.thicknessMap,m.thicknessMapTransform)),m.attenuationDistance.value=p.attenuationDistance,m.attenuationColor.value.copy(p.attenuationColor)),p.anisotropy>0&&(m.anisotropyVector.value.set(p.anisotropy*Math.cos(p.anisotropyRotation),p.anisotropy*Math.sin(p.anisotropyRotation)),p.anisotropyMap&&(m.anisotropyMap.value=p.anisotropyMap,t(p.anisotropyMap,m.anisotropyMapTransform))),m.specularIntensity.value=p.specularIntensity,m.specularColor.value.copy(p.specularColor),p.specularColorMap&&(m.specularColorMap.value=p.specularColorMap,t(p.specularColorMap,m.specularColorMapTransform)),p.specularIntensityMap&&(m.specularIntensityMap.value=p.specularIntensityMap,t(p.specularIntensityMap,m.specularIntensityMapTransform))}function g(m,p){p.matcap&&(m.matcap.value=p.matcap)}function v(m,p){let y=e.get(p).light;m.referencePosition.value.setFromMatrixPosition(y.matrixWorld),m.nearDistance.value=y.shadow.camera.near,m.farDistance.value=y.shadow.camera.far}return{refreshFogUniforms:i,refreshMaterialUniforms:s}}function UE(n,e,t,i){let s={},r={};function o(y,C){let w=C.program;i.uniformBlockBinding(y,w,s[y.id])}function a(y,C){let w=s[y.id];w===void 0&&(g(y),w=l(y),s[y.id]=w,y.addEventListener("dispose",m));let P=C.program;i.updateUBOMapping(y,P);let E=e.render.frame;r[y.id]!==E&&(c(y),r[y.id]=E)}function l(y){let C=n.createBuffer(),w=y.__size,P=y.usage;return n.bindBuffer(n.UNIFORM_BUFFER,C),n.bufferData(n.UNIFORM_BUFFER,w,P),n.bindBuffer(n.UNIFORM_BUFFER,null),C}function c(y){let C=s[y.id],w=y.uniforms,P=y.__cache;n.bindBuffer(n.UNIFORM_BUFFER,C);for(let E=0,x=w.length;E<x;E++){let T=w[E];if(Array.isArray(T))for(let k=0,N=T.length;k<N;k++)h(T[k],E,k,P);else h(T,E,0,P)}n.bindBuffer(n.UNIFORM_BUFFER,null)}function h(y,C,w,P){if(d(y,C,w,P)===!0){let E=y.__offset,x=y.value;if(Array.isArray(x)){let T=0;for(let k=0;k<x.length;k++){let N=x[k],L=v(N,!0);u(N,y.__data,T),T+=L.storage/Float32Array.BYTES_PER_ELEMENT}}else u(x,y.__data,0);n.bufferSubData(n.UNIFORM_BUFFER,E,y.__data)}}function u(y,C,w){typeof y=="number"||typeof y=="boolean"?C[w]=y:y.isMatrix3?(C[w]=y.elements[0],C[w+1]=y.elements[1],C[w+2]=y.elements[2],C[w+3]=0,C[w+4]=y.elements[3],C[w+5]=y.elements[4],C[w+6]=y.elements[5],C[w+7]=0,C[w+8]=y.elements[6],C[w+9]=y.elements[7],C[w+10]=y.elements[8],C[w+11]=0):ArrayBuffer.isView(y)?C.set(y.subarray(0,C.length-w),w):y.toArray(C,w)}function d(y,C,w,P){let E=y.value,x=C+"_"+w;if(Array.isArray(E)){P[x]===void 0&&(P[x]=[]);let T=P[x],k=!1;for(let N=0;N<E.length;N++)f(E[N],T,N)===!0&&(k=!0);return k}return f(E,P,x)}function f(y,C,w){if(C[w]===void 0)return typeof y=="number"||typeof y=="boolean"?C[w]=y:ArrayBuffer.isView(y)?C[w]=y.slice():C[w]=y.clone(),!0;{let P=C[w];if(typeof y=="number"||typeof y=="boolean"){if(P!==y)return C[w]=y,!0}else{if(ArrayBuffer.isView(y))return!0;if(P.equals(y)===!1)return P.copy(y),!0}}return!1}function g(y){let C=y.uniforms,w=0,P=16;for(let x=0,T=C.length;x<T;x++){let k=Array.isArray(C[x])?C[x]:[C[x]];for(let N=0,L=k.length;N<L;N++){let z=k[N],W=Array.isArray(z.value)?z.value:[z.value],D=Array.isArray(C[x])||Array.isArray(z.value),X=w;for(let H=0,he=W.length;H<he;H++){let J=W[H],Q=v(J,D),re=w%P,fe=re%Q.boundary,de=re+fe;w+=fe,de!==0&&P-de<Q.storage&&(w+=P-de),H===0&&(X=w),w+=Q.storage}let $=z.type==="int"?Int32Array:z.type==="uint"?Uint32Array:Float32Array;z.__data=new $((w-X)/Float32Array.BYTES_PER_ELEMENT),z.__offset=X}}let E=w%P;return E>0&&(w+=P-E),y.__size=w,y.__cache={},this}function v(y,C){let w={boundary:0,storage:0};return typeof y=="number"||typeof y=="boolean"?(w.boundary=4,w.storage=4):y.isVector2?(w.boundary=8,w.storage=8):y.isVector3||y.isColor?(w.boundary=16,w.storage=12):y.isVector4?(w.boundary=16,w.storage=16):y.isMatrix3?(w.boundary=16,w.storage=48):y.isMatrix4?(w.boundary=16,w.storage=64):y.isTexture?Ke("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(y)?(w.boundary=16,w.storage=y.byteLength):Ke("WebGLRenderer: Unsupported uniform value type.",y),C===!0&&(w.boundary=16,w.storage=Math.ceil(w.storage/16)*16),w}function m(y){let C=y.target;C.removeEventListener("dispose",m),n.deleteBuffer(s[C.id]),delete s[C.id],delete r[C.id]}function p(){for(let y in s)n.deleteBuffer(s[y]);s={},r={}}return{bind:o,update:a,dispose:p}}var FE=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),gs=null;function OE(){return gs===null&&(gs=new Oo(FE,16,16,mr,$i),gs.name="DFG_LUT",gs.minFilter=ni,gs.magFilter=ni,gs.wrapS=ds,gs.wrapT=ds,gs.generateMipmaps=!1,gs.needsUpdate=!0),gs}var du=class{constructor(e={}){let{canvas:t=p0(),context:i=null,depth:s=!0,stencil:r=!1,alpha:o=!1,antialias:a=!1,premultipliedAlpha:l=!0,preserveDrawingBuffer:c=!1,powerPreference:h="default",failIfMajorPerformanceCaveat:u=!1,reversedDepthBuffer:d=!1,outputBufferType:f=hi}=e;this.isWebGLRenderer=!0;let g;if(i!==null){if(typeof WebGLRenderingContext<"u"&&i instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");g=i.getContextAttributes().alpha}else g=o;let v=f,m=new Set([Ph,Rh,Ch]),p=new Set([hi,qi,Wo,Vr,Eh,Ah]),y=new Uint32Array(4),C=new Int32Array(4),w={textures:[],min:[],max:[],resolution:[]},P=null,E=null,x=[],T=[],k=null;this.domElement=t,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=ms,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let N=this,L=!1,z=null,W=null,D=null,X=null;this._outputColorSpace=vi;let $=0,H=0,he=null,J=-1,Q=null,re=new tn,fe=new tn,de=null,te=new je(0),ge=0,ye=t.width,Ce=t.height,Me=1,Xe=null,lt=null,He=new tn(0,0,ye,Ce),mt=new tn(0,0,ye,Ce),ut=!1,ot=new or,Qt=new nh,Ht=!1,pn=!1,Bt=new Pt,Dn=new B,wt=new tn,Mn={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},sn=!1;function mn(){return he===null?Me:1}let F=i;function Pe(M,O){return t.getContext(M,O)}let Je,ct,we,zt,Ge,Ze,A,S,q,ue,ae,xe,ve,ne,se,me,U,oe,ie,Te,_e,be,We;try{let M={alpha:!0,depth:s,stencil:r,antialias:a,premultipliedAlpha:l,preserveDrawingBuffer:c,powerPreference:h,failIfMajorPerformanceCaveat:u};if("setAttribute"in t&&t.setAttribute("data-engine",`three.js r${"187"}`),t.addEventListener("webglcontextlost",ke,!1),t.addEventListener("webglcontextrestored",tt,!1),t.addEventListener("webglcontextcreationerror",Re,!1),F===null){let O="webgl2";if(F=Pe(O,M),F===null)throw Pe(O)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}et()}catch(M){throw t.removeEventListener("webglcontextlost",ke,!1),t.removeEventListener("webglcontextrestored",tt,!1),t.removeEventListener("webglcontextcreationerror",Re,!1),it("WebGLRenderer: "+M.message),M}function et(){Je=new $w(F),Je.init(),_e=new PE(F,Je),ct=new Ow(F,Je,e,_e),we=new CE(F,Je),ct.reversedDepthBuffer&&d&&we.buffers.depth.setReversed(!0),W=F.createFramebuffer(),D=F.createFramebuffer(),X=F.createFramebuffer(),zt=new Jw(F),Ge=new pE,Ze=new RE(F,Je,we,Ge,ct,_e,zt),A=new Yw(N),S=new QS(F),be=new Uw(F,S),q=new Zw(F,S,zt,be),ue=new Qw(F,q,S,be,zt),oe=new jw(F,ct,Ze),se=new Bw(Ge),ae=new fE(N,A,Je,ct,be,se),xe=new NE(N,Ge),ve=new gE,ne=new bE(Je),U=new Nw(N,A,we,ue,g,l),me=new AE(N,ue,ct),We=new UE(F,zt,ct,we),ie=new Fw(F,Je,zt),Te=new Kw(F,Je,zt),zt.programs=ae.programs,N.capabilities=ct,N.extensions=Je,N.properties=Ge,N.renderLists=ve,N.shadowMap=me,N.state=we,N.info=zt}v!==hi&&(k=new tT(v,t.width,t.height,a,s,r));let ce=new ip(N,F);this.xr=ce,this.getContext=function(){return F},this.getContextAttributes=function(){return F.getContextAttributes()},this.forceContextLoss=function(){let M=Je.get("WEBGL_lose_context");M&&M.loseContext()},this.forceContextRestore=function(){let M=Je.get("WEBGL_lose_context");M&&M.restoreContext()},this.getPixelRatio=function(){return Me},this.setPixelRatio=function(M){M!==void 0&&(Me=M,this.setSize(ye,Ce,!1))},this.getSize=function(M){return M.set(ye,Ce)},this.setSize=function(M,O,j=!0){if(ce.isPresenting){Ke("WebGLRenderer: Can't change size while VR device is presenting.");return}ye=M,Ce=O,t.width=Math.floor(M*Me),t.height=Math.floor(O*Me),j===!0&&(t.style.width=M+"px",t.style.height=O+"px"),k!==null&&k.setSize(t.width,t.height),this.setViewport(0,0,M,O)},this.getDrawingBufferSize=function(M){return M.set(ye*Me,Ce*Me).floor()},this.setDrawingBufferSize=function(M,O,j){ye=M,Ce=O,Me=j,t.width=Math.floor(M*j),t.height=Math.floor(O*j),this.setViewport(0,0,M,O)},this.setEffects=function(M){if(v===hi){it("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(M){for(let O=0;O<M.length;O++)if(M[O].isOutputPass===!0){Ke("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}k.setEffects(M||[])},this.getCurrentViewport=function(M){return M.copy(re)},this.getViewport=function(M){return M.copy(He)},this.setViewport=function(M,O,j,Y){M.isVector4?He.set(M.x,M.y,M.z,M.w):He.set(M,O,j,Y),we.viewport(re.copy(He).multiplyScalar(mn()).round())},this.getScissor=function(M){return M.copy(mt)},this.setScissor=function(M,O,j,Y){M.isVector4?mt.set(M.x,M.y,M.z,M.w):mt.set(M,O,j,Y),we.scissor(fe.copy(mt).multiplyScalar(mn()).round())},this.getScissorTest=function(){return ut},this.setScissorTest=function(M){we.setScissorTest(ut=M)},this.setOpaqueSort=function(M){Xe=M},this.setTransparentSort=function(M){lt=M},this.getClearColor=function(M){return M.copy(U.getClearColor())},this.setClearColor=function(){U.setClearColor(...arguments)},this.getClearAlpha=function(){return U.getClearAlpha()},this.setClearAlpha=function(){U.setClearAlpha(...arguments)},this.clear=function(M=!0,O=!0,j=!0){let Y=0;if(M){let Z=!1;if(he!==null){let Ee=he.texture.format;Z=m.has(Ee)}if(Z){let Ee=he.texture.type,Ie=p.has(Ee),Ae=U.getClearColor(),De=U.getClearAlpha(),Ve=Ae.r,rt=Ae.g,gt=Ae.b;Ie?(y[0]=Ve,y[1]=rt,y[2]=gt,y[3]=De,F.clearBufferuiv(F.COLOR,0,y)):(C[0]=Ve,C[1]=rt,C[2]=gt,C[3]=De,F.clearBufferiv(F.COLOR,0,C))}else Y|=F.COLOR_BUFFER_BIT}O&&(Y|=F.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),j&&(Y|=F.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),Y!==0&&F.clear(Y)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(M){M.setRenderer(this),z=M},this.dispose=function(){t.removeEventListener("webglcontextlost",ke,!1),t.removeEventListener("webglcontextrestored",tt,!1),t.removeEventListener("webglcontextcreationerror",Re,!1),U.dispose(),ve.dispose(),ne.dispose(),Ze.dispose(),Ge.dispose(),A.dispose(),ue.dispose(),q.dispose(),be.dispose(),We.dispose(),ae.dispose(),ce.dispose(),ce.removeEventListener("sessionstart",Ol),ce.removeEventListener("sessionend",es),ys.stop()};function ke(M){M.preventDefault(),Xa("WebGLRenderer: Context Lost."),L=!0}function tt(){Xa("WebGLRenderer: Context Restored."),L=!1;let M=zt.autoReset,O=me.enabled,j=me.autoUpdate,Y=me.needsUpdate,Z=me.type;et(),zt.autoReset=M,me.enabled=O,me.autoUpdate=j,me.needsUpdate=Y,me.type=Z}function Re(M){it("WebGLRenderer: A WebGL context could not be created. Reason: ",M.statusMessage)}function ht(M){let O=M.target;O.removeEventListener("dispose",ht),qt(O)}function qt(M){Zn(M),Ge.remove(M)}function Zn(M){let O=Ge.get(M).programs;O!==void 0&&(O.forEach(function(j){ae.releaseProgram(j)}),M.isShaderMaterial&&ae.releaseShaderCache(M))}this.renderBufferDirect=function(M,O,j,Y,Z,Ee){O===null&&(O=Mn);let Ie=Z.isMesh&&Z.matrixWorld.determinantAffine()<0,Ae=ca(M,O,j,Y,Z);we.setMaterial(Y,Ie);let De=j.index,Ve=1;if(Y.wireframe===!0){if(De=q.getWireframeAttribute(j),De===void 0)return;Ve=2}let rt=j.drawRange,gt=j.attributes.position,ze=rt.start*Ve,_t=(rt.start+rt.count)*Ve;Ee!==null&&(ze=Math.max(ze,Ee.start*Ve),_t=Math.min(_t,(Ee.start+Ee.count)*Ve)),De!==null?(ze=Math.max(ze,0),_t=Math.min(_t,De.count)):gt!=null&&(ze=Math.max(ze,0),_t=Math.min(_t,gt.count));let nn=_t-ze;if(nn<0||nn===1/0)return;be.setup(Z,Y,Ae,j,De);let Ut,Ft=ie;if(De!==null&&(Ut=S.get(De),Ft=Te,Ft.setIndex(Ut)),Z.isMesh)Y.wireframe===!0?(we.setLineWidth(Y.wireframeLinewidth*mn()),Ft.setMode(F.LINES)):Ft.setMode(F.TRIANGLES);else if(Z.isLine){let wn=Y.linewidth;wn===void 0&&(wn=1),we.setLineWidth(wn*mn()),Z.isLineSegments?Ft.setMode(F.LINES):Z.isLineLoop?Ft.setMode(F.LINE_LOOP):Ft.setMode(F.LINE_STRIP)}else Z.isPoints?Ft.setMode(F.POINTS):Z.isSprite&&Ft.setMode(F.TRIANGLES);if(Z.isBatchedMesh)if(Je.get("WEBGL_multi_draw"))Ft.renderMultiDraw(Z._multiDrawStarts,Z._multiDrawCounts,Z._multiDrawCount);else{let wn=Z._multiDrawStarts,Fe=Z._multiDrawCounts,gn=Z._multiDrawCount,vt=De?S.get(De).bytesPerElement:1,Ss=Ge.get(Y).currentProgram.getUniforms();for(let _n=0;_n<gn;_n++)Ss.setValue(F,"_gl_DrawID",_n),Ft.render(wn[_n]/vt,Fe[_n])}else if(Z.isInstancedMesh)Ft.renderInstances(ze,nn,Z.count);else if(j.isInstancedBufferGeometry){let wn=j._maxInstanceCount!==void 0?j._maxInstanceCount:1/0,Fe=Math.min(j.instanceCount,wn);Ft.renderInstances(ze,nn,Fe)}else Ft.render(ze,nn)};function oa(M,O,j,Y){z!==null&&M.isNodeMaterial&&z.setObject(Y,M),Ht===!0&&se.setState(M,j,!1),M.transparent===!0&&M.side===oi&&M.forceSinglePass===!1?(M.side=ri,M.needsUpdate=!0,ts(M,O,Y),M.side=pr,M.needsUpdate=!0,ts(M,O,Y),M.side=oi):ts(M,O,Y)}this.compile=function(M,O,j=null){j===null&&(j=M),z!==null&&z.renderStart(M,O,j),E=ne.get(j),E.init(O),T.push(E),j.traverseVisible(function(Z){Z.isLight&&Z.layers.test(O.layers)&&(E.pushLight(Z),Z.castShadow&&E.pushShadow(Z))}),M!==j&&M.traverseVisible(function(Z){Z.isLight&&Z.layers.test(O.layers)&&(E.pushLight(Z),Z.castShadow&&E.pushShadow(Z))}),E.setupLights(),z!==null&&z.updateLights(E.state.lightsArray),pn=this.localClippingEnabled,Ht=se.init(this.clippingPlanes,pn),Ht===!0&&se.setGlobalState(this.clippingPlanes,O),z!==null&&me.render(E.state.shadowsArray,j,O);let Y=new Set;return M.traverse(function(Z){if(!(Z.isMesh||Z.isPoints||Z.isLine||Z.isSprite))return;let Ee=Z.material;if(Ee)if(Array.isArray(Ee))for(let Ie=0;Ie<Ee.length;Ie++){let Ae=Ee[Ie];oa(Ae,j,O,Z),Y.add(Ae)}else oa(Ee,j,O,Z),Y.add(Ee)}),E=T.pop(),z!==null&&z.renderEnd(),Y},this.compileAsync=function(M,O,j=null){let Y=this.compile(M,O,j);return new Promise(Z=>{function Ee(){if(Y.forEach(function(Ie){let De=Ge.get(Ie).currentProgram;(De===void 0||De.isReady())&&Y.delete(Ie)}),Y.size===0){Z(M);return}setTimeout(Ee,10)}Je.get("KHR_parallel_shader_compile")!==null?Ee():setTimeout(Ee,10)})};let Zr=null;function Ku(M){Zr&&Zr(M)}function Ol(){ys.stop()}function es(){ys.start()}let ys=new W0;ys.setAnimationLoop(Ku),typeof self<"u"&&ys.setContext(self),this.setAnimationLoop=function(M){Zr=M,ce.setAnimationLoop(M),M===null?ys.stop():ys.start()},ce.addEventListener("sessionstart",Ol),ce.addEventListener("sessionend",es),this.render=function(M,O){if(O!==void 0&&O.isCamera!==!0){it("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(L===!0)return;z!==null&&z.renderStart(M,O);let j=ce.enabled===!0&&ce.isPresenting===!0,Y=k!==null&&(he===null||j)&&k.begin(N,he);if(M.matrixWorldAutoUpdate===!0&&M.updateMatrixWorld(),O.parent===null&&O.matrixWorldAutoUpdate===!0&&O.updateMatrixWorld(),ce.enabled===!0&&ce.isPresenting===!0&&(k===null||k.isCompositing()===!1)&&(ce.cameraAutoUpdate===!0&&ce.updateCamera(O),O=ce.getCamera()),M.isScene===!0&&M.onBeforeRender(N,M,O,he),E=ne.get(M,T.length),E.init(O),E.state.textureUnits=Ze.getTextureUnits(),T.push(E),Bt.multiplyMatrices(O.projectionMatrix,O.matrixWorldInverse),O.isArrayCamera?Qt.setFromArrayCamera(O):ot.setFromProjectionMatrix(Bt,Di,O.reversedDepth),pn=this.localClippingEnabled,Ht=se.init(this.clippingPlanes,pn),P=ve.get(M,x.length),P.init(),x.push(P),this.info.render.frame++,ce.enabled===!0&&ce.isPresenting===!0){let Ie=N.xr.getDepthSensingMesh();Ie!==null&&vs(Ie,O,-1/0,N.sortObjects)}vs(M,O,0,N.sortObjects),P.finish(),z!==null&&z.updateLights(E.state.lightsArray),N.sortObjects===!0&&P.sort(Xe,lt),sn=ce.enabled===!1||ce.isPresenting===!1||ce.hasDepthSensing()===!1,sn&&U.addToRenderList(P,M),this.info.autoReset===!0&&this.info.reset(),Ht===!0&&se.beginShadows();let Z=E.state.shadowsArray;if(me.render(Z,M,O),Ht===!0&&se.endShadows(),(Y&&k.hasRenderPass())===!1){let Ie=P.opaque,Ae=P.transmissive;if(E.setupLights(),O.isArrayCamera){let De=O.cameras;if(Ae.length>0)for(let Ve=0,rt=De.length;Ve<rt;Ve++){let gt=De[Ve];Ui(Ie,Ae,M,gt)}sn&&U.render(M);for(let Ve=0,rt=De.length;Ve<rt;Ve++){let gt=De[Ve];aa(P,M,gt,gt.viewport)}}else Ae.length>0&&Ui(Ie,Ae,M,O),sn&&U.render(M),aa(P,M,O)}he!==null&&H===0&&(Ze.updateMultisampleRenderTarget(he),Ze.updateRenderTargetMipmap(he)),Y&&k.end(N),M.isScene===!0&&M.onAfterRender(N,M,O),be.resetDefaultState(),J=-1,Q=null,T.pop(),T.length>0?(E=T[T.length-1],Ze.setTextureUnits(E.state.textureUnits),Ht===!0&&se.setGlobalState(N.clippingPlanes,E.state.camera)):E=null,x.pop(),x.length>0?P=x[x.length-1]:P=null,z!==null&&z.renderEnd()};function vs(M,O,j,Y){if(M.visible===!1)return;if(M.layers.test(O.layers)){if(M.isGroup)j=M.renderOrder;else if(M.isLOD)M.autoUpdate===!0&&M.update(O);else if(M.isLight)E.pushLight(M),M.castShadow&&E.pushShadow(M);else if(M.isSprite){let Ie=O.isArrayCamera?Qt:ot;if(!M.frustumCulled||M.intersectsFrustum(Ie)){Y&&wt.setFromMatrixPosition(M.matrixWorld).applyMatrix4(Bt);let Ae=ue.update(M),De=M.material;De.visible&&P.push(M,Ae,De,j,wt.z,null,O)}}else if(M.isMesh||M.isLine||M.isPoints){let Ie=O.isArrayCamera?Qt:ot;if(!M.frustumCulled||M.intersectsFrustum(Ie)){let Ae=ue.update(M),De=M.material;if(Y&&(M.boundingSphere!==void 0?(M.boundingSphere===null&&M.computeBoundingSphere(),wt.copy(M.boundingSphere.center)):(Ae.boundingSphere===null&&Ae.computeBoundingSphere(),wt.copy(Ae.boundingSphere.center)),wt.applyMatrix4(M.matrixWorld).applyMatrix4(Bt)),Array.isArray(De)){let Ve=Ae.groups;for(let rt=0,gt=Ve.length;rt<gt;rt++){let ze=Ve[rt],_t=De[ze.materialIndex];_t&&_t.visible&&P.push(M,Ae,_t,j,wt.z,ze,O)}}else De.visible&&P.push(M,Ae,De,j,wt.z,null,O)}}}let Ee=M.children;for(let Ie=0,Ae=Ee.length;Ie<Ae;Ie++)vs(Ee[Ie],O,j,Y)}function aa(M,O,j,Y){let{opaque:Z,transmissive:Ee,transparent:Ie}=M;E.setupLightsView(j),Ht===!0&&se.setGlobalState(N.clippingPlanes,j),Y&&we.viewport(re.copy(Y)),Z.length>0&&rn(Z,O,j),Ee.length>0&&rn(Ee,O,j),Ie.length>0&&rn(Ie,O,j),we.buffers.depth.setTest(!0),we.buffers.depth.setMask(!0),we.buffers.color.setMask(!0),we.setPolygonOffset(!1)}function Ui(M,O,j,Y){if((j.isScene===!0?j.overrideMaterial:null)!==null)return;if(E.state.transmissionRenderTarget[Y.id]===void 0){let ze=Je.has("EXT_color_buffer_half_float")||Je.has("EXT_color_buffer_float");E.state.transmissionRenderTarget[Y.id]=new bi(1,1,{generateMipmaps:!0,type:ze?$i:hi,minFilter:Os,samples:Math.max(4,ct.samples),stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:bt.workingColorSpace})}let Ee=E.state.transmissionRenderTarget[Y.id],Ie=Y.viewport||re;Ee.setSize(Ie.z*N.transmissionResolutionScale,Ie.w*N.transmissionResolutionScale);let Ae=N.getRenderTarget(),De=N.getActiveCubeFace(),Ve=N.getActiveMipmapLevel();N.setRenderTarget(Ee),N.getClearColor(te),ge=N.getClearAlpha(),ge<1&&N.setClearColor(16777215,.5),N.clear(),sn&&U.render(j);let rt=N.toneMapping;N.toneMapping=ms;let gt=Y.viewport;if(Y.viewport!==void 0&&(Y.viewport=void 0),E.setupLightsView(Y),Ht===!0&&se.setGlobalState(N.clippingPlanes,Y),rn(M,j,Y),Ze.updateMultisampleRenderTarget(Ee),Ze.updateRenderTargetMipmap(Ee),Je.has("WEBGL_multisampled_render_to_texture")===!1){let ze=!1;for(let _t=0,nn=O.length;_t<nn;_t++){let Ut=O[_t],{object:Ft,geometry:wn,material:Fe,group:gn}=Ut;if(Fe.side===oi&&Ft.layers.test(Y.layers)){let vt=Fe.side;Fe.side=ri,Fe.needsUpdate=!0,dn(Ft,j,Y,wn,Fe,gn),Fe.side=vt,Fe.needsUpdate=!0,ze=!0}}ze===!0&&(Ze.updateMultisampleRenderTarget(Ee),Ze.updateRenderTargetMipmap(Ee))}N.setRenderTarget(Ae,De,Ve),N.setClearColor(te,ge),gt!==void 0&&(Y.viewport=gt),N.toneMapping=rt}function rn(M,O,j){let Y=O.isScene===!0?O.overrideMaterial:null;for(let Z=0,Ee=M.length;Z<Ee;Z++){let Ie=M[Z],{object:Ae,geometry:De,group:Ve}=Ie,rt=Ie.material;rt.allowOverride===!0&&Y!==null&&(rt=Y),Ae.layers.test(j.layers)&&dn(Ae,O,j,De,rt,Ve)}}function dn(M,O,j,Y,Z,Ee){z!==null&&Z.isNodeMaterial&&z.setObject(M,Z),M.onBeforeRender(N,O,j,Y,Z,Ee),M.modelViewMatrix.multiplyMatrices(j.matrixWorldInverse,M.matrixWorld),M.normalMatrix.getNormalMatrix(M.modelViewMatrix),Z.onBeforeRender(N,O,j,Y,M,Ee),Z.transparent===!0&&Z.side===oi&&Z.forceSinglePass===!1?(Z.side=ri,Z.needsUpdate=!0,N.renderBufferDirect(j,O,Y,Z,M,Ee),Z.side=pr,Z.needsUpdate=!0,N.renderBufferDirect(j,O,Y,Z,M,Ee),Z.side=oi):N.renderBufferDirect(j,O,Y,Z,M,Ee),M.onAfterRender(N,O,j,Y,Z,Ee)}function fn(M){let O=0;for(let j of M)j.texture!==null&&O++;return O}function ts(M,O,j){O.isScene!==!0&&(O=Mn);let Y=Ge.get(M),Z=E.state.lights,Ee=E.state.shadowsArray,Ie=Z.state.version,Ae=ae.getParameters(M,Z.state,Ee,O,j,E.state.lightProbeGridArray),De=ae.getProgramCacheKey(Ae),Ve=Y.programs;Y.environment=M.isMeshStandardMaterial||M.isMeshLambertMaterial||M.isMeshPhongMaterial?O.environment:null,Y.fog=O.fog;let rt=M.isMeshStandardMaterial||M.isMeshLambertMaterial&&!M.envMap||M.isMeshPhongMaterial&&!M.envMap;Y.envMap=A.get(M.envMap||Y.environment,rt),Y.envMapRotation=Y.environment!==null&&M.envMap===null?O.environmentRotation:M.envMapRotation,Ve===void 0&&(M.addEventListener("dispose",ht),Ve=new Map,Y.programs=Ve,Y.programVariants=new Map);let gt=Ve.get(De);if(gt!==void 0){if(Y.currentProgram===gt&&Y.lightsStateVersion===Ie)return la(M,Ae),gt}else Ae.uniforms=ae.getUniforms(M),z!==null&&M.isNodeMaterial&&z.build(M,j,Ae),M.onBeforeCompile(Ae,N),gt=ae.acquireProgram(Ae,De),Ve.set(De,gt),Y.uniforms=Ae.uniforms;let ze=Y.uniforms;return(!M.isShaderMaterial&&!M.isRawShaderMaterial||M.clipping===!0)&&(ze.clippingPlanes=se.uniform),la(M,Ae),Y.needsLights=qs(M),Y.lightsStateVersion=Ie,Y.needsLights&&(ze.ambientLightColor.value=Z.state.ambient,ze.lightProbe.value=Z.state.probe,ze.sunLights.value=Z.state.sun,ze.sunLightShadows.value=Z.state.sunShadow,ze.directionalLights.value=Z.state.directional,ze.directionalLightShadows.value=Z.state.directionalShadow,ze.spotLights.value=Z.state.spot,ze.spotLightShadows.value=Z.state.spotShadow,ze.rectAreaLights.value=Z.state.rectArea,ze.ltc_1.value=Z.state.rectAreaLTC1,ze.ltc_2.value=Z.state.rectAreaLTC2,ze.pointLights.value=Z.state.point,ze.pointLightShadows.value=Z.state.pointShadow,ze.hemisphereLights.value=Z.state.hemi,ze.sunShadowMatrix.value=Z.state.sunShadowMatrix,ze.sunShadowCascade.value=Z.state.sunShadowCascade,ze.directionalShadowMatrix.value=Z.state.directionalShadowMatrix,ze.spotLightMatrix.value=Z.state.spotLightMatrix,ze.spotLightMap.value=Z.state.spotLightMap,ze.pointShadowMatrix.value=Z.state.pointShadowMatrix),Y.numLightProbeGrids=fn(E.state.lightProbeGridArray),Y.currentProgram=gt,Y.uniformsList=null,gt}function di(M,O,j,Y,Z){let Ee=Ge.get(M),Ie=Ee.currentProgram.id+","+Y+","+Z,Ae=Ee.programVariants.get(Ie);return Ae===void 0?(Ae=ts(M,O,j),Ee.programVariants.set(Ie,Ae)):(Ee.currentProgram=Ae,Ee.uniformsList=null,Ee.outputColorSpace=Y,Ee.toneMapping=Z),Ae}function Xs(M){if(M.uniformsList===null){let O=M.currentProgram.getUniforms();M.uniformsList=Xo.seqWithValue(O.seq,M.uniforms)}return M.uniformsList}function la(M,O){let j=Ge.get(M);j.outputColorSpace=O.outputColorSpace,j.batching=O.batching,j.batchingColor=O.batchingColor,j.instancing=O.instancing,j.instancingColor=O.instancingColor,j.instancingMorph=O.instancingMorph,j.skinning=O.skinning,j.morphTargets=O.morphTargets,j.morphNormals=O.morphNormals,j.morphColors=O.morphColors,j.morphTargetsCount=O.morphTargetsCount,j.numClippingPlanes=O.numClippingPlanes,j.numIntersection=O.numClipIntersection,j.vertexAlphas=O.vertexAlphas,j.vertexTangents=O.vertexTangents,j.toneMapping=O.toneMapping}function ca(M,O,j,Y,Z){O.isScene!==!0&&(O=Mn),Ze.resetTextureUnits();let Ee=O.fog,Ie=Y.isMeshStandardMaterial||Y.isMeshLambertMaterial||Y.isMeshPhongMaterial?O.environment:null,Ae=he===null?N.outputColorSpace:he.isXRRenderTarget===!0?he.texture.colorSpace:bt.workingColorSpace,De=Y.isMeshStandardMaterial||Y.isMeshLambertMaterial&&!Y.envMap||Y.isMeshPhongMaterial&&!Y.envMap,Ve=A.get(Y.envMap||Ie,De),rt=Y.vertexColors===!0&&!!j.attributes.color&&j.attributes.color.itemSize===4,gt=!!j.attributes.tangent&&(!!Y.normalMap||Y.anisotropy>0),ze=!!j.morphAttributes.position,_t=!!j.morphAttributes.normal,nn=!!j.morphAttributes.color,Ut=ms;Y.toneMapped&&(he===null||he.isXRRenderTarget===!0)&&(Ut=N.toneMapping);let Ft=j.morphAttributes.position||j.morphAttributes.normal||j.morphAttributes.color,wn=Ft!==void 0?Ft.length:0,Fe=Ge.get(Y),gn=E.state.lights;if(Ht===!0&&(pn===!0||M!==Q)){let Ot=M===Q&&Y.id===J;se.setState(Y,M,Ot)}let vt=!1,Ss=!1;Y.version===Fe.__version?Fe.needsLights&&Fe.lightsStateVersion!==gn.state.version||Z.isBatchedMesh&&Fe.batching===!1||!Z.isBatchedMesh&&Fe.batching===!0||Z.isBatchedMesh&&Fe.batchingColor===!0&&Z._colorsTexture===null||Z.isBatchedMesh&&Fe.batchingColor===!1&&Z._colorsTexture!==null||Z.isInstancedMesh&&Fe.instancing===!1||!Z.isInstancedMesh&&Fe.instancing===!0||Z.isSkinnedMesh&&Fe.skinning===!1||!Z.isSkinnedMesh&&Fe.skinning===!0||Z.isInstancedMesh&&Fe.instancingColor===!0&&Z.instanceColor===null||Z.isInstancedMesh&&Fe.instancingColor===!1&&Z.instanceColor!==null||Z.isInstancedMesh&&Fe.instancingMorph===!0&&Z.morphTexture===null||Z.isInstancedMesh&&Fe.instancingMorph===!1&&Z.morphTexture!==null||Fe.envMap!==Ve||Y.fog===!0&&Fe.fog!==Ee||Fe.numClippingPlanes!==void 0&&(Fe.numClippingPlanes!==se.numPlanes||Fe.numIntersection!==se.numIntersection)||Fe.vertexAlphas!==rt||Fe.vertexTangents!==gt||Fe.morphTargets!==ze||Fe.morphNormals!==_t||Fe.morphColors!==nn||Fe.morphTargetsCount!==wn||Fe.numLightProbeGrids!==fn(E.state.lightProbeGridArray)?vt=!0:(Fe.outputColorSpace!==Ae||Fe.toneMapping!==Ut)&&(Ss=!0):(vt=!0,Fe.__version=Y.version);let _n=Fe.currentProgram;(vt===!0||Ss===!0)&&(_n=Ss===!0?di(Y,O,Z,Ae,Ut):ts(Y,O,Z),z&&Y.isNodeMaterial&&z.onUpdateProgram(Y,_n,Fe));let jr=!1,ns=!1,bs=!1,dt=_n.getUniforms(),on=Fe.uniforms;if(we.useProgram(_n.program)&&(jr=!0,ns=!0,bs=!0),Y.id!==J&&(J=Y.id,ns=!0),jr||Q!==M){we.buffers.depth.getReversed()&&M.reversedDepth!==!0&&(M._reversedDepth=!0,M.updateProjectionMatrix()),dt.setValue(F,"projectionMatrix",M.projectionMatrix),dt.setValue(F,"viewMatrix",M.matrixWorldInverse);let xn=dt.map.cameraPosition;xn!==void 0&&xn.setValue(F,Dn.setFromMatrixPosition(M.matrixWorld)),ct.logarithmicDepthBuffer&&dt.setValue(F,"logDepthBufFC",2/(Math.log(M.far+1)/Math.LN2)),(Y.isMeshPhongMaterial||Y.isMeshToonMaterial||Y.isMeshLambertMaterial||Y.isMeshBasicMaterial||Y.isMeshStandardMaterial||Y.isShaderMaterial)&&dt.setValue(F,"isOrthographic",M.isOrthographicCamera===!0),Q!==M&&(Q=M,ns=!0,bs=!0)}if(Fe.needsLights&&(gn.state.sunShadowMap.length>0&&dt.setValue(F,"sunShadowMap",gn.state.sunShadowMap,Ze),gn.state.directionalShadowMap.length>0&&dt.setValue(F,"directionalShadowMap",gn.state.directionalShadowMap,Ze),gn.state.spotShadowMap.length>0&&dt.setValue(F,"spotShadowMap",gn.state.spotShadowMap,Ze),gn.state.pointShadowMap.length>0&&dt.setValue(F,"pointShadowMap",gn.state.pointShadowMap,Ze)),Z.isSkinnedMesh){dt.setOptional(F,Z,"bindMatrix"),dt.setOptional(F,Z,"bindMatrixInverse");let Ot=Z.skeleton;Ot&&(Ot.boneTexture===null&&Ot.computeBoneTexture(),dt.setValue(F,"boneTexture",Ot.boneTexture,Ze))}Z.isBatchedMesh&&(dt.setOptional(F,Z,"batchingTexture"),dt.setValue(F,"batchingTexture",Z._matricesTexture,Ze),dt.setOptional(F,Z,"batchingIdTexture"),dt.setValue(F,"batchingIdTexture",Z._indirectTexture,Ze),dt.setOptional(F,Z,"batchingColorTexture"),Z._colorsTexture!==null&&dt.setValue(F,"batchingColorTexture",Z._colorsTexture,Ze));let Kn=j.morphAttributes;if((Kn.position!==void 0||Kn.normal!==void 0||Kn.color!==void 0)&&oe.update(Z,j,_n),(ns||Fe.receiveShadow!==Z.receiveShadow)&&(Fe.receiveShadow=Z.receiveShadow,dt.setValue(F,"receiveShadow",Z.receiveShadow)),(Y.isMeshStandardMaterial||Y.isMeshLambertMaterial||Y.isMeshPhongMaterial)&&Y.envMap===null&&O.environment!==null&&(on.envMapIntensity.value=O.environmentIntensity),on.dfgLUT!==void 0&&(on.dfgLUT.value=OE()),ns){if(dt.setValue(F,"toneMappingExposure",N.toneMappingExposure),Fe.needsLights&&Kr(on,bs),Ee&&Y.fog===!0&&xe.refreshFogUniforms(on,Ee),xe.refreshMaterialUniforms(on,Y,Me,Ce,E.state.transmissionRenderTarget[M.id]),Fe.needsLights&&Fe.numLightProbeGrids>0){let Ot=w,xn=0;for(let Xn of E.state.lightProbeGridArray)Xn.texture!==null&&(Ot.textures[xn]=Xn.texture,Ot.min[xn]=Xn.boundingBox.min,Ot.max[xn]=Xn.boundingBox.max,Ot.resolution[xn]=Xn.resolution,xn++);for(let Xn in Ot)Ot[Xn].length=xn;on.probesSH.value=Ot.textures,on.probesMin.value=Ot.min,on.probesMax.value=Ot.max,on.probesResolution.value=Ot.resolution}Xo.upload(F,Xs(Fe),on,Ze)}if(Y.isShaderMaterial&&Y.uniformsNeedUpdate===!0&&(Xo.upload(F,Xs(Fe),on,Ze),Y.uniformsNeedUpdate=!1),Y.isSpriteMaterial&&dt.setValue(F,"center",Z.center),dt.setValue(F,"modelViewMatrix",Z.modelViewMatrix),dt.setValue(F,"normalMatrix",Z.normalMatrix),dt.setValue(F,"modelMatrix",Z.matrixWorld),Y.uniformsGroups!==void 0){let Ot=Y.uniformsGroups;for(let xn=0,Xn=Ot.length;xn<Xn;xn++){let Bl=Ot[xn];We.update(Bl,_n),We.bind(Bl,_n)}}return _n}function Kr(M,O){M.ambientLightColor.needsUpdate=O,M.lightProbe.needsUpdate=O,M.sunLights.needsUpdate=O,M.sunLightShadows.needsUpdate=O,M.directionalLights.needsUpdate=O,M.directionalLightShadows.needsUpdate=O,M.pointLights.needsUpdate=O,M.pointLightShadows.needsUpdate=O,M.spotLights.needsUpdate=O,M.spotLightShadows.needsUpdate=O,M.rectAreaLights.needsUpdate=O,M.hemisphereLights.needsUpdate=O}function qs(M){return M.isMeshLambertMaterial||M.isMeshToonMaterial||M.isMeshPhongMaterial||M.isMeshStandardMaterial||M.isShadowMaterial||M.isShaderMaterial&&M.lights===!0}this.getActiveCubeFace=function(){return $},this.getActiveMipmapLevel=function(){return H},this.getRenderTarget=function(){return he},this.setRenderTargetTextures=function(M,O,j){let Y=Ge.get(M);Y.__autoAllocateDepthBuffer=M.resolveDepthBuffer===!1,Y.__autoAllocateDepthBuffer===!1&&(Y.__useRenderToTexture=!1),Ge.get(M.texture).__webglTexture=O,Ge.get(M.depthTexture).__webglTexture=Y.__autoAllocateDepthBuffer?void 0:j,Y.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(M,O){let j=Ge.get(M);j.__webglFramebuffer=O,j.__useDefaultFramebuffer=O===void 0},this.setRenderTarget=function(M,O=0,j=0){he=M,$=O,H=j;let Y=null,Z=!1,Ee=!1;if(M){let Ae=Ge.get(M);if(Ae.__useDefaultFramebuffer!==void 0){we.bindFramebuffer(F.FRAMEBUFFER,Ae.__webglFramebuffer),re.copy(M.viewport),fe.copy(M.scissor),de=M.scissorTest,we.viewport(re),we.scissor(fe),we.setScissorTest(de),J=-1;return}else if(Ae.__webglFramebuffer===void 0)Ze.setupRenderTarget(M);else if(Ae.__hasExternalTextures)Ze.rebindTextures(M,Ge.get(M.texture).__webglTexture,Ge.get(M.depthTexture).__webglTexture);else if(M.depthBuffer){let rt=M.depthTexture;if(Ae.__boundDepthTexture!==rt){if(rt!==null&&Ge.has(rt)&&(M.width!==rt.image.width||M.height!==rt.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");Ze.setupDepthRenderbuffer(M)}}let De=M.texture;(De.isData3DTexture||De.isDataArrayTexture||De.isCompressedArrayTexture)&&(Ee=!0);let Ve=Ge.get(M).__webglFramebuffer;M.isWebGLCubeRenderTarget?(Array.isArray(Ve[O])?Y=Ve[O][j]:Y=Ve[O],Z=!0):M.samples>0&&Ze.useMultisampledRTT(M)===!1?Y=Ge.get(M).__webglMultisampledFramebuffer:Array.isArray(Ve)?Y=Ve[j]:Y=Ve,re.copy(M.viewport),fe.copy(M.scissor),de=M.scissorTest}else re.copy(He).multiplyScalar(Me).floor(),fe.copy(mt).multiplyScalar(Me).floor(),de=ut;if(j!==0&&(Y=W),we.bindFramebuffer(F.FRAMEBUFFER,Y)&&we.drawBuffers(M,Y),we.viewport(re),we.scissor(fe),we.setScissorTest(de),Z){let Ae=Ge.get(M.texture);F.framebufferTexture2D(F.FRAMEBUFFER,F.COLOR_ATTACHMENT0,F.TEXTURE_CUBE_MAP_POSITIVE_X+O,Ae.__webglTexture,j)}else if(Ee){let Ae=O;for(let De=0;De<M.textures.length;De++){let Ve=Ge.get(M.textures[De]);F.framebufferTextureLayer(F.FRAMEBUFFER,F.COLOR_ATTACHMENT0+De,Ve.__webglTexture,j,Ae)}}else if(M!==null&&j!==0){let Ae=Ge.get(M.texture);F.framebufferTexture2D(F.FRAMEBUFFER,F.COLOR_ATTACHMENT0,F.TEXTURE_2D,Ae.__webglTexture,j)}J=-1};function Jr(M){let O=Ge.get(M);return(O.__readFormat!==M.format||O.__readType!==M.type)&&(O.__readFormat=M.format,O.__readType=M.type,O.__formatReadable=ct.textureFormatReadable(M.format),O.__typeReadable=ct.textureTypeReadable(M.type)),O}this.readRenderTargetPixels=function(M,O,j,Y,Z,Ee,Ie,Ae=0){if(!(M&&M.isWebGLRenderTarget)){it("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let De=Ge.get(M).__webglFramebuffer;if(M.isWebGLCubeRenderTarget&&Ie!==void 0&&(De=De[Ie],Array.isArray(De)&&(De=De[0])),De){we.bindFramebuffer(F.FRAMEBUFFER,De);try{let Ve=M.textures[Ae],rt=Ve.format,gt=Ve.type;M.textures.length>1&&F.readBuffer(F.COLOR_ATTACHMENT0+Ae);let ze=Jr(Ve);if(ze.__formatReadable===!1){it("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(ze.__typeReadable===!1){it("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}O>=0&&O<=M.width-Y&&j>=0&&j<=M.height-Z&&F.readPixels(O,j,Y,Z,_e.convert(rt),_e.convert(gt),Ee)}finally{let Ve=he!==null?Ge.get(he).__webglFramebuffer:null;we.bindFramebuffer(F.FRAMEBUFFER,Ve)}}},this.readRenderTargetPixelsAsync=async function(M,O,j,Y,Z,Ee,Ie,Ae=0){if(!(M&&M.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let De=Ge.get(M).__webglFramebuffer;if(M.isWebGLCubeRenderTarget&&Ie!==void 0&&(De=De[Ie],Array.isArray(De)&&(De=De[0])),De)if(O>=0&&O<=M.width-Y&&j>=0&&j<=M.height-Z){we.bindFramebuffer(F.FRAMEBUFFER,De);let Ve=M.textures[Ae],rt=Ve.format,gt=Ve.type;M.textures.length>1&&F.readBuffer(F.COLOR_ATTACHMENT0+Ae);let ze=Jr(Ve);if(ze.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(ze.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let _t=F.createBuffer();F.bindBuffer(F.PIXEL_PACK_BUFFER,_t),F.bufferData(F.PIXEL_PACK_BUFFER,Ee.byteLength,F.STREAM_READ),F.readPixels(O,j,Y,Z,_e.convert(rt),_e.convert(gt),0),F.bindBuffer(F.PIXEL_PACK_BUFFER,null);let nn=he!==null?Ge.get(he).__webglFramebuffer:null;we.bindFramebuffer(F.FRAMEBUFFER,nn);let Ut=F.fenceSync(F.SYNC_GPU_COMMANDS_COMPLETE,0);return F.flush(),await g0(F,Ut,4),F.bindBuffer(F.PIXEL_PACK_BUFFER,_t),F.getBufferSubData(F.PIXEL_PACK_BUFFER,0,Ee),F.bindBuffer(F.PIXEL_PACK_BUFFER,null),F.deleteBuffer(_t),F.deleteSync(Ut),Ee}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(M,O=null,j=0){let Y=Math.pow(2,-j),Z=Math.floor(M.image.width*Y),Ee=Math.floor(M.image.height*Y),Ie=O!==null?O.x:0,Ae=O!==null?O.y:0;Ze.setTexture2D(M,0),F.copyTexSubImage2D(F.TEXTURE_2D,j,0,0,Ie,Ae,Z,Ee),we.unbindTexture()},this.copyTextureToTexture=function(M,O,j=null,Y=null,Z=0,Ee=0){let Ie,Ae,De,Ve,rt,gt,ze,_t,nn,Ut=M.isCompressedTexture?M.mipmaps[Ee]:M.image;if(j!==null)Ie=j.max.x-j.min.x,Ae=j.max.y-j.min.y,De=j.isBox3?j.max.z-j.min.z:1,Ve=j.min.x,rt=j.min.y,gt=j.isBox3?j.min.z:0;else{let dt=Math.pow(2,-Z);Ie=Math.floor(Ut.width*dt),Ae=Math.floor(Ut.height*dt),M.isDataArrayTexture?De=Ut.depth:M.isData3DTexture?De=Math.floor(Ut.depth*dt):De=1,Ve=0,rt=0,gt=0}Y!==null?(ze=Y.x,_t=Y.y,nn=Y.z):(ze=0,_t=0,nn=0);let Ft=_e.convert(O.format),wn=_e.convert(O.type),Fe;O.isData3DTexture?(Ze.setTexture3D(O,0),Fe=F.TEXTURE_3D):O.isDataArrayTexture||O.isCompressedArrayTexture?(Ze.setTexture2DArray(O,0),Fe=F.TEXTURE_2D_ARRAY):(Ze.setTexture2D(O,0),Fe=F.TEXTURE_2D),we.activeTexture(F.TEXTURE0),we.pixelStorei(F.UNPACK_FLIP_Y_WEBGL,O.flipY),we.pixelStorei(F.UNPACK_PREMULTIPLY_ALPHA_WEBGL,O.premultiplyAlpha),we.pixelStorei(F.UNPACK_ALIGNMENT,O.unpackAlignment);let gn=we.getParameter(F.UNPACK_ROW_LENGTH),vt=we.getParameter(F.UNPACK_IMAGE_HEIGHT),Ss=we.getParameter(F.UNPACK_SKIP_PIXELS),_n=we.getParameter(F.UNPACK_SKIP_ROWS),jr=we.getParameter(F.UNPACK_SKIP_IMAGES);we.pixelStorei(F.UNPACK_ROW_LENGTH,Ut.width),we.pixelStorei(F.UNPACK_IMAGE_HEIGHT,Ut.height),we.pixelStorei(F.UNPACK_SKIP_PIXELS,Ve),we.pixelStorei(F.UNPACK_SKIP_ROWS,rt),we.pixelStorei(F.UNPACK_SKIP_IMAGES,gt);let ns=M.isDataArrayTexture||M.isData3DTexture,bs=O.isDataArrayTexture||O.isData3DTexture;if(M.isDepthTexture){let dt=Ge.get(M),on=Ge.get(O),Kn=Ge.get(dt.__renderTarget),Ot=Ge.get(on.__renderTarget);we.bindFramebuffer(F.READ_FRAMEBUFFER,Kn.__webglFramebuffer),we.bindFramebuffer(F.DRAW_FRAMEBUFFER,Ot.__webglFramebuffer);for(let xn=0;xn<De;xn++)ns&&(F.framebufferTextureLayer(F.READ_FRAMEBUFFER,F.COLOR_ATTACHMENT0,Ge.get(M).__webglTexture,Z,gt+xn),F.framebufferTextureLayer(F.DRAW_FRAMEBUFFER,F.COLOR_ATTACHMENT0,Ge.get(O).__webglTexture,Ee,nn+xn)),F.blitFramebuffer(Ve,rt,Ve+Ie,rt+Ae,ze,_t,ze+Ie,_t+Ae,F.DEPTH_BUFFER_BIT,F.NEAREST);we.bindFramebuffer(F.READ_FRAMEBUFFER,null),we.bindFramebuffer(F.DRAW_FRAMEBUFFER,null)}else if(Z!==0||M.isRenderTargetTexture||Ge.has(M)){let dt=Ge.get(M),on=Ge.get(O);we.bindFramebuffer(F.READ_FRAMEBUFFER,D),we.bindFramebuffer(F.DRAW_FRAMEBUFFER,X);for(let Kn=0;Kn<De;Kn++)ns?F.framebufferTextureLayer(F.READ_FRAMEBUFFER,F.COLOR_ATTACHMENT0,dt.__webglTexture,Z,gt+Kn):F.framebufferTexture2D(F.READ_FRAMEBUFFER,F.COLOR_ATTACHMENT0,F.TEXTURE_2D,dt.__webglTexture,Z),bs?F.framebufferTextureLayer(F.DRAW_FRAMEBUFFER,F.COLOR_ATTACHMENT0,on.__webglTexture,Ee,nn+Kn):F.framebufferTexture2D(F.DRAW_FRAMEBUFFER,F.COLOR_ATTACHMENT0,F.TEXTURE_2D,on.__webglTexture,Ee),Z!==0?F.blitFramebuffer(Ve,rt,Ve+Ie,rt+Ae,ze,_t,ze+Ie,_t+Ae,F.COLOR_BUFFER_BIT,F.NEAREST):bs?F.copyTexSubImage3D(Fe,Ee,ze,_t,nn+Kn,Ve,rt,Ie,Ae):F.copyTexSubImage2D(Fe,Ee,ze,_t,Ve,rt,Ie,Ae);we.bindFramebuffer(F.READ_FRAMEBUFFER,null),we.bindFramebuffer(F.DRAW_FRAMEBUFFER,null)}else bs?M.isDataTexture||M.isData3DTexture?F.texSubImage3D(Fe,Ee,ze,_t,nn,Ie,Ae,De,Ft,wn,Ut.data):O.isCompressedArrayTexture?F.compressedTexSubImage3D(Fe,Ee,ze,_t,nn,Ie,Ae,De,Ft,Ut.data):F.texSubImage3D(Fe,Ee,ze,_t,nn,Ie,Ae,De,Ft,wn,Ut):M.isDataTexture?F.texSubImage2D(F.TEXTURE_2D,Ee,ze,_t,Ie,Ae,Ft,wn,Ut.data):M.isCompressedTexture?F.compressedTexSubImage2D(F.TEXTURE_2D,Ee,ze,_t,Ut.width,Ut.height,Ft,Ut.data):F.texSubImage2D(F.TEXTURE_2D,Ee,ze,_t,Ie,Ae,Ft,wn,Ut);we.pixelStorei(F.UNPACK_ROW_LENGTH,gn),we.pixelStorei(F.UNPACK_IMAGE_HEIGHT,vt),we.pixelStorei(F.UNPACK_SKIP_PIXELS,Ss),we.pixelStorei(F.UNPACK_SKIP_ROWS,_n),we.pixelStorei(F.UNPACK_SKIP_IMAGES,jr),Ee===0&&O.generateMipmaps===!0&&O.mipmapsAutoUpdate===!0&&F.generateMipmap(Fe),we.unbindTexture()},this.initRenderTarget=function(M){Ge.get(M).__webglFramebuffer===void 0&&Ze.setupRenderTarget(M)},this.initTexture=function(M){M.isCubeTexture?Ze.setTextureCube(M,0):M.isData3DTexture?Ze.setTexture3D(M,0):M.isDataArrayTexture||M.isCompressedArrayTexture?Ze.setTexture2DArray(M,0):Ze.setTexture2D(M,0),we.unbindTexture()},this.resetState=function(){$=0,H=0,he=null,we.reset(),be.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return Di}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(e){this._outputColorSpace=e;let t=this.getContext();t.drawingBufferColorSpace=bt._getDrawingBufferColorSpace(e),t.unpackColorSpace=bt._getUnpackColorSpace()}};var t_=12,n_=8,Yo=48;function mu({centre:n,radius:e}){return{centre:n,axes:[e,0,0,0,e,0,0,0,e]}}function sp({centre:n,axes:e},t,i){let s=[];for(let[o,a]of BE())for(let l of[o,a])for(let c=0;c<3;c++){let h=n[c]??0;for(let u=0;u<3;u++)h+=(e[3*c+u]??0)*(l[u]??0);s.push(h)}let r=new Xt;return r.setAttribute("position",new hn(Float32Array.from(s),3)),new fs(r,new Xi({color:t,opacity:i,transparent:!0,depthWrite:!1}))}function i_({centre:n,axes:e},t){let[i,s]=t,r=(c,h)=>[0,1,2].reduce((u,d)=>u+(e[3*c+d]??0)*(e[3*h+d]??0),0),o=Math.sqrt(r(i,i)),a=o>0?r(i,s)/o:0,l=Math.sqrt(Math.max(0,r(s,s)-a*a));return Array.from({length:2*Yo+1},(c,h)=>{let[u,d]=[Math.cos(Math.PI*h/Yo),Math.sin(Math.PI*h/Yo)];return[(n[i]??0)+o*u,(n[s]??0)+a*u+l*d]})}function*BE(){let n=(t,i)=>[Math.cos(t)*Math.cos(i),Math.cos(t)*Math.sin(i),Math.sin(t)],e=2*Math.PI/Yo;for(let t=0;t<t_/2;t++){let i=2*Math.PI*t/t_;for(let s=0;s<Yo;s++)yield[n(e*s,i),n(e*(s+1),i)]}for(let t=1;t<n_;t++){let i=-Math.PI/2+Math.PI*t/n_;for(let s=0;s<Yo;s++)yield[n(i,e*s),n(i,e*(s+1))]}}var rp={left:32,right:6,top:5,bottom:16},kE=10,zE="11px system-ui, 'DejaVu Sans', sans-serif",gu=class{constructor(e,t,i,s,r,o){this.panel=e;this.plane=t;this.frames=i;this.data=s;this.maker=r;this.store=o;let[a,l]=t;this.canvas=ee("canvas",{role:"img","aria-label":`Plane ${"xyz"[a]??""}-${"xyz"[l]??""} of the force or moment space`}),e.append(this.canvas),this.canvas.addEventListener("click",c=>this.jump(c)),new ResizeObserver(()=>i.later(this)).observe(e)}panel;plane;frames;data;maker;store;canvas;points=document.createElement("canvas");key="";last=null;update(){this.frames.later(this)}place(e,t){let[i,s]=this.plane,{left:r,right:o,top:a,bottom:l}=rp,[c,h]=[this.panel.clientWidth-r-o,this.panel.clientHeight-a-l],u=Math.min(c,h)/(2*e.half);return[r+c/2+((t[i]??Number.NaN)-(e.centre[i]??0))*u,a+h/2-((t[s]??Number.NaN)-(e.centre[s]??0))*u]}sampleOnScreen(e,t){let i=this.maker.of(this.store.state),s=i.clouds[e];if(!s)return null;let r=this.canvas.getBoundingClientRect(),[o,a]=this.place(i,this.data.vector(s.series,t,this.store.state.quantity));return{x:r.left+o,y:r.top+a}}draw(){let[e,t]=[this.panel.clientWidth,this.panel.clientHeight];if(e===0||t===0)return;let{state:i}=this.store,s=this.maker.of(i),r=JSON.stringify([e,t,devicePixelRatio,[...i.hidden],i.wireframes]);(r!==this.key||s!==this.last)&&(this.key=r,this.last=s,this.drawPoints(s,s_(this.points,e,t)));let o=s_(this.canvas,e,t);o.drawImage(this.points,0,0,e,t);for(let a of this.visible(s)){let[l,c]=this.place(s,this.data.vector(a.series,i.sample,i.quantity));for(let[h,u]of[[6.5,"#ffffff"],[5,a.colour],[1.8,"#ffffff"]])o.fillStyle=u,o.beginPath(),o.arc(l,c,h,0,2*Math.PI),Number.isFinite(l+c)&&o.fill()}}visible(e){return e.clouds.filter(t=>!this.store.state.hidden.has(t.series.name))}drawPoints(e,t){this.drawAxes(e,t);let{left:i,right:s,top:r,bottom:o}=rp;t.save(),t.beginPath(),t.rect(i,r,this.panel.clientWidth-i-s,this.panel.clientHeight-r-o),t.clip();for(let a of this.visible(e)){t.fillStyle=a.colour;for(let c=0;c+2<a.points.length;c+=3){let[h,u]=this.place(e,a.points.subarray(c,c+3));Number.isFinite(h+u)&&t.fillRect(h-.8,u-.8,1.6,1.6)}if(!this.store.state.wireframes)continue;let l=[[a.sphere&&mu(a.sphere),"#777777"],[a.ellipsoid,a.colour]];for(let[c,h]of l)if(c){t.strokeStyle=h,t.beginPath();for(let[u,d]of i_(c,this.plane)){let f=[0,0,0];f[this.plane[0]]=u,f[this.plane[1]]=d,t.lineTo(...this.place(e,f))}t.stroke()}}t.restore()}drawAxes(e,t){let[i,s]=this.plane,{left:r,right:o,top:a,bottom:l}=rp,[c,h]=[this.panel.clientWidth,this.panel.clientHeight],[u,d]=[e.centre[i]??0,e.centre[s]??0],f=Math.min(c-r-o,h-a-l)/(2*e.half),g=[(c-r-o)/2/f,(h-a-l)/2/f];t.font=zE,t.fillStyle="#59606c",t.strokeStyle="#eceff3",t.textAlign="center";for(let p of _a(u-g[0],u+g[0],c/45)){let y=this.place(e,i===0?[p,d,d]:[d,p,d])[0];r_(t,y,a,y,h-l),y>r+8&&y<c-o-8&&t.fillText(o_(p),y,h-l+11)}t.textAlign="right";for(let p of _a(d-g[1],d+g[1],h/30)){let y=this.place(e,s===2?[u,u,p]:[u,p,u])[1];r_(t,r,y,c-o,y),y>a+4&&t.fillText(o_(p),r-4,y+4)}t.strokeStyle=pa,t.strokeRect(r+.5,a+.5,c-r-o,h-a-l);let v=this.store.state.quantity==="force"?"f":"t",m=Js[this.store.state.quantity];t.fillStyle=ci,t.textAlign="left",t.fillText(`${v}${"xyz"[s]??""} [${m}]`,r+4,a+12),t.textAlign="right",t.fillText(`${v}${"xyz"[i]??""} [${m}]`,c-o-4,h-l-5)}jump(e){let t=this.maker.of(this.store.state),i=this.canvas.getBoundingClientRect(),s={sample:-1,distance:kE};for(let r of this.visible(t))t.samples.forEach((o,a)=>{let[l,c]=this.place(t,r.points.subarray(3*a,3*a+3)),h=Math.hypot(l-e.clientX+i.left,c-e.clientY+i.top);h<s.distance&&(s={sample:o,distance:h})});s.sample>=0&&this.store.set({sample:s.sample,playing:!1})}};function s_(n,e,t){n.width=Math.round(e*devicePixelRatio),n.height=Math.round(t*devicePixelRatio);let i=n.getContext("2d");if(!i)throw new Error("this browser draws nothing on a canvas");return i.setTransform(devicePixelRatio,0,0,devicePixelRatio,0,0),i.fillStyle="#ffffff",i.fillRect(0,0,e,t),i}function r_(n,e,t,i,s){n.beginPath(),n.moveTo(e,t),n.lineTo(i,s),n.stroke()}function o_(n){return String(Number(n.toPrecision(6))).replace("-","\u2212")}var VE="uplot",GE="u-hz",HE="u-vt",WE="u-title",XE="u-wrap",qE="u-under",YE="u-over",$E="u-axis",Xr="u-off",ZE="u-select",KE="u-cursor-x",JE="u-cursor-y",jE="u-cursor-pt",QE="u-legend",e1="u-live",t1="u-inline",n1="u-series",i1="u-marker",a_="u-label",s1="u-value",El="width",Al="height";var l_="bottom",$o="left",op="right",Mp="#000",c_=Mp+"0",ap="mousemove",h_="mousedown",lp="mouseup",u_="mouseenter",d_="mouseleave",f_="dblclick",r1="resize",o1="scroll",p_="change",Su="dppxchange",wp="--",ta=typeof window<"u",fp=ta?document:null,Ko=ta?window:null,a1=ta?navigator:null,It,_u;function pp(){let n=devicePixelRatio;It!=n&&(It=n,_u&&gp(p_,_u,pp),_u=matchMedia(`(min-resolution: ${It-.001}dppx) and (max-resolution: ${It+.001}dppx)`),qr(p_,_u,pp),Ko.dispatchEvent(new CustomEvent(Su)))}function wi(n,e){if(e!=null){let t=n.classList;!t.contains(e)&&t.add(e)}}function mp(n,e){let t=n.classList;t.contains(e)&&t.remove(e)}function jt(n,e,t){n.style[e]=t+"px"}function Ki(n,e,t,i){let s=fp.createElement(n);return e!=null&&wi(s,e),t?.insertBefore(s,i),s}function Li(n,e){return Ki("div",n,e)}var m_=new WeakMap;function xs(n,e,t,i,s){let r="translate("+e+"px,"+t+"px)",o=m_.get(n);r!=o&&(n.style.transform=r,m_.set(n,r),e<0||t<0||e>i||t>s?wi(n,Xr):mp(n,Xr))}var g_=new WeakMap;function __(n,e,t){let i=e+t,s=g_.get(n);i!=s&&(g_.set(n,i),n.style.background=e,n.style.borderColor=t)}var x_=new WeakMap;function y_(n,e,t,i){let s=e+""+t,r=x_.get(n);s!=r&&(x_.set(n,s),n.style.height=t+"px",n.style.width=e+"px",n.style.marginLeft=i?-e/2+"px":0,n.style.marginTop=i?-t/2+"px":0)}var Tp={passive:!0},l1={...Tp,capture:!0};function qr(n,e,t,i){e.addEventListener(n,t,i?l1:Tp)}function gp(n,e,t,i){e.removeEventListener(n,t,Tp)}ta&&pp();function Ji(n,e,t,i){let s;t=t||0,i=i||e.length-1;let r=i<=2147483647;for(;i-t>1;)s=r?t+i>>1:Ti((t+i)/2),e[s]<n?t=s:i=s;return n-e[t]<=e[i]-n?t:i}function Y_(n){return(t,i,s)=>{let r=-1,o=-1;for(let a=i;a<=s;a++)if(n(t[a])){r=a;break}for(let a=s;a>=i;a--)if(n(t[a])){o=a;break}return[r,o]}}var $_=n=>n!=null,Z_=n=>n!=null&&n>0,wu=Y_($_),c1=Y_(Z_);function h1(n,e,t,i=0,s=!1){let r=s?c1:wu,o=s?Z_:$_;[e,t]=r(n,e,t);let a=n[e],l=n[e];if(e>-1)if(i==1)a=n[e],l=n[t];else if(i==-1)a=n[t],l=n[e];else for(let c=e;c<=t;c++){let h=n[c];o(h)&&(h<a?a=h:h>l&&(l=h))}return[a??Vt,l??-Vt]}function Tu(n,e,t,i){let s=b_(n),r=b_(e);n==e&&(s==-1?(n*=t,e/=t):(n/=t,e*=t));let o=t==10?zs:K_,a=s==1?Ti:Ni,l=r==1?Ni:Ti,c=a(o(Pn(n))),h=l(o(Pn(e))),u=Jo(t,c),d=Jo(t,h);return t==10&&(c<0&&(u=Gt(u,-c)),h<0&&(d=Gt(d,-h))),i||t==2?(n=u*s,e=d*r):(n=ex(n,u),e=Eu(e,d)),[n,e]}function Ep(n,e,t,i){let s=Tu(n,e,t,i);return n==0&&(s[0]=0),e==0&&(s[1]=0),s}var Ap=.1,v_={mode:3,pad:Ap},Rl={pad:0,soft:null,mode:0},u1={min:Rl,max:Rl};function bu(n,e,t,i){return Au(t)?S_(n,e,t):(Rl.pad=t,Rl.soft=i?0:null,Rl.mode=i?3:0,S_(n,e,u1))}function At(n,e){return n??e}function d1(n,e,t){for(e=At(e,0),t=At(t,n.length-1);e<=t;){if(n[e]!=null)return!0;e++}return!1}function S_(n,e,t){let i=t.min,s=t.max,r=At(i.pad,0),o=At(s.pad,0),a=At(i.hard,-Vt),l=At(s.hard,Vt),c=At(i.soft,Vt),h=At(s.soft,-Vt),u=At(i.mode,0),d=At(s.mode,0),f=e-n,g=zs(f),v=ai(Pn(n),Pn(e)),m=zs(v),p=Pn(m-g);(f<1e-24||p>10)&&(f=0,(n==0||e==0)&&(f=1e-24,u==2&&c!=Vt&&(r=0),d==2&&h!=-Vt&&(o=0)));let y=f||v||1e3,C=zs(y),w=Jo(10,Ti(C)),P=y*(f==0?n==0?.1:1:r),E=Gt(ex(n-P,w/10),24),x=n>=c&&(u==1||u==3&&E<=c||u==2&&E>=c)?c:Vt,T=ai(a,E<x&&n>=x?x:ji(x,E)),k=y*(f==0?e==0?.1:1:o),N=Gt(Eu(e+k,w/10),24),L=e<=h&&(d==1||d==3&&N>=h||d==2&&N<=h)?h:-Vt,z=ji(l,N>L&&e<=L?L:ai(L,N));return T==z&&T==0&&(z=100),[T,z]}var f1=new Intl.NumberFormat(ta?a1.language:"en-US"),Cp=n=>f1.format(n),Ei=Math,vu=Ei.PI,Pn=Ei.abs,Ti=Ei.floor,Rn=Ei.round,Ni=Ei.ceil,ji=Ei.min,ai=Ei.max,Jo=Ei.pow,b_=Ei.sign,zs=Ei.log10,K_=Ei.log2,p1=(n,e=1)=>Ei.sinh(n)*e,cp=(n,e=1)=>Ei.asinh(n/e),Vt=1/0;function M_(n){return(zs((n^n>>31)-(n>>31))|0)+1}function _p(n,e,t){return ji(ai(n,e),t)}function J_(n){return typeof n=="function"}function Mt(n){return J_(n)?n:()=>n}var m1=()=>{},j_=n=>n,Q_=(n,e)=>e,g1=n=>null,w_=n=>!0,T_=(n,e)=>n==e,_1=/\.\d*?(?=9{6,}|0{6,})/gm,Yr=n=>{if(nx(n)||xr.has(n))return n;let e=`${n}`,t=e.match(_1);if(t==null)return n;let i=t[0].length-1;if(e.indexOf("e-")!=-1){let[s,r]=e.split("e");return+`${Yr(s)}e${r}`}return Gt(n,i)};function Hr(n,e){return Yr(Gt(Yr(n/e))*e)}function Eu(n,e){return Yr(Ni(Yr(n/e))*e)}function ex(n,e){return Yr(Ti(Yr(n/e))*e)}function Gt(n,e=0){if(nx(n))return n;let t=10**e,i=n*t*(1+Number.EPSILON);return Rn(i)/t}var xr=new Map;function tx(n){return((""+n).split(".")[1]||"").length}function Il(n,e,t,i){let s=[],r=i.map(tx);for(let o=e;o<t;o++){let a=Pn(o),l=Gt(Jo(n,o),a);for(let c=0;c<i.length;c++){let h=n==10?+`${i[c]}e${o}`:i[c]*l,u=(o>=0?0:a)+(o>=r[c]?0:r[c]),d=n==10?h:Gt(h,u);s.push(d),xr.set(d,u)}}return s}var Pl={},Rp=[],jo=[null,null],_r=Array.isArray,nx=Number.isInteger,x1=n=>n===void 0;function E_(n){return typeof n=="string"}function Au(n){let e=!1;if(n!=null){let t=n.constructor;e=t==null||t==Object}return e}function y1(n){return n!=null&&typeof n=="object"}var v1=Object.getPrototypeOf(Uint8Array),ix="__proto__";function Qo(n,e=Au){let t;if(_r(n)){let i=n.find(s=>s!=null);if(_r(i)||e(i)){t=Array(n.length);for(let s=0;s<n.length;s++)t[s]=Qo(n[s],e)}else t=n.slice()}else if(n instanceof v1)t=n.slice();else if(e(n)){t={};for(let i in n)i!=ix&&(t[i]=Qo(n[i],e))}else t=n;return t}function bn(n){let e=arguments;for(let t=1;t<e.length;t++){let i=e[t];for(let s in i)s!=ix&&(Au(n[s])?bn(n[s],Qo(i[s])):n[s]=Qo(i[s]))}return n}var S1=0,b1=1,M1=2;function w1(n,e,t){for(let i=0,s,r=-1;i<e.length;i++){let o=e[i];if(o>r){for(s=o-1;s>=0&&n[s]==null;)n[s--]=null;for(s=o+1;s<t&&n[s]==null;)n[r=s++]=null}}}function T1(n,e){if(C1(n)){let o=n[0].slice();for(let a=1;a<n.length;a++)o.push(...n[a].slice(1));return R1(o[0])||(o=A1(o)),o}let t=new Set;for(let o=0;o<n.length;o++){let l=n[o][0],c=l.length;for(let h=0;h<c;h++)t.add(l[h])}let i=[Array.from(t).sort((o,a)=>o-a)],s=i[0].length,r=new Map;for(let o=0;o<s;o++)r.set(i[0][o],o);for(let o=0;o<n.length;o++){let a=n[o],l=a[0];for(let c=1;c<a.length;c++){let h=a[c],u=Array(s).fill(void 0),d=e?e[o][c]:b1,f=[];for(let g=0;g<h.length;g++){let v=h[g],m=r.get(l[g]);v===null?d!=S1&&(u[m]=v,d==M1&&f.push(m)):u[m]=v}w1(u,f,s),i.push(u)}}return i}var E1=typeof queueMicrotask>"u"?n=>Promise.resolve().then(n):queueMicrotask;function A1(n){let e=n[0],t=e.length,i=Array(t);for(let r=0;r<i.length;r++)i[r]=r;i.sort((r,o)=>e[r]-e[o]);let s=[];for(let r=0;r<n.length;r++){let o=n[r],a=Array(t);for(let l=0;l<t;l++)a[l]=o[i[l]];s.push(a)}return s}function C1(n){let e=n[0][0],t=e.length;for(let i=1;i<n.length;i++){let s=n[i][0];if(s.length!=t)return!1;if(s!=e){for(let r=0;r<t;r++)if(s[r]!=e[r])return!1}}return!0}function R1(n,e=100){let t=n.length;if(t<=1)return!0;let i=0,s=t-1;for(;i<=s&&n[i]==null;)i++;for(;s>=i&&n[s]==null;)s--;if(s<=i)return!0;let r=ai(1,Ti((s-i+1)/e));for(let o=n[i],a=i+r;a<=s;a+=r){let l=n[a];if(l!=null){if(l<=o)return!1;o=l}}return!0}var sx=["January","February","March","April","May","June","July","August","September","October","November","December"],rx=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function ox(n){return n.slice(0,3)}var P1=rx.map(ox),I1=sx.map(ox),D1={MMMM:sx,MMM:I1,WWWW:rx,WWW:P1};function Tl(n){return(n<10?"0":"")+n}function L1(n){return(n<10?"00":n<100?"0":"")+n}var N1={YYYY:n=>n.getFullYear(),YY:n=>(n.getFullYear()+"").slice(2),MMMM:(n,e)=>e.MMMM[n.getMonth()],MMM:(n,e)=>e.MMM[n.getMonth()],MM:n=>Tl(n.getMonth()+1),M:n=>n.getMonth()+1,DD:n=>Tl(n.getDate()),D:n=>n.getDate(),WWWW:(n,e)=>e.WWWW[n.getDay()],WWW:(n,e)=>e.WWW[n.getDay()],HH:n=>Tl(n.getHours()),H:n=>n.getHours(),h:n=>{let e=n.getHours();return e==0?12:e>12?e-12:e},AA:n=>n.getHours()>=12?"PM":"AM",aa:n=>n.getHours()>=12?"pm":"am",a:n=>n.getHours()>=12?"p":"a",mm:n=>Tl(n.getMinutes()),m:n=>n.getMinutes(),ss:n=>Tl(n.getSeconds()),s:n=>n.getSeconds(),fff:n=>L1(n.getMilliseconds())};function Pp(n,e){e=e||D1;let t=[],i=/\{([a-z]+)\}|[^{]+/gi,s;for(;s=i.exec(n);)t.push(s[0][0]=="{"?N1[s[1]]:s[0]);return r=>{let o="";for(let a=0;a<t.length;a++)o+=typeof t[a]=="string"?t[a]:t[a](r,e);return o}}var U1=new Intl.DateTimeFormat().resolvedOptions().timeZone;function F1(n,e){let t;return e=="UTC"||e=="Etc/UTC"?t=new Date(+n+n.getTimezoneOffset()*6e4):e==U1?t=n:(t=new Date(n.toLocaleString("en-US",{timeZone:e})),t.setMilliseconds(n.getMilliseconds())),t}var ax=n=>n%1==0,Mu=[1,2,2.5,5],O1=Il(10,-32,0,Mu),lx=Il(10,0,32,Mu),B1=lx.filter(ax),Wr=O1.concat(lx),Ip=`
`,cx="{YYYY}",A_=Ip+cx,hx="{M}/{D}",Cl=Ip+hx,xu=Cl+"/{YY}",ux="{aa}",k1="{h}:{mm}",Zo=k1+ux,C_=Ip+Zo,R_=":{ss}",Nt=null;function dx(n){let e=n*1e3,t=e*60,i=t*60,s=i*24,r=s*30,o=s*365,l=(n==1?Il(10,0,3,Mu).filter(ax):Il(10,-3,0,Mu)).concat([e,e*5,e*10,e*15,e*30,t,t*5,t*10,t*15,t*30,i,i*2,i*3,i*4,i*6,i*8,i*12,s,s*2,s*3,s*4,s*5,s*6,s*7,s*8,s*9,s*10,s*15,r,r*2,r*3,r*4,r*6,o,o*2,o*5,o*10,o*25,o*50,o*100]),c=[[o,cx,Nt,Nt,Nt,Nt,Nt,Nt,1],[s*28,"{MMM}",A_,Nt,Nt,Nt,Nt,Nt,1],[s,hx,A_,Nt,Nt,Nt,Nt,Nt,1],[i,"{h}"+ux,xu,Nt,Cl,Nt,Nt,Nt,1],[t,Zo,xu,Nt,Cl,Nt,Nt,Nt,1],[e,R_,xu+" "+Zo,Nt,Cl+" "+Zo,Nt,C_,Nt,1],[n,R_+".{fff}",xu+" "+Zo,Nt,Cl+" "+Zo,Nt,C_,Nt,1]];function h(u){return(d,f,g,v,m,p)=>{let y=[],C=m>=o,w=m>=r&&m<o,P=u(g),E=Gt(P*n,3),x=hp(P.getFullYear(),C?0:P.getMonth(),w||C?1:P.getDate()),T=Gt(x*n,3);if(w||C){let k=w?m/r:0,N=C?m/o:0,L=E==T?E:Gt(hp(x.getFullYear()+N,x.getMonth()+k,1)*n,3),z=new Date(Rn(L/n)),W=z.getFullYear(),D=z.getMonth();for(let X=0;L<=v;X++){let $=hp(W+N*X,D+k*X,1),H=$-u(Gt($*n,3));L=Gt((+$+H)*n,3),L<=v&&y.push(L)}}else{let k=m>=s?s:m,N=Ti(g)-Ti(E),L=T+N+Eu(E-T,k);y.push(L);let z=u(L),W=z.getHours()+z.getMinutes()/t+z.getSeconds()/i,D=m/i,X=d.axes[f]._space,$=p/X;for(;L=Gt(L+m,n==1?0:3),!(L>v);)if(D>1){let H=Ti(Gt(W+D,6))%24,Q=u(L).getHours()-H;Q>1&&(Q=-1),L-=Q*i,W=(W+D)%24;let re=y[y.length-1];Gt((L-re)/m,3)*$>=.7&&y.push(L)}else y.push(L)}return y}}return[l,c,h]}var[z1,V1,G1]=dx(1),[H1,W1,X1]=dx(.001);Il(2,-53,53,[1]);function P_(n,e){return n.map(t=>t.map((i,s)=>s==0||s==8||i==null?i:e(s==1||t[8]==0?i:t[1]+i)))}function I_(n,e){return(t,i,s,r,o)=>{let a=e.find(g=>o>=g[0])||e[e.length-1],l,c,h,u,d,f;return i.map(g=>{let v=n(g),m=v.getFullYear(),p=v.getMonth(),y=v.getDate(),C=v.getHours(),w=v.getMinutes(),P=v.getSeconds(),E=m!=l&&a[2]||p!=c&&a[3]||y!=h&&a[4]||C!=u&&a[5]||w!=d&&a[6]||P!=f&&a[7]||a[1];return l=m,c=p,h=y,u=C,d=w,f=P,E(v)})}}function q1(n,e){let t=Pp(e);return(i,s,r,o,a)=>s.map(l=>t(n(l)))}function hp(n,e,t){return new Date(n,e,t)}function D_(n,e){return e(n)}var Y1="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function L_(n,e){return(t,i,s,r)=>r==null?wp:e(n(i))}function $1(n,e){let t=n.series[e];return t.width?t.stroke(n,e):t.points.width?t.points.stroke(n,e):null}function Z1(n,e){return n.series[e].fill(n,e)}var K1={show:!0,live:!0,isolate:!1,mount:m1,markers:{show:!0,width:2,stroke:$1,fill:Z1,dash:"solid"},idx:null,idxs:null,values:[]};function J1(n,e){let t=n.cursor.points,i=Li(),s=t.size(n,e);jt(i,El,s),jt(i,Al,s);let r=s/-2;jt(i,"marginLeft",r),jt(i,"marginTop",r);let o=t.width(n,e,s);return o&&jt(i,"borderWidth",o),i}function j1(n,e){let t=n.series[e].points;return t._fill||t._stroke}function Q1(n,e){let t=n.series[e].points;return t._stroke||t._fill}function eA(n,e){return n.series[e].points.size}var up=[0,0];function tA(n,e,t){return up[0]=e,up[1]=t,up}function yu(n,e,t,i=!0){return s=>{s.button==0&&(!i||s.target==e)&&t(s)}}function dp(n,e,t,i=!0){return s=>{(!i||s.target==e)&&t(s)}}var nA={show:!0,x:!0,y:!0,lock:!1,move:tA,points:{one:!1,show:J1,size:eA,width:0,stroke:Q1,fill:j1},bind:{mousedown:yu,mouseup:yu,click:yu,dblclick:yu,mousemove:dp,mouseleave:dp,mouseenter:dp},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(n,e)=>{e.stopPropagation(),e.stopImmediatePropagation()},_x:!1,_y:!1},focus:{dist:(n,e,t,i,s)=>i-s,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},fx={show:!0,stroke:"rgba(0,0,0,0.07)",width:2},Dp=bn({},fx,{filter:Q_}),px=bn({},Dp,{size:10}),mx=bn({},fx,{show:!1}),Lp='12px system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',gx="bold "+Lp,_x=1.5,N_={show:!0,scale:"x",stroke:Mp,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:gx,side:2,grid:Dp,ticks:px,border:mx,font:Lp,lineGap:_x,rotate:0},iA="Value",sA="Time",U_={show:!0,scale:"x",auto:!1,sorted:1,min:Vt,max:-Vt,idxs:[]};function rA(n,e,t,i,s){return e.map(r=>r==null?"":Cp(r))}function oA(n,e,t,i,s,r,o){let a=[],l=xr.get(s)||0;t=o?t:Gt(Eu(t,s),l);for(let c=t;c<=i;c=Gt(c+s,l))a.push(Object.is(c,-0)?0:c);return a}function xp(n,e,t,i,s,r,o){let a=[],l=n.scales[n.axes[e].scale].log,c=l==10?zs:K_,h=Ti(c(t));s=Jo(l,h),l==10&&(s=Wr[Ji(s,Wr)]);let u=t,d=s*l;l==10&&(d=Wr[Ji(d,Wr)]);do a.push(u),u=u+s,l==10&&!xr.has(u)&&(u=Gt(u,xr.get(s))),u>=d&&(s=u,d=s*l,l==10&&(d=Wr[Ji(d,Wr)]));while(u<=i);return a}function aA(n,e,t,i,s,r,o){let l=n.scales[n.axes[e].scale].asinh,c=i>l?xp(n,e,ai(l,t),i,s):[l],h=i>=0&&t<=0?[0]:[];return(t<-l?xp(n,e,ai(l,-i),-t,s):[l]).reverse().map(d=>-d).concat(h,c)}var xx=/./,lA=/[12357]/,cA=/[125]/,F_=/1/,yp=(n,e,t,i)=>n.map((s,r)=>e==4&&s==0||r%i==0&&t.test(s.toExponential()[s<0?1:0])?s:null);function hA(n,e,t,i,s){let r=n.axes[t],o=r.scale,a=n.scales[o],l=n.valToPos,c=r._space,h=l(10,o),u=l(9,o)-h>=c?xx:l(7,o)-h>=c?lA:l(5,o)-h>=c?cA:F_;if(u==F_){let d=Pn(l(1,o)-h);if(d<c)return yp(e.slice().reverse(),a.distr,u,Ni(c/d)).reverse()}return yp(e,a.distr,u,1)}function uA(n,e,t,i,s){let r=n.axes[t],o=r.scale,a=r._space,l=n.valToPos,c=Pn(l(1,o)-l(2,o));return c<a?yp(e.slice().reverse(),3,xx,Ni(a/c)).reverse():e}function dA(n,e,t,i){return i==null?wp:e==null?"":Cp(e)}var O_={show:!0,scale:"y",stroke:Mp,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:gx,side:3,grid:Dp,ticks:px,border:mx,font:Lp,lineGap:_x,rotate:0};function fA(n,e){let t=3+(n||1)*2;return Gt(t*e,3)}function pA(n,e){let{scale:t,idxs:i}=n.series[0],s=n._data[0],r=n.valToPos(s[i[0]],t,!0),o=n.valToPos(s[i[1]],t,!0),a=Pn(o-r),l=n.series[e],c=a/(l.points.space*It);return i[1]-i[0]<=c}var B_={scale:null,auto:!0,sorted:0,min:Vt,max:-Vt},yx=(n,e,t,i,s)=>s,k_={show:!0,auto:!0,sorted:0,gaps:yx,alpha:1,facets:[bn({},B_,{scale:"x"}),bn({},B_,{scale:"y"})]},z_={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,gaps:yx,alpha:1,points:{show:pA,filter:null},values:null,min:Vt,max:-Vt,idxs:[],path:null,clip:null};function mA(n,e,t,i,s){return t/10}var vx={time:!0,auto:!0,distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},gA=bn({},vx,{time:!1,ori:1}),V_={};function Sx(n,e){let t=V_[n];return t||(t={key:n,plots:[],sub(i){t.plots.push(i)},unsub(i){t.plots=t.plots.filter(s=>s!=i)},pub(i,s,r,o,a,l,c){for(let h=0;h<t.plots.length;h++)t.plots[h]!=s&&t.plots[h].pub(i,s,r,o,a,l,c)}},n!=null&&(V_[n]=t)),t}var ea=1,vp=2;function $r(n,e,t){let i=n.mode,s=n.series[e],r=i==2?n._data[e]:n._data,o=n.scales,a=n.bbox,l=r[0],c=i==2?r[1]:r[e],h=i==2?o[s.facets[0].scale]:o[n.series[0].scale],u=i==2?o[s.facets[1].scale]:o[s.scale],d=a.left,f=a.top,g=a.width,v=a.height,m=n.valToPosH,p=n.valToPosV;return h.ori==0?t(s,l,c,h,u,m,p,d,f,g,v,Ru,na,Iu,Mx,Tx):t(s,l,c,h,u,p,m,f,d,v,g,Pu,ia,Fp,wx,Ex)}function Np(n,e){let t=0,i=0,s=At(n.bands,Rp);for(let r=0;r<s.length;r++){let o=s[r];o.series[0]==e?t=o.dir:o.series[1]==e&&(o.dir==1?i|=1:i|=2)}return[t,i==1?-1:i==2?1:i==3?2:0]}function _A(n,e,t,i,s){let r=n.mode,o=n.series[e],a=r==2?o.facets[1].scale:o.scale,l=n.scales[a];return s==-1?l.min:s==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function Vs(n,e,t,i,s,r){return $r(n,e,(o,a,l,c,h,u,d,f,g,v,m)=>{let p=o.pxRound,y=c.dir*(c.ori==0?1:-1),C=c.ori==0?na:ia,w,P;y==1?(w=t,P=i):(w=i,P=t);let E=p(u(a[w],c,v,f)),x=p(d(l[w],h,m,g)),T=p(u(a[P],c,v,f)),k=p(d(r==1?h.max:h.min,h,m,g)),N=new Path2D(s);return C(N,T,k),C(N,E,k),C(N,E,x),N})}function Cu(n,e,t,i,s,r){let o=null;if(n.length>0){o=new Path2D;let a=e==0?Iu:Fp,l=t;for(let u=0;u<n.length;u++){let d=n[u];if(d[1]>d[0]){let f=d[0]-l;f>0&&a(o,l,i,f,i+r),l=d[1]}}let c=t+s-l,h=10;c>0&&a(o,l,i-h/2,c,i+r+h)}return o}function xA(n,e,t){let i=n[n.length-1];i&&i[0]==e?i[1]=t:n.push([e,t])}function Up(n,e,t,i,s,r,o){let a=[],l=n.length;for(let c=s==1?t:i;c>=t&&c<=i;c+=s)if(e[c]===null){let u=c,d=c;if(s==1)for(;++c<=i&&e[c]===null;)d=c;else for(;--c>=t&&e[c]===null;)d=c;let f=r(n[u]),g=d==u?f:r(n[d]),v=u-s;f=o<=0&&v>=0&&v<l?r(n[v]):f;let p=d+s;g=o>=0&&p>=0&&p<l?r(n[p]):g,g>=f&&a.push([f,g])}return a}function G_(n){return n==0?j_:n==1?Rn:e=>Hr(e,n)}function bx(n){let e=n==0?Ru:Pu,t=n==0?(s,r,o,a,l,c)=>{s.arcTo(r,o,a,l,c)}:(s,r,o,a,l,c)=>{s.arcTo(o,r,l,a,c)},i=n==0?(s,r,o,a,l)=>{s.rect(r,o,a,l)}:(s,r,o,a,l)=>{s.rect(o,r,l,a)};return(s,r,o,a,l,c=0,h=0)=>{c==0&&h==0?i(s,r,o,a,l):(c=ji(c,a/2,l/2),h=ji(h,a/2,l/2),e(s,r+c,o),t(s,r+a,o,r+a,o+l,c),t(s,r+a,o+l,r,o+l,h),t(s,r,o+l,r,o,h),t(s,r,o,r+a,o,c),s.closePath())}}var Ru=(n,e,t)=>{n.moveTo(e,t)},Pu=(n,e,t)=>{n.moveTo(t,e)},na=(n,e,t)=>{n.lineTo(e,t)},ia=(n,e,t)=>{n.lineTo(t,e)},Iu=bx(0),Fp=bx(1),Mx=(n,e,t,i,s,r)=>{n.arc(e,t,i,s,r)},wx=(n,e,t,i,s,r)=>{n.arc(t,e,i,s,r)},Tx=(n,e,t,i,s,r,o)=>{n.bezierCurveTo(e,t,i,s,r,o)},Ex=(n,e,t,i,s,r,o)=>{n.bezierCurveTo(t,e,s,i,o,r)};function Ax(n){return(e,t,i,s,r)=>$r(e,t,(o,a,l,c,h,u,d,f,g,v,m)=>{let{pxRound:p,points:y}=o,C,w;c.ori==0?(C=Ru,w=Mx):(C=Pu,w=wx);let P=Gt(y.width*It,3),E=(y.size-y.width)/2*It,x=Gt(E*2,3),T=new Path2D,k=new Path2D,{left:N,top:L,width:z,height:W}=e.bbox;Iu(k,N-x,L-x,z+x*2,W+x*2);let D=X=>{if(l[X]!=null){let $=p(u(a[X],c,v,f)),H=p(d(l[X],h,m,g));C(T,$+E,H),w(T,$,H,E,0,vu*2)}};if(r)r.forEach(D);else for(let X=i;X<=s;X++)D(X);return{stroke:P>0?T:null,fill:T,clip:k,flags:ea|vp}})}function Cx(n){return(e,t,i,s,r,o)=>{i!=s&&(r!=i&&o!=i&&n(e,t,i),r!=s&&o!=s&&n(e,t,s),n(e,t,o))}}var yA=Cx(na),vA=Cx(ia);function Rx(n){let e=At(n?.alignGaps,0);return(t,i,s,r)=>$r(t,i,(o,a,l,c,h,u,d,f,g,v,m)=>{[s,r]=wu(l,s,r);let p=o.pxRound,y=W=>p(u(W,c,v,f)),C=W=>p(d(W,h,m,g)),w,P;c.ori==0?(w=na,P=yA):(w=ia,P=vA);let E=c.dir*(c.ori==0?1:-1),x={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:ea},T=x.stroke,k=!1;if(r-s>=v*4){let W=de=>t.posToVal(de,c.key,!0),D=null,X=null,$,H,he,J=y(a[E==1?s:r]),Q=y(a[s]),re=y(a[r]),fe=W(E==1?Q+1:re-1);for(let de=E==1?s:r;de>=s&&de<=r;de+=E){let te=a[de],ye=(E==1?te<fe:te>fe)?J:y(te),Ce=l[de];ye==J?Ce!=null?(H=Ce,D==null?(w(T,ye,C(H)),$=D=X=H):H<D?D=H:H>X&&(X=H)):Ce===null&&(k=!0):(D!=null&&P(T,J,C(D),C(X),C($),C(H)),Ce!=null?(H=Ce,w(T,ye,C(H)),D=X=$=H):(D=X=null,Ce===null&&(k=!0)),J=ye,fe=W(J+E))}D!=null&&D!=X&&he!=J&&P(T,J,C(D),C(X),C($),C(H))}else for(let W=E==1?s:r;W>=s&&W<=r;W+=E){let D=l[W];D===null?k=!0:D!=null&&w(T,y(a[W]),C(D))}let[L,z]=Np(t,i);if(o.fill!=null||L!=0){let W=x.fill=new Path2D(T),D=o.fillTo(t,i,o.min,o.max,L),X=C(D),$=y(a[s]),H=y(a[r]);E==-1&&([H,$]=[$,H]),w(W,H,X),w(W,$,X)}if(!o.spanGaps){let W=[];k&&W.push(...Up(a,l,s,r,E,y,e)),x.gaps=W=o.gaps(t,i,s,r,W),x.clip=Cu(W,c.ori,f,g,v,m)}return z!=0&&(x.band=z==2?[Vs(t,i,s,r,T,-1),Vs(t,i,s,r,T,1)]:Vs(t,i,s,r,T,z)),x})}function SA(n){let e=At(n.align,1),t=At(n.ascDesc,!1),i=At(n.alignGaps,0),s=At(n.extend,!1);return(r,o,a,l)=>$r(r,o,(c,h,u,d,f,g,v,m,p,y,C)=>{[a,l]=wu(u,a,l);let w=c.pxRound,{left:P,width:E}=r.bbox,x=Q=>w(g(Q,d,y,m)),T=Q=>w(v(Q,f,C,p)),k=d.ori==0?na:ia,N={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:ea},L=N.stroke,z=d.dir*(d.ori==0?1:-1),W=T(u[z==1?a:l]),D=x(h[z==1?a:l]),X=D,$=D;s&&e==-1&&($=P,k(L,$,W)),k(L,D,W);for(let Q=z==1?a:l;Q>=a&&Q<=l;Q+=z){let re=u[Q];if(re==null)continue;let fe=x(h[Q]),de=T(re);e==1?k(L,fe,W):k(L,X,de),k(L,fe,de),W=de,X=fe}let H=X;s&&e==1&&(H=P+E,k(L,H,W));let[he,J]=Np(r,o);if(c.fill!=null||he!=0){let Q=N.fill=new Path2D(L),re=c.fillTo(r,o,c.min,c.max,he),fe=T(re);k(Q,H,fe),k(Q,$,fe)}if(!c.spanGaps){let Q=[];Q.push(...Up(h,u,a,l,z,x,i));let re=c.width*It/2,fe=t||e==1?re:-re,de=t||e==-1?-re:re;Q.forEach(te=>{te[0]+=fe,te[1]+=de}),N.gaps=Q=c.gaps(r,o,a,l,Q),N.clip=Cu(Q,d.ori,m,p,y,C)}return J!=0&&(N.band=J==2?[Vs(r,o,a,l,L,-1),Vs(r,o,a,l,L,1)]:Vs(r,o,a,l,L,J)),N})}function H_(n,e,t,i,s,r,o=Vt){if(n.length>1){let a=null;for(let l=0,c=1/0;l<n.length;l++)if(e[l]!==void 0){if(a!=null){let h=Pn(n[l]-n[a]);h<c&&(c=h,o=Pn(t(n[l],i,s,r)-t(n[a],i,s,r)))}a=l}}return o}function bA(n){n=n||Pl;let e=At(n.size,[.6,Vt,1]),t=n.align||0,i=n.gap||0,s=n.radius;s=s==null?[0,0]:typeof s=="number"?[s,0]:s;let r=Mt(s),o=1-e[0],a=At(e[1],Vt),l=At(e[2],1),c=At(n.disp,Pl),h=At(n.each,f=>{}),{fill:u,stroke:d}=c;return(f,g,v,m)=>$r(f,g,(p,y,C,w,P,E,x,T,k,N,L)=>{let z=p.pxRound,W=t,D=i*It,X=a*It,$=l*It,H,he;w.ori==0?[H,he]=r(f,g):[he,H]=r(f,g);let J=w.dir*(w.ori==0?1:-1),Q=w.ori==0?Iu:Fp,re=w.ori==0?h:(Pe,Je,ct,we,zt,Ge,Ze)=>{h(Pe,Je,ct,zt,we,Ze,Ge)},fe=At(f.bands,Rp).find(Pe=>Pe.series[0]==g),de=fe!=null?fe.dir:0,te=p.fillTo(f,g,p.min,p.max,de),ge=z(x(te,P,L,k)),ye,Ce,Me,Xe=N,lt=z(p.width*It),He=!1,mt=null,ut=null,ot=null,Qt=null;u!=null&&(lt==0||d!=null)&&(He=!0,mt=u.values(f,g,v,m),ut=new Map,new Set(mt).forEach(Pe=>{Pe!=null&&ut.set(Pe,new Path2D)}),lt>0&&(ot=d.values(f,g,v,m),Qt=new Map,new Set(ot).forEach(Pe=>{Pe!=null&&Qt.set(Pe,new Path2D)})));let{x0:Ht,size:pn}=c;if(Ht!=null&&pn!=null){W=1,y=Ht.values(f,g,v,m),Ht.unit==2&&(y=y.map(ct=>f.posToVal(T+ct*N,w.key,!0)));let Pe=pn.values(f,g,v,m);pn.unit==2?Ce=Pe[0]*N:Ce=E(Pe[0],w,N,T)-E(0,w,N,T),Xe=H_(y,C,E,w,N,T,Xe),Me=Xe-Ce+D}else Xe=H_(y,C,E,w,N,T,Xe),Me=Xe*o+D,Ce=Xe-Me;Me<1&&(Me=0),lt>=Ce/2&&(lt=0),Me<5&&(z=j_);let Bt=Me>0,Dn=Xe-Me-(Bt?lt:0);Ce=z(_p(Dn,$,X)),ye=(W==0?Ce/2:W==J?0:Ce)-W*J*((W==0?D/2:0)+(Bt?lt/2:0));let wt={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},Mn=He?null:new Path2D,sn=null;if(fe!=null)sn=f.data[fe.series[1]];else{let{y0:Pe,y1:Je}=c;Pe!=null&&Je!=null&&(C=Je.values(f,g,v,m),sn=Pe.values(f,g,v,m))}let mn=H*Ce,F=he*Ce;for(let Pe=J==1?v:m;Pe>=v&&Pe<=m;Pe+=J){let Je=C[Pe];if(Je==null)continue;if(sn!=null){let q=sn[Pe]??0;if(Je-q==0)continue;ge=x(q,P,L,k)}let ct=w.distr!=2||c!=null?y[Pe]:Pe,we=E(ct,w,N,T),zt=x(At(Je,te),P,L,k),Ge=z(we-ye),Ze=z(ai(zt,ge)),A=z(ji(zt,ge)),S=Ze-A;if(Je!=null){let q=Je<0?F:mn,ue=Je<0?mn:F;He?(lt>0&&ot[Pe]!=null&&Q(Qt.get(ot[Pe]),Ge,A+Ti(lt/2),Ce,ai(0,S-lt),q,ue),mt[Pe]!=null&&Q(ut.get(mt[Pe]),Ge,A+Ti(lt/2),Ce,ai(0,S-lt),q,ue)):Q(Mn,Ge,A+Ti(lt/2),Ce,ai(0,S-lt),q,ue),re(f,g,Pe,Ge-lt/2,A,Ce+lt,S)}}return lt>0?wt.stroke=He?Qt:Mn:He||(wt._fill=p.width==0?p._fill:p._stroke??p._fill,wt.width=0),wt.fill=He?ut:Mn,wt})}function MA(n,e){let t=At(e?.alignGaps,0);return(i,s,r,o)=>$r(i,s,(a,l,c,h,u,d,f,g,v,m,p)=>{[r,o]=wu(c,r,o);let y=a.pxRound,C=H=>y(d(H,h,m,g)),w=H=>y(f(H,u,p,v)),P,E,x;h.ori==0?(P=Ru,x=na,E=Tx):(P=Pu,x=ia,E=Ex);let T=h.dir*(h.ori==0?1:-1),k=C(l[T==1?r:o]),N=k,L=[],z=[];for(let H=T==1?r:o;H>=r&&H<=o;H+=T)if(c[H]!=null){let J=l[H],Q=C(J);L.push(N=Q),z.push(w(c[H]))}let W={stroke:n(L,z,P,x,E,y),fill:null,clip:null,band:null,gaps:null,flags:ea},D=W.stroke,[X,$]=Np(i,s);if(a.fill!=null||X!=0){let H=W.fill=new Path2D(D),he=a.fillTo(i,s,a.min,a.max,X),J=w(he);x(H,N,J),x(H,k,J)}if(!a.spanGaps){let H=[];H.push(...Up(l,c,r,o,T,C,t)),W.gaps=H=a.gaps(i,s,r,o,H),W.clip=Cu(H,h.ori,g,v,m,p)}return $!=0&&(W.band=$==2?[Vs(i,s,r,o,D,-1),Vs(i,s,r,o,D,1)]:Vs(i,s,r,o,D,$)),W})}function wA(n){return MA(TA,n)}function TA(n,e,t,i,s,r){let o=n.length;if(o<2)return null;let a=new Path2D;if(t(a,n[0],e[0]),o==2)i(a,n[1],e[1]);else{let l=Array(o),c=Array(o-1),h=Array(o-1),u=Array(o-1);for(let d=0;d<o-1;d++)h[d]=e[d+1]-e[d],u[d]=n[d+1]-n[d],c[d]=h[d]/u[d];l[0]=c[0];for(let d=1;d<o-1;d++)c[d]===0||c[d-1]===0||c[d-1]>0!=c[d]>0?l[d]=0:(l[d]=3*(u[d-1]+u[d])/((2*u[d]+u[d-1])/c[d-1]+(u[d]+2*u[d-1])/c[d]),isFinite(l[d])||(l[d]=0));l[o-1]=c[o-2];for(let d=0;d<o-1;d++)s(a,n[d]+u[d]/3,e[d]+l[d]*u[d]/3,n[d+1]-u[d]/3,e[d+1]-l[d+1]*u[d]/3,n[d+1],e[d+1])}return a}var Sp=new Set;function W_(){for(let n of Sp)n.syncRect(!0)}ta&&(qr(r1,Ko,W_),qr(o1,Ko,W_,!0),qr(Su,Ko,()=>{Wn.pxRatio=It}));var EA=Rx(),AA=Ax();function X_(n,e,t,i){return(i?[n[0],n[1]].concat(n.slice(2)):[n[0]].concat(n.slice(1))).map((r,o)=>bp(r,o,e,t))}function CA(n,e){return n.map((t,i)=>i==0?{}:bn({},e,t))}function bp(n,e,t,i){return bn({},e==0?t:i,n)}function Px(n,e,t){return e==null?jo:[e,t]}var RA=Px;function PA(n,e,t){return e==null?jo:bu(e,t,Ap,!0)}function Ix(n,e,t,i){return e==null?jo:Tu(e,t,n.scales[i].log,!1)}var IA=Ix;function Dx(n,e,t,i){return e==null?jo:Ep(e,t,n.scales[i].log,!1)}var DA=Dx;function LA(n,e,t,i,s){let r=ai(M_(n),M_(e)),o=e-n,a=Ji(s/i*o,t);do{let l=t[a],c=i*l/o;if(c>=s&&r+(l<5?xr.get(l):0)<=17)return[l,c]}while(++a<t.length);return[0,0]}function q_(n){let e,t;return n=n.replace(/(\d+)px/,(i,s)=>(e=Rn((t=+s)*It))+"px"),[n,e,t]}function NA(n){n.show&&[n.font,n.labelFont].forEach(e=>{let t=Gt(e[2]*It,1);e[0]=e[0].replace(/[0-9.]+px/,t+"px"),e[1]=t})}function Wn(n,e,t){let i={mode:At(n.mode,1)},s=i.mode;function r(_,b,R,I){let G=b.valToPct(_);return I+R*(b.dir==-1?1-G:G)}function o(_,b,R,I){let G=b.valToPct(_);return I+R*(b.dir==-1?G:1-G)}function a(_,b,R,I){return b.ori==0?r(_,b,R,I):o(_,b,R,I)}i.valToPosH=r,i.valToPosV=o;let l=!1;i.status=0;let c=i.root=Li(VE);if(n.id!=null&&(c.id=n.id),wi(c,n.class),n.title){let _=Li(WE,c);_.textContent=n.title}let h=Ki("canvas"),u=i.ctx=h.getContext("2d"),d=Li(XE,c);qr("click",d,_=>{_.target===g&&(Yt!=to||en!=no)&&Gn.click(i,_)},!0);let f=i.under=Li(qE,d);d.appendChild(h);let g=i.over=Li(YE,d);n=Qo(n);let v=+At(n.pxAlign,1),m=G_(v);(n.plugins||[]).forEach(_=>{_.opts&&(n=_.opts(i,n)||n)});let p=n.ms||.001,y=i.series=s==1?X_(n.series||[],U_,z_,!1):CA(n.series||[null],k_),C=i.axes=X_(n.axes||[],N_,O_,!0),w=i.scales={},P=i.bands=n.bands||[];P.forEach(_=>{_.fill=Mt(_.fill||null),_.dir=At(_.dir,-1)});let E=s==2?y[1].facets[0].scale:y[0].scale,x={axes:bs,series:_t},T=(n.drawOrder||["axes","series"]).map(_=>x[_]);function k(_){let b=_.distr==3?R=>zs(R>0?R:_.clamp(i,R,_.min,_.max,_.key)):_.distr==4?R=>cp(R,_.asinh):_.distr==100?R=>_.fwd(R):R=>R;return R=>{let I=b(R),{_min:G,_max:K}=_,le=K-G;return(I-G)/le}}function N(_){let b=w[_];if(b==null){let R=(n.scales||Pl)[_]||Pl;if(R.from!=null){N(R.from);let I=bn({},w[R.from],R,{key:_});I.valToPct=k(I),w[_]=I}else{b=w[_]=bn({},_==E?vx:gA,R),b.key=_;let I=b.time,G=b.range,K=_r(G);if((_!=E||s==2&&!I)&&(K&&(G[0]==null||G[1]==null)&&(G={min:G[0]==null?v_:{mode:1,hard:G[0],soft:G[0]},max:G[1]==null?v_:{mode:1,hard:G[1],soft:G[1]}},K=!1),!K&&Au(G))){let le=G;G=(pe,Se,Ne)=>Se==null?jo:bu(Se,Ne,le)}b.range=Mt(G||(I?RA:_==E?b.distr==3?IA:b.distr==4?DA:Px:b.distr==3?Ix:b.distr==4?Dx:PA)),b.auto=Mt(K?!1:b.auto),b.clamp=Mt(b.clamp||mA),b._min=b._max=null,b.valToPct=k(b)}}}N("x"),N("y"),s==1&&y.forEach(_=>{N(_.scale)}),C.forEach(_=>{N(_.scale)});for(let _ in n.scales)N(_);let L=w[E],z=L.distr,W,D;L.ori==0?(wi(c,GE),W=r,D=o):(wi(c,HE),W=o,D=r);let X={};for(let _ in w){let b=w[_];(b.min!=null||b.max!=null)&&(X[_]={min:b.min,max:b.max},b.min=b.max=null)}let $=n.tzDate||(_=>new Date(Rn(_/p))),H=n.fmtDate||Pp,he=p==1?G1($):X1($),J=I_($,P_(p==1?V1:W1,H)),Q=L_($,D_(Y1,H)),re=[],fe=i.legend=bn({},K1,n.legend),de=i.cursor=bn({},nA,{drag:{y:s==2}},n.cursor),te=fe.show,ge=de.show,ye=fe.markers;fe.idxs=re,ye.width=Mt(ye.width),ye.dash=Mt(ye.dash),ye.stroke=Mt(ye.stroke),ye.fill=Mt(ye.fill);let Ce,Me,Xe,lt=[],He=[],mt,ut=!1,ot={};if(fe.live){let _=y[1]?y[1].values:null;ut=_!=null,mt=ut?_(i,1,0):{_:0};for(let b in mt)ot[b]=wp}if(te)if(Ce=Ki("table",QE,c),Xe=Ki("tbody",null,Ce),fe.mount(i,Ce),ut){Me=Ki("thead",null,Ce,Xe);let _=Ki("tr",null,Me);Ki("th",null,_);for(var Qt in mt)Ki("th",a_,_).textContent=Qt}else wi(Ce,t1),fe.live&&wi(Ce,e1);let Ht={show:!0},pn={show:!1};function Bt(_,b){if(b==0&&(ut||!fe.live||s==2))return jo;let R=[],I=Ki("tr",n1,Xe,Xe.childNodes[b]);wi(I,_.class),_.show||wi(I,Xr);let G=Ki("th",null,I);if(ye.show){let pe=Li(i1,G);if(b>0){let Se=ye.width(i,b);Se&&(pe.style.border=Se+"px "+ye.dash(i,b)+" "+ye.stroke(i,b)),pe.style.background=ye.fill(i,b)}}let K=Li(a_,G);_.label instanceof HTMLElement?K.appendChild(_.label):K.textContent=_.label,b>0&&(ye.show||(K.style.color=_.width>0?ye.stroke(i,b):ye.fill(i,b)),wt("click",G,pe=>{if(de._lock)return;et(pe);let Se=y.indexOf(_);if((pe.ctrlKey||pe.metaKey)!=fe.isolate){let Ne=y.some((Ue,Be)=>Be>0&&Be!=Se&&Ue.show);y.forEach((Ue,Be)=>{Be>0&&is(Be,Ne?Be==Se?Ht:pn:Ht,!0,yn.setSeries)})}else is(Se,{show:!_.show},!0,yn.setSeries)},!1),tt&&wt(u_,G,pe=>{de._lock||(et(pe),is(y.indexOf(_),so,!0,yn.setSeries))},!1));for(var le in mt){let pe=Ki("td",s1,I);pe.textContent="--",R.push(pe)}return[I,R]}let Dn=new Map;function wt(_,b,R,I=!0){let G=Dn.get(b)||{},K=de.bind[_](i,b,R,I);K&&(qr(_,b,G[_]=K),Dn.set(b,G))}function Mn(_,b,R){let I=Dn.get(b)||{};for(let G in I)(_==null||G==_)&&(gp(G,b,I[G]),delete I[G]);_==null&&Dn.delete(b)}let sn=0,mn=0,F=0,Pe=0,Je=0,ct=0,we=Je,zt=ct,Ge=F,Ze=Pe,A=0,S=0,q=0,ue=0;i.bbox={};let ae=!1,xe=!1,ve=!1,ne=!1,se=!1,me=!1;function U(_,b,R){(R||_!=i.width||b!=i.height)&&oe(_,b),dt(!1),ve=!0,xe=!0,Xn()}function oe(_,b){i.width=sn=F=_,i.height=mn=Pe=b,Je=ct=0,be(),We();let R=i.bbox;A=R.left=Hr(Je*It,.5),S=R.top=Hr(ct*It,.5),q=R.width=Hr(F*It,.5),ue=R.height=Hr(Pe*It,.5)}let ie=3;function Te(){let _=!1,b=0;for(;!_;){b++;let R=jr(b),I=ns(b);_=b==ie||R&&I,_||(oe(i.width,i.height),xe=!0)}}function _e({width:_,height:b}){U(_,b)}i.setSize=_e;function be(){let _=!1,b=!1,R=!1,I=!1;C.forEach((G,K)=>{if(G.show&&G._show){let{side:le,_size:pe}=G,Se=le%2,Ne=G.label!=null?G.labelSize:0,Ue=pe+Ne;Ue>0&&(Se?(F-=Ue,le==3?(Je+=Ue,I=!0):R=!0):(Pe-=Ue,le==0?(ct+=Ue,_=!0):b=!0))}}),es[0]=_,es[1]=R,es[2]=b,es[3]=I,F-=Ui[1]+Ui[3],Je+=Ui[3],Pe-=Ui[2]+Ui[0],ct+=Ui[0]}function We(){let _=Je+F,b=ct+Pe,R=Je,I=ct;function G(K,le){switch(K){case 1:return _+=le,_-le;case 2:return b+=le,b-le;case 3:return R-=le,R+le;case 0:return I-=le,I+le}}C.forEach((K,le)=>{if(K.show&&K._show){let pe=K.side;K._pos=G(pe,K._size),K.label!=null&&(K._lpos=G(pe,K.labelSize))}})}if(de.dataIdx==null){let _=de.hover,b=_.skip=new Set(_.skip??[]);b.add(void 0);let R=_.prox=Mt(_.prox),I=_.bias??=0;de.dataIdx=(G,K,le,pe)=>{if(K==0)return le;let Se=le,Ne=R(G,K,le,pe)??Vt,Ue=Ne>=0&&Ne<Vt,Be=L.ori==0?F:Pe,at=de.left,Ct=e[0],Et=e[K];if(b.has(Et[le])){Se=null;let yt=null,Qe=null,qe;if(I==0||I==-1)for(qe=le;yt==null&&qe-- >0;)b.has(Et[qe])||(yt=qe);if(I==0||I==1)for(qe=le;Qe==null&&qe++<Et.length;)b.has(Et[qe])||(Qe=qe);if(yt!=null||Qe!=null)if(Ue){let Zt=yt==null?-1/0:W(Ct[yt],L,Be,0),an=Qe==null?1/0:W(Ct[Qe],L,Be,0),Fn=at-Zt,kt=an-at;Fn<=kt?Fn<=Ne&&(Se=yt):kt<=Ne&&(Se=Qe)}else Se=Qe==null?yt:yt==null?Qe:le-yt<=Qe-le?yt:Qe}else Ue&&Pn(at-W(Ct[le],L,Be,0))>Ne&&(Se=null);return Se}}let et=_=>{de.event=_};de.idxs=re,de._lock=!1;let ce=de.points;ce.show=Mt(ce.show),ce.size=Mt(ce.size),ce.stroke=Mt(ce.stroke),ce.width=Mt(ce.width),ce.fill=Mt(ce.fill);let ke=i.focus=bn({},n.focus||{alpha:.3},de.focus),tt=ke.prox>=0,Re=tt&&ce.one,ht=[],qt=[],Zn=[];function oa(_,b){let R=ce.show(i,b);if(R instanceof HTMLElement)return wi(R,jE),wi(R,_.class),xs(R,-10,-10,F,Pe),g.insertBefore(R,ht[b]),R}function Zr(_,b){if(s==1||b>0){let R=s==1&&w[_.scale].time,I=_.value;_.value=R?E_(I)?L_($,D_(I,H)):I||Q:I||dA,_.label=_.label||(R?sA:iA)}if(Re||b>0){_.width=_.width==null?1:_.width,_.paths=_.paths||EA||g1,_.fillTo=Mt(_.fillTo||_A),_.pxAlign=+At(_.pxAlign,v),_.pxRound=G_(_.pxAlign),_.stroke=Mt(_.stroke||null),_.fill=Mt(_.fill||null),_._stroke=_._fill=_._paths=_._focus=null;let R=fA(ai(1,_.width),1),I=_.points=bn({},{size:R,width:ai(1,R*.2),stroke:_.stroke,space:R*2,paths:AA,_stroke:null,_fill:null},_.points);I.show=Mt(I.show),I.filter=Mt(I.filter),I.fill=Mt(I.fill),I.stroke=Mt(I.stroke),I.paths=Mt(I.paths),I.pxAlign=_.pxAlign}if(te){let R=Bt(_,b);lt.splice(b,0,R[0]),He.splice(b,0,R[1]),fe.values.push(null)}if(ge){re.splice(b,0,null);let R=null;Re?b==0&&(R=oa(_,b)):b>0&&(R=oa(_,b)),ht.splice(b,0,R),qt.splice(b,0,0),Zn.splice(b,0,0)}Un("addSeries",b)}function Ku(_,b){b=b??y.length,_=s==1?bp(_,b,U_,z_):bp(_,b,{},k_),y.splice(b,0,_),Zr(y[b],b)}i.addSeries=Ku;function Ol(_){if(y.splice(_,1),te){fe.values.splice(_,1),He.splice(_,1);let b=lt.splice(_,1)[0];Mn(null,b.firstChild),b.remove()}ge&&(re.splice(_,1),ht.splice(_,1)[0].remove(),qt.splice(_,1),Zn.splice(_,1)),Un("delSeries",_)}i.delSeries=Ol;let es=[!1,!1,!1,!1];function ys(_,b){if(_._show=_.show,_.show){let R=_.side%2,I=w[_.scale];I==null&&(_.scale=R?y[1].scale:E,I=w[_.scale]);let G=I.time;_.size=Mt(_.size),_.space=Mt(_.space),_.rotate=Mt(_.rotate),_r(_.incrs)&&_.incrs.forEach(le=>{!xr.has(le)&&xr.set(le,tx(le))}),_.incrs=Mt(_.incrs||(I.distr==2?B1:G?p==1?z1:H1:Wr)),_.splits=Mt(_.splits||(G&&I.distr==1?he:I.distr==3?xp:I.distr==4?aA:oA)),_.stroke=Mt(_.stroke),_.grid.stroke=Mt(_.grid.stroke),_.ticks.stroke=Mt(_.ticks.stroke),_.border.stroke=Mt(_.border.stroke);let K=_.values;_.values=_r(K)&&!_r(K[0])?Mt(K):G?_r(K)?I_($,P_(K,H)):E_(K)?q1($,K):K||J:K||rA,_.filter=Mt(_.filter||(I.distr>=3&&I.log==10?hA:I.distr==3&&I.log==2?uA:Q_)),_.font=q_(_.font),_.labelFont=q_(_.labelFont),_._size=_.size(i,null,b,0),_._space=_._rotate=_._incrs=_._found=_._splits=_._values=null,_._size>0&&(es[b]=!0,_._el=Li($E,d))}}function vs(_,b,R,I){let[G,K,le,pe]=R,Se=b%2,Ne=0;return Se==0&&(pe||K)&&(Ne=b==0&&!G||b==2&&!le?Rn(N_.size/3):0),Se==1&&(G||le)&&(Ne=b==1&&!K||b==3&&!pe?Rn(O_.size/2):0),Ne}let aa=i.padding=(n.padding||[vs,vs,vs,vs]).map(_=>Mt(At(_,vs))),Ui=i._padding=aa.map((_,b)=>_(i,b,es,0)),rn,dn=null,fn=null,ts=s==1?y[0].idxs:null,di=null,Xs=!1;function la(_,b){if(e=_??[],i.data=i._data=e,s==2){rn=0;for(let R=1;R<y.length;R++)rn+=e[R][0].length}else{e.length==0&&(i.data=i._data=e=[[]]),di=e[0],rn=di.length;let R=e;if(z==2){R=e.slice();let I=R[0]=Array(rn);for(let G=0;G<rn;G++)I[G]=G}i._data=e=R}if(dt(!0),Un("setData"),z==2&&(ve=!0),b!==!1){let R=L;R.auto(i,Xs)?ca():$s(E,R.min,R.max),ne=ne||de.left>=0,me=!0,Xn()}}i.setData=la;function ca(){Xs=!0;let _,b;s==1&&(rn>0?(dn=ts[0]=0,fn=ts[1]=rn-1,_=e[0][dn],b=e[0][fn],z==2?(_=dn,b=fn):_==b&&(z==3?[_,b]=Tu(_,_,L.log,!1):z==4?[_,b]=Ep(_,_,L.log,!1):L.time?b=_+Rn(86400/p):[_,b]=bu(_,b,Ap,!0))):(dn=ts[0]=_=null,fn=ts[1]=b=null)),$s(E,_,b)}let Kr,qs,Jr,M,O,j,Y,Z,Ee,Ie;function Ae(_,b,R,I,G,K){_??=c_,R??=Rp,I??="butt",G??=c_,K??="round",_!=Kr&&(u.strokeStyle=Kr=_),G!=qs&&(u.fillStyle=qs=G),b!=Jr&&(u.lineWidth=Jr=b),K!=O&&(u.lineJoin=O=K),I!=j&&(u.lineCap=j=I),R!=M&&u.setLineDash(M=R)}function De(_,b,R,I){b!=qs&&(u.fillStyle=qs=b),_!=Y&&(u.font=Y=_),R!=Z&&(u.textAlign=Z=R),I!=Ee&&(u.textBaseline=Ee=I)}function Ve(_,b,R,I,G=0){if(I.length>0&&_.auto(i,Xs)&&(b==null||b.min==null)){let K=At(dn,0),le=At(fn,I.length-1),pe=R.min==null?h1(I,K,le,G,_.distr==3):[R.min,R.max];_.min=ji(_.min,R.min=pe[0]),_.max=ai(_.max,R.max=pe[1])}}let rt={min:null,max:null};function gt(){for(let I in w){let G=w[I];X[I]==null&&(G.min==null||X[E]!=null&&G.auto(i,Xs))&&(X[I]=rt)}for(let I in w){let G=w[I];X[I]==null&&G.from!=null&&X[G.from]!=null&&(X[I]=rt)}X[E]!=null&&dt(!0);let _={};for(let I in X){let G=X[I];if(G!=null){let K=_[I]=Qo(w[I],y1);if(G.min!=null)bn(K,G);else if(I!=E||s==2)if(rn==0&&K.from==null){let le=K.range(i,null,null,I);K.min=le[0],K.max=le[1]}else K.min=Vt,K.max=-Vt}}if(rn>0){y.forEach((I,G)=>{if(s==1){let K=I.scale,le=X[K];if(le==null)return;let pe=_[K];if(G==0){let Se=pe.range(i,pe.min,pe.max,K);pe.min=Se[0],pe.max=Se[1],dn=Ji(pe.min,e[0]),fn=Ji(pe.max,e[0]),fn-dn>1&&(e[0][dn]<pe.min&&dn++,e[0][fn]>pe.max&&fn--),I.min=di[dn],I.max=di[fn]}else I.show&&I.auto&&Ve(pe,le,I,e[G],I.sorted);I.idxs[0]=dn,I.idxs[1]=fn}else if(G>0&&I.show&&I.auto){let[K,le]=I.facets,pe=K.scale,Se=le.scale,[Ne,Ue]=e[G],Be=_[pe],at=_[Se];Be!=null&&Ve(Be,X[pe],K,Ne,K.sorted),at!=null&&Ve(at,X[Se],le,Ue,le.sorted),I.min=le.min,I.max=le.max}});for(let I in _){let G=_[I],K=X[I];if(G.from==null&&(K==null||K.min==null)){let le=G.range(i,G.min==Vt?null:G.min,G.max==-Vt?null:G.max,I);G.min=le[0],G.max=le[1]}}}for(let I in _){let G=_[I];if(G.from!=null){let K=_[G.from];if(K.min==null)G.min=G.max=null;else{let le=G.range(i,K.min,K.max,I);G.min=le[0],G.max=le[1]}}}let b={},R=!1;for(let I in _){let G=_[I],K=w[I];if(K.min!=G.min||K.max!=G.max){K.min=G.min,K.max=G.max;let le=K.distr;K._min=le==3?zs(K.min):le==4?cp(K.min,K.asinh):le==100?K.fwd(K.min):K.min,K._max=le==3?zs(K.max):le==4?cp(K.max,K.asinh):le==100?K.fwd(K.max):K.max,b[I]=R=!0}}if(R){y.forEach((I,G)=>{s==2?G>0&&b.y&&(I._paths=null):b[I.scale]&&(I._paths=null)});for(let I in b)ve=!0,Un("setScale",I);ge&&de.left>=0&&(ne=me=!0)}for(let I in X)X[I]=null}function ze(_){let b=_p(dn-1,0,rn-1),R=_p(fn+1,0,rn-1);for(;_[b]==null&&b>0;)b--;for(;_[R]==null&&R<rn-1;)R++;return[b,R]}function _t(){if(rn>0){let _=y.some(b=>b._focus)&&Ie!=ke.alpha;_&&(u.globalAlpha=Ie=ke.alpha),y.forEach((b,R)=>{if(R>0&&b.show&&(nn(R,!1),nn(R,!0),b._paths==null)){let I=Ie;Ie!=b.alpha&&(u.globalAlpha=Ie=b.alpha);let G=s==2?[0,e[R][0].length-1]:ze(e[R]);b._paths=b.paths(i,R,G[0],G[1]),Ie!=I&&(u.globalAlpha=Ie=I)}}),y.forEach((b,R)=>{if(R>0&&b.show){let I=Ie;Ie!=b.alpha&&(u.globalAlpha=Ie=b.alpha),b._paths!=null&&Ut(R,!1);{let G=b._paths!=null?b._paths.gaps:null,K=b.points.show(i,R,dn,fn,G),le=b.points.filter(i,R,K,G);(K||le)&&(b.points._paths=b.points.paths(i,R,dn,fn,le),Ut(R,!0))}Ie!=I&&(u.globalAlpha=Ie=I),Un("drawSeries",R)}}),_&&(u.globalAlpha=Ie=1)}}function nn(_,b){let R=b?y[_].points:y[_];R._stroke=R.stroke(i,_),R._fill=R.fill(i,_)}function Ut(_,b){let R=b?y[_].points:y[_],{stroke:I,fill:G,clip:K,flags:le,_stroke:pe=R._stroke,_fill:Se=R._fill,_width:Ne=R.width}=R._paths;Ne=Gt(Ne*It,3);let Ue=null,Be=Ne%2/2;b&&Se==null&&(Se=Ne>0?"#fff":pe);let at=R.pxAlign==1&&Be>0;if(at&&u.translate(Be,Be),!b){let Ct=A-Ne/2,Et=S-Ne/2,yt=q+Ne,Qe=ue+Ne;Ue=new Path2D,Ue.rect(Ct,Et,yt,Qe)}b?Fe(pe,Ne,R.dash,R.cap,Se,I,G,le,K):Ft(_,pe,Ne,R.dash,R.cap,Se,I,G,le,Ue,K),at&&u.translate(-Be,-Be)}function Ft(_,b,R,I,G,K,le,pe,Se,Ne,Ue){let Be=!1;Se!=0&&P.forEach((at,Ct)=>{if(at.series[0]==_){let Et=y[at.series[1]],yt=e[at.series[1]],Qe=(Et._paths||Pl).band;_r(Qe)&&(Qe=at.dir==1?Qe[0]:Qe[1]);let qe,Zt=null;Et.show&&Qe&&d1(yt,dn,fn)?(Zt=at.fill(i,Ct)||K,qe=Et._paths.clip):Qe=null,Fe(b,R,I,G,Zt,le,pe,Se,Ne,Ue,qe,Qe),Be=!0}}),Be||Fe(b,R,I,G,K,le,pe,Se,Ne,Ue)}let wn=ea|vp;function Fe(_,b,R,I,G,K,le,pe,Se,Ne,Ue,Be){Ae(_,b,R,I,G),(Se||Ne||Be)&&(u.save(),Se&&u.clip(Se),Ne&&u.clip(Ne)),Be?(pe&wn)==wn?(u.clip(Be),Ue&&u.clip(Ue),vt(G,le),gn(_,K,b)):pe&vp?(vt(G,le),u.clip(Be),gn(_,K,b)):pe&ea&&(u.save(),u.clip(Be),Ue&&u.clip(Ue),vt(G,le),u.restore(),gn(_,K,b)):(vt(G,le),gn(_,K,b)),(Se||Ne||Be)&&u.restore()}function gn(_,b,R){R>0&&(b instanceof Map?b.forEach((I,G)=>{u.strokeStyle=Kr=G,u.stroke(I)}):b!=null&&_&&u.stroke(b))}function vt(_,b){b instanceof Map?b.forEach((R,I)=>{u.fillStyle=qs=I,u.fill(R)}):b!=null&&_&&u.fill(b)}function Ss(_,b,R,I){let G=C[_],K;if(I<=0)K=[0,0];else{let le=G._space=G.space(i,_,b,R,I),pe=G._incrs=G.incrs(i,_,b,R,I,le);K=LA(b,R,pe,I,le)}return G._found=K}function _n(_,b,R,I,G,K,le,pe,Se,Ne){let Ue=le%2/2;v==1&&u.translate(Ue,Ue),Ae(pe,le,Se,Ne,pe),u.beginPath();let Be,at,Ct,Et,yt=G+(I==0||I==3?-K:K);R==0?(at=G,Et=yt):(Be=G,Ct=yt);for(let Qe=0;Qe<_.length;Qe++)b[Qe]!=null&&(R==0?Be=Ct=_[Qe]:at=Et=_[Qe],u.moveTo(Be,at),u.lineTo(Ct,Et));u.stroke(),v==1&&u.translate(-Ue,-Ue)}function jr(_){let b=!0;return C.forEach((R,I)=>{if(!R.show)return;let G=w[R.scale];if(G.min==null){R._show&&(b=!1,R._show=!1,dt(!1));return}else R._show||(b=!1,R._show=!0,dt(!1));let K=R.side,le=K%2,{min:pe,max:Se}=G,[Ne,Ue]=Ss(I,pe,Se,le==0?F:Pe);if(Ue==0)return;let Be=G.distr==2,at=R._splits=R.splits(i,I,pe,Se,Ne,Ue,Be),Ct=G.distr==2?at.map(qe=>di[qe]):at,Et=G.distr==2?di[at[1]]-di[at[0]]:Ne,yt=R._values=R.values(i,R.filter(i,Ct,I,Ue,Et),I,Ue,Et);R._rotate=K==2?R.rotate(i,yt,I,Ue):0;let Qe=R._size;R._size=Ni(R.size(i,yt,I,_)),Qe!=null&&R._size!=Qe&&(b=!1)}),b}function ns(_){let b=!0;return aa.forEach((R,I)=>{let G=R(i,I,es,_);G!=Ui[I]&&(b=!1),Ui[I]=G}),b}function bs(){for(let _=0;_<C.length;_++){let b=C[_];if(!b.show||!b._show)continue;let R=b.side,I=R%2,G,K,le=b.stroke(i,_),pe=R==0||R==3?-1:1,[Se,Ne]=b._found;if(b.label!=null){let jn=b.labelGap*pe,mi=Rn((b._lpos+jn)*It);De(b.labelFont[0],le,"center",R==2?"top":l_),u.save(),I==1?(G=K=0,u.translate(mi,Rn(S+ue/2)),u.rotate((R==3?-vu:vu)/2)):(G=Rn(A+q/2),K=mi);let br=J_(b.label)?b.label(i,_,Se,Ne):b.label;u.fillText(br,G,K),u.restore()}if(Ne==0)continue;let Ue=w[b.scale],Be=I==0?q:ue,at=I==0?A:S,Ct=b._splits,Et=Ue.distr==2?Ct.map(jn=>di[jn]):Ct,yt=Ue.distr==2?di[Ct[1]]-di[Ct[0]]:Se,Qe=b.ticks,qe=b.border,Zt=Qe.show?Qe.size:0,an=Rn(Zt*It),Fn=Rn((b.alignTo==2?b._size-Zt-b.gap:b.gap)*It),kt=b._rotate*-vu/180,ln=m(b._pos*It),fi=(an+Fn)*pe,Jn=ln+fi;K=I==0?Jn:0,G=I==1?Jn:0;let Ai=b.font[0],Fi=b.align==1?$o:b.align==2?op:kt>0?$o:kt<0?op:I==0?"center":R==3?op:$o,rs=kt||I==1?"middle":R==2?"top":l_;De(Ai,le,Fi,rs);let pi=b.font[1]*b.lineGap,Ci=Ct.map(jn=>m(a(jn,Ue,Be,at))),Oi=b._values;for(let jn=0;jn<Oi.length;jn++){let mi=Oi[jn];if(mi!=null){I==0?G=Ci[jn]:K=Ci[jn],mi=""+mi;let br=mi.indexOf(`
`)==-1?[mi]:mi.split(/\n/gm);for(let Qn=0;Qn<br.length;Qn++){let am=br[Qn];kt?(u.save(),u.translate(G,K+Qn*pi),u.rotate(kt),u.fillText(am,0,0),u.restore()):u.fillText(am,G,K+Qn*pi)}}}Qe.show&&_n(Ci,Qe.filter(i,Et,_,Ne,yt),I,R,ln,an,Gt(Qe.width*It,3),Qe.stroke(i,_),Qe.dash,Qe.cap);let os=b.grid;os.show&&_n(Ci,os.filter(i,Et,_,Ne,yt),I,I==0?2:1,I==0?S:A,I==0?ue:q,Gt(os.width*It,3),os.stroke(i,_),os.dash,os.cap),qe.show&&_n([ln],[1],I==0?1:0,I==0?1:2,I==1?S:A,I==1?ue:q,Gt(qe.width*It,3),qe.stroke(i,_),qe.dash,qe.cap)}Un("drawAxes")}function dt(_){y.forEach((b,R)=>{R>0&&(b._paths=null,_&&(s==1?(b.min=null,b.max=null):b.facets.forEach(I=>{I.min=null,I.max=null})))})}let on=!1,Kn=!1,Ot=[];function xn(){Kn=!1;for(let _=0;_<Ot.length;_++)Un(...Ot[_]);Ot.length=0}function Xn(){on||(E1(Hp),on=!0)}function Bl(_,b=!1){on=!0,Kn=b,_(i),Hp(),b&&Ot.length>0&&queueMicrotask(xn)}i.batch=Bl;function Hp(){if(ae&&(gt(),ae=!1),ve&&(Te(),ve=!1),xe){if(jt(f,$o,Je),jt(f,"top",ct),jt(f,El,F),jt(f,Al,Pe),jt(g,$o,Je),jt(g,"top",ct),jt(g,El,F),jt(g,Al,Pe),jt(d,El,sn),jt(d,Al,mn),h.width=Rn(sn*It),h.height=Rn(mn*It),C.forEach(({_el:_,_show:b,_size:R,_pos:I,side:G})=>{if(_!=null)if(b){let K=G===3||G===0?R:0,le=G%2==1;jt(_,le?"left":"top",I-K),jt(_,le?"width":"height",R),jt(_,le?"top":"left",le?ct:Je),jt(_,le?"height":"width",le?Pe:F),mp(_,Xr)}else wi(_,Xr)}),Kr=qs=Jr=O=j=Y=Z=Ee=M=null,Ie=1,da(!0),Je!=we||ct!=zt||F!=Ge||Pe!=Ze){dt(!1);let _=F/Ge,b=Pe/Ze;if(ge&&!ne&&de.left>=0){de.left*=_,de.top*=b,Qr&&xs(Qr,Rn(de.left),0,F,Pe),eo&&xs(eo,0,Rn(de.top),F,Pe);for(let R=0;R<ht.length;R++){let I=ht[R];I!=null&&(qt[R]*=_,Zn[R]*=b,xs(I,Ni(qt[R]),Ni(Zn[R]),F,Pe))}}if($t.show&&!se&&$t.left>=0&&$t.width>0){$t.left*=_,$t.width*=_,$t.top*=b,$t.height*=b;for(let R in nd)jt(io,R,$t[R])}we=Je,zt=ct,Ge=F,Ze=Pe}Un("setSize"),xe=!1}sn>0&&mn>0&&(u.clearRect(0,0,h.width,h.height),Un("drawClear"),T.forEach(_=>_()),Un("draw")),$t.show&&se&&(kl($t),se=!1),ge&&ne&&(Sr(null,!0,!1),ne=!1),fe.show&&fe.live&&me&&(ed(),me=!1),l||(l=!0,i.status=1,Un("ready")),Xs=!1,on=!1}i.redraw=(_,b)=>{ve=b||!1,_!==!1?$s(E,L.min,L.max):Xn()};function Ju(_,b){let R=w[_];if(R.from==null){if(rn==0){let I=R.range(i,b.min,b.max,_);b.min=I[0],b.max=I[1]}if(b.min>b.max){let I=b.min;b.min=b.max,b.max=I}if(rn>1&&b.min!=null&&b.max!=null&&b.max-b.min<1e-16)return;_==E&&R.distr==2&&rn>0&&(b.min=Ji(b.min,e[0]),b.max=Ji(b.max,e[0]),b.min==b.max&&b.max++),X[_]=b,ae=!0,Xn()}}i.setScale=Ju;let ju,Qu,Qr,eo,Wp,Xp,to,no,qp,Yp,Yt,en,Ys=!1,Gn=de.drag,Ln=Gn.x,Nn=Gn.y;ge&&(de.x&&(ju=Li(KE,g)),de.y&&(Qu=Li(JE,g)),L.ori==0?(Qr=ju,eo=Qu):(Qr=Qu,eo=ju),Yt=de.left,en=de.top);let $t=i.select=bn({show:!0,over:!0,left:0,width:0,top:0,height:0},n.select),io=$t.show?Li(ZE,$t.over?g:f):null;function kl(_,b){if($t.show){for(let R in _)$t[R]=_[R],R in nd&&jt(io,R,_[R]);b!==!1&&Un("setSelect")}}i.setSelect=kl;function Jx(_){if(y[_].show)te&&mp(lt[_],Xr);else if(te&&wi(lt[_],Xr),ge){let R=Re?ht[0]:ht[_];R!=null&&xs(R,-10,-10,F,Pe)}}function $s(_,b,R){Ju(_,{min:b,max:R})}function is(_,b,R,I){b.focus!=null&&ny(_),b.show!=null&&y.forEach((G,K)=>{K>0&&(_==K||_==null)&&(G.show=b.show,Jx(K),s==2?($s(G.facets[0].scale,null,null),$s(G.facets[1].scale,null,null)):$s(G.scale,null,null),Xn())}),R!==!1&&Un("setSeries",_,b),I&&fa("setSeries",i,_,b)}i.setSeries=is;function jx(_,b){bn(P[_],b)}function Qx(_,b){_.fill=Mt(_.fill||null),_.dir=At(_.dir,-1),b=b??P.length,P.splice(b,0,_)}function ey(_){_==null?P.length=0:P.splice(_,1)}i.addBand=Qx,i.setBand=jx,i.delBand=ey;function ty(_,b){y[_].alpha=b,ge&&ht[_]!=null&&(ht[_].style.opacity=b),te&&lt[_]&&(lt[_].style.opacity=b)}let Ms,Zs,vr,so={focus:!0};function ny(_){if(_!=vr){let b=_==null,R=ke.alpha!=1;y.forEach((I,G)=>{if(s==1||G>0){let K=b||G==0||G==_;I._focus=b?null:K,R&&ty(G,K?1:ke.alpha)}}),vr=_,R&&Xn()}}te&&tt&&wt(d_,Ce,_=>{de._lock||(et(_),vr!=null&&is(null,so,!0,yn.setSeries))});function ss(_,b,R){let I=w[b];R&&(_=_/It-(I.ori==1?ct:Je));let G=F;I.ori==1&&(G=Pe,_=G-_),I.dir==-1&&(_=G-_);let K=I._min,le=I._max,pe=_/G,Se=K+(le-K)*pe,Ne=I.distr;return Ne==3?Jo(10,Se):Ne==4?p1(Se,I.asinh):Ne==100?I.bwd(Se):Se}function iy(_,b){let R=ss(_,E,b);return Ji(R,e[0],dn,fn)}i.valToIdx=_=>Ji(_,e[0]),i.posToIdx=iy,i.posToVal=ss,i.valToPos=(_,b,R)=>w[b].ori==0?r(_,w[b],R?q:F,R?A:0):o(_,w[b],R?ue:Pe,R?S:0),i.setCursor=(_,b,R)=>{Yt=_.left,en=_.top,Sr(null,b,R)};function $p(_,b){jt(io,$o,$t.left=_),jt(io,El,$t.width=b)}function Zp(_,b){jt(io,"top",$t.top=_),jt(io,Al,$t.height=b)}let ha=L.ori==0?$p:Zp,ua=L.ori==1?$p:Zp;function sy(){if(te&&fe.live)for(let _=s==2?1:0;_<y.length;_++){if(_==0&&ut)continue;let b=fe.values[_],R=0;for(let I in b)He[_][R++].firstChild.nodeValue=b[I]}}function ed(_,b){if(_!=null&&(_.idxs?_.idxs.forEach((R,I)=>{re[I]=R}):x1(_.idx)||re.fill(_.idx),fe.idx=re[0]),te&&fe.live){for(let R=0;R<y.length;R++)(R>0||s==1&&!ut)&&ry(R,re[R]);sy()}me=!1,b!==!1&&Un("setLegend")}i.setLegend=ed;function ry(_,b){let R=y[_],I=_==0&&z==2?di:e[_],G;ut?G=R.values(i,_,b)??ot:(G=R.value(i,b==null?null:I[b],_,b),G=G==null?ot:{_:G}),fe.values[_]=G}function Sr(_,b,R){qp=Yt,Yp=en,[Yt,en]=de.move(i,Yt,en),de.left=Yt,de.top=en,ge&&(Qr&&xs(Qr,Rn(Yt),0,F,Pe),eo&&xs(eo,0,Rn(en),F,Pe));let I,G=dn>fn;Ms=Vt,Zs=null;let K=L.ori==0?F:Pe,le=L.ori==1?F:Pe;if(Yt<0||rn==0||G){I=de.idx=null;for(let pe=0;pe<y.length;pe++){let Se=ht[pe];Se!=null&&xs(Se,-10,-10,F,Pe)}tt&&is(null,so,!0,_==null&&yn.setSeries),fe.live&&(re.fill(I),me=!0)}else{let pe,Se,Ne;s==1&&(pe=L.ori==0?Yt:en,Se=ss(pe,E),I=de.idx=Ji(Se,e[0],dn,fn),Ne=W(e[0][I],L,K,0));let Ue=-10,Be=-10,at=0,Ct=0,Et=!0,yt="",Qe="";for(let qe=s==2?1:0;qe<y.length;qe++){let Zt=y[qe],an=re[qe],Fn=an==null?null:s==1?e[qe][an]:e[qe][1][an],kt=de.dataIdx(i,qe,I,Se),ln=kt==null?null:s==1?e[qe][kt]:e[qe][1][kt];if(me=me||ln!=Fn||kt!=an,re[qe]=kt,qe>0&&Zt.show){let fi=kt==null?-10:kt==I?Ne:W(s==1?e[0][kt]:e[qe][0][kt],L,K,0),Jn=ln==null?-10:D(ln,s==1?w[Zt.scale]:w[Zt.facets[1].scale],le,0);if(tt&&ln!=null){let Ai=L.ori==1?Yt:en,Fi=Pn(ke.dist(i,qe,kt,Jn,Ai));if(Fi<Ms){let rs=ke.bias;if(rs!=0){let pi=ss(Ai,Zt.scale),Ci=ln>=0?1:-1,Oi=pi>=0?1:-1;Oi==Ci&&(Oi==1?rs==1?ln>=pi:ln<=pi:rs==1?ln<=pi:ln>=pi)&&(Ms=Fi,Zs=qe)}else Ms=Fi,Zs=qe}}if(me||Re){let Ai,Fi;L.ori==0?(Ai=fi,Fi=Jn):(Ai=Jn,Fi=fi);let rs,pi,Ci,Oi,os,jn,mi=!0,br=ce.bbox;if(br!=null){mi=!1;let Qn=br(i,qe);Ci=Qn.left,Oi=Qn.top,rs=Qn.width,pi=Qn.height}else Ci=Ai,Oi=Fi,rs=pi=ce.size(i,qe);if(jn=ce.fill(i,qe),os=ce.stroke(i,qe),Re)qe==Zs&&Ms<=ke.prox&&(Ue=Ci,Be=Oi,at=rs,Ct=pi,Et=mi,yt=jn,Qe=os);else{let Qn=ht[qe];Qn!=null&&(qt[qe]=Ci,Zn[qe]=Oi,y_(Qn,rs,pi,mi),__(Qn,jn,os),xs(Qn,Ni(Ci),Ni(Oi),F,Pe))}}}}if(Re){let qe=ke.prox,Zt=vr==null?Ms<=qe:Ms>qe||Zs!=vr;if(me||Zt){let an=ht[0];an!=null&&(qt[0]=Ue,Zn[0]=Be,y_(an,at,Ct,Et),__(an,yt,Qe),xs(an,Ni(Ue),Ni(Be),F,Pe))}}}if($t.show&&Ys)if(_!=null){let[pe,Se]=yn.scales,[Ne,Ue]=yn.match,[Be,at]=_.cursor.sync.scales,Ct=_.cursor.drag;if(Ln=Ct._x,Nn=Ct._y,Ln||Nn){let{left:Et,top:yt,width:Qe,height:qe}=_.select,Zt=_.scales[Be].ori,an=_.posToVal,Fn,kt,ln,fi,Jn,Ai=pe!=null&&Ne(pe,Be),Fi=Se!=null&&Ue(Se,at);Ai&&Ln?(Zt==0?(Fn=Et,kt=Qe):(Fn=yt,kt=qe),ln=w[pe],fi=W(an(Fn,Be),ln,K,0),Jn=W(an(Fn+kt,Be),ln,K,0),ha(ji(fi,Jn),Pn(Jn-fi))):ha(0,K),Fi&&Nn?(Zt==1?(Fn=Et,kt=Qe):(Fn=yt,kt=qe),ln=w[Se],fi=D(an(Fn,at),ln,le,0),Jn=D(an(Fn+kt,at),ln,le,0),ua(ji(fi,Jn),Pn(Jn-fi))):ua(0,le)}else id()}else{let pe=Pn(qp-Wp),Se=Pn(Yp-Xp);if(L.ori==1){let at=pe;pe=Se,Se=at}Ln=Gn.x&&pe>=Gn.dist,Nn=Gn.y&&Se>=Gn.dist;let Ne=Gn.uni;Ne!=null?Ln&&Nn&&(Ln=pe>=Ne,Nn=Se>=Ne,!Ln&&!Nn&&(Se>pe?Nn=!0:Ln=!0)):Gn.x&&Gn.y&&(Ln||Nn)&&(Ln=Nn=!0);let Ue,Be;Ln&&(L.ori==0?(Ue=to,Be=Yt):(Ue=no,Be=en),ha(ji(Ue,Be),Pn(Be-Ue)),Nn||ua(0,le)),Nn&&(L.ori==1?(Ue=to,Be=Yt):(Ue=no,Be=en),ua(ji(Ue,Be),Pn(Be-Ue)),Ln||ha(0,K)),!Ln&&!Nn&&(ha(0,0),ua(0,0))}if(Gn._x=Ln,Gn._y=Nn,_==null){if(R){if(om!=null){let[pe,Se]=yn.scales;yn.values[0]=pe!=null?ss(L.ori==0?Yt:en,pe):null,yn.values[1]=Se!=null?ss(L.ori==1?Yt:en,Se):null}fa(ap,i,Yt,en,F,Pe,I)}if(tt){let pe=R&&yn.setSeries,Se=ke.prox;vr==null?Ms<=Se&&is(Zs,so,!0,pe):Ms>Se?is(null,so,!0,pe):Zs!=vr&&is(Zs,so,!0,pe)}}me&&(fe.idx=I,ed()),b!==!1&&Un("setCursor")}let Ks=null;Object.defineProperty(i,"rect",{get(){return Ks==null&&da(!1),Ks}});function da(_=!1){_?Ks=null:(Ks=g.getBoundingClientRect(),Un("syncRect",Ks))}function Kp(_,b,R,I,G,K,le){de._lock||Ys&&_!=null&&_.movementX==0&&_.movementY==0||(td(_,b,R,I,G,K,le,!1,_!=null),_!=null?Sr(null,!0,!0):Sr(b,!0,!1))}function td(_,b,R,I,G,K,le,pe,Se){if(Ks==null&&da(!1),et(_),_!=null)R=_.clientX-Ks.left,I=_.clientY-Ks.top;else{if(R<0||I<0){Yt=-10,en=-10;return}let[Ne,Ue]=yn.scales,Be=b.cursor.sync,[at,Ct]=Be.values,[Et,yt]=Be.scales,[Qe,qe]=yn.match,Zt=b.axes[0].side%2==1,an=L.ori==0?F:Pe,Fn=L.ori==1?F:Pe,kt=Zt?K:G,ln=Zt?G:K,fi=Zt?I:R,Jn=Zt?R:I;if(Et!=null?R=Qe(Ne,Et)?a(at,w[Ne],an,0):-10:R=an*(fi/kt),yt!=null?I=qe(Ue,yt)?a(Ct,w[Ue],Fn,0):-10:I=Fn*(Jn/ln),L.ori==1){let Ai=R;R=I,I=Ai}}Se&&(b==null||b.cursor.event.type==ap)&&((R<=1||R>=F-1)&&(R=Hr(R,F)),(I<=1||I>=Pe-1)&&(I=Hr(I,Pe))),pe?(Wp=R,Xp=I,[to,no]=de.move(i,R,I)):(Yt=R,en=I)}let nd={width:0,height:0,left:0,top:0};function id(){kl(nd,!1)}let Jp,jp,Qp,em;function tm(_,b,R,I,G,K,le){Ys=!0,Ln=Nn=Gn._x=Gn._y=!1,td(_,b,R,I,G,K,le,!0,!1),_!=null&&(wt(lp,fp,nm,!1),fa(h_,i,to,no,F,Pe,null));let{left:pe,top:Se,width:Ne,height:Ue}=$t;Jp=pe,jp=Se,Qp=Ne,em=Ue}function nm(_,b,R,I,G,K,le){Ys=Gn._x=Gn._y=!1,td(_,b,R,I,G,K,le,!1,!0);let{left:pe,top:Se,width:Ne,height:Ue}=$t,Be=Ne>0||Ue>0,at=Jp!=pe||jp!=Se||Qp!=Ne||em!=Ue;if(Be&&at&&kl($t),Gn.setScale&&Be&&at){let Ct=pe,Et=Ne,yt=Se,Qe=Ue;if(L.ori==1&&(Ct=Se,Et=Ue,yt=pe,Qe=Ne),Ln&&$s(E,ss(Ct,E),ss(Ct+Et,E)),Nn)for(let qe in w){let Zt=w[qe];qe!=E&&Zt.from==null&&Zt.min!=Vt&&$s(qe,ss(yt+Qe,qe),ss(yt,qe))}id()}else de.lock&&(de._lock=!de._lock,Sr(b,!0,_!=null));_!=null&&(Mn(lp,fp),fa(lp,i,Yt,en,F,Pe,null))}function oy(_,b,R,I,G,K,le){if(de._lock)return;et(_);let pe=Ys;if(Ys){let Se=!0,Ne=!0,Ue=10,Be,at;L.ori==0?(Be=Ln,at=Nn):(Be=Nn,at=Ln),Be&&at&&(Se=Yt<=Ue||Yt>=F-Ue,Ne=en<=Ue||en>=Pe-Ue),Be&&Se&&(Yt=Yt<to?0:F),at&&Ne&&(en=en<no?0:Pe),Sr(null,!0,!0),Ys=!1}Yt=-10,en=-10,re.fill(null),Sr(null,!0,!0),pe&&(Ys=pe)}function im(_,b,R,I,G,K,le){de._lock||(et(_),ca(),id(),_!=null&&fa(f_,i,Yt,en,F,Pe,null))}function sm(){C.forEach(NA),U(i.width,i.height,!0)}qr(Su,Ko,sm);let ro={};ro.mousedown=tm,ro.mousemove=Kp,ro.mouseup=nm,ro.dblclick=im,ro.setSeries=(_,b,R,I)=>{let G=yn.match[2];R=G(i,b,R),R!=-1&&is(R,I,!0,!1)},ge&&(wt(h_,g,tm),wt(ap,g,Kp),wt(u_,g,_=>{et(_),da(!1)}),wt(d_,g,oy),wt(f_,g,im),Sp.add(i),i.syncRect=da);let zl=i.hooks=n.hooks||{};function Un(_,b,R){Kn?Ot.push([_,b,R]):_ in zl&&zl[_].forEach(I=>{I.call(null,i,b,R)})}(n.plugins||[]).forEach(_=>{for(let b in _.hooks)zl[b]=(zl[b]||[]).concat(_.hooks[b])});let rm=(_,b,R)=>R,yn=bn({key:null,setSeries:!1,filters:{pub:w_,sub:w_},scales:[E,y[1]?y[1].scale:null],match:[T_,T_,rm],values:[null,null]},de.sync);yn.match.length==2&&yn.match.push(rm),de.sync=yn;let om=yn.key,sd=Sx(om);function fa(_,b,R,I,G,K,le){yn.filters.pub(_,b,R,I,G,K,le)&&sd.pub(_,b,R,I,G,K,le)}sd.sub(i);function ay(_,b,R,I,G,K,le){yn.filters.sub(_,b,R,I,G,K,le)&&ro[_](null,b,R,I,G,K,le)}i.pub=ay;function ly(){sd.unsub(i),Sp.delete(i),Dn.clear(),gp(Su,Ko,sm),c.remove(),Ce?.remove(),Un("destroy")}i.destroy=ly;function rd(){Un("init",n,e),la(e||n.data,!1),X[E]?Ju(E,X[E]):ca(),se=$t.show&&($t.width>0||$t.height>0),ne=me=!0,U(n.width,n.height)}return y.forEach(Zr),C.forEach(ys),t?t instanceof HTMLElement?(t.appendChild(c),rd()):t(i,rd):rd(),i}Wn.assign=bn;Wn.fmtNum=Cp;Wn.rangeNum=bu;Wn.rangeLog=Tu;Wn.rangeAsinh=Ep;Wn.orient=$r;Wn.pxRatio=It;Wn.join=T1;Wn.fmtDate=Pp,Wn.tzDate=F1;Wn.sync=Sx;{Wn.addGap=xA,Wn.clipGaps=Cu;let n=Wn.paths={points:Ax};n.linear=Rx,n.stepped=SA,n.bars=bA,n.spline=wA}var li=58,Gs=10,UA=13,Lx=4,Du="11px system-ui, 'DejaVu Sans', sans-serif",Lu=class{constructor(e,t,i,s,r){this.panel=e;this.axis=t;this.frames=i;this.data=s;this.store=r;new ResizeObserver(()=>i.later(this)).observe(e)}panel;axis;frames;data;store;plot=null;cursor=ee("div",{class:"plot-cursor"});bounds=[-1,1];key="";update(){this.frames.later(this)}draw(){let{state:e}=this.store,[t,i]=[this.panel.clientWidth,this.panel.clientHeight];if(t<=li||i===0||this.data.samples===0)return;let s=Bi(this.data,e.marks).map(o=>[o.start_s,o.end_s,o.use]),r=JSON.stringify([t,i,e.sensor,e.quantity,[...e.hidden],e.window,s]);r!==this.key&&(this.key=r,this.rebuild(t,i))}moveCursor(){let{sample:e,window:t}=this.store.state,i=this.data.time[e]??0;this.cursor.hidden=!this.plot||i<t[0]||i>t[1],this.plot&&(this.cursor.style.transform=`translateX(${Math.round(this.plot.valToPos(i,"x"))}px)`)}shown(){return(this.data.sensor(this.store.state.sensor)?.wrenches??[]).filter(t=>!this.store.state.hidden.has(t.name))}rebuild(e,t){let{state:i}=this.store,s=ya[i.quantity]+this.axis,r=this.shown(),o=r.map(h=>({values:this.data.floats(h.values),place:s}));this.bounds=FA(r.map(h=>this.data.range(h,s)));let a=Math.max(0,this.data.sampleAt(i.window[0])),l=Math.min(this.data.samples,this.data.sampleAt(i.window[1])+2),c=dm(this.data.time,o,a,l,e-li-Gs);this.plot?.destroy(),this.plot=new Wn(this.options(e,t,r),[c.x,...c.y],this.panel),this.plot.over.append(this.cursor),this.jumpOnClick(this.plot)}options(e,t,i){let{state:s}=this.store,r=this.data.sensor(s.sensor),o=s.quantity==="force"?"f":"t",a=this.axis===2;return{width:e,height:t,padding:[5,Gs,a?0:4,0],legend:{show:!1},cursor:{x:!1,y:!1,points:{show:!1},drag:{x:!0,y:!1,setScale:!1}},scales:{x:{time:!1,range:()=>[s.window[0],s.window[1]]},y:{range:()=>this.bounds}},axes:[{show:!0,size:a?20:0,font:Du,stroke:ci,grid:{stroke:"#eceff3"},ticks:{size:a?4:0},label:a?"time [s]":"",labelSize:a?UA:0,labelGap:0,gap:2,labelFont:Du,values:a?(l,c)=>c.map(String):()=>[]},{size:li-14,font:Du,stroke:ci,grid:{stroke:"#eceff3"},ticks:{size:4},gap:2,space:15,label:`${o}${"xyz"[this.axis]??""} [${Js[s.quantity]}]`,labelSize:14,labelGap:0,labelFont:Du}],series:[{},...i.map(l=>({label:l.name,stroke:r?Ri(r,l):ci,width:l.role==="expected"?2:1,points:{show:!1}}))],hooks:{drawClear:[l=>this.drawSpans(l)],draw:[()=>this.moveCursor()],setSelect:[l=>this.zoom(l)]}}}drawSpans(e){let{left:t,top:i,width:s,height:r}=e.bbox,o=(l,c,h)=>{let u=Math.max(t,e.valToPos(l,"x",!0)),d=Math.min(t+s,e.valToPos(c,"x",!0));e.ctx.fillStyle=h,d>u&&e.ctx.fillRect(u,i,d-u,r)},a=[...this.data.scene.intervals,...Bi(this.data,this.store.state.marks)];for(let{start_s:l,end_s:c,use:h}of a)o(l,c,ma(Mr[h],h==="ignore"?.3:.12))}zoom(e){let{left:t,width:i}=e.select;if(i<=Lx)return;let s=[e.posToVal(t,"x"),e.posToVal(t+i,"x")];queueMicrotask(()=>this.store.set({window:s}))}jumpOnClick(e){let t=0;e.over.addEventListener("mousedown",i=>{t=i.clientX}),e.over.addEventListener("click",i=>{if(Math.abs(i.clientX-t)>Lx)return;let s=e.posToVal(i.clientX-e.over.getBoundingClientRect().left,"x");this.store.set({sample:this.data.nearestSample(s),playing:!1})}),e.over.addEventListener("dblclick",()=>this.store.set({window:this.data.span}))}};function FA(n){let e=n.filter(r=>r!==null);if(e.length===0)return[-1,1];let t=Math.min(...e.map(([r])=>r)),i=Math.max(...e.map(([,r])=>r)),s=i>t?.06*(i-t):Math.max(1,.1*Math.abs(i));return[t-s,i+s]}var Dl=64;function Hs(n,e,t,i=!1){let s=document.createElement("canvas"),r=`600 ${.75*Dl}px system-ui, "DejaVu Sans", sans-serif`,o=s.getContext("2d");if(!o)throw new Error("this browser draws no text on a canvas");o.font=r,s.width=Math.ceil(o.measureText(n).width)+12,s.height=Dl,o=s.getContext("2d"),o&&(o.font=r,o.textAlign="center",o.textBaseline="middle",o.lineWidth=6,o.lineJoin="round",o.strokeStyle="rgba(255,255,255,0.85)",o.strokeText(n,s.width/2,Dl/2),o.fillStyle=e,o.fillText(n,s.width/2,Dl/2));let a=new Qa(s);a.colorSpace="srgb";let l=new Ur(new Fo({map:a,depthTest:!i,depthWrite:!1}));return l.scale.set(t*s.width/Dl,t,1),l.renderOrder=i?30:5,l}var OA=new B(0,1,0),BA=new lr(1,1,1,10).translate(0,.5,0),kA=new nl(1,1,14).translate(0,-.5,0);function Ws(n){return new Pt().fromArray(n).transpose()}var yr=class extends Wt{constructor(t,i,s){super();this.width=i;let r=new Us({color:t,depthTest:!1,depthWrite:!1,transparent:!0});this.shaft=new Vn(BA,r),this.heads=Array.from({length:s==="force"?1:2},()=>new Vn(kA,r)),this.add(this.shaft,...this.heads);for(let o of this.children)o.renderOrder=20;this.visible=!1}width;shaft;heads;point(t,i){let s=i.length();if(this.visible=Number.isFinite(s)&&s>1e-9,!this.visible)return;this.position.copy(t),this.quaternion.copy(new ii().setFromUnitVectors(OA,i.clone().divideScalar(s)));let r=Math.min(4.5*this.width,.5*s);this.shaft.scale.set(this.width,Math.max(s-r,1e-9),this.width),this.heads.forEach((o,a)=>{o.scale.set(.45*r,r,.45*r),o.position.y=s-.7*a*r})}};function Nx(n,e,t){let i=new Wt;return[new B(1,0,0),new B(0,1,0),new B(0,0,1)].forEach((r,o)=>{let a=Gl[o]??"#000000",l=new yr(a,e,"force");if(l.point(new B,r.clone().multiplyScalar(n)),i.add(l),t){let c=Hs("xyz"[o]??"",a,.45*n,!0);c.position.copy(r).multiplyScalar(1.25*n),i.add(c)}}),i.matrixAutoUpdate=!1,i}var Nu=class extends Wt{constructor(t){super();this.data=t;let{shapes:i}=t.scene.robot;for(let s of t.scene.robot.links){let r=new Wt;r.matrixAutoUpdate=!1,this.links.set(s,r),this.add(r)}for(let s of i)this.links.get(s.link)?.add(this.solid(s));this.bones=i.length===0?new fs(new Xt,new Xi({color:ci})):null,this.bones&&(this.bones.frustumCulled=!1,this.add(this.bones))}data;links=new Map;bones;place(t){for(let[i,s]of this.links){let r=t.get(i);s.visible=r!==void 0,r&&s.matrix.copy(Ws(r))}this.bones?.geometry.setFromPoints(this.data.scene.robot.joints.flatMap(i=>[Uu(t,i.parent),Uu(t,i.child)]))}solid(t){let[i=.7,s=.7,r=.7,o=1]=t.colour,a=new sl({color:new je().setRGB(i,s,r,"srgb"),opacity:o,transparent:o<1,flatShading:!0,side:oi}),l=new Vn(this.surface(t),a);if(l.matrixAutoUpdate=!1,l.matrix.copy(Ws(t.link_H_shape)),t.kind==="mesh"){let[c=1,h=1,u=1]=t.size;l.matrix.scale(new B(c,h,u))}return l}surface(t){let[i=0,s=0,r=0]=t.size;if(t.kind==="box")return new ar(i,s,r);if(t.kind==="sphere")return new Or(i,24,16);if(t.kind==="cylinder")return new lr(i,i,s,32).rotateX(Math.PI/2);let o=this.data.scene.robot.meshes[t.mesh??-1],a=new Xt;return o&&(a.setAttribute("position",new hn(this.data.floats(o.vertices),3)),a.setIndex(new hn(this.data.integers(o.faces),1))),a}};function Uu(n,e){let t=n.get(e);return new B(t?.[3]??0,t?.[7]??0,t?.[11]??0)}function Ll(n,e,t){let i=n.doubles(e.time_s),s=0,r=i.length;for(;s<r;){let a=s+r>>1;(i[a]??0)<=t?s=a+1:r=a}let o=i[s-1];return o!==void 0&&t<o+e.hold_s?s-1:null}function Fu(n,e,t){if(t===null)return[];let i=n.integers(e.first),[s,r]=[n.floats(e.place),n.floats(e.force)],o=e.spread?n.floats(e.spread):null,a=n.integers(e.identity),[l,c]=[i[t]??0,i[t+1]??0];return Array.from({length:c-l},(h,u)=>{let d=l+u,f=o?[...o.subarray(9*d,9*d+9)]:null;return{place:[...s.subarray(3*d,3*d+3)],force:[...r.subarray(3*d,3*d+3)],spread:f?.every(Number.isFinite)?f:null,identity:a[d]??0}})}function Ux({force:n,spread:e}){let t=Math.hypot(...n);if(!e||t===0)return Number.NaN;let i=[0,1,2].map(s=>n.reduce((r,o,a)=>r+o/t*(e[3*a+s]??0),0));return Math.hypot(...i)}function Fx(n,e){let t=n.floats(e.force),i=0;for(let s=0;s+2<t.length;s+=3){let r=Math.hypot(t[s]??0,t[s+1]??0,t[s+2]??0);r>i&&(i=r)}return i}var zA=.2,Ou=ql.map(n=>new je(n)),VA=new Or(1,20,14),Bu=class extends Wt{constructor(t,i,s){super();this.colour=t;this.size=i;this.matrixAutoUpdate=!1,this.words=s===null?null:new Wt,this.words&&s!==null&&(this.words.add(Hs(s,t,.03*i,!0)),this.add(this.words))}colour;size;arrows=[];balls=[];words;tips=[];point(t,i){for(;this.arrows.length<t.length;)this.addOne();this.tips=[],this.arrows.forEach((r,o)=>{let a=this.balls[o],l=t[o];if(a&&(a.visible=!1),r.visible=!1,!l)return;let c=new B().fromArray([...l.place]),h=new B().fromArray([...l.force]).multiplyScalar(i);r.point(c,h),this.tips.push(c.clone().add(h).toArray()),a&&l.spread&&this.stretch(a,c.add(h),l.spread,i)});let[s]=t;this.words&&(this.words.visible=s!==void 0,s&&this.words.position.fromArray([...s.place]))}inWorld(){return this.visible?this.tips.map(t=>new B().fromArray(t).applyMatrix4(this.matrix).toArray()):[]}get ellipsoids(){return this.visible?this.balls.filter(t=>t.visible).length:0}stretch(t,i,s,r){let[o=0,a=0,l=0,c=0,h=0,u=0,d=0,f=0,g=0]=s.map(v=>v*r);t.matrix.set(o,a,l,i.x,c,h,u,i.y,d,f,g,i.z,0,0,0,1),t.visible=!0}addOne(){let t=new yr(this.colour,.0038*this.size,"force"),i=new Vn(VA,new Us({color:this.colour,opacity:.35,transparent:!0,depthTest:!1,depthWrite:!1,side:oi}));i.matrixAutoUpdate=!1,i.visible=!1,i.renderOrder=21,this.arrows.push(t),this.balls.push(i),this.add(t,i)}},Op=class extends Vn{constructor(t,i){let s=new Us({vertexColors:!0,side:oi,polygonOffset:!0});[s.polygonOffsetFactor,s.polygonOffsetUnits]=[-4,-4];super(new Xt,s);this.data=t;this.patch=i;let r=i.vertices.shape[0]??0;this.colours=new hn(new Float32Array(3*r),3),this.geometry.setAttribute("position",new hn(t.floats(i.vertices),3)),this.geometry.setAttribute("color",this.colours),this.geometry.setIndex(new hn(t.integers(i.faces),1)),this.matrixAutoUpdate=!1}data;patch;pressed=0;colours;colour(t){let i=this.colours.count,s=t===null?null:this.data.floats(this.patch.pressure).subarray(t*i);this.pressed=0;for(let r=0;r<i;r++){let o=s?.[r]??0;o>0&&this.pressed++;let{r:a,g:l,b:c}=GA(o/(this.patch.largest_Pa||1));this.colours.setXYZ(r,a,l,c)}this.colours.needsUpdate=!0}},ku=class extends Wt{constructor(t,i){super();this.data=t;let{skin:s,skin_events:r}=t.scene;this.metresPer=Ox(t,s.map(a=>a.contacts),i);let o=Ox(t,r.map(a=>a.contacts),i);this.patches=s.map(a=>({patch:a,surface:new Op(t,a),arrows:new Bu(Wl,i,null)})),this.events=r.map(a=>({series:a,arrows:new Bu(Xl,i,"heuristic"),metresPer:o}));for(let{surface:a,arrows:l}of this.patches)this.add(a,l);for(let{arrows:a}of this.events)this.add(a)}data;metresPer;patches;events;update(t,i){let s=this.data.time[t.sample]??Number.NaN;for(let{patch:r,surface:o,arrows:a}of this.patches){let l=i.get(r.link);if(o.visible=a.visible=t.skin&&l!==void 0,!o.visible||!l)continue;let c=Ll(this.data,r.contacts,s);o.matrix.copy(Ws(l)),o.colour(c),this.turn(a,r.contacts,c,l,this.metresPer)}for(let{series:r,arrows:o,metresPer:a}of this.events){let l=i.get(r.link);o.visible=t.skinEvents&&l!==void 0,l&&this.turn(o,r.contacts,Ll(this.data,r.contacts,s),l,a)}}shown(){let t=[...this.patches.map(({patch:i,arrows:s})=>[i.name,s]),...this.events.map(({series:i,arrows:s})=>[i.name,s])];return{pressed:Object.fromEntries(this.patches.map(({patch:i,surface:s})=>[i.name,s.visible?s.pressed:0])),contacts:Object.fromEntries(t.map(([i,s])=>[i,s.inWorld()])),ellipsoids:t.reduce((i,[,s])=>i+s.ellipsoids,0)}}turn(t,i,s,r,o){t.matrix.copy(Ws(r)),t.point(Fu(this.data,i,s),o)}};function GA(n){let e=Math.min(1,Math.max(0,n))*(Ou.length-1),t=Math.min(Math.floor(e),Ou.length-2);return new je().lerpColors(Ou[t]??new je,Ou[t+1]??new je,e-t)}function Ox(n,e,t){let i=Math.max(0,...e.map(s=>Fx(n,s)));return i>0?zA*t/i:1}var Bx={type:"change"},kp={type:"start"},zx={type:"end"},zu=new rr,kx=new Si,HA=Math.cos(70*Hf.DEG2RAD),In=new B,ui=2*Math.PI,Dt={NONE:-1,ROTATE:0,DOLLY:1,PAN:2,TOUCH_ROTATE:3,TOUCH_PAN:4,TOUCH_DOLLY_PAN:5,TOUCH_DOLLY_ROTATE:6},Bp=1e-6,Vu=class extends dl{constructor(e,t=null){super(e,t),this.state=Dt.NONE,this.target=new B,this.cursor=new B,this.minDistance=0,this.maxDistance=1/0,this.minZoom=0,this.maxZoom=1/0,this.minTargetRadius=0,this.maxTargetRadius=1/0,this.minPolarAngle=0,this.maxPolarAngle=Math.PI,this.minAzimuthAngle=-1/0,this.maxAzimuthAngle=1/0,this.enableDamping=!1,this.dampingFactor=.05,this.enableZoom=!0,this.zoomSpeed=1,this.enableRotate=!0,this.rotateSpeed=1,this.keyRotateSpeed=1,this.enablePan=!0,this.panSpeed=1,this.screenSpacePanning=!0,this.keyPanSpeed=7,this.zoomToCursor=!1,this.autoRotate=!1,this.autoRotateSpeed=2,this.keys={LEFT:"ArrowLeft",UP:"ArrowUp",RIGHT:"ArrowRight",BOTTOM:"ArrowDown"},this.mouseButtons={LEFT:dr.ROTATE,MIDDLE:dr.DOLLY,RIGHT:dr.PAN},this.touches={ONE:fr.ROTATE,TWO:fr.DOLLY_PAN},this.target0=this.target.clone(),this.position0=this.object.position.clone(),this.zoom0=this.object.zoom,this._cursorStyle="auto",this._domElementKeyEvents=null,this._lastPosition=new B,this._lastQuaternion=new ii,this._lastTargetPosition=new B,this._quat=new ii().setFromUnitVectors(e.up,new B(0,1,0)),this._quatInverse=this._quat.clone().invert(),this._spherical=new zo,this._sphericalDelta=new zo,this._scale=1,this._panOffset=new B,this._rotateStart=new $e,this._rotateEnd=new $e,this._rotateDelta=new $e,this._panStart=new $e,this._panEnd=new $e,this._panDelta=new $e,this._dollyStart=new $e,this._dollyEnd=new $e,this._dollyDelta=new $e,this._dollyDirection=new B,this._mouse=new $e,this._performCursorZoom=!1,this._pointers=[],this._pointerPositions={},this._controlActive=!1,this._onPointerMove=XA.bind(this),this._onPointerDown=WA.bind(this),this._onPointerUp=qA.bind(this),this._onContextMenu=QA.bind(this),this._onMouseWheel=ZA.bind(this),this._onKeyDown=KA.bind(this),this._onTouchStart=JA.bind(this),this._onTouchMove=jA.bind(this),this._onMouseDown=YA.bind(this),this._onMouseMove=$A.bind(this),this._interceptControlDown=eC.bind(this),this._interceptControlUp=tC.bind(this),this.domElement!==null&&this.connect(this.domElement),this.update()}set cursorStyle(e){this._cursorStyle=e,e==="grab"?this.domElement.style.cursor="grab":this.domElement.style.cursor="auto"}get cursorStyle(){return this._cursorStyle}connect(e){super.connect(e),this.domElement.addEventListener("pointerdown",this._onPointerDown),this.domElement.addEventListener("pointercancel",this._onPointerUp),this.domElement.addEventListener("contextmenu",this._onContextMenu),this.domElement.addEventListener("wheel",this._onMouseWheel,{passive:!1}),this.domElement.ownerDocument.addEventListener("keydown",this._interceptControlDown,{passive:!0,capture:!0}),this.domElement.style.touchAction="none"}disconnect(){this.state=Dt.NONE,this.domElement.removeEventListener("pointerdown",this._onPointerDown),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.domElement.removeEventListener("pointercancel",this._onPointerUp),this.domElement.removeEventListener("wheel",this._onMouseWheel),this.domElement.removeEventListener("contextmenu",this._onContextMenu),this.stopListenToKeyEvents(),this.domElement.ownerDocument.removeEventListener("keydown",this._interceptControlDown,{capture:!0}),this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{capture:!0}),this._controlActive=!1,this._pointers.length=0,this._pointerPositions={},this.domElement.style.touchAction="",this.domElement.style.cursor="auto"}dispose(){this.disconnect()}getPolarAngle(){return this._spherical.phi}getAzimuthalAngle(){return this._spherical.theta}getDistance(){return this.object.position.distanceTo(this.target)}listenToKeyEvents(e){e.addEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=e}stopListenToKeyEvents(){this._domElementKeyEvents!==null&&(this._domElementKeyEvents.removeEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=null)}saveState(){this.target0.copy(this.target),this.position0.copy(this.object.position),this.zoom0=this.object.zoom}reset(){this.target.copy(this.target0),this.object.position.copy(this.position0),this.object.zoom=this.zoom0,this.object.updateProjectionMatrix(),this.dispatchEvent(Bx),this.update(),this.state=Dt.NONE}pan(e,t){this._pan(e,t),this.update()}dollyIn(e){this._dollyIn(e),this.update()}dollyOut(e){this._dollyOut(e),this.update()}rotateLeft(e){this._rotateLeft(e),this.update()}rotateUp(e){this._rotateUp(e),this.update()}update(e=null){let t=this.object.position;In.copy(t).sub(this.target),In.applyQuaternion(this._quat),this._spherical.setFromVector3(In),this.autoRotate&&this.state===Dt.NONE&&this._rotateLeft(this._getAutoRotationAngle(e)),this.enableDamping?(this._spherical.theta+=this._sphericalDelta.theta*this.dampingFactor,this._spherical.phi+=this._sphericalDelta.phi*this.dampingFactor):(this._spherical.theta+=this._sphericalDelta.theta,this._spherical.phi+=this._sphericalDelta.phi);let i=this.minAzimuthAngle,s=this.maxAzimuthAngle;isFinite(i)&&isFinite(s)&&(i<-Math.PI?i+=ui:i>Math.PI&&(i-=ui),s<-Math.PI?s+=ui:s>Math.PI&&(s-=ui),i<=s?this._spherical.theta=Math.max(i,Math.min(s,this._spherical.theta)):this._spherical.theta=this._spherical.theta>(i+s)/2?Math.max(i,this._spherical.theta):Math.min(s,this._spherical.theta)),this._spherical.phi=Math.max(this.minPolarAngle,Math.min(this.maxPolarAngle,this._spherical.phi)),this._spherical.makeSafe(),this.enableDamping===!0?this.target.addScaledVector(this._panOffset,this.dampingFactor):this.target.add(this._panOffset),this.target.sub(this.cursor),this.target.clampLength(this.minTargetRadius,this.maxTargetRadius),this.target.add(this.cursor);let r=!1;if(this.zoomToCursor&&this._performCursorZoom||this.object.isOrthographicCamera)this._spherical.radius=this._clampDistance(this._spherical.radius);else{let o=this._spherical.radius;this._spherical.radius=this._clampDistance(this._spherical.radius*this._scale),r=o!=this._spherical.radius}if(In.setFromSpherical(this._spherical),In.applyQuaternion(this._quatInverse),t.copy(this.target).add(In),this.object.lookAt(this.target),this.enableDamping===!0?(this._sphericalDelta.theta*=1-this.dampingFactor,this._sphericalDelta.phi*=1-this.dampingFactor,this._panOffset.multiplyScalar(1-this.dampingFactor)):(this._sphericalDelta.set(0,0,0),this._panOffset.set(0,0,0)),this.zoomToCursor&&this._performCursorZoom){let o=null;if(this.object.isPerspectiveCamera){let a=In.length();o=this._clampDistance(a*this._scale);let l=a-o;this.object.position.addScaledVector(this._dollyDirection,l),this.object.updateMatrixWorld(),r=!!l}else if(this.object.isOrthographicCamera){let a=new B(this._mouse.x,this._mouse.y,0);a.unproject(this.object);let l=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),this.object.updateProjectionMatrix(),r=l!==this.object.zoom;let c=new B(this._mouse.x,this._mouse.y,0);c.unproject(this.object),this.object.position.sub(c).add(a),this.object.updateMatrixWorld(),o=In.length()}else console.warn("WARNING: OrbitControls.js encountered an unknown camera type - zoom to cursor disabled."),this.zoomToCursor=!1;o!==null&&(this.screenSpacePanning?this.target.set(0,0,-1).transformDirection(this.object.matrix).multiplyScalar(o).add(this.object.position):(zu.origin.copy(this.object.position),zu.direction.set(0,0,-1).transformDirection(this.object.matrix),Math.abs(this.object.up.dot(zu.direction))<HA?this.object.lookAt(this.target):(kx.setFromNormalAndCoplanarPoint(this.object.up,this.target),zu.intersectPlane(kx,this.target))))}else if(this.object.isOrthographicCamera){let o=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),o!==this.object.zoom&&(this.object.updateProjectionMatrix(),r=!0)}return this._scale=1,this._performCursorZoom=!1,r||this._lastPosition.distanceToSquared(this.object.position)>Bp||8*(1-this._lastQuaternion.dot(this.object.quaternion))>Bp||this._lastTargetPosition.distanceToSquared(this.target)>Bp?(this.dispatchEvent(Bx),this._lastPosition.copy(this.object.position),this._lastQuaternion.copy(this.object.quaternion),this._lastTargetPosition.copy(this.target),!0):!1}_getAutoRotationAngle(e){return e!==null?ui/60*this.autoRotateSpeed*e:ui/60/60*this.autoRotateSpeed}_getZoomScale(e){let t=Math.abs(e*.01);return Math.pow(.95,this.zoomSpeed*t)}_rotateLeft(e){this._sphericalDelta.theta-=e}_rotateUp(e){this._sphericalDelta.phi-=e}_panLeft(e,t){In.setFromMatrixColumn(t,0),In.multiplyScalar(-e),this._panOffset.add(In)}_panUp(e,t){this.screenSpacePanning===!0?In.setFromMatrixColumn(t,1):(In.setFromMatrixColumn(t,0),In.crossVectors(this.object.up,In)),In.multiplyScalar(e),this._panOffset.add(In)}_pan(e,t){let i=this.domElement;if(this.object.isPerspectiveCamera){let s=this.object.position;In.copy(s).sub(this.target);let r=In.length();r*=Math.tan(this.object.fov/2*Math.PI/180),this._panLeft(2*e*r/i.clientHeight,this.object.matrix),this._panUp(2*t*r/i.clientHeight,this.object.matrix)}else this.object.isOrthographicCamera?(this._panLeft(e*(this.object.right-this.object.left)/this.object.zoom/i.clientWidth,this.object.matrix),this._panUp(t*(this.object.top-this.object.bottom)/this.object.zoom/i.clientHeight,this.object.matrix)):(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - pan disabled."),this.enablePan=!1)}_dollyOut(e){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale/=e:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_dollyIn(e){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale*=e:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_updateZoomParameters(e,t){if(!this.zoomToCursor)return;this._performCursorZoom=!0;let i=this.domElement.getBoundingClientRect(),s=e-i.left,r=t-i.top,o=i.width,a=i.height;this._mouse.x=s/o*2-1,this._mouse.y=-(r/a)*2+1,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()}_clampDistance(e){return Math.max(this.minDistance,Math.min(this.maxDistance,e))}_handleMouseDownRotate(e){this._rotateStart.set(e.clientX,e.clientY)}_handleMouseDownDolly(e){this._updateZoomParameters(e.clientX,e.clientY),this._dollyStart.set(e.clientX,e.clientY)}_handleMouseDownPan(e){this._panStart.set(e.clientX,e.clientY)}_handleMouseMoveRotate(e){this._rotateEnd.set(e.clientX,e.clientY),this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let t=this.domElement;this._rotateLeft(ui*this._rotateDelta.x/t.clientHeight),this._rotateUp(ui*this._rotateDelta.y/t.clientHeight),this._rotateStart.copy(this._rotateEnd),this.update()}_handleMouseMoveDolly(e){this._dollyEnd.set(e.clientX,e.clientY),this._dollyDelta.subVectors(this._dollyEnd,this._dollyStart),this._dollyDelta.y>0?this._dollyOut(this._getZoomScale(this._dollyDelta.y)):this._dollyDelta.y<0&&this._dollyIn(this._getZoomScale(this._dollyDelta.y)),this._dollyStart.copy(this._dollyEnd),this.zoomToCursor&&(this._performCursorZoom=!0,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()),this.update()}_handleMouseMovePan(e){this._panEnd.set(e.clientX,e.clientY),this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd),this.update()}_handleMouseWheel(e){this._updateZoomParameters(e.clientX,e.clientY),e.deltaY<0?this._dollyIn(this._getZoomScale(e.deltaY)):e.deltaY>0&&this._dollyOut(this._getZoomScale(e.deltaY)),this.update()}_handleKeyDown(e){let t=!1;switch(e.code){case this.keys.UP:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateUp(ui*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,this.keyPanSpeed),t=!0;break;case this.keys.BOTTOM:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateUp(-ui*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,-this.keyPanSpeed),t=!0;break;case this.keys.LEFT:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateLeft(ui*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(this.keyPanSpeed,0),t=!0;break;case this.keys.RIGHT:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateLeft(-ui*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(-this.keyPanSpeed,0),t=!0;break}t&&(e.preventDefault(),this.update())}_handleTouchStartRotate(e){if(this._pointers.length===1)this._rotateStart.set(e.pageX,e.pageY);else{let t=this._getSecondPointerPosition(e),i=.5*(e.pageX+t.x),s=.5*(e.pageY+t.y);this._rotateStart.set(i,s)}}_handleTouchStartPan(e){if(this._pointers.length===1)this._panStart.set(e.pageX,e.pageY);else{let t=this._getSecondPointerPosition(e),i=.5*(e.pageX+t.x),s=.5*(e.pageY+t.y);this._panStart.set(i,s)}}_handleTouchStartDolly(e){let t=this._getSecondPointerPosition(e),i=e.pageX-t.x,s=e.pageY-t.y,r=Math.sqrt(i*i+s*s);this._dollyStart.set(0,r)}_handleTouchStartDollyPan(e){this.enableZoom&&this._handleTouchStartDolly(e),this.enablePan&&this._handleTouchStartPan(e)}_handleTouchStartDollyRotate(e){this.enableZoom&&this._handleTouchStartDolly(e),this.enableRotate&&this._handleTouchStartRotate(e)}_handleTouchMoveRotate(e){if(this._pointers.length==1)this._rotateEnd.set(e.pageX,e.pageY);else{let i=this._getSecondPointerPosition(e),s=.5*(e.pageX+i.x),r=.5*(e.pageY+i.y);this._rotateEnd.set(s,r)}this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let t=this.domElement;this._rotateLeft(ui*this._rotateDelta.x/t.clientHeight),this._rotateUp(ui*this._rotateDelta.y/t.clientHeight),this._rotateStart.copy(this._rotateEnd)}_handleTouchMovePan(e){if(this._pointers.length===1)this._panEnd.set(e.pageX,e.pageY);else{let t=this._getSecondPointerPosition(e),i=.5*(e.pageX+t.x),s=.5*(e.pageY+t.y);this._panEnd.set(i,s)}this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd)}_handleTouchMoveDolly(e){let t=this._getSecondPointerPosition(e),i=e.pageX-t.x,s=e.pageY-t.y,r=Math.sqrt(i*i+s*s);this._dollyEnd.set(0,r),this._dollyDelta.set(0,Math.pow(this._dollyEnd.y/this._dollyStart.y,this.zoomSpeed)),this._dollyOut(this._dollyDelta.y),this._dollyStart.copy(this._dollyEnd);let o=(e.pageX+t.x)*.5,a=(e.pageY+t.y)*.5;this._updateZoomParameters(o,a)}_handleTouchMoveDollyPan(e){this.enableZoom&&this._handleTouchMoveDolly(e),this.enablePan&&this._handleTouchMovePan(e)}_handleTouchMoveDollyRotate(e){this.enableZoom&&this._handleTouchMoveDolly(e),this.enableRotate&&this._handleTouchMoveRotate(e)}_addPointer(e){this._pointers.push(e.pointerId)}_removePointer(e){delete this._pointerPositions[e.pointerId];for(let t=0;t<this._pointers.length;t++)if(this._pointers[t]==e.pointerId){this._pointers.splice(t,1);return}}_isTrackingPointer(e){for(let t=0;t<this._pointers.length;t++)if(this._pointers[t]==e.pointerId)return!0;return!1}_trackPointer(e){let t=this._pointerPositions[e.pointerId];t===void 0&&(t=new $e,this._pointerPositions[e.pointerId]=t),t.set(e.pageX,e.pageY)}_getSecondPointerPosition(e){let t=e.pointerId===this._pointers[0]?this._pointers[1]:this._pointers[0];return this._pointerPositions[t]}_customWheelEvent(e){let t=e.deltaMode,i={clientX:e.clientX,clientY:e.clientY,deltaY:e.deltaY};switch(t){case 1:i.deltaY*=16;break;case 2:i.deltaY*=100;break}return e.ctrlKey&&!this._controlActive&&(i.deltaY*=10),i}};function WA(n){this.enabled!==!1&&(this._pointers.length===0&&(this.domElement.setPointerCapture(n.pointerId),this.domElement.ownerDocument.addEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.addEventListener("pointerup",this._onPointerUp)),!this._isTrackingPointer(n)&&(this._addPointer(n),n.pointerType==="touch"?this._onTouchStart(n):this._onMouseDown(n),this._cursorStyle==="grab"&&(this.domElement.style.cursor="grabbing")))}function XA(n){this.enabled!==!1&&(n.pointerType==="touch"?this._onTouchMove(n):this._onMouseMove(n))}function qA(n){switch(this._removePointer(n),this._pointers.length){case 0:this.domElement.releasePointerCapture(n.pointerId),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.dispatchEvent(zx),this.state=Dt.NONE,this._cursorStyle==="grab"&&(this.domElement.style.cursor="grab");break;case 1:let e=this._pointers[0],t=this._pointerPositions[e];this._onTouchStart({pointerId:e,pageX:t.x,pageY:t.y});break}}function YA(n){let e;switch(n.button){case 0:e=this.mouseButtons.LEFT;break;case 1:e=this.mouseButtons.MIDDLE;break;case 2:e=this.mouseButtons.RIGHT;break;default:e=-1}switch(e){case dr.DOLLY:if(this.enableZoom===!1)return;this._handleMouseDownDolly(n),this.state=Dt.DOLLY;break;case dr.ROTATE:if(n.ctrlKey||n.metaKey||n.shiftKey){if(this.enablePan===!1)return;this._handleMouseDownPan(n),this.state=Dt.PAN}else{if(this.enableRotate===!1)return;this._handleMouseDownRotate(n),this.state=Dt.ROTATE}break;case dr.PAN:if(n.ctrlKey||n.metaKey||n.shiftKey){if(this.enableRotate===!1)return;this._handleMouseDownRotate(n),this.state=Dt.ROTATE}else{if(this.enablePan===!1)return;this._handleMouseDownPan(n),this.state=Dt.PAN}break;default:this.state=Dt.NONE}this.state!==Dt.NONE&&this.dispatchEvent(kp)}function $A(n){switch(this.state){case Dt.ROTATE:if(this.enableRotate===!1)return;this._handleMouseMoveRotate(n);break;case Dt.DOLLY:if(this.enableZoom===!1)return;this._handleMouseMoveDolly(n);break;case Dt.PAN:if(this.enablePan===!1)return;this._handleMouseMovePan(n);break}}function ZA(n){this.enabled===!1||this.enableZoom===!1||this.state!==Dt.NONE||(n.preventDefault(),this.dispatchEvent(kp),this._handleMouseWheel(this._customWheelEvent(n)),this.dispatchEvent(zx))}function KA(n){this.enabled!==!1&&this._handleKeyDown(n)}function JA(n){switch(this._trackPointer(n),this._pointers.length){case 1:switch(this.touches.ONE){case fr.ROTATE:if(this.enableRotate===!1){this.state=Dt.NONE;break}this._handleTouchStartRotate(n),this.state=Dt.TOUCH_ROTATE;break;case fr.PAN:if(this.enablePan===!1){this.state=Dt.NONE;break}this._handleTouchStartPan(n),this.state=Dt.TOUCH_PAN;break;default:this.state=Dt.NONE}break;case 2:switch(this.touches.TWO){case fr.DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchStartDollyPan(n),this.state=Dt.TOUCH_DOLLY_PAN;break;case fr.DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchStartDollyRotate(n),this.state=Dt.TOUCH_DOLLY_ROTATE;break;default:this.state=Dt.NONE}break;default:this.state=Dt.NONE}this.state!==Dt.NONE&&this.dispatchEvent(kp)}function jA(n){switch(this._trackPointer(n),this.state){case Dt.TOUCH_ROTATE:if(this.enableRotate===!1)return;this._handleTouchMoveRotate(n),this.update();break;case Dt.TOUCH_PAN:if(this.enablePan===!1)return;this._handleTouchMovePan(n),this.update();break;case Dt.TOUCH_DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchMoveDollyPan(n),this.update();break;case Dt.TOUCH_DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchMoveDollyRotate(n),this.update();break;default:this.state=Dt.NONE}}function QA(n){this.enabled!==!1&&n.preventDefault()}function eC(n){n.key==="Control"&&(this._controlActive=!0,this.domElement.ownerDocument.addEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}function tC(n){n.key==="Control"&&(this._controlActive=!1,this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}var Gu=Math.PI/24,Vx=1.15,nC=2,sa=class{constructor(e,t,i){this.panel=e;this.frames=i;this.renderer=iC(),this.canvas=this.renderer?.domElement??document.createElement("canvas"),this.canvas.tabIndex=0,this.canvas.setAttribute("role","img"),this.canvas.setAttribute("aria-label",t),e.append(this.canvas),this.renderer||e.append(ee("p",{class:"overlay absent"},"This browser draws nothing in 3-D: it has no WebGL 2.")),this.scene.background=new je("#ffffff"),this.camera.up.set(0,0,1),this.controls=new Vu(this.camera,this.canvas),this.controls.addEventListener("change",()=>i.later(this)),this.canvas.addEventListener("keydown",s=>this.turnByKey(s)),this.fit(),new ResizeObserver(()=>this.fit()).observe(e)}panel;frames;canvas;scene=new $a;camera=new ti(35,1,.01,100);renderer;controls;home={from:new B(3,-3,2),at:new B};fixed=!1;size="";lookFrom(e,t){this.home={from:e.clone(),at:t.clone()};let i=e.distanceTo(t);this.camera.near=i/100,this.camera.far=i*20,this.reset()}reset(){this.camera.position.copy(this.home.from),this.controls.target.copy(this.home.at),this.camera.updateProjectionMatrix(),this.controls.update(),this.frames.later(this)}draw(){this.renderer?.render(this.scene,this.camera)}hold(e,t){this.fixed=!0,this.resize(e,t,1,!1)}release(){this.fixed=!1,this.size="",this.fit()}onCanvas(e){let t=e.clone().project(this.camera);return t.z>1?null:{x:(.5+.5*t.x)*this.canvas.clientWidth,y:(.5-.5*t.y)*this.canvas.clientHeight}}fit(){let{clientWidth:e,clientHeight:t}=this.panel,i=Math.min(devicePixelRatio,nC),s=`${e} ${t} ${i}`;this.fixed||e===0||t===0||s===this.size||(this.size=s,this.resize(e,t,i,!0),this.frames.later(this))}resize(e,t,i,s){this.renderer?.setPixelRatio(i),this.renderer?.setSize(e,t,s),this.camera.aspect=e/t,this.camera.updateProjectionMatrix(),this.camera.updateMatrixWorld()}turnByKey(e){let t=this.camera.position.clone().sub(this.controls.target),i=new B().crossVectors(this.camera.up,t).normalize(),s={ArrowLeft:()=>t.applyAxisAngle(this.camera.up,-Gu),ArrowRight:()=>t.applyAxisAngle(this.camera.up,Gu),ArrowUp:()=>t.applyAxisAngle(i,-Gu),ArrowDown:()=>t.applyAxisAngle(i,Gu)},r={"+":()=>t.divideScalar(Vx),"-":()=>t.multiplyScalar(Vx),0:()=>t.copy(this.home.from).sub(this.controls.target)},o=e.altKey?s[e.key]:r[e.key];o&&(e.preventDefault(),e.stopPropagation(),o(),this.camera.position.copy(this.controls.target).add(t),this.controls.update(),this.frames.later(this))}};function iC(){try{return new du({antialias:!0,preserveDrawingBuffer:!0})}catch{return null}}var sC=["force","moment"],rC=.3,Hu=class extends Wt{constructor(t,i){super();this.data=t;this.size=i;this.metresPer={force:this.unit("force"),moment:this.unit("moment")};let{sensors:s,contacts:r}=t.scene;this.places=[...s.map((o,a)=>this.place(a,o.name,o.link,o.link_H_sensor,o.wrenches)),...r.map(o=>this.place(null,o.name,o.link,o.link_H_contact,[o]))]}data;size;metresPer;places;update(t,i){for(let s of this.places){let r=jl(i.get(s.link)??hd,s.link_H_frame),o=s.sensor===null?t.contacts:t.allSensors||s.sensor===t.sensor;s.frame.matrix.copy(Ws(r)),s.frame.visible=o;for(let{series:a,arrows:l}of s.drawn){let c=o&&!("role"in a&&t.hidden.has(a.name));for(let h of sC){let u=c&&(h==="force"?t.forceArrows:t.momentArrows);this.turn(l[h],a,h,u?r:null,t.sample)}}}}turn(t,i,s,r,o){if(r===null){t.visible=!1;return}let a=Ws(r),l=new B(...this.data.vector(i,o,s));l.applyMatrix3(new st().setFromMatrix4(a)).multiplyScalar(this.metresPer[s]),t.point(new B().setFromMatrixPosition(a),l)}place(t,i,s,r,o){let a=new Wt;a.matrixAutoUpdate=!1,a.matrix=new Pt,a.add(Nx(.07*this.size,.002*this.size,t!==null));let l=Hs(i,t===null?Hl:"#1f2430",.032*this.size,!0);l.position.set(0,0,-.035*this.size),a.add(l),this.add(a);let c=o.map(h=>{let u="role"in h?this.colour(t,h):Hl,d=("role"in h&&h.role==="expected"?.0065:.0042)*this.size,f={force:new yr(u,d,"force"),moment:new yr(u,.7*d,"moment")};return this.add(f.force,f.moment),{series:h,arrows:f}});return{sensor:t,link:s,link_H_frame:r,frame:a,drawn:c}}colour(t,i){let s=t===null?void 0:this.data.sensor(t);return s?Ri(s,i):Hl}unit(t){let i=t==="force"?0:3,r=this.data.scene.sensors.flatMap(({wrenches:a})=>{let l=a.filter(({role:c})=>c==="expected");return l.some(c=>this.data.range(c,i)!==null)?l:a}).flatMap(a=>[0,1,2].map(l=>{let c=this.data.range(a,i+l);return c?Math.max(-c[0],c[1]):0})),o=Math.max(0,...r);return o>0?rC*this.size/o:1}};var oC=24,Wu=class extends sa{constructor(t,i,s){super(t,"Robot in its posture at the current sample",i);this.data=s;let r=new hl("#ffffff",1.9);r.position.set(2,-3,5),this.scene.add(new al("#ffffff","#b9bec8",2.2),r),this.model=new Nu(s),this.scene.add(this.model);let o=this.reach(),a=Math.max(o.getSize(new B).length(),.001);this.wrenches=new Hu(s,a),this.scene.add(this.wrenches),this.skin=new ku(s,a),this.scene.add(this.skin),this.floor(o,a);let l=o.getCenter(new B);this.lookFrom(l.clone().add(new B(.82,-.95,.45).multiplyScalar(a)),l)}data;wrenches;skin;model;update(t){let i=va(this.data,t.sample);this.model.place(i),this.wrenches.update(t,i),this.skin.update(t,i),this.frames.later(this)}reach(){let t=Math.min(oC,Math.max(1,this.data.samples)),i=Array.from({length:t},(o,a)=>Math.floor(a*this.data.samples/t)),s=new Hi,r=new Map;for(let o of i){r=va(this.data,o);for(let a of r.keys())s.expandByPoint(Uu(r,a))}return this.model.place(r),this.model.updateMatrixWorld(!0),s.union(new Hi().setFromObject(this.model))}floor(t,i){let s=new ul(2*i,20,"#c9ced6","#e6e9ee");s.rotateX(Math.PI/2);let r=t.getCenter(new B);s.position.set(r.x,r.y,t.min.z),this.scene.add(s)}};var aC=[["forceArrows","Force arrows"],["momentArrows","Moment arrows (two heads)"],["allSensors","Arrows of all sensors"],["contacts","Contact wrenches (world on robot)"],["skin","Pressure and contacts on skin"],["skinEvents","Contacts of the skinManager (heuristic, not newtons)"],["wireframes","Ellipsoids and reference sphere"],["hideIgnored","Hide ignored intervals in the clouds"]];function Gx(n,e){let t=ee("div",{role:"group","aria-label":"Series"});return e.on(["sensor","hidden"],()=>{let i=n.sensor(e.state.sensor),s=t.contains(document.activeElement)?document.activeElement?.getAttribute("aria-label"):null;t.replaceChildren();for(let r of i?.wrenches??[]){let o=ee("span",{class:"chip"});o.style.background=i?Ri(i,r):"";let{row:a,box:l}=ld([o,r.name],!e.state.hidden.has(r.name),c=>{let h=new Set(e.state.hidden);c?h.delete(r.name):h.add(r.name),e.set({hidden:h})},r.name);t.append(a),r.name===s&&l.focus()}i?.wrenches.length||t.append(ee("p",{class:"absent"},"No wrenches of this sensor."))}),t}function Hx(n,e){let t=ee("div",{role:"group","aria-label":"Shown"});for(let[i,s]of aC){if(lC(n,i))continue;let{row:r,box:o}=ld([s],e.state[i],a=>e.set({[i]:a}));e.on([i],()=>{o.checked=e.state[i]}),t.append(r)}return t}function lC({scene:n},e){let t={contacts:n.contacts,skin:n.skin,skinEvents:n.skin_events};return e in t&&t[e].length===0}function Xx(n,e,t,i){let{skin:s,skin_events:r}=n.scene;if(s.length+r.length===0)return[];let o=s.map(({name:h,largest_Pa:u})=>{let d=ee("span",{class:"pressures",role:"img","aria-label":`Colours from 0 to ${Wx(u)} kPa`});return d.style.background=`linear-gradient(to right, ${ql.join(", ")})`,ee("p",{class:"pressure-legend"},`${h}: 0 `,d,` ${Wx(u)} kPa`)}),a=Number((.1/i).toPrecision(2)),l=s.length?[ee("p",{},`0.1 m of arrow on skin: ${a} N, ellipsoid: one standard deviation`)]:[],c=new zp(n,e,t);return[ee("section",{"aria-label":"Skin"},ee("h2",{},"Skin"),...o,...l,c.root)]}var zp=class{constructor(e,t,i){this.data=e;this.store=t;t.on(["sample"],()=>i.later(this))}data;store;root=ee("div",{class:"values"});draw(){let{skin:e,skin_events:t}=this.data.scene,i=[...e.flatMap(({name:r,contacts:o})=>this.rows(r,o,Wl,"N")),...t.flatMap(({name:r,contacts:o})=>this.rows(r,o,Xl,"heuristic"))],s=ee("p",{class:"absent"},"No contact on skin at this sample.");this.root.replaceChildren(i.length?ee("table",{},ee("tbody",{},...i)):s)}rows(e,t,i,s){let r=this.data.time[this.store.state.sample]??Number.NaN;return Fu(this.data,t,Ll(this.data,t,r)).map(a=>{let l=ee("span",{class:"chip"});l.style.background=i;let c=Ux(a),h=Math.hypot(...a.force).toFixed(2)+(Number.isFinite(c)?` \xB1 ${c.toFixed(2)}`:"");return ee("tr",{},ee("th",{scope:"row"},l,`${e}: contact ${a.identity}`),ee("td",{},`${h} ${s}`))})}};function Wx(n){return(.001*n).toFixed(1)}function Vp(n){n.traverse(e=>{if(e===n)return;if(e instanceof Ur){e.material.map?.dispose(),e.material.dispose();return}let{geometry:t,material:i}=e;t?.dispose(),i?.dispose()}),n.clear()}var Qi=32,Nl=null;function Gp(){if(Nl)return Nl;let n=new Uint8Array(4*Qi*Qi).fill(255);for(let e=0;e<Qi*Qi;e++){let[t,i]=[e%Qi-Qi/2+.5,Math.floor(e/Qi)-Qi/2+.5];n[4*e+3]=Math.hypot(t,i)<Qi/2?255:0}return Nl=new Oo(n,Qi,Qi),Nl.needsUpdate=!0,Nl}var cC={force:"f",moment:"t"},qx=.17;function $x(n,e){let t=new Wt,i=r=>new B(r&1?1:-1,r&2?1:-1,r&4?1:-1),s=[0,1,2,3,4,5,6,7].flatMap(r=>[1,2,4].filter(o=>!(r&o)).flatMap(o=>[i(r),i(r|o)]));t.add(Zx(s,pa));for(let r of[0,1,2])t.add(...hC(n,e,r));return t}function Ul(n,e){let[t,i,s]=[0,1,2].map(r=>((e[r]??Number.NaN)-(n.centre[r]??0))/n.half);return new B(t,i,s)}function hC(n,e,t){let i=Gl[t]??pa,s=n.centre[t]??0,r=(u,d)=>{let f=t===2?new B(-1,1,0):new B(-1,-1,-1);f.setComponent(t,(u-s)/n.half);let g=t===0?new B(0,-1,0):new B(-1,0,0);return f.addScaledVector(g,d)},o=_a(s-n.half,s+n.half,4),a=o.flatMap(u=>[r(u,0),r(u,.04)]),l=[r(s-n.half,0),r(s+n.half,0)],c=o.map(u=>Yx(Hs(String(u),"#59606c",qx),r(u,.2))),h=Hs(`${cC[e]}${"xyz"[t]??""} [${Js[e]}]`,i,1.15*qx);return[Zx([...a,...l],i),...c,Yx(h,r(s+1.2*n.half,0))]}function Yx(n,e){return n.position.copy(e),n}function Zx(n,e){return new fs(new Xt().setFromPoints(n),new Xi({color:e}))}var uC=12,dC=4,Xu=class extends sa{constructor(t,i,s,r,o){super(t,"Force or moment space with the current sample",i);this.data=s;this.maker=r;this.store=o;this.scene.add(this.fixedParts,this.markers),this.lookFrom(new B(2.75,-4.6,2.2),new B(0,-.1,-.05)),this.jumpOnClick()}data;maker;store;fixedParts=new Wt;markers=new Wt;clouds=null;drawn="";update(t){let i=this.maker.of(t),s=JSON.stringify([[...t.hidden],t.wireframes]);(i!==this.clouds||s!==this.drawn)&&this.rebuild(i,t),this.clouds=i,this.drawn=s,this.mark(i,t),this.frames.later(this)}sampleOnCanvas(t,i){let s=this.clouds?.clouds[t];return!this.clouds||!s?null:this.onCanvas(Ul(this.clouds,this.data.vector(s.series,i,this.store.state.quantity)))}samples(){return this.clouds?.samples??new Uint32Array}rebuild(t,i){Vp(this.fixedParts),this.fixedParts.add($x(t,i.quantity));for(let s of this.visible(t,i)){if(this.fixedParts.add(fC(t,s)),!i.wireframes)continue;let r=new Wt;s.sphere&&r.add(sp(mu(s.sphere),"#000000",.22)),s.ellipsoid&&r.add(sp(s.ellipsoid,s.colour,.45)),r.scale.setScalar(1/t.half),r.position.copy(Ul(t,[0,0,0])),this.fixedParts.add(r)}}mark(t,i){Vp(this.markers);for(let s of this.visible(t,i)){let r=Ul(t,this.data.vector(s.series,i.sample,i.quantity));if(!Number.isFinite(r.x+r.y+r.z))continue;let o=new Xt().setFromPoints([r]);for(let[a,l]of[[17,"#ffffff"],[14,s.colour],[5,"#ffffff"]]){let c=new Bo(o,new Fr({color:l,size:a,sizeAttenuation:!1,map:Gp(),transparent:!0,depthTest:!1,alphaTest:.5}));c.renderOrder=20,this.markers.add(c)}}}visible(t,i){return t.clouds.filter(s=>!i.hidden.has(s.series.name))}jumpOnClick(){let t=[0,0];this.canvas.addEventListener("pointerdown",i=>{t=[i.clientX,i.clientY]}),this.canvas.addEventListener("click",i=>{if(Math.hypot(i.clientX-t[0],i.clientY-t[1])>dC)return;let s=this.canvas.getBoundingClientRect(),r=this.closest(i.clientX-s.left,i.clientY-s.top);r!==null&&this.store.set({sample:r,playing:!1})})}closest(t,i){if(!this.clouds)return null;let s=null;for(let r of this.visible(this.clouds,this.store.state))this.clouds.samples.forEach((o,a)=>{let l=this.clouds&&this.onCanvas(Ul(this.clouds,r.points.subarray(3*a,3*a+3)));if(!l||Number.isNaN(l.x))return;let c=Math.hypot(l.x-t,l.y-i);c<(s?.distance??uC)&&(s={sample:o,distance:c})});return s?.sample??null}};function fC(n,e){let t=new Float32Array(e.points.length),i=new B(...n.centre),s=0,r=new B;for(let a=0;a+2<e.points.length;a+=3)r.fromArray(e.points,a).sub(i).divideScalar(n.half),Number.isFinite(r.x+r.y+r.z)&&r.toArray(t,s++*3);let o=new Xt;return o.setAttribute("position",new hn(t.subarray(0,3*s),3)),new Bo(o,new Fr({color:e.colour,size:3,sizeAttenuation:!1,map:Gp(),alphaTest:.5}))}var qu=class{constructor(e){this.current=e}current;listeners=[];get state(){return this.current}set(e){let t=Object.keys(e).filter(i=>e[i]!==this.current[i]);if(t.length!==0){this.current={...this.current,...e};for(let{keys:i,call:s}of this.listeners)t.some(r=>i.has(r))&&s()}}on(e,t){this.listeners.push({keys:new Set(e),call:t}),t()}};var ra={top:1,height:14},Fl={top:17,height:9},Yu=class{constructor(e,t,i,s){this.panel=e;this.frames=t;this.data=i;this.store=s;this.canvas=ee("canvas",{role:"img"}),e.append(this.canvas),new ResizeObserver(()=>t.later(this)).observe(e),this.canvas.addEventListener("click",r=>{let o=this.instant(r.clientX-this.canvas.getBoundingClientRect().left);s.set({sample:i.nearestSample(o),playing:!1})}),this.canvas.addEventListener("mousemove",r=>{this.canvas.title=this.describe(this.instant(r.clientX-this.canvas.getBoundingClientRect().left))})}panel;frames;data;store;canvas;update(){this.frames.later(this)}draw(){let[e,t]=[this.panel.clientWidth,this.panel.clientHeight],i=this.canvas.getContext("2d");if(!i||e<=li+Gs)return;this.canvas.width=Math.round(e*devicePixelRatio),this.canvas.height=Math.round(t*devicePixelRatio),i.setTransform(devicePixelRatio,0,0,devicePixelRatio,0,0),i.font="10px system-ui, 'DejaVu Sans', sans-serif";let s=[...this.data.scene.intervals,...Bi(this.data,this.store.state.marks)],r=this.data.scene.findings;this.canvas.setAttribute("aria-label",`Time axis with ${s.length} intervals and ${r.length} findings; both are listed beside the plots`);for(let{label:o,start_s:a,end_s:l,use:c}of s)this.bar(i,a,l,c,o);for(let{start_s:o,end_s:a}of r)this.finding(i,o,a);for(let o of this.store.state.marks)this.flag(i,o.time_s,o.mark);i.fillStyle=ci,i.fillText("intervals",4,ra.top+11),i.fillStyle=Vl,i.fillText("findings",4,Fl.top+8)}bar(e,t,i,s,r){let o=Math.max(li,this.pixel(t)),a=Math.min(this.panel.clientWidth-Gs,this.pixel(i));if(a<=o)return;e.fillStyle=ma(Mr[s],.4),e.fillRect(o,ra.top,a-o,ra.height),e.strokeStyle=Mr[s],e.strokeRect(o+.5,ra.top+.5,Math.max(0,a-o-1),ra.height-1),e.fillStyle=ci;let l=s==="ignore"?`${r} (ignored)`:r;e.measureText(l).width<a-o-6&&e.fillText(l,o+4,ra.top+11)}finding(e,t,i){if(t===null)return;let s=this.panel.clientWidth-Gs,[r,o]=[this.pixel(t),this.pixel(i??t)];if(!(o<li||r>s)){e.fillStyle=ma(Vl,.25),e.fillRect(Math.max(li,r),Fl.top,Math.min(s,o)-Math.max(li,r),Fl.height),e.fillStyle=Vl;for(let a of[r,o])a>=li&&a<=s&&e.fillRect(a-.75,Fl.top,1.5,Fl.height)}}flag(e,t,i){let s=this.pixel(t);if(s<li||s>this.panel.clientWidth-Gs)return;let r=i==="begin"?6:i==="end"?-6:0;if(e.fillStyle=lm,e.fillRect(s-.75,0,1.5,this.panel.clientHeight),e.beginPath(),r===0)e.arc(s,4,3.5,0,2*Math.PI);else for(let[o,a]of[[s,0],[s+r,4],[s,8]])e.lineTo(o,a);e.fill()}pixel(e){let[t,i]=this.store.state.window;return li+(e-t)/(i-t||1)*(this.panel.clientWidth-li-Gs)}instant(e){let[t,i]=this.store.state.window;return t+(e-li)/(this.panel.clientWidth-li-Gs)*(i-t)}describe(e){let t=3*Math.abs(this.instant(1)-this.instant(0)),{intervals:i,findings:s}=this.data.scene;return[...i.filter(r=>r.start_s<=e&&e<r.end_s).map(r=>`${r.label} (${r.use})`),...s.filter(r=>r.start_s!==null&&r.start_s-t<=e&&e<=(r.end_s??r.start_s)+t).map(r=>`${r.stream}: ${r.kind}: ${r.message}`)].slice(0,12).join(`
`)}};var pC=180/Math.PI,$u=class{constructor(e,t,i){this.data=e;this.store=t;t.on(["sample","sensor","quantity","hidden"],()=>i.later(this))}data;store;root=ee("div",{class:"values"});draw(){let{sample:e,sensor:t,quantity:i,hidden:s}=this.store.state,r=this.data.sensor(t),o=i==="force"?"f":"t",a=["",`${o}x`,`${o}y`,`${o}z`,`|${o}|`],l=(r?.wrenches??[]).filter(c=>!s.has(c.name)).map(c=>{let h=this.data.vector(c,e,i),u=[...h,Math.hypot(...h)].map(f=>ee("td",{},gC(f,i))),d=ee("span",{class:"chip"});return d.style.background=r?Ri(r,c):"",ee("tr",{},ee("th",{scope:"row",title:c.name,"aria-label":c.name},d),...u)});this.root.replaceChildren(ee("table",{},ee("caption",{},`${i==="force"?"Force":"Torque"} [${Js[i]}]${mC(r)}`),ee("thead",{},ee("tr",{},...a.map(c=>ee("th",{scope:"col"},c)))),ee("tbody",{},...l)))}},Zu=class{constructor(e,t,i){this.data=e;this.store=t;let s=ee("table",{},this.body);this.root=ee("details",{},ee("summary",{},`Joint configuration (${e.scene.coordinates.length})`),s),this.root.addEventListener("toggle",()=>i.later(this)),t.on(["sample"],()=>i.later(this))}data;store;root;body=ee("tbody");draw(){if(!this.root.open)return;let{sample:e}=this.store.state;this.body.replaceChildren(...this.data.scene.coordinates.map((t,i)=>{let s=this.data.position(e,i),r=this.data.isLength(i),o=Number.isNaN(s)?"absent":r?`${s.toFixed(4)} m`:`${(s*pC).toFixed(2)}\xB0`;return ee("tr",{},ee("th",{scope:"row"},t),ee("td",{},o))}))}};function mC(n){return n?n.acting===null?` unexplained on ${n.acted_on}`:` of ${n.acting} on ${n.acted_on}`:""}function gC(n,e){return Number.isFinite(n)?n.toFixed(e==="force"?2:3):"\u2013"}function Kx(n,e){let t=(u,d,f,g)=>ee("input",{type:"number","aria-label":u,value:d,min:f,step:g}),[i,s]=[t("Video start in seconds",0,0,.1),t("Video end in seconds",0,0,.1)],[r,o]=[t("Video frames per second",20,1,1),t("Video speed",1,.1,.1)],a=js("Video codec",[["h264","H.264: plays everywhere"],["vp9","VP9: same file every time"]],"h264",()=>{}),l=ee("progress",{max:1,value:0,"aria-label":"Video progress"});l.hidden=!0,n.store.on(["window"],()=>{i.value=n.store.state.window[0].toFixed(3),s.value=n.store.state.window[1].toFixed(3)});let c=cn("Record video",()=>{h()},{});async function h(){c.disabled=!0,l.hidden=!1;try{let[u,d,f,g]=[i,s,r,o].map(C=>C.valueAsNumber),[v,m]=[u??0,d??0].map(C=>n.data.nearestSample(C)),p={start:v??0,end:m??0,fps:f??20,speed:g??1,codec:a.value},y=await uc(n,p,C=>{l.value=C});Zl(Kl(n.data.scene.title,".mp4"),y,"video/mp4"),e("The video is made.")}catch(u){e(String(u))}finally{c.disabled=!1,l.hidden=!0}}return ee("details",{},ee("summary",{},"Video"),ee("div",{class:"row video"},ee("label",{},"from",i),ee("label",{},"to",s),ee("label",{},"frames/s",r),ee("label",{},"speed",o)),ee("div",{class:"row"},a,c,l))}window.ft={ready:_C()};async function _C(){document.readyState==="loading"&&await new Promise(t=>document.addEventListener("DOMContentLoaded",t,{once:!0}));let n=ee("progress",{"aria-label":"Loading the data"}),e=ee("div",{class:"waiting",role:"status"},"Loading the data ",n);document.body.append(e);try{let t=$m();document.title||=t.title;let i=await Zm((s,r)=>{r>0&&([n.max,n.value]=[r,s])});return xC(new Yl(t,i)),e.remove(),document.documentElement.dataset.ready="true",!0}catch(t){throw e.replaceChildren(`This page cannot be shown. ${t instanceof Error?t.message:String(t)}`),e.setAttribute("role","alert"),t}}function xC(n){let e=new qu({sample:ng(n,0),sensor:0,quantity:"force",hidden:new Set,forceArrows:!0,momentArrows:!0,allSensors:!0,contacts:!0,skin:!0,skinEvents:!0,wireframes:!0,hideIgnored:!1,marks:[],markKind:"point",window:n.span,large:null,playing:!1,speed:1}),t=new Jl,i=h=>{s.status.textContent=h},s=qm(n,e,()=>Vm(n,e,i));(document.getElementById("viewer")??document.body).append(s.app);let r=new $l(n),o=new Wu(s.robot,t,n),a=new Xu(s.space,t,n,r,e);s.robotTitle.prepend(cn("\u27F2",()=>o.reset(),{"aria-label":"Reset the robot's view",title:"Reset the view"})),s.spaceTitle.prepend(cn("\u27F2",()=>a.reset(),{"aria-label":"Reset the space's view",title:"Reset the view"})),e.on(["sample","sensor","hidden","forceArrows","momentArrows","allSensors","contacts","skin","skinEvents"],()=>o.update(e.state)),e.on(["sample","sensor","quantity","hidden","wireframes","hideIgnored","marks"],()=>a.update(e.state));let l=yC(s,t,n,r,e),c={data:n,store:e,robot:o,space:a,flush:()=>t.flush()};vC(s,t,c,i),SC(s,c,o),Gm(n,e),Wm(n,e,i),Xm(),Object.assign(window.ft,zm(c,a,l)),t.flush()}function yC(n,e,t,i,s){n.plots.forEach((o,a)=>{let l=new Lu(o,[0,1,2][a]??0,e,t,s);s.on(["sensor","quantity","hidden","window","marks"],()=>l.update()),s.on(["sample"],()=>l.moveCursor())});let r=new Yu(n.strip,e,t,s);return s.on(["window","marks"],()=>r.update()),n.planes.map((o,a)=>{let l=new gu(o,[[0,1],[1,2],[0,2]][a]??[0,1],e,t,i,s);return s.on(["sample","sensor","quantity","hidden","wireframes","hideIgnored","marks"],()=>l.update()),l})}function vC(n,e,t,i){let{data:s,store:r}=t,o=(h,...u)=>ee("section",{"aria-label":h},ee("h2",{},h),...u),a=new $u(s,r,e),l=new Zu(s,r,e),c=ee("details",{},ee("summary",{},"Origin of the data"),ee("ul",{class:"entries"},...s.scene.provenance.map(h=>ee("li",{},h))));n.side.append(...mm(s),o("Series",Gx(s,r),a.root),o("Shown",Hx(s,r)),...Xx(s,r,e,t.robot.skin.metresPer),o("Saved samples",tg(s,r,i),n.status),l.root,_m(s,r),gm(s,r),Kx(t,i),c)}function SC(n,{data:e,store:t,space:i},s){let{force:r,moment:o}=s.wrenches.metresPer,a=l=>String(Number((.1/l).toPrecision(2)));n.scale.textContent=`0.1 m of arrow: ${a(r)} N, ${a(o)} N m`,t.on(["sample","sensor","quantity"],()=>{let{sample:l,sensor:c,quantity:h}=t.state,u=`sample ${l}, ${(e.time[l]??0).toFixed(3)} s`;s.canvas.setAttribute("aria-label",`Robot ${e.scene.robot.name} in its posture at ${u}`);let d=e.sensor(c)?.name??"no sensor";i.canvas.setAttribute("aria-label",`${h==="force"?"Force":"Torque"} space of ${d} at ${u}`)})}})();
