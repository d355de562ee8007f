"use strict";(()=>{var wd={expected:{word:"expected",colours:["#000000","#ffffff"],dash:[]},prior:{word:"prior",colours:["#747b85","#9aa3af"],dash:[4,2]},"calibration-1":{word:"calibration",colours:["#0072B2","#56b4e9"],dash:[]},"calibration-2":{word:"second calibration",colours:["#D55E00","#f08a3c"],dash:[6,2]},"calibration-3":{word:"third calibration",colours:["#009E73","#2fc79b"],dash:[6,2,1,2]},"calibration-4":{word:"fourth calibration",colours:["#CC79A7","#e3a0c6"],dash:[2,1.5]},"calibration-5":{word:"fifth calibration",colours:["#665200","#ffc04d"],dash:[6,2,1,2,1,2]},"calibration-6":{word:"sixth calibration",colours:["#5b2a86","#b7a3e3"],dash:[1,1]},contact:{word:"contact",colours:["#7a4a00","#d9a25f"],dash:[]},limit:{word:"limit",colours:["#c1121f","#ff6b6b"],dash:[4,3]},finding:{word:"finding",colours:["#b04a00","#ff9d5c"],dash:[]},skin:{word:"contact on skin",colours:["#882255","#e08bb4"],dash:[]},heuristic:{word:"heuristic contact",colours:["#5b6472","#a9b2c0"],dash:[1,2]},"axis-x":{word:"x",colours:["#d0312d","#ff7b72"],dash:[]},"axis-y":{word:"y",colours:["#2a8a3c","#5fd075"],dash:[]},"axis-z":{word:"z",colours:["#2b5fd0","#82aaff"],dash:[]},"use-calibration":{word:"calibration",colours:["#3a8fc4","#3d8fc0"],dash:[]},"use-validation":{word:"validation",colours:["#009e73","#1f9c78"],dash:[]},"use-ignore":{word:"ignored",colours:["#8a8f98","#7d838d"],dash:[]},"tone-good":{word:"use",colours:["#00654a","#4ed1a5"],dash:[]},"tone-caution":{word:"caution",colours:["#8a5a00","#f0b64a"],dash:[]},"tone-bad":{word:"refuse",colours:["#a33c00","#ff8f5c"],dash:[]},"tone-unknown":{word:"unknown",colours:["#4b5560","#aab3be"],dash:[]}},Dm={ink:["#1f2430","#e8ebf0"],muted:["#59606c","#a4acb9"],line:["#d8dce3","#3a4150"],border:["#7b8390","#7d8694"],guide:["#c9ced6","#4a5263"],grid:["#e9ecf1","#2a303c"],ground:["#f4f6f8","#12151b"],panel:["#ffffff","#1b1f27"],hover:["#eef3f7","#2a313d"],chosen:["#dcecf6","#1d3a52"],accent:["#0069a6","#5cb8f0"],"on-accent":["#ffffff","#0c1218"],link:["#005c91","#7cc7f5"],note:["#fff7e0","#3a3115"],"note-border":["#b87f00","#a8842a"],shadow:["#00000033","#000000aa"],sky:["#ffffff","#ffffff"],earth:["#b9bec8","#9aa1ad"]},ec=["#f3efe6","#f2c14e","#d1495b","#3b0f70"];var Ed=matchMedia("(prefers-color-scheme: dark)").matches;document.documentElement.dataset.ground=Ed?"dark":"light";var _i=n=>wd[n].colours[Ed?1:0],sr=n=>Dm[n][Ed?1:0],hn=sr("ink"),rr=sr("muted"),Pr=sr("guide"),Ir=sr("grid"),xi=sr("panel"),[Ad,Lm]=[sr("sky"),sr("earth")],Nm=sr("accent"),tc=_i("finding"),Aa=_i("limit"),Um=_i("expected"),nc=[_i("axis-x"),_i("axis-y"),_i("axis-z")],ic=_i("contact"),sc=_i("skin"),rc=_i("heuristic"),Dr={calibration:_i("use-calibration"),validation:_i("use-validation"),ignore:_i("use-ignore")},Td=["calibration-1","calibration-2","calibration-3","calibration-4","calibration-5","calibration-6"];function Fm(n,e){if(e.role==="expected")return"expected";if(!e.calibrated)return"prior";let t=n.wrenches.filter(i=>i.calibrated).indexOf(e);return Td[t%Td.length]??Td[0]}function ni(n,e){return _i(Fm(n,e))}function Om(n,e){return wd[Fm(n,e)].dash}function Ni(n,e){return n+Math.round(e*255).toString(16).padStart(2,"0")}function Is(n){let e={begin:0,point:1,end:2};return[...n].sort((t,i)=>t.sample-i.sample||e[t.mark]-e[i.mark])}function yi(n,e){let t=[],i=new Set(n.scene.intervals.map(r=>r.label)),s=null;for(let r of Is(e))if(r.mark==="begin")s=r;else if(r.mark==="end"&&s!==null){let o=Ky(s.label||"marked",i),a={start_s:s.time_s,end_s:Jy(n,r.sample),use:s.use},l={supportLines:jy(n,a),overlaps:Qy(n,a)};t.push({begin:s,label:o,...a,...l}),s=null}return t}function Bm(n){let e=[],t=null;for(let i of Is(n))i.mark!=="point"&&(i.mark==="end"&&t===null&&e.push(i),i.mark==="begin"&&t!==null&&e.push(t),t=i.mark==="begin"?i:null);return t===null?e:[...e,t]}function km(n,e){return[...n.scene.intervals,...yi(n,e)].filter(t=>t.use==="ignore")}function Ky(n,e){let t=n;for(let i=2;e.has(t);i++)t=`${n} ${i}`;return e.add(t),t}function Jy(n,e){let t=n.samples-1,[i,s]=n.span,r=t>0?(s-i)/t:1;return Math.min(e<t?n.time[e+1]??0:s+r,n.scene.end_s)}function jy(n,{start_s:e,end_s:t,use:i}){let{intervals:s}=n.scene;if(!s.every(o=>o.states_support))return[];let r=s.find(o=>o.support!==null&&o.start_s<=e&&t<=o.end_s+1e-9);return r?[`support = ${Ca(r.support??"")}`]:i==="ignore"?[]:['# support = "..."  # state the link that stands still']}function Qy(n,{start_s:e,end_s:t,use:i}){return n.scene.intervals.filter(s=>i!=="ignore"&&s.use!=="ignore").filter(s=>s.start_s<t-1e-9&&e<s.end_s-1e-9).map(s=>s.label)}function Ca(n){return JSON.stringify(n).replaceAll("\x7F","\\u007f")}var lc=[0,1,2,3],ev=1.96,Ds=64,oc={low:1/0,high:-1/0,sum:0,squares:0,count:0},Rd=class n{constructor(e,t){this.samples=e;this.at=t}samples;at;blocks=null;others=new Map;beside(e,t){let i=this.others.get(e)??new n(this.samples,t);return this.others.set(e,i),i}summary(e,t){let[i,s]=[Math.ceil(e/Ds),Math.floor(t/Ds)];if(s<=i)return this.scan(e,t,oc);this.blocks??=this.summedUp();let r=this.scan(e,i*Ds,oc);for(let o=i;o<s;o++)r=tv(r,this.blocks[o]??oc);return this.scan(s*Ds,t,r)}farthest(e,t){let i=null,s=-1;for(let r=e;r<t;r+=Ds){let o=Math.min(t,r+Ds),{low:a,high:l}=this.summary(r,o);if(Math.max(-a,l)>s)for(let c=r;c<o;c++){let h=Math.abs(this.at(c));h>s&&([i,s]=[c,h])}}return i}summedUp(){return Array.from({length:Math.floor(this.samples/Ds)},(e,t)=>this.scan(t*Ds,(t+1)*Ds,oc))}scan(e,t,i){let{low:s,high:r,sum:o,squares:a,count:l}=i;for(let c=e;c<t;c++){let h=this.at(c);Number.isNaN(h)||(h<s&&(s=h),h>r&&(r=h),o+=h,a+=h*h,l++)}return{low:s,high:r,sum:o,squares:a,count:l}}};function tv(n,e){return{low:Math.min(n.low,e.low),high:Math.max(n.high,e.high),sum:n.sum+e.sum,squares:n.squares+e.squares,count:n.count+e.count}}var ac=class{constructor(e){this.data=e}data;known=new Map;measured(e,t,i){return this.remembered(`measured ${e.values.offset} ${t} ${i}`,()=>Cd(this.data.floats(e.values),null,Lr[t],i))}error(e,t,i,s){let r=Pd(e);return!r||t===r?null:this.remembered(`error ${t.values.offset} ${i} ${s}`,()=>Cd(this.data.floats(t.values),this.data.floats(r.values),Lr[i],s))}band(e,t,i){let{deviation:s}=e;return s?this.remembered(`band ${s.offset} ${t} ${i}`,()=>{let r=Cd(this.data.floats(s),null,Lr[t],i);return o=>ev*r(o)}):null}remembered(e,t){let i=this.known.get(e);if(i)return i;let s=new Rd(this.data.samples,t());return this.known.set(e,s),s}};function Pd(n){return n?.wrenches.find(e=>e.role==="expected")}function Ra(n,e){let t=n?.wrenches.filter(i=>i.role==="measured"&&!e.has(i.name))??[];return t.find(i=>i.calibrated)??t[0]}function Cd(n,e,t,i){let s=r=>(n[r]??NaN)-(e===null?0:e[r]??NaN);return i!==3?r=>s(6*r+t+i):r=>{let o=6*r+t;return Math.hypot(s(o),s(o+1),s(o+2))}}var vi={force:"N",moment:"N m"},Lr={force:0,moment:3},cc=class{constructor(e,t){this.scene=e;this.block=t;this.time=this.doubles(e.time_s),this.positions=this.floats(e.positions),this.root=this.floats(e.root)}scene;block;time;positions;root;columns=new ac(this);get samples(){return this.scene.samples}floats(e){return new Float32Array(this.block,this.placed(e,"float32",4),Pa(e))}doubles(e){return new Float64Array(this.block,this.placed(e,"float64",8),Pa(e))}integers(e){return new Uint32Array(this.block,this.placed(e,"uint32",4),Pa(e))}vector(e,t,i){let s=this.floats(e.values),r=6*t+Lr[i];return[s[r]??Number.NaN,s[r+1]??Number.NaN,s[r+2]??Number.NaN]}position(e,t){return this.positions[e*this.scene.coordinates.length+t]??Number.NaN}isLength(e){let t=this.scene.coordinates[e];return this.scene.robot.joints.some(i=>i.name===t&&i.type==="prismatic")}sensor(e){return this.scene.sensors[e]}sampleAt(e){let t=0,i=this.samples;for(;t<i;){let s=t+i>>1;(this.time[s]??0)<=e?t=s+1:i=s}return Math.max(0,t-1)}firstAt(e){let t=this.sampleAt(e);return(this.time[t]??e)<e?t+1:t}nearestSample(e){let t=this.sampleAt(e),i=Math.min(t+1,this.samples-1),s=Math.abs((this.time[i]??0)-e)<Math.abs((this.time[t]??0)-e);return Math.max(0,s?i:t)}get span(){return[this.time[0]??0,this.time[this.samples-1]??0]}placed(e,t,i){if(e.dtype!==t)throw new Error(`expected an array of ${t}, got ${e.dtype}`);if(e.offset+i*Pa(e)>this.block.byteLength){let s=e.offset+i*Pa(e);throw new Error(`an array ends at byte ${s}, the data are ${this.block.byteLength} bytes long`)}return e.offset}};function Pa(n){return n.shape.reduce((e,t)=>e*t,1)}function zm(n,e,t){let i=0;for(let a=0;a<n;a++)t(a)&&i++;let s=Math.max(1,Math.ceil(i/e)),r=new Uint32Array(Math.ceil(i/s)),o=0;for(let a=0;a<n;a++)t(a)&&(o%s===0&&(r[o/s]=a),o++);return r}function Vm(n,e,t,i,s){let r=i-t;if(r<=2*s){let l=Array.from({length:r},(c,h)=>t+h);return{x:l.map(c=>n[c]??0),y:e.map(({at:c})=>l.map(h=>nv(c(h))))}}let o=[],a=e.map(()=>[]);for(let l=0;l<s;l++){let c=t+Math.floor(r*l/s),h=t+Math.floor(r*(l+1)/s);o.push(n[c]??0,n[c+h>>1]??0),e.forEach((u,d)=>{let{low:f,high:m,count:y}=u.summary(c,h);a[d]?.push(y?f:null,y?m:null)})}return{x:o,y:a}}function nv(n){return Number.isNaN(n)?null:n}function Ia(n,e,t){if(!(e>n))return[n];let i=(e-n)/t,s=10**Math.floor(Math.log10(i)),r=[1,2,5,10].map(a=>a*s).find(a=>a>=i)??i,o=[];for(let a=Math.ceil(n/r-1e-9);a*r<=e+1e-9*r;a++)o.push(Number((a*r).toPrecision(12)));return o}var iv=2e4,sv=3,Gm={samples:new Uint32Array,clouds:[],centre:[0,0,0],half:1},hc=class{constructor(e){this.data=e}data;last={whole:{key:"",clouds:Gm},window:{key:"",clouds:Gm}};of(e){let{sensor:t,quantity:i,window:s}=e,r=e.hideIgnored?km(this.data,e.marks):[],o=JSON.stringify([t,i,r.map(c=>[c.start_s,c.end_s])]),a=this.data.span,l=this.remembered("whole",o,()=>{let c=Hm(this.data,t,i,r,a);return{...c,...ov(c.clouds)}});return s[0]<=a[0]&&s[1]>=a[1]?l:this.remembered("window",`${o} ${s.join(" ")}`,()=>({...Hm(this.data,t,i,r,s),centre:l.centre,half:l.half}))}remembered(e,t,i){return this.last[e].key!==t&&(this.last[e]={key:t,clouds:i()}),this.last[e].clouds}};function Hm(n,e,t,i,s){let r=new Uint8Array(n.samples).fill(1);r.fill(0,n.firstAt(s[0]),n.sampleAt(s[1])+1);for(let{start_s:h,end_s:u}of i)r.fill(1,n.firstAt(h),n.firstAt(u));let o=n.sensor(e),a=Math.floor(iv/Math.max(1,o?.wrenches.length??0)),l=zm(n.samples,a,h=>r[h]===0),c=(o?.wrenches??[]).map(h=>({series:h,colour:o?ni(o,h):hn,points:rv(n.floats(h.values),l,Lr[t]),ellipsoid:t==="force"?h.ellipsoid_force:h.ellipsoid_moment,sphere:t==="force"?h.reference_force:h.reference_moment}));return{samples:l,clouds:c}}function rv(n,e,t){let i=new Float32Array(3*e.length);return e.forEach((s,r)=>i.set(n.subarray(6*s+t,6*s+t+3),3*r)),i}function ov(n){let e=[0,1,2].map(o=>{let a=n.flatMap(({points:u})=>[...u.filter((d,f)=>f%3===o&&!Number.isNaN(d))]),l=a.length>0?[av(Float64Array.from(a).sort())]:[],c=n.flatMap(({sphere:u})=>u?[[u.centre[o]??0,u.radius]]:[]),h=[...l,...c.map(([u,d])=>[u-d,u+d])];return h.length>0?[Math.min(...h.map(([u])=>u)),Math.max(...h.map(([,u])=>u))]:[0,0]}),[t,i,s]=e.map(([o,a])=>(o+a)/2),r=Math.max(...e.map(([o,a])=>a-o));return{centre:[t??0,i??0,s??0],half:r>0?.55*r:1}}function av(n){let e=o=>n[Math.round(o*(n.length-1))]??0,[t,i,s]=[e(.01),e(.5),e(.99)],r=sv*Math.max(s-i,i-t);return[Math.max(e(0),i-r),Math.min(e(1),i+r)]}function Y(n,e={},...t){let i=document.createElement(n);for(let[s,r]of Object.entries(e))r!==!1&&r!==null&&i.setAttribute(s,r===!0?"":String(r));return i.append(...t),i}function zt(n,e,t={}){let i=Y("button",{type:"button",...t},n);return i.addEventListener("click",e),i}function Id(n,e,t,i){let s=Y("input",{type:"checkbox","aria-label":i??null});return s.checked=e,s.addEventListener("change",()=>t(s.checked)),{row:Y("label",{class:"check"},s,...n),box:s}}function or(n,e,t,i){let s=Y("select",{"aria-label":n});for(let[r,o]of e)s.append(Y("option",{value:r},o));return s.value=t,s.addEventListener("change",()=>i(s.value)),s}function uc(n,e,t){let i=URL.createObjectURL(new Blob([e],{type:t})),s=Y("a",{href:i,download:n});document.body.append(s),s.click(),s.remove(),setTimeout(()=>URL.revokeObjectURL(i),6e4)}function dc(n,e){return`${n.replace(/[^\w.-]+/gu,"_").slice(0,80)||"experiment"}${e}`}var Dd=200;function Wm(n){let e=[...n.scene.notes];if(n.samples===0&&e.push("The scene has no samples."),e.length===0)return[];let t=Y("ul",{},...e.map(s=>Y("li",{},s))),i=e.length===1?"1 note":`${e.length} notes`;return[Y("section",{class:"notes","aria-label":"Notes"},Y("details",{open:!0},Y("summary",{},i),t))]}function Xm(n,e){let t=n.scene.intervals.map(i=>{let s=Y("span",{class:"chip"});s.style.background=Dr[i.use];let r=zt(i.label,()=>Ym(n,e,i.start_s),{class:"link"}),o=`${i.start_s.toFixed(1)}\u2013${i.end_s.toFixed(1)} s, ${i.use}`,a=i.support===null?"":`, on ${i.support}`;return Y("li",{},s,r,Y("span",{class:"muted"},o+a))});return $m(`Intervals (${t.length})`,t,t.length>0?"":"The experiment names none.")}function qm(n,e){let{findings:t}=n.scene,i=t.slice(0,Dd).map(s=>{let{start_s:r}=s,o=`${s.kind}${r===null?"":` at ${r.toFixed(2)} s`}`,a=r===null?Y("b",{},o):zt(o,()=>Ym(n,e,r),{class:"link"});return Y("li",{},a,Y("span",{class:"muted"},`${s.stream}: ${s.message}`))});return t.length>Dd&&i.push(Y("li",{},`and ${t.length-Dd} more`)),$m(`Findings (${t.length})`,i,t.length>0?"":"None.")}function Ym(n,e,t){e.set({sample:n.nearestSample(t),playing:!1})}function $m(n,e,t){return Y("details",{},Y("summary",{},n),Y("ul",{class:"entries"},...e),Y("p",{class:"absent"},t))}var fc=class{waiting=new Set;request=0;later(e){this.waiting.add(e),this.request===0&&(this.request=requestAnimationFrame(()=>this.flush()))}flush(){cancelAnimationFrame(this.request),this.request=0;let e=[...this.waiting];this.waiting.clear();for(let t of e)t.draw()}};var Da=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1];function _o(n,e){let t=new Array(16).fill(0);for(let i=0;i<4;i++)for(let s=0;s<4;s++){let r=0;for(let o=0;o<4;o++)r+=(n[4*i+o]??0)*(e[4*o+s]??0);t[4*i+s]=r}return t}function lv(n,e){let t=n.root.subarray(7*e,7*e+7),[i=0,s=0,r=0,o=1,a=0,l=0,c=0]=t;if(t.length<7||t.some(Number.isNaN))return Da;let h=2/(o*o+a*a+l*l+c*c);return[1-h*(l*l+c*c),h*(a*l-c*o),h*(a*c+l*o),i,h*(a*l+c*o),1-h*(a*a+c*c),h*(l*c-a*o),s,h*(a*c-l*o),h*(l*c+a*o),1-h*(a*a+l*l),r,0,0,0,1]}function cv(n,e,t){if(e.column===null)return e.offset;let i=n.position(t,e.column);return e.multiplier*(Number.isNaN(i)?0:i)+e.offset}function La(n,e){let{robot:t}=n.scene,i=new Map([[t.root_link,lv(n,e)]]);for(let s of t.joints){let r=i.get(s.parent);if(!r)throw new Error(`joint ${s.name}: link ${s.parent} comes after it`);let o=_o(r,s.parent_H_child);i.set(s.child,s.type==="fixed"?o:_o(o,hv(s,n,e)))}return i}function hv(n,e,t){let[i=0,s=0,r=1]=n.axis,o=cv(e,n,t);if(n.type==="prismatic")return[1,0,0,i*o,0,1,0,s*o,0,0,1,r*o,0,0,0,1];let a=Math.sin(o),l=2*Math.sin(o/2)**2;return[1-l*(s*s+r*r),l*i*s-a*r,l*i*r+a*s,0,l*i*s+a*r,1-l*(i*i+r*r),l*s*r-a*i,0,l*i*r-a*s,l*s*r+a*i,1-l*(i*i+s*s),0,0,0,0,1]}var Hd=(n,e,t)=>{if(!e.has(n))throw TypeError("Cannot "+t)},V=(n,e,t)=>(Hd(n,e,"read from private field"),t?t.call(n):e.get(n)),ft=(n,e,t)=>{if(e.has(n))throw TypeError("Cannot add the same private member more than once");e instanceof WeakSet?e.add(n):e.set(n,t)},kn=(n,e,t,i)=>(Hd(n,e,"write to private field"),i?i.call(n,t):e.set(n,t),t),uv=(n,e,t,i)=>({set _(s){kn(n,e,s,t)},get _(){return V(n,e,i)}}),St=(n,e,t)=>(Hd(n,e,"access private method"),t),Tt=new Uint8Array(8),gs=new DataView(Tt.buffer),En=n=>[(n%256+256)%256],Rt=n=>(gs.setUint16(0,n,!1),[Tt[0],Tt[1]]),dv=n=>(gs.setInt16(0,n,!1),[Tt[0],Tt[1]]),Km=n=>(gs.setUint32(0,n,!1),[Tt[1],Tt[2],Tt[3]]),Oe=n=>(gs.setUint32(0,n,!1),[Tt[0],Tt[1],Tt[2],Tt[3]]),fv=n=>(gs.setInt32(0,n,!1),[Tt[0],Tt[1],Tt[2],Tt[3]]),kr=n=>(gs.setUint32(0,Math.floor(n/2**32),!1),gs.setUint32(4,n,!1),[Tt[0],Tt[1],Tt[2],Tt[3],Tt[4],Tt[5],Tt[6],Tt[7]]),Wd=n=>(gs.setInt16(0,2**8*n,!1),[Tt[0],Tt[1]]),ps=n=>(gs.setInt32(0,2**16*n,!1),[Tt[0],Tt[1],Tt[2],Tt[3]]),Ld=n=>(gs.setInt32(0,2**30*n,!1),[Tt[0],Tt[1],Tt[2],Tt[3]]),Ui=(n,e=!1)=>{let t=Array(n.length).fill(null).map((i,s)=>n.charCodeAt(s));return e&&t.push(0),t},yc=n=>n&&n[n.length-1],Xd=n=>{let e;for(let t of n)(!e||t.presentationTimestamp>e.presentationTimestamp)&&(e=t);return e},ms=(n,e,t=!0)=>{let i=n*e;return t?Math.round(i):i},Jm=n=>{let e=n*(Math.PI/180),t=Math.cos(e),i=Math.sin(e);return[t,i,0,-i,t,0,0,0,1]},jm=Jm(0),Qm=n=>[ps(n[0]),ps(n[1]),Ld(n[2]),ps(n[3]),ps(n[4]),Ld(n[5]),ps(n[6]),ps(n[7]),Ld(n[8])],Fa=n=>!n||typeof n!="object"?n:Array.isArray(n)?n.map(Fa):Object.fromEntries(Object.entries(n).map(([e,t])=>[e,Fa(t)])),So=n=>n>=0&&n<2**32,Sn=(n,e,t)=>({type:n,contents:e&&new Uint8Array(e.flat(10)),children:t}),Jt=(n,e,t,i,s)=>Sn(n,[En(e),Km(t),i??[]],s),pv=n=>{let e=512;return n.fragmented?Sn("ftyp",[Ui("iso5"),Oe(e),Ui("iso5"),Ui("iso6"),Ui("mp41")]):Sn("ftyp",[Ui("isom"),Oe(e),Ui("isom"),n.holdsAvc?Ui("avc1"):[],Ui("mp41")])},Nd=n=>({type:"mdat",largeSize:n}),mv=n=>({type:"free",size:n}),pc=(n,e,t=!1)=>Sn("moov",null,[gv(e,n),...n.map(i=>_v(i,e)),t?$v(n):null]),gv=(n,e)=>{let t=ms(Math.max(0,...e.filter(o=>o.samples.length>0).map(o=>{let a=Xd(o.samples);return a.presentationTimestamp+a.duration})),Od),i=Math.max(...e.map(o=>o.id))+1,s=!So(n)||!So(t),r=s?kr:Oe;return Jt("mvhd",+s,0,[r(n),r(n),Oe(Od),r(t),ps(1),Wd(1),Array(10).fill(0),Qm(jm),Array(24).fill(0),Oe(i)])},_v=(n,e)=>Sn("trak",null,[xv(n,e),yv(n,e)]),xv=(n,e)=>{let t=Xd(n.samples),i=ms(t?t.presentationTimestamp+t.duration:0,Od),s=!So(e)||!So(i),r=s?kr:Oe,o;return n.info.type==="video"?o=typeof n.info.rotation=="number"?Jm(n.info.rotation):n.info.rotation:o=jm,Jt("tkhd",+s,3,[r(e),r(e),Oe(n.id),Oe(0),r(i),Array(8).fill(0),Rt(0),Rt(0),Wd(n.info.type==="audio"?1:0),Rt(0),Qm(o),ps(n.info.type==="video"?n.info.width:0),ps(n.info.type==="video"?n.info.height:0)])},yv=(n,e)=>Sn("mdia",null,[vv(n,e),Sv(n.info.type==="video"?"vide":"soun"),bv(n)]),vv=(n,e)=>{let t=Xd(n.samples),i=ms(t?t.presentationTimestamp+t.duration:0,n.timescale),s=!So(e)||!So(i),r=s?kr:Oe;return Jt("mdhd",+s,0,[r(e),r(e),Oe(n.timescale),r(i),Rt(21956),Rt(0)])},Sv=n=>Jt("hdlr",0,0,[Ui("mhlr"),Ui(n),Oe(0),Oe(0),Oe(0),Ui("mp4-muxer-hdlr",!0)]),bv=n=>Sn("minf",null,[n.info.type==="video"?Mv():wv(),Tv(),Cv(n)]),Mv=()=>Jt("vmhd",0,1,[Rt(0),Rt(0),Rt(0),Rt(0)]),wv=()=>Jt("smhd",0,0,[Rt(0),Rt(0)]),Tv=()=>Sn("dinf",null,[Ev()]),Ev=()=>Jt("dref",0,0,[Oe(1)],[Av()]),Av=()=>Jt("url ",0,1),Cv=n=>{let e=n.compositionTimeOffsetTable.length>1||n.compositionTimeOffsetTable.some(t=>t.sampleCompositionTimeOffset!==0);return Sn("stbl",null,[Rv(n),Gv(n),Hv(n),Wv(n),Xv(n),qv(n),e?Yv(n):null])},Rv=n=>Jt("stsd",0,0,[Oe(1)],[n.info.type==="video"?Pv(sS[n.info.codec],n):kv(oS[n.info.codec],n)]),Pv=(n,e)=>Sn(n,[Array(6).fill(0),Rt(1),Rt(0),Rt(0),Array(12).fill(0),Rt(e.info.width),Rt(e.info.height),Oe(4718592),Oe(4718592),Oe(0),Rt(1),Array(32).fill(0),Rt(24),dv(65535)],[rS[e.info.codec](e),e.info.decoderConfig.colorSpace?Nv(e):null]),Iv={bt709:1,bt470bg:5,smpte170m:6},Dv={bt709:1,smpte170m:6,"iec61966-2-1":13},Lv={rgb:0,bt709:1,bt470bg:5,smpte170m:6},Nv=n=>Sn("colr",[Ui("nclx"),Rt(Iv[n.info.decoderConfig.colorSpace.primaries]),Rt(Dv[n.info.decoderConfig.colorSpace.transfer]),Rt(Lv[n.info.decoderConfig.colorSpace.matrix]),En((n.info.decoderConfig.colorSpace.fullRange?1:0)<<7)]),Uv=n=>n.info.decoderConfig&&Sn("avcC",[...new Uint8Array(n.info.decoderConfig.description)]),Fv=n=>n.info.decoderConfig&&Sn("hvcC",[...new Uint8Array(n.info.decoderConfig.description)]),Ov=n=>{if(!n.info.decoderConfig)return null;let e=n.info.decoderConfig;if(!e.colorSpace)throw new Error("'colorSpace' is required in the decoder config for VP9.");let t=e.codec.split("."),i=Number(t[1]),s=Number(t[2]),a=(Number(t[3])<<4)+(0<<1)+Number(e.colorSpace.fullRange);return Jt("vpcC",1,0,[En(i),En(s),En(a),En(2),En(2),En(2),Rt(0)])},Bv=()=>{let t=(1<<7)+1;return Sn("av1C",[t,0,0,0])},kv=(n,e)=>Sn(n,[Array(6).fill(0),Rt(1),Rt(0),Rt(0),Oe(0),Rt(e.info.numberOfChannels),Rt(16),Rt(0),Rt(0),ps(e.info.sampleRate)],[aS[e.info.codec](e)]),zv=n=>{let e=new Uint8Array(n.info.decoderConfig.description);return Jt("esds",0,0,[Oe(58753152),En(32+e.byteLength),Rt(1),En(0),Oe(75530368),En(18+e.byteLength),En(64),En(21),Km(0),Oe(130071),Oe(130071),Oe(92307584),En(e.byteLength),...e,Oe(109084800),En(1),En(2)])},Vv=n=>{let e=3840,t=0,i=n.info.decoderConfig?.description;if(i){if(i.byteLength<18)throw new TypeError("Invalid decoder description provided for Opus; must be at least 18 bytes long.");let s=ArrayBuffer.isView(i)?new DataView(i.buffer,i.byteOffset,i.byteLength):new DataView(i);e=s.getUint16(10,!0),t=s.getInt16(14,!0)}return Sn("dOps",[En(0),En(n.info.numberOfChannels),Rt(e),Oe(n.info.sampleRate),Wd(t),En(0)])},Gv=n=>Jt("stts",0,0,[Oe(n.timeToSampleTable.length),n.timeToSampleTable.map(e=>[Oe(e.sampleCount),Oe(e.sampleDelta)])]),Hv=n=>{if(n.samples.every(t=>t.type==="key"))return null;let e=[...n.samples.entries()].filter(([,t])=>t.type==="key");return Jt("stss",0,0,[Oe(e.length),e.map(([t])=>Oe(t+1))])},Wv=n=>Jt("stsc",0,0,[Oe(n.compactlyCodedChunkTable.length),n.compactlyCodedChunkTable.map(e=>[Oe(e.firstChunk),Oe(e.samplesPerChunk),Oe(1)])]),Xv=n=>Jt("stsz",0,0,[Oe(0),Oe(n.samples.length),n.samples.map(e=>Oe(e.size))]),qv=n=>n.finalizedChunks.length>0&&yc(n.finalizedChunks).offset>=2**32?Jt("co64",0,0,[Oe(n.finalizedChunks.length),n.finalizedChunks.map(e=>kr(e.offset))]):Jt("stco",0,0,[Oe(n.finalizedChunks.length),n.finalizedChunks.map(e=>Oe(e.offset))]),Yv=n=>Jt("ctts",0,0,[Oe(n.compositionTimeOffsetTable.length),n.compositionTimeOffsetTable.map(e=>[Oe(e.sampleCount),Oe(e.sampleCompositionTimeOffset)])]),$v=n=>Sn("mvex",null,n.map(Zv)),Zv=n=>Jt("trex",0,0,[Oe(n.id),Oe(1),Oe(0),Oe(0),Oe(0)]),Zm=(n,e)=>Sn("moof",null,[Kv(n),...e.map(Jv)]),Kv=n=>Jt("mfhd",0,0,[Oe(n)]),eg=n=>{let e=0,t=0,i=0,s=0,r=n.type==="delta";return t|=+r,r?e|=1:e|=2,e<<24|t<<16|i<<8|s},Jv=n=>Sn("traf",null,[jv(n),Qv(n),eS(n)]),jv=n=>{let e=0;e|=8,e|=16,e|=32,e|=131072;let t=n.currentChunk.samples[1]??n.currentChunk.samples[0],i={duration:t.timescaleUnitsToNextSample,size:t.size,flags:eg(t)};return Jt("tfhd",0,e,[Oe(n.id),Oe(i.duration),Oe(i.size),Oe(i.flags)])},Qv=n=>Jt("tfdt",1,0,[kr(ms(n.currentChunk.startTimestamp,n.timescale))]),eS=n=>{let e=n.currentChunk.samples.map(y=>y.timescaleUnitsToNextSample),t=n.currentChunk.samples.map(y=>y.size),i=n.currentChunk.samples.map(eg),s=n.currentChunk.samples.map(y=>ms(y.presentationTimestamp-y.decodeTimestamp,n.timescale)),r=new Set(e),o=new Set(t),a=new Set(i),l=new Set(s),c=a.size===2&&i[0]!==i[1],h=r.size>1,u=o.size>1,d=!c&&a.size>1,f=l.size>1||[...l].some(y=>y!==0),m=0;return m|=1,m|=4*+c,m|=256*+h,m|=512*+u,m|=1024*+d,m|=2048*+f,Jt("trun",1,m,[Oe(n.currentChunk.samples.length),Oe(n.currentChunk.offset-n.currentChunk.moofOffset||0),c?Oe(i[0]):[],n.currentChunk.samples.map((y,g)=>[h?Oe(e[g]):[],u?Oe(t[g]):[],d?Oe(i[g]):[],f?fv(s[g]):[]])])},tS=n=>Sn("mfra",null,[...n.map(nS),iS()]),nS=(n,e)=>Jt("tfra",1,0,[Oe(n.id),Oe(63),Oe(n.finalizedChunks.length),n.finalizedChunks.map(i=>[kr(ms(i.startTimestamp,n.timescale)),kr(i.moofOffset),Oe(e+1),Oe(1),Oe(1)])]),iS=()=>Jt("mfro",0,0,[Oe(0)]),sS={avc:"avc1",hevc:"hvc1",vp9:"vp09",av1:"av01"},rS={avc:Uv,hevc:Fv,vp9:Ov,av1:Bv},oS={aac:"mp4a",opus:"Opus"},aS={aac:zv,opus:Vv};var Tc=class{},qd=class extends Tc{constructor(){super(...arguments),this.buffer=null}},tg=class extends Tc{constructor(n){if(super(),this.options=n,typeof n!="object")throw new TypeError("StreamTarget requires an options object to be passed to its constructor.");if(n.onData){if(typeof n.onData!="function")throw new TypeError("options.onData, when provided, must be a function.");if(n.onData.length<2)throw new TypeError("options.onData, when provided, must be a function that takes in at least two arguments (data and position). Ignoring the position argument, which specifies the byte offset at which the data is to be written, can lead to broken outputs.")}if(n.chunked!==void 0&&typeof n.chunked!="boolean")throw new TypeError("options.chunked, when provided, must be a boolean.");if(n.chunkSize!==void 0&&(!Number.isInteger(n.chunkSize)||n.chunkSize<1024))throw new TypeError("options.chunkSize, when provided, must be an integer and not smaller than 1024.")}},lS=class extends Tc{constructor(n,e){if(super(),this.stream=n,this.options=e,!(n instanceof FileSystemWritableFileStream))throw new TypeError("FileSystemWritableFileStreamTarget requires a FileSystemWritableFileStream instance.");if(e!==void 0&&typeof e!="object")throw new TypeError("FileSystemWritableFileStreamTarget's options, when provided, must be an object.");if(e&&e.chunkSize!==void 0&&(!Number.isInteger(e.chunkSize)||e.chunkSize<=0))throw new TypeError("options.chunkSize, when provided, must be a positive integer")}},Nr,xo,ng=class{constructor(){this.pos=0,ft(this,Nr,new Uint8Array(8)),ft(this,xo,new DataView(V(this,Nr).buffer)),this.offsets=new WeakMap}seek(n){this.pos=n}writeU32(n){V(this,xo).setUint32(0,n,!1),this.write(V(this,Nr).subarray(0,4))}writeU64(n){V(this,xo).setUint32(0,Math.floor(n/2**32),!1),V(this,xo).setUint32(4,n,!1),this.write(V(this,Nr).subarray(0,8))}writeAscii(n){for(let e=0;e<n.length;e++)V(this,xo).setUint8(e%8,n.charCodeAt(e)),e%8===7&&this.write(V(this,Nr));n.length%8!==0&&this.write(V(this,Nr).subarray(0,n.length%8))}writeBox(n){if(this.offsets.set(n,this.pos),n.contents&&!n.children)this.writeBoxHeader(n,n.size??n.contents.byteLength+8),this.write(n.contents);else{let e=this.pos;if(this.writeBoxHeader(n,0),n.contents&&this.write(n.contents),n.children)for(let s of n.children)s&&this.writeBox(s);let t=this.pos,i=n.size??t-e;this.seek(e),this.writeBoxHeader(n,i),this.seek(t)}}writeBoxHeader(n,e){this.writeU32(n.largeSize?1:e),this.writeAscii(n.type),n.largeSize&&this.writeU64(e)}measureBoxHeader(n){return 8+(n.largeSize?8:0)}patchBox(n){let e=this.pos;this.seek(this.offsets.get(n)),this.writeBox(n),this.seek(e)}measureBox(n){if(n.contents&&!n.children)return this.measureBoxHeader(n)+n.contents.byteLength;{let e=this.measureBoxHeader(n);if(n.contents&&(e+=n.contents.byteLength),n.children)for(let t of n.children)t&&(e+=this.measureBox(t));return e}}};Nr=new WeakMap;xo=new WeakMap;var mc,Br,Va,Na,gc,Ud,cS=class extends ng{constructor(n){super(),ft(this,gc),ft(this,mc,void 0),ft(this,Br,new ArrayBuffer(2**16)),ft(this,Va,new Uint8Array(V(this,Br))),ft(this,Na,0),kn(this,mc,n)}write(n){St(this,gc,Ud).call(this,this.pos+n.byteLength),V(this,Va).set(n,this.pos),this.pos+=n.byteLength,kn(this,Na,Math.max(V(this,Na),this.pos))}finalize(){St(this,gc,Ud).call(this,this.pos),V(this,mc).buffer=V(this,Br).slice(0,Math.max(V(this,Na),this.pos))}};mc=new WeakMap;Br=new WeakMap;Va=new WeakMap;Na=new WeakMap;gc=new WeakSet;Ud=function(n){let e=V(this,Br).byteLength;for(;e<n;)e*=2;if(e===V(this,Br).byteLength)return;let t=new ArrayBuffer(e),i=new Uint8Array(t);i.set(V(this,Va),0),kn(this,Br,t),kn(this,Va,i)};var hS=2**24,uS=2,Oa,Ur,Ua,Ns,bi,vc,Fd,Yd,ig,$d,sg,Ba,Sc,Zd=class extends ng{constructor(n){super(),ft(this,vc),ft(this,Yd),ft(this,$d),ft(this,Ba),ft(this,Oa,void 0),ft(this,Ur,[]),ft(this,Ua,void 0),ft(this,Ns,void 0),ft(this,bi,[]),kn(this,Oa,n),kn(this,Ua,n.options?.chunked??!1),kn(this,Ns,n.options?.chunkSize??hS)}write(n){V(this,Ur).push({data:n.slice(),start:this.pos}),this.pos+=n.byteLength}flush(){if(V(this,Ur).length===0)return;let n=[],e=[...V(this,Ur)].sort((t,i)=>t.start-i.start);n.push({start:e[0].start,size:e[0].data.byteLength});for(let t=1;t<e.length;t++){let i=n[n.length-1],s=e[t];s.start<=i.start+i.size?i.size=Math.max(i.size,s.start+s.data.byteLength-i.start):n.push({start:s.start,size:s.data.byteLength})}for(let t of n){t.data=new Uint8Array(t.size);for(let i of V(this,Ur))t.start<=i.start&&i.start<t.start+t.size&&t.data.set(i.data,i.start-t.start);V(this,Ua)?(St(this,vc,Fd).call(this,t.data,t.start),St(this,Ba,Sc).call(this)):V(this,Oa).options.onData?.(t.data,t.start)}V(this,Ur).length=0}finalize(){V(this,Ua)&&St(this,Ba,Sc).call(this,!0)}};Oa=new WeakMap;Ur=new WeakMap;Ua=new WeakMap;Ns=new WeakMap;bi=new WeakMap;vc=new WeakSet;Fd=function(n,e){let t=V(this,bi).findIndex(a=>a.start<=e&&e<a.start+V(this,Ns));t===-1&&(t=St(this,$d,sg).call(this,e));let i=V(this,bi)[t],s=e-i.start,r=n.subarray(0,Math.min(V(this,Ns)-s,n.byteLength));i.data.set(r,s);let o={start:s,end:s+r.byteLength};if(St(this,Yd,ig).call(this,i,o),i.written[0].start===0&&i.written[0].end===V(this,Ns)&&(i.shouldFlush=!0),V(this,bi).length>uS){for(let a=0;a<V(this,bi).length-1;a++)V(this,bi)[a].shouldFlush=!0;St(this,Ba,Sc).call(this)}r.byteLength<n.byteLength&&St(this,vc,Fd).call(this,n.subarray(r.byteLength),e+r.byteLength)};Yd=new WeakSet;ig=function(n,e){let t=0,i=n.written.length-1,s=-1;for(;t<=i;){let r=Math.floor(t+(i-t+1)/2);n.written[r].start<=e.start?(t=r+1,s=r):i=r-1}for(n.written.splice(s+1,0,e),(s===-1||n.written[s].end<e.start)&&s++;s<n.written.length-1&&n.written[s].end>=n.written[s+1].start;)n.written[s].end=Math.max(n.written[s].end,n.written[s+1].end),n.written.splice(s+1,1)};$d=new WeakSet;sg=function(n){let t={start:Math.floor(n/V(this,Ns))*V(this,Ns),data:new Uint8Array(V(this,Ns)),written:[],shouldFlush:!1};return V(this,bi).push(t),V(this,bi).sort((i,s)=>i.start-s.start),V(this,bi).indexOf(t)};Ba=new WeakSet;Sc=function(n=!1){for(let e=0;e<V(this,bi).length;e++){let t=V(this,bi)[e];if(!(!t.shouldFlush&&!n)){for(let i of t.written)V(this,Oa).options.onData?.(t.data.subarray(i.start,i.end),t.start+i.start);V(this,bi).splice(e--,1)}}};var dS=class extends Zd{constructor(n){super(new tg({onData:(e,t)=>n.stream.write({type:"write",data:e,position:t}),chunked:!0,chunkSize:n.options?.chunkSize}))}},Od=1e3,fS=["avc","hevc","vp9","av1"],pS=["aac","opus"],mS=2082844800,gS=["strict","offset","cross-track-offset"],Ye,it,bc,Si,Wn,Bn,yo,vo,Kd,Fr,Or,ka,Bd,rg,kd,og,Jd,ag,zd,lg,jd,cg,_c,Vd,fs,Ls,Qd,hg,za,Mc,wc,ef,bo,Ga,xc,Gd,ug=class{constructor(n){if(ft(this,Bd),ft(this,kd),ft(this,Jd),ft(this,zd),ft(this,jd),ft(this,_c),ft(this,fs),ft(this,Qd),ft(this,za),ft(this,wc),ft(this,bo),ft(this,xc),ft(this,Ye,void 0),ft(this,it,void 0),ft(this,bc,void 0),ft(this,Si,void 0),ft(this,Wn,null),ft(this,Bn,null),ft(this,yo,Math.floor(Date.now()/1e3)+mS),ft(this,vo,[]),ft(this,Kd,1),ft(this,Fr,[]),ft(this,Or,[]),ft(this,ka,!1),St(this,Bd,rg).call(this,n),n.video=Fa(n.video),n.audio=Fa(n.audio),n.fastStart=Fa(n.fastStart),this.target=n.target,kn(this,Ye,{firstTimestampBehavior:"strict",...n}),n.target instanceof qd)kn(this,it,new cS(n.target));else if(n.target instanceof tg)kn(this,it,new Zd(n.target));else if(n.target instanceof lS)kn(this,it,new dS(n.target));else throw new Error(`Invalid target: ${n.target}`);St(this,zd,lg).call(this),St(this,kd,og).call(this)}addVideoChunk(n,e,t,i){if(!(n instanceof EncodedVideoChunk))throw new TypeError("addVideoChunk's first argument (sample) must be of type EncodedVideoChunk.");if(e&&typeof e!="object")throw new TypeError("addVideoChunk's second argument (meta), when provided, must be an object.");if(t!==void 0&&(!Number.isFinite(t)||t<0))throw new TypeError("addVideoChunk's third argument (timestamp), when provided, must be a non-negative real number.");if(i!==void 0&&!Number.isFinite(i))throw new TypeError("addVideoChunk's fourth argument (compositionTimeOffset), when provided, must be a real number.");let s=new Uint8Array(n.byteLength);n.copyTo(s),this.addVideoChunkRaw(s,n.type,t??n.timestamp,n.duration,e,i)}addVideoChunkRaw(n,e,t,i,s,r){if(!(n instanceof Uint8Array))throw new TypeError("addVideoChunkRaw's first argument (data) must be an instance of Uint8Array.");if(e!=="key"&&e!=="delta")throw new TypeError("addVideoChunkRaw's second argument (type) must be either 'key' or 'delta'.");if(!Number.isFinite(t)||t<0)throw new TypeError("addVideoChunkRaw's third argument (timestamp) must be a non-negative real number.");if(!Number.isFinite(i)||i<0)throw new TypeError("addVideoChunkRaw's fourth argument (duration) must be a non-negative real number.");if(s&&typeof s!="object")throw new TypeError("addVideoChunkRaw's fifth argument (meta), when provided, must be an object.");if(r!==void 0&&!Number.isFinite(r))throw new TypeError("addVideoChunkRaw's sixth argument (compositionTimeOffset), when provided, must be a real number.");if(St(this,xc,Gd).call(this),!V(this,Ye).video)throw new Error("No video track declared.");if(typeof V(this,Ye).fastStart=="object"&&V(this,Wn).samples.length===V(this,Ye).fastStart.expectedVideoChunks)throw new Error(`Cannot add more video chunks than specified in 'fastStart' (${V(this,Ye).fastStart.expectedVideoChunks}).`);let o=St(this,_c,Vd).call(this,V(this,Wn),n,e,t,i,s,r);if(V(this,Ye).fastStart==="fragmented"&&V(this,Bn)){for(;V(this,Or).length>0&&V(this,Or)[0].decodeTimestamp<=o.decodeTimestamp;){let a=V(this,Or).shift();St(this,fs,Ls).call(this,V(this,Bn),a)}o.decodeTimestamp<=V(this,Bn).lastDecodeTimestamp?St(this,fs,Ls).call(this,V(this,Wn),o):V(this,Fr).push(o)}else St(this,fs,Ls).call(this,V(this,Wn),o)}addAudioChunk(n,e,t){if(!(n instanceof EncodedAudioChunk))throw new TypeError("addAudioChunk's first argument (sample) must be of type EncodedAudioChunk.");if(e&&typeof e!="object")throw new TypeError("addAudioChunk's second argument (meta), when provided, must be an object.");if(t!==void 0&&(!Number.isFinite(t)||t<0))throw new TypeError("addAudioChunk's third argument (timestamp), when provided, must be a non-negative real number.");let i=new Uint8Array(n.byteLength);n.copyTo(i),this.addAudioChunkRaw(i,n.type,t??n.timestamp,n.duration,e)}addAudioChunkRaw(n,e,t,i,s){if(!(n instanceof Uint8Array))throw new TypeError("addAudioChunkRaw's first argument (data) must be an instance of Uint8Array.");if(e!=="key"&&e!=="delta")throw new TypeError("addAudioChunkRaw's second argument (type) must be either 'key' or 'delta'.");if(!Number.isFinite(t)||t<0)throw new TypeError("addAudioChunkRaw's third argument (timestamp) must be a non-negative real number.");if(!Number.isFinite(i)||i<0)throw new TypeError("addAudioChunkRaw's fourth argument (duration) must be a non-negative real number.");if(s&&typeof s!="object")throw new TypeError("addAudioChunkRaw's fifth argument (meta), when provided, must be an object.");if(St(this,xc,Gd).call(this),!V(this,Ye).audio)throw new Error("No audio track declared.");if(typeof V(this,Ye).fastStart=="object"&&V(this,Bn).samples.length===V(this,Ye).fastStart.expectedAudioChunks)throw new Error(`Cannot add more audio chunks than specified in 'fastStart' (${V(this,Ye).fastStart.expectedAudioChunks}).`);let r=St(this,_c,Vd).call(this,V(this,Bn),n,e,t,i,s);if(V(this,Ye).fastStart==="fragmented"&&V(this,Wn)){for(;V(this,Fr).length>0&&V(this,Fr)[0].decodeTimestamp<=r.decodeTimestamp;){let o=V(this,Fr).shift();St(this,fs,Ls).call(this,V(this,Wn),o)}r.decodeTimestamp<=V(this,Wn).lastDecodeTimestamp?St(this,fs,Ls).call(this,V(this,Bn),r):V(this,Or).push(r)}else St(this,fs,Ls).call(this,V(this,Bn),r)}finalize(){if(V(this,ka))throw new Error("Cannot finalize a muxer more than once.");if(V(this,Ye).fastStart==="fragmented"){for(let e of V(this,Fr))St(this,fs,Ls).call(this,V(this,Wn),e);for(let e of V(this,Or))St(this,fs,Ls).call(this,V(this,Bn),e);St(this,wc,ef).call(this,!1)}else V(this,Wn)&&St(this,za,Mc).call(this,V(this,Wn)),V(this,Bn)&&St(this,za,Mc).call(this,V(this,Bn));let n=[V(this,Wn),V(this,Bn)].filter(Boolean);if(V(this,Ye).fastStart==="in-memory"){let e;for(let i=0;i<2;i++){let s=pc(n,V(this,yo)),r=V(this,it).measureBox(s);e=V(this,it).measureBox(V(this,Si));let o=V(this,it).pos+r+e;for(let a of V(this,vo)){a.offset=o;for(let{data:l}of a.samples)o+=l.byteLength,e+=l.byteLength}if(o<2**32)break;e>=2**32&&(V(this,Si).largeSize=!0)}let t=pc(n,V(this,yo));V(this,it).writeBox(t),V(this,Si).size=e,V(this,it).writeBox(V(this,Si));for(let i of V(this,vo))for(let s of i.samples)V(this,it).write(s.data),s.data=null}else if(V(this,Ye).fastStart==="fragmented"){let e=V(this,it).pos,t=tS(n);V(this,it).writeBox(t);let i=V(this,it).pos-e;V(this,it).seek(V(this,it).pos-4),V(this,it).writeU32(i)}else{let e=V(this,it).offsets.get(V(this,Si)),t=V(this,it).pos-e;V(this,Si).size=t,V(this,Si).largeSize=t>=2**32,V(this,it).patchBox(V(this,Si));let i=pc(n,V(this,yo));if(typeof V(this,Ye).fastStart=="object"){V(this,it).seek(V(this,bc)),V(this,it).writeBox(i);let s=e-V(this,it).pos;V(this,it).writeBox(mv(s))}else V(this,it).writeBox(i)}St(this,bo,Ga).call(this),V(this,it).finalize(),kn(this,ka,!0)}};Ye=new WeakMap;it=new WeakMap;bc=new WeakMap;Si=new WeakMap;Wn=new WeakMap;Bn=new WeakMap;yo=new WeakMap;vo=new WeakMap;Kd=new WeakMap;Fr=new WeakMap;Or=new WeakMap;ka=new WeakMap;Bd=new WeakSet;rg=function(n){if(typeof n!="object")throw new TypeError("The muxer requires an options object to be passed to its constructor.");if(!(n.target instanceof Tc))throw new TypeError("The target must be provided and an instance of Target.");if(n.video){if(!fS.includes(n.video.codec))throw new TypeError(`Unsupported video codec: ${n.video.codec}`);if(!Number.isInteger(n.video.width)||n.video.width<=0)throw new TypeError(`Invalid video width: ${n.video.width}. Must be a positive integer.`);if(!Number.isInteger(n.video.height)||n.video.height<=0)throw new TypeError(`Invalid video height: ${n.video.height}. Must be a positive integer.`);let e=n.video.rotation;if(typeof e=="number"&&![0,90,180,270].includes(e))throw new TypeError(`Invalid video rotation: ${e}. Has to be 0, 90, 180 or 270.`);if(Array.isArray(e)&&(e.length!==9||e.some(t=>typeof t!="number")))throw new TypeError(`Invalid video transformation matrix: ${e.join()}`);if(n.video.frameRate!==void 0&&(!Number.isInteger(n.video.frameRate)||n.video.frameRate<=0))throw new TypeError(`Invalid video frame rate: ${n.video.frameRate}. Must be a positive integer.`)}if(n.audio){if(!pS.includes(n.audio.codec))throw new TypeError(`Unsupported audio codec: ${n.audio.codec}`);if(!Number.isInteger(n.audio.numberOfChannels)||n.audio.numberOfChannels<=0)throw new TypeError(`Invalid number of audio channels: ${n.audio.numberOfChannels}. Must be a positive integer.`);if(!Number.isInteger(n.audio.sampleRate)||n.audio.sampleRate<=0)throw new TypeError(`Invalid audio sample rate: ${n.audio.sampleRate}. Must be a positive integer.`)}if(n.firstTimestampBehavior&&!gS.includes(n.firstTimestampBehavior))throw new TypeError(`Invalid first timestamp behavior: ${n.firstTimestampBehavior}`);if(typeof n.fastStart=="object"){if(n.video){if(n.fastStart.expectedVideoChunks===void 0)throw new TypeError("'fastStart' is an object but is missing property 'expectedVideoChunks'.");if(!Number.isInteger(n.fastStart.expectedVideoChunks)||n.fastStart.expectedVideoChunks<0)throw new TypeError("'expectedVideoChunks' must be a non-negative integer.")}if(n.audio){if(n.fastStart.expectedAudioChunks===void 0)throw new TypeError("'fastStart' is an object but is missing property 'expectedAudioChunks'.");if(!Number.isInteger(n.fastStart.expectedAudioChunks)||n.fastStart.expectedAudioChunks<0)throw new TypeError("'expectedAudioChunks' must be a non-negative integer.")}}else if(![!1,"in-memory","fragmented"].includes(n.fastStart))throw new TypeError("'fastStart' option must be false, 'in-memory', 'fragmented' or an object.");if(n.minFragmentDuration!==void 0&&(!Number.isFinite(n.minFragmentDuration)||n.minFragmentDuration<0))throw new TypeError("'minFragmentDuration' must be a non-negative number.")};kd=new WeakSet;og=function(){if(V(this,it).writeBox(pv({holdsAvc:V(this,Ye).video?.codec==="avc",fragmented:V(this,Ye).fastStart==="fragmented"})),kn(this,bc,V(this,it).pos),V(this,Ye).fastStart==="in-memory")kn(this,Si,Nd(!1));else if(V(this,Ye).fastStart!=="fragmented"){if(typeof V(this,Ye).fastStart=="object"){let n=St(this,Jd,ag).call(this);V(this,it).seek(V(this,it).pos+n)}kn(this,Si,Nd(!0)),V(this,it).writeBox(V(this,Si))}St(this,bo,Ga).call(this)};Jd=new WeakSet;ag=function(){if(typeof V(this,Ye).fastStart!="object")return;let n=0,e=[V(this,Ye).fastStart.expectedVideoChunks,V(this,Ye).fastStart.expectedAudioChunks];for(let t of e)t&&(n+=8*Math.ceil(2/3*t),n+=4*t,n+=12*Math.ceil(2/3*t),n+=4*t,n+=8*t);return n+=4096,n};zd=new WeakSet;lg=function(){if(V(this,Ye).video&&kn(this,Wn,{id:1,info:{type:"video",codec:V(this,Ye).video.codec,width:V(this,Ye).video.width,height:V(this,Ye).video.height,rotation:V(this,Ye).video.rotation??0,decoderConfig:null},timescale:V(this,Ye).video.frameRate??57600,samples:[],finalizedChunks:[],currentChunk:null,firstDecodeTimestamp:void 0,lastDecodeTimestamp:-1,timeToSampleTable:[],compositionTimeOffsetTable:[],lastTimescaleUnits:null,lastSample:null,compactlyCodedChunkTable:[]}),V(this,Ye).audio&&(kn(this,Bn,{id:V(this,Ye).video?2:1,info:{type:"audio",codec:V(this,Ye).audio.codec,numberOfChannels:V(this,Ye).audio.numberOfChannels,sampleRate:V(this,Ye).audio.sampleRate,decoderConfig:null},timescale:V(this,Ye).audio.sampleRate,samples:[],finalizedChunks:[],currentChunk:null,firstDecodeTimestamp:void 0,lastDecodeTimestamp:-1,timeToSampleTable:[],compositionTimeOffsetTable:[],lastTimescaleUnits:null,lastSample:null,compactlyCodedChunkTable:[]}),V(this,Ye).audio.codec==="aac")){let n=St(this,jd,cg).call(this,2,V(this,Ye).audio.sampleRate,V(this,Ye).audio.numberOfChannels);V(this,Bn).info.decoderConfig={codec:V(this,Ye).audio.codec,description:n,numberOfChannels:V(this,Ye).audio.numberOfChannels,sampleRate:V(this,Ye).audio.sampleRate}}};jd=new WeakSet;cg=function(n,e,t){let s=[96e3,88200,64e3,48e3,44100,32e3,24e3,22050,16e3,12e3,11025,8e3,7350].indexOf(e),r=t,o="";o+=n.toString(2).padStart(5,"0"),o+=s.toString(2).padStart(4,"0"),s===15&&(o+=e.toString(2).padStart(24,"0")),o+=r.toString(2).padStart(4,"0");let a=Math.ceil(o.length/8)*8;o=o.padEnd(a,"0");let l=new Uint8Array(o.length/8);for(let c=0;c<o.length;c+=8)l[c/8]=parseInt(o.slice(c,c+8),2);return l};_c=new WeakSet;Vd=function(n,e,t,i,s,r,o){let a=i/1e6,l=(i-(o??0))/1e6,c=s/1e6,h=St(this,Qd,hg).call(this,a,l,n);return a=h.presentationTimestamp,l=h.decodeTimestamp,r?.decoderConfig&&(n.info.decoderConfig===null?n.info.decoderConfig=r.decoderConfig:Object.assign(n.info.decoderConfig,r.decoderConfig)),{presentationTimestamp:a,decodeTimestamp:l,duration:c,data:e,size:e.byteLength,type:t,timescaleUnitsToNextSample:ms(c,n.timescale)}};fs=new WeakSet;Ls=function(n,e){V(this,Ye).fastStart!=="fragmented"&&n.samples.push(e);let t=ms(e.presentationTimestamp-e.decodeTimestamp,n.timescale);if(n.lastTimescaleUnits!==null){let s=ms(e.decodeTimestamp,n.timescale,!1),r=Math.round(s-n.lastTimescaleUnits);if(n.lastTimescaleUnits+=r,n.lastSample.timescaleUnitsToNextSample=r,V(this,Ye).fastStart!=="fragmented"){let o=yc(n.timeToSampleTable);o.sampleCount===1?(o.sampleDelta=r,o.sampleCount++):o.sampleDelta===r?o.sampleCount++:(o.sampleCount--,n.timeToSampleTable.push({sampleCount:2,sampleDelta:r}));let a=yc(n.compositionTimeOffsetTable);a.sampleCompositionTimeOffset===t?a.sampleCount++:n.compositionTimeOffsetTable.push({sampleCount:1,sampleCompositionTimeOffset:t})}}else n.lastTimescaleUnits=0,V(this,Ye).fastStart!=="fragmented"&&(n.timeToSampleTable.push({sampleCount:1,sampleDelta:ms(e.duration,n.timescale)}),n.compositionTimeOffsetTable.push({sampleCount:1,sampleCompositionTimeOffset:t}));n.lastSample=e;let i=!1;if(!n.currentChunk)i=!0;else{let s=e.presentationTimestamp-n.currentChunk.startTimestamp;if(V(this,Ye).fastStart==="fragmented"){let r=V(this,Wn)??V(this,Bn),o=V(this,Ye).minFragmentDuration??1;n===r&&e.type==="key"&&s>=o&&(i=!0,St(this,wc,ef).call(this))}else i=s>=.5}i&&(n.currentChunk&&St(this,za,Mc).call(this,n),n.currentChunk={startTimestamp:e.presentationTimestamp,samples:[]}),n.currentChunk.samples.push(e)};Qd=new WeakSet;hg=function(n,e,t){let i=V(this,Ye).firstTimestampBehavior==="strict",s=t.lastDecodeTimestamp===-1;if(i&&s&&e!==0)throw new Error(`The first chunk for your media track must have a timestamp of 0 (received DTS=${e}).Non-zero first timestamps are often caused by directly piping frames or audio data from a MediaStreamTrack into the encoder. Their timestamps are typically relative to the age of thedocument, which is probably what you want.

If you want to offset all timestamps of a track such that the first one is zero, set firstTimestampBehavior: 'offset' in the options.
`);if(V(this,Ye).firstTimestampBehavior==="offset"||V(this,Ye).firstTimestampBehavior==="cross-track-offset"){t.firstDecodeTimestamp===void 0&&(t.firstDecodeTimestamp=e);let o;V(this,Ye).firstTimestampBehavior==="offset"?o=t.firstDecodeTimestamp:o=Math.min(V(this,Wn)?.firstDecodeTimestamp??1/0,V(this,Bn)?.firstDecodeTimestamp??1/0),e-=o,n-=o}if(e<t.lastDecodeTimestamp)throw new Error(`Timestamps must be monotonically increasing (DTS went from ${t.lastDecodeTimestamp*1e6} to ${e*1e6}).`);return t.lastDecodeTimestamp=e,{presentationTimestamp:n,decodeTimestamp:e}};za=new WeakSet;Mc=function(n){if(V(this,Ye).fastStart==="fragmented")throw new Error("Can't finalize individual chunks if 'fastStart' is set to 'fragmented'.");if(n.currentChunk){if(n.finalizedChunks.push(n.currentChunk),V(this,vo).push(n.currentChunk),(n.compactlyCodedChunkTable.length===0||yc(n.compactlyCodedChunkTable).samplesPerChunk!==n.currentChunk.samples.length)&&n.compactlyCodedChunkTable.push({firstChunk:n.finalizedChunks.length,samplesPerChunk:n.currentChunk.samples.length}),V(this,Ye).fastStart==="in-memory"){n.currentChunk.offset=0;return}n.currentChunk.offset=V(this,it).pos;for(let e of n.currentChunk.samples)V(this,it).write(e.data),e.data=null;St(this,bo,Ga).call(this)}};wc=new WeakSet;ef=function(n=!0){if(V(this,Ye).fastStart!=="fragmented")throw new Error("Can't finalize a fragment unless 'fastStart' is set to 'fragmented'.");let e=[V(this,Wn),V(this,Bn)].filter(a=>a&&a.currentChunk);if(e.length===0)return;let t=uv(this,Kd)._++;if(t===1){let a=pc(e,V(this,yo),!0);V(this,it).writeBox(a)}let i=V(this,it).pos,s=Zm(t,e);V(this,it).writeBox(s);{let a=Nd(!1),l=0;for(let h of e)for(let u of h.currentChunk.samples)l+=u.size;let c=V(this,it).measureBox(a)+l;c>=2**32&&(a.largeSize=!0,c=V(this,it).measureBox(a)+l),a.size=c,V(this,it).writeBox(a)}for(let a of e){a.currentChunk.offset=V(this,it).pos,a.currentChunk.moofOffset=i;for(let l of a.currentChunk.samples)V(this,it).write(l.data),l.data=null}let r=V(this,it).pos;V(this,it).seek(V(this,it).offsets.get(s));let o=Zm(t,e);V(this,it).writeBox(o),V(this,it).seek(r);for(let a of e)a.finalizedChunks.push(a.currentChunk),V(this,vo).push(a.currentChunk),a.currentChunk=null;n&&St(this,bo,Ga).call(this)};bo=new WeakSet;Ga=function(){V(this,it)instanceof Zd&&V(this,it).flush()};xc=new WeakSet;Gd=function(){if(V(this,ka))throw new Error("Cannot add new video or audio chunks after the file has been finalized.")};var _S=new Set(["moov","trak","mdia"]),xS=new Set(["mvhd","tkhd","mdhd"]);function dg(n){return fg(n,0,n.length),n}function fg(n,e,t){let i=new DataView(n.buffer,n.byteOffset,n.byteLength);for(let s=e;s+8<=t;){let r=i.getUint32(s),o=String.fromCharCode(...n.subarray(s+4,s+8));if(_S.has(o)&&fg(n,s+8,s+r),xS.has(o)&&n.fill(0,s+12,s+12+(n[s+8]===1?16:8)),r<8)return;s+=r}}var yS=44,vS=2,SS=4,bS={h264:["avc1.640028","avc1.42002a"],vp9:["vp09.00.40.08"]},pg=1e-9,MS=24;function wS(n,e){let{fps:t=20,speed:i=1,start:s=0,end:r=n.samples-1}=e,[o,a]=[n.time[s],n.time[r]];if(!(t>0&&i>0)||o===void 0||a===void 0||a<o){let c=`fps ${t}, speed ${i}, samples ${s} to ${r} of ${n.samples}`;throw new Error(`video: expected fps and speed above 0, and a last sample after the first one, got ${c}`)}let l=Math.floor((a-o)*t/i+pg)+1;return Array.from({length:l},(c,h)=>o+h*i/t+pg)}async function Ec(n,e,t){let{fps:i=20,width:s=960,height:r=480}=e;if(s%2!==0||r%2!==0||s<64||r<64)throw new Error(`video: expected an even width and height of at least 64 x 64, got ${s} x ${r}`);let o=wS(n.data,e),{config:a,codec:l}=await TS(e.codec?[e.codec]:["h264","vp9"],s,r,i),c=new qd,h=new ug({target:c,video:{codec:l==="h264"?"avc":"vp9",width:s,height:r,frameRate:i},fastStart:"in-memory"}),u=null,d=new VideoEncoder({output:(y,g)=>h.addVideoChunk(y,g),error:y=>{u=y}});d.configure(a);let f=new OffscreenCanvas(s,r),m=n.store.state;n.store.set({playing:!1});for(let y of[n.robot,n.space])y.hold(s/2,r-yS);try{for(let[y,g]of o.entries()){ES(n,f,n.data.sampleAt(g));let p=new VideoFrame(f,{timestamp:Math.round(y*1e6/i),duration:Math.round(1e6/i)}),S={keyFrame:y%Math.max(1,Math.round(vS*i))===0,vp9:{quantizer:MS}};d.encode(p,S),p.close(),t((y+1)/o.length);do await new Promise(C=>setTimeout(C,0));while(d.encodeQueueSize>SS&&u===null);if(u!==null)throw u}await d.flush()}finally{d.state!=="closed"&&d.close();for(let y of[n.robot,n.space])y.release();n.store.set({sample:m.sample})}return h.finalize(),dg(new Uint8Array(c.buffer))}async function TS(n,e,t,i){if(typeof VideoEncoder>"u")throw new Error("video: this browser has no WebCodecs; Chromium has");for(let s of n){let r=s==="h264"?{bitrate:4e6,avc:{format:"avc"}}:{bitrateMode:"quantizer"};for(let o of bS[s]){let a={codec:o,width:e,height:t,framerate:i,latencyMode:"quality",hardwareAcceleration:"prefer-software",...r};if((await VideoEncoder.isConfigSupported(a).catch(()=>null))?.supported)return{config:a,codec:s}}}throw new Error(`video: this browser does not encode ${n.join(" or ")} at ${e} x ${t}`)}function ES(n,e,t){let{data:i,store:s,robot:r,space:o}=n;s.set({sample:t}),n.flush(),r.draw(),o.draw();let a=e.getContext("2d");if(!a)throw new Error("video: this browser draws nothing on a canvas");let{width:l,height:c}=e;a.fillStyle=xi,a.fillRect(0,0,l,c),a.drawImage(r.canvas,0,0),a.drawImage(o.canvas,l/2,0),a.fillStyle=hn,a.font="14px system-ui, 'DejaVu Sans', sans-serif";let h=i.sensor(s.state.sensor),u=s.state.quantity==="force"?"force":"torque";a.fillText(`${i.scene.title} \xB7 ${h?.name??""} \xB7 ${u}`,12,c-26,l/2),a.fillText(`sample ${t} \xB7 ${(i.time[t]??0).toFixed(3)} s`,12,c-8);let d=l/2+12;for(let f of h?.wrenches??[])s.state.hidden.has(f.name)||(a.fillStyle=h?ni(h,f):hn,a.fillRect(d,c-22,10,10),a.fillText(f.name,d+14,c-12),d+=30+a.measureText(f.name).width)}function mg(n,e,t,i){let s=n.store.state;return{reset(){n.store.set(s);for(let r of[n.robot,n.space])r.reset();n.flush()},show(r){let o=Math.max(0,n.data.samples-1);n.store.set({sample:Math.min(o,Math.max(0,r)),playing:!1}),n.flush()},sample:()=>n.store.state.sample,linkPoses:r=>Object.fromEntries([...La(n.data,r)].map(([o,a])=>[o,[...a]])),spacePoint(r,o){let a=e.sampleOnCanvas(r,o),l=e.canvas.getBoundingClientRect();return a&&{x:l.left+a.x,y:l.top+a.y}},planePoint:(r,o,a)=>t[r]?.sampleOnScreen(o,a)??null,plots:()=>i.flatMap(r=>r.range()??[]),cloudSamples:()=>[...e.samples()],skin:()=>n.robot.skin.shown(),video:async(r={})=>AS(await Ec(n,r,()=>{}))}}function AS(n){let e="";for(let t=0;t<n.length;t+=32768)e+=String.fromCharCode(...n.subarray(t,t+32768));return btoa(e)}var CS=1e-6;function Mo(n,e){let t=n.sensor(e.sensor),i=Ra(t,e.hidden),s=t&&i?n.columns.error(t,i,e.quantity,3):null;if(!s)return null;let[r,o]=e.window;for(let a of["validation","calibration"]){let l=null;for(let{start_s:c,end_s:h}of n.scene.intervals.filter(u=>u.use===a)){let u=Math.min(n.firstAt(h),n.sampleAt(o)+1),d=s.farthest(n.firstAt(Math.max(r,c)),u);d!==null&&(l===null||s.at(d)>s.at(l))&&(l=d)}if(l!==null)return l}return null}function gg(n,e,t){let i=n.time[e.sample]??0,r=[...[...n.scene.intervals,...yi(n,e.marks),...e.selected].map(o=>o.start_s),...n.scene.findings.flatMap(({start_s:o})=>o===null?[]:[o]),...e.marks.map(({time_s:o})=>o)].map(o=>n.time[n.nearestSample(o)]??o).filter(o=>t*(o-i)>CS);return r.length===0?null:n.nearestSample(t>0?Math.min(...r):Math.max(...r))}function zr(n,e,t,i,s){let r=4*(i[1]-i[0])/Math.max(1,s-1),o=Math.min(i[1]-i[0],Math.max(r,e*(n[1]-n[0]))),a=(t-n[0])/(n[1]-n[0]||1);return _g(t-a*o,o,i)}function wo(n,e,t){return _g(n[0]+e,n[1]-n[0],t)}function _g(n,e,[t,i]){let s=Math.max(t,Math.min(i-e,n));return[s,Math.min(i,s+e)]}var RS=["0.1","0.25","0.5","1","2","5","10","50"],PS=["point","begin","end"];function xg(n,e,t){let i=Math.max(0,n.samples-1),s=Y("input",{type:"range",min:0,max:i,step:1,"aria-label":"Sample slider",class:"slider"});s.addEventListener("input",()=>e.set({sample:Number(s.value),playing:!1}));let r=Y("input",{type:"number",min:0,max:i,step:1,"aria-label":"Sample number"});r.addEventListener("change",()=>{let h=Math.round(r.valueAsNumber);Number.isFinite(h)&&e.set({sample:Math.min(i,Math.max(0,h)),playing:!1}),r.value=String(e.state.sample)});let o=Y("time",{"aria-label":"Time"}),a=zt("\u25B6 Play",()=>nf(n,e),{class:"play"}),l=RS.map(h=>[h,`${h}\xD7`]),c=or("Speed",l,"1",h=>e.set({speed:Number(h)}));return e.on(["sample"],()=>{let{sample:h}=e.state;s.value=String(h),r.value=String(h);let u=(n.time[h]??0).toFixed(3);s.setAttribute("aria-valuetext",`sample ${h}, ${u} s`),o.textContent=`${u} s`}),e.on(["playing"],()=>{let{playing:h}=e.state;a.textContent=h?"\u275A\u275A Pause":"\u25B6 Play",a.setAttribute("aria-label",h?"Pause":"Play"),a.setAttribute("aria-pressed",String(h))}),Y("footer",{class:"transport"},a,c,zt("\u22121",()=>Ac(n,e,-1),{"aria-label":"One sample back"}),s,zt("+1",()=>Ac(n,e,1),{"aria-label":"One sample on"}),r,o,IS(n,e,t))}function IS(n,e,t){let i=Y("span",{class:"segments",role:"radiogroup","aria-label":"Saved sample is"});for(let s of PS){let r=Y("input",{type:"radio",name:"mark-kind",value:s});r.addEventListener("change",()=>e.set({markKind:s})),e.on(["markKind"],()=>{r.checked=e.state.markKind===s}),i.append(Y("label",{},r,Y("span",{},s)))}return Y("span",{class:"saving"},i,zt("Save sample",()=>tf(n,e,t),{class:"primary"}))}function tf(n,e,t){let{sample:i,markKind:s,marks:r}=e.state;if(n.samples===0)return;let o=n.time[i]??0,a={sample:i,time_s:o,mark:s,label:"",use:"ignore"},l={begin:"end",end:"begin",point:"point"};e.set({marks:[...r,a],markKind:l[s]}),t(`Saved sample ${i} at ${o.toFixed(3)} s as ${s}.`)}function Ac(n,e,t){let i=Math.min(Math.max(0,n.samples-1),Math.max(0,e.state.sample+t));e.set({sample:i,playing:!1})}function nf(n,e){let{playing:t,sample:i}=e.state;!t&&i>=n.samples-1&&e.set({sample:0}),e.set({playing:!t&&n.samples>1})}function yg(n,e){let t=0,i=-1,s=0,r=o=>{let{playing:a,sample:l,speed:c}=e.state;a&&(l!==i&&(t=n.time[l]??0),t+=Math.min(.5,(o-s)/1e3)*c,s=o,i=n.sampleAt(t),e.set({sample:i,playing:i<n.samples-1}),requestAnimationFrame(r))};e.on(["playing"],()=>{e.state.playing&&(i=-1,s=performance.now(),requestAnimationFrame(r))})}var vg=1.5,Sg=.25,wg=[["\u2190 \u2192","one sample back, on; with Shift ten"],["Home End","first, last sample"],["Space","play, pause"],["w","worst sample of the validation data in view"],["n, Shift+n","next, previous event: interval, finding, saved sample"],["+ \u2212 0","stretch, shrink the time in view, all of it; wheel likewise"],["[ ]","move the time in view; drag likewise, Shift+drag chooses it"],["Esc","forget what was encircled in a plane"],["f t","force, torque"],["p b e","the saved sample is a point, begin, end"],["s","save the sample"],["Alt + arrows, + \u2212, 0","turn, zoom, reset the focused 3-D view"]];function Tg(n,e,t){let i={Home:()=>e.set({sample:0,playing:!1}),End:()=>e.set({sample:Math.max(0,n.samples-1),playing:!1})," ":()=>nf(n,e),w:()=>sf(n,e),n:()=>Cc(n,e,1),N:()=>Cc(n,e,-1),"+":()=>bg(n,e,1/vg),"-":()=>bg(n,e,vg),0:()=>e.set({window:n.span}),"[":()=>Mg(n,e,-Sg),"]":()=>Mg(n,e,Sg),Escape:()=>e.set({selected:[]}),f:()=>e.set({quantity:"force"}),t:()=>e.set({quantity:"moment"}),p:()=>e.set({markKind:"point"}),b:()=>e.set({markKind:"begin"}),e:()=>e.set({markKind:"end"}),s:()=>tf(n,e,t)};document.addEventListener("keydown",s=>{if(s.ctrlKey||s.metaKey||s.altKey||DS(s.target,s.key))return;let r=s.key==="ArrowRight"?1:s.key==="ArrowLeft"?-1:0,o=r!==0?()=>Ac(n,e,s.shiftKey?10*r:r):i[s.key];o&&(s.preventDefault(),o())})}function sf(n,e){let t=Mo(n,e.state);t!==null&&e.set({sample:t,playing:!1})}function Cc(n,e,t){let i=gg(n,e.state,t);if(i===null)return;let{window:s}=e.state,r=n.time[i]??0,a=s[0]<=r&&r<=s[1]?s:wo(s,r-(s[0]+s[1])/2,n.span);e.set({sample:i,playing:!1,window:a})}function bg(n,e,t){let{window:i,sample:s}=e.state,r=n.time[s]??0,o=i[0]<=r&&r<=i[1]?r:(i[0]+i[1])/2;e.set({window:zr(i,t,o,n.span,n.samples)})}function Mg(n,e,t){let{window:i}=e.state;e.set({window:wo(i,t*(i[1]-i[0]),n.span)})}function Eg(){document.addEventListener("change",({target:n})=>{(n instanceof HTMLSelectElement||n instanceof HTMLInputElement&&n.type==="radio")&&!n.matches(":focus-visible")&&n.blur()})}function DS(n,e){return n instanceof HTMLInputElement?n.type==="range"?!1:n.type==="checkbox"?e===" ":n.type==="radio"?e===" "||e.startsWith("Arrow"):!0:n instanceof HTMLSelectElement||n instanceof HTMLTextAreaElement?!0:n instanceof HTMLElement&&n.closest("button, summary, a")!==null&&e===" "}var Ag=["error","measured"];function Cg(n,e,t){let i=Y("p",{role:"status",class:"status"}),s=Y("div",{class:"view"}),r=Y("div",{class:"view"}),o=Y("p",{class:"overlay"}),a=[0,1,2].map(()=>Y("div",{class:"view"})),l=NS(n,e),c=Y("aside",{class:"side","aria-label":"Details"}),h=Y("div",{class:"tools"}),u=Y("div",{class:"tools"}),d=Y("div",{class:"views"},rf(e,"Robot","robot",h,s,o),rf(e,"Force space","space",u,r),rf(e,"Planes","planes",Y("div",{class:"tools"}),Y("div",{class:"three"},...a)));d.classList.toggle("robot-alone",n.scene.sensors.length===0),e.on(["large"],()=>{d.dataset.large=e.state.large??""});let f=Y("div",{class:"app"},LS(n,e),Y("main",{},d,l.root),c,t(g=>{i.textContent=g}));e.on(["quantity"],()=>{let g=f.querySelector(".space h2");g&&(g.textContent=e.state.quantity==="force"?"Force space":"Torque space")});let{strips:m,plots:y}=l;return{robot:s,space:r,planes:a,strips:m,plots:y,side:c,scale:o,robotTitle:h,spaceTitle:u,status:i,app:f}}function LS(n,e){let t=n.scene.sensors.map((o,a)=>[String(a),o.serial?`${o.name} (${o.serial})`:o.name]),i=or("Sensor",t,"0",o=>e.set({sensor:Number(o)}));e.on(["sensor"],()=>{i.value=String(e.state.sensor)});let s=Y("span",{class:"segments",role:"radiogroup","aria-label":"Quantity"});for(let[o,a]of[["force","Force"],["moment","Torque"]]){let l=Y("input",{type:"radio",name:"quantity",value:o});l.addEventListener("change",()=>e.set({quantity:o})),e.on(["quantity"],()=>{l.checked=e.state.quantity===o}),s.append(Y("label",{},l,Y("span",{},a)))}let r=Y("details",{class:"keys"},Y("summary",{},"Keys"),Y("dl",{},...wg.flatMap(([o,a])=>[Y("dt",{},o),Y("dd",{},a)])));return Y("header",{},Y("h1",{title:n.scene.title},n.scene.title),i,s,r)}function NS(n,e){let t=Ag.map(h=>Y("div",{class:"strip","aria-hidden":h==="error"?null:"true"})),i=[],s=["force","moment"],o=(n.scene.sensors.length===0?[]:s).map(h=>{let u=lc.flatMap(d=>Ag.map(f=>{let m=d===3,y=Y("div",{class:m?"plot last":"plot","data-kind":f});return i.push({panel:y,shown:{kind:f,quantity:h,component:d,last:m}}),y}));return Y("div",{class:`rows ${h}`},...u)}),a=Y("span",{class:"muted"});e.on(["sample","hover"],()=>{let{sample:h,hover:u}=e.state;a.textContent=`at ${(n.time[u??h]??0).toFixed(3)} s`});let l=Y("div",{class:"heading columns"},Y("h2",{},"Error: measured \u2212 expected ",a),Y("h2",{},"Measured and expected"),US(n,e)),c=Y("section",{class:"times","aria-label":"Time plots"},l,Y("div",{class:"strips"},...t),...o);return e.on(["quantity"],()=>{c.dataset.quantity=e.state.quantity}),{root:c,strips:t,plots:i}}function US(n,e){let t=zt("Whole recording",()=>e.set({window:n.span}));e.on(["window"],()=>{let[s,r]=n.span;t.hidden=e.state.window[0]===s&&e.state.window[1]===r});let i=Y("div",{class:"tools"},t);return n.scene.sensors.length>0&&i.append(zt("Worst sample",()=>sf(n,e),{title:"Largest error of the validation data in view (w)"}),zt("Next event",()=>Cc(n,e,1),{title:"Next interval, finding or saved sample (n)"}),Rg(e,"time plots","times")),i}function Rg(n,e,t){let i=zt("\u2922",()=>n.set({large:n.state.large===t?null:t}),{"aria-label":`Enlarge ${e}`,title:"Enlarge"});return n.on(["large"],()=>i.setAttribute("aria-pressed",String(n.state.large===t))),i}function rf(n,e,t,i,...s){i.append(Rg(n,e.toLowerCase(),t));let r=Y("div",{class:"heading"},Y("h2",{},e),i);return Y("section",{class:`panel ${t}`,"aria-label":e},r,...s)}function Ig(){let n=document.getElementById("scene")?.textContent;if(!n)throw new Error('the page holds no scene: expected a script element with id "scene"');let e=JSON.parse(n);if(e.schema!=="forcetorque/scene/1")throw new Error(`expected a scene of schema "forcetorque/scene/1", got ${JSON.stringify(e.schema)}`);return e}async function Dg(n){let e=document.getElementById("data");if(!e)throw new Error('the page holds no data: expected a script element with id "data"');let t=e.dataset.url;if(t)return OS(t,n);let i=FS(e.textContent??"");return e.textContent="",i}function FS(n){let e=n.trim(),t=e.endsWith("==")?2:e.endsWith("=")?1:0,i=new Uint8Array(e.length/4*3-t),s=0;for(let r=0;r<e.length;r+=1048576){let o=atob(e.slice(r,r+1048576));for(let a=0;a<o.length;a++)i[s++]=o.charCodeAt(a)}return i.buffer}async function OS(n,e){e(0,0);let t=await Pg(n,0);if(t.status===200){let o=await t.arrayBuffer();return e(o.byteLength,o.byteLength),o}let i=Number(/\/(\d+)$/.exec(t.headers.get("Content-Range")??"")?.[1]??Number.NaN);if(!Number.isFinite(i))throw new Error(`${n}: the server sent a piece without saying how long the whole is`);let s=new Uint8Array(i),r=0;for(let o=t;;o=await Pg(n,r)){let a=new Uint8Array(await o.arrayBuffer());if(a.length===0||r+a.length>i)throw new Error(`${n}: expected ${i-r} more bytes at most, got ${a.length}`);if(s.set(a,r),r+=a.length,e(r,i),r===i)return s.buffer}}async function Pg(n,e){let t=await fetch(n,{headers:{Range:`bytes=${e}-${e+4194304-1}`}});if(!t.ok)throw new Error(`${n}: the server answered ${t.status} ${t.statusText}`);return t}var BS=180/Math.PI;function Ng(n,e){let t=n.scene.coordinates.map((s,r)=>`${s}${n.isLength(r)?"_m":"_deg"}`),i=Is(e).map(s=>[String(s.sample),Og(s.time_s),s.mark,s.label,...n.scene.coordinates.map((r,o)=>kS(n,s.sample,o))]);return[["sample","time_s","mark","label",...t],...i].map(s=>`${s.map(zS).join(",")}
`).join("")}function Ug(n,e){return[`# intervals marked in the viewer; copy them into the experiment file
`,...yi(n,e).map(i=>{let s=["[[interval]]",`label = ${Ca(i.label)}`,`start_s = ${Lg(i.start_s)}`,`end_s = ${Lg(i.end_s)}`,`use = ${Ca(i.use)}`,...i.supportLines],r=i.overlaps.map(Ca).join(", ");return r&&s.push(`# overlaps ${r}: shorten those, as a sample is fitted or judged once`),`${s.join(`
`)}
`})].join(`
`)}function Fg(n,e){return{samples:Is(e),intervals:yi(n,e).map(({label:t,start_s:i,end_s:s,use:r})=>({label:t,start_s:i,end_s:s,use:r}))}}function kS(n,e,t){let i=n.position(e,t);return Number.isNaN(i)?"":n.isLength(t)?i.toFixed(6):(i*BS).toFixed(4)}function Og(n){return n.toFixed(9).replace(/0+$/,"").replace(/\.$/,"")}function Lg(n){let e=Og(n);return e.includes(".")?e:`${e}.0`}function zS(n){return/[",\r\n]/.test(n)?`"${n.replaceAll('"','""')}"`:n}var Bg=.25;function kg(n,e,t){let i=!1;return n.forEach(([s,r],o)=>{let[a,l]=n[(o+1)%n.length]??[s,r];r>t!=l>t&&e<s+(a-s)*(t-r)/(l-r)&&(i=!i)}),i}function zg(n,e,t){let i=[];return e.samples.forEach((s,r)=>{if(!t(r))return;let o=n.time[s]??0,a=n.time[e.samples[r+1]??s]??o,l=i.at(-1),c=Math.min(a,o+Bg);l&&o-l.end_s<Bg?l.end_s=c:i.push({start_s:o,end_s:c})}),i.filter(({start_s:s,end_s:r})=>r>s)}function Vg(n,e,t){let i=e.flatMap(({start_s:s,end_s:r})=>["begin","end"].map(o=>{let a=n.firstAt(s),l=o==="begin"?a:Math.max(a,n.firstAt(r)-1);return{sample:l,time_s:n.time[l]??0,mark:o,label:"",use:"ignore"}}));return Is([...t,...i])}var VS=[["ignore","ignore"],["calibration","calibration"],["validation","validation"]],GS=180;function Gg(n,e,t){let i=Y("ul",{class:"marks","aria-label":"Saved samples"}),s=Y("ul",{class:"marks","aria-label":"Marked intervals"});e.on(["marks"],()=>{let{marks:a}=e.state;(!i.contains(document.activeElement)||i.children.length!==a.length)&&i.replaceChildren(...Is(a).map(l=>WS(l,e))),a.length===0&&i.replaceChildren(Y("li",{class:"absent"},"None yet: \u201CSave sample\u201D keeps the one shown.")),s.replaceChildren(...XS(n,e))});let r=new Set;addEventListener("beforeunload",a=>{let{marks:l}=e.state;l.length>0&&!r.has(l)&&a.preventDefault()});let o=a=>{r.add(a)};return Y("div",{},i,s,HS(n,e,t),qS(n,e,t,o))}function HS(n,e,t){let i=Y("div",{class:"row"});return e.on(["selected"],()=>{let{selected:s}=e.state;i.hidden=s.length===0;let r=s.reduce((o,{start_s:a,end_s:l})=>o+l-a,0);i.replaceChildren(Y("span",{class:"muted"},`Selected: ${r.toFixed(2)} s in ${s.length} interval(s)`),zt("Save as intervals",()=>{e.set({marks:Vg(n,s,e.state.marks),selected:[]}),t(`Saved ${s.length} interval(s).`)}),zt("Forget",()=>e.set({selected:[]})))}),i}function WS(n,e){let t=n,i=`sample ${n.sample}`,s=Y("input",{type:"text",maxlength:GS,value:n.label,placeholder:"label","aria-label":`Label of ${i}`});s.addEventListener("change",()=>{let o={...t,label:s.value.trim()},a=e.state.marks.map(l=>l===t?o:l);t=o,e.set({marks:a})});let r=()=>e.set({marks:e.state.marks.filter(o=>o!==t)});return Y("li",{},zt(`${n.sample}`,()=>e.set({sample:n.sample,playing:!1}),{class:"link","aria-label":`Go to ${i}`}),Y("span",{class:"muted"},`${n.time_s.toFixed(2)} s ${n.mark}`),s,zt("\u2715",r,{"aria-label":`Delete ${i}`}))}function XS(n,e){let t=yi(n,e.state.marks).map(s=>{let r=or(`Use of ${s.label}`,VS,s.use,c=>{let h=e.state.marks.map(u=>u===s.begin?{...u,use:c}:u);e.set({marks:h})}),o=`${s.label}: ${s.start_s.toFixed(2)}\u2013${s.end_s.toFixed(2)} s`,a=s.overlaps.join(", "),l=a?[Y("span",{class:"muted clash"},`overlaps ${a}: shorten it there`)]:[];return Y("li",{},Y("span",{class:"grow"},o),r,...l)}),i=Bm(e.state.marks).map(({mark:s,sample:r})=>Y("li",{class:"absent"},s==="begin"?`begin at ${r} has no end`:`end at ${r} has no begin`));return[...t,...i]}function qS(n,e,t,i){let{title:s,annotations_url:r}=n.scene,o=(l,c,h)=>{uc(dc(s,l),c,h),i(e.state.marks)},a=Y("div",{class:"row"},zt("Samples as CSV",()=>o("_samples.csv",Ng(n,e.state.marks),"text/csv")),zt("Intervals as TOML",()=>o("_intervals.toml",Ug(n,e.state.marks),"application/toml")));return r!==null&&a.append(zt("Write beside the experiment",()=>{let{marks:l}=e.state;YS(r,n,l,t).then(c=>{c&&i(l)})},{class:"primary"})),a}async function YS(n,e,t,i){try{let s=JSON.stringify(Fg(e,t)),r=await fetch(n,{method:"POST",headers:{"Content-Type":"application/json"},body:s}),o=await r.text();if(!r.ok)throw new Error(`${r.status} ${r.statusText}: ${o.slice(0,300)}`);let{files:a}=JSON.parse(o);return i(`Written beside the experiment: ${a.join(", ")}`),!0}catch(s){return i(`Not written. ${s instanceof Error?s.message:String(s)}`),!1}}var Hg=["robot","space","planes","times"],Rc=class{constructor(e){this.current=e}current;listeners=[];get state(){return this.current}set(e){let t=Object.keys(e).filter(i=>e[i]!==this.current[i]);if(t.length!==0){this.current={...this.current,...e};for(let{keys:i,call:s}of this.listeners)t.some(r=>i.has(r))&&s()}}on(e,t){this.listeners.push({keys:new Set(e),call:t}),t()}};var $S=250,ZS=4;function KS(n,e){let{sensor:t,quantity:i,window:s,hidden:r,large:o}=e,a=new URLSearchParams({sample:String(e.sample)}),l=n.sensor(t)?.name;l!==void 0&&a.set("sensor",l),a.set("quantity",i);let[c,h]=n.span;(s[0]>c||s[1]<h)&&a.set("window",s.map(u=>u.toFixed(ZS)).join(","));for(let u of r)a.append("hide",u);return o&&a.set("large",o),a.toString()}function of(n,e){let t=new URLSearchParams(e.replace(/^#/,"")),i={},s=t.get("sample");s!==null&&/^\d+$/.test(s)&&(i.sample=Math.min(Number(s),Math.max(0,n.samples-1)));let r=n.scene.sensors.findIndex(({name:h})=>h===t.get("sensor"));r>=0&&(i.sensor=r);let o=t.get("quantity");(o==="force"||o==="moment")&&(i.quantity=o);let[a=NaN,l=NaN]=(t.get("window")??"").split(",").map(Number);l>a&&(i.window=zr([a,l],1,a,n.span,n.samples)),t.has("hide")&&(i.hidden=new Set(t.getAll("hide")));let c=Hg.find(h=>h===t.get("large"));return c&&(i.large=c),i}function Wg(n,e){let t=0,i="",s=!0;e.on(["sample","sensor","quantity","window","hidden","large"],()=>{if(s){s=!1;return}clearTimeout(t),t=setTimeout(()=>{i=`#${KS(n,e.state)}`,history.replaceState(null,"",i)},$S)}),addEventListener("hashchange",()=>{location.hash!==i&&e.set({...of(n,location.hash),playing:!1})})}var vr={LEFT:0,MIDDLE:1,RIGHT:2,ROTATE:0,DOLLY:1,PAN:2},Sr={ROTATE:0,PAN:1,DOLLY_PAN:2,DOLLY_ROTATE:3},w0=0,Of=1,T0=2;var El=1,E0=2,ea=3,br=0,li=1,ci=2,$r=0,ta=1,Bf=2,kf=3,zf=4,A0=5;var Zr=100,C0=101,R0=102,P0=103,I0=104,D0=200,L0=201,N0=202,U0=203,Vf=204,Gf=205,F0=206,O0=207,B0=208,k0=209,z0=210,V0=211,G0=212,H0=213,W0=214,rh=0,oh=1,ah=2,Ho=3,lh=4,ch=5,hh=6,uh=7,Bh=0,X0=1,q0=2,Ss=0,Hf=1,Wf=2,Xf=3,qf=4,Yf=5,$f=6,Zf=7;var Kf=300,Kr=301,na=302,kh=303,zh=304,dh=1e3,xs=1001,fh=1002,Vn=1003,Y0=1004;var Al=1005;var ri=1006,Vh=1007;var qs=1008;var ui=1009,Jf=1010,jf=1011,ia=1012,Gh=1013,Ki=1014,Ji=1015,ji=1016,Hh=1017,Wh=1018,Jr=1020,Qf=35902,ep=35899,tp=1021,np=1022,Qi=1023,Gs=1026,Ys=1027,ip=1028,Xh=1029,Mr=1030,qh=1031;var Yh=1033,Cl=33776,Rl=33777,Pl=33778,Il=33779,$h=35840,Zh=35841,Kh=35842,Jh=35843,jh=36196,Qh=37492,eu=37496,tu=37488,nu=37489,Dl=37490,iu=37491,su=37808,ru=37809,ou=37810,au=37811,lu=37812,cu=37813,hu=37814,uu=37815,du=37816,fu=37817,pu=37818,mu=37819,gu=37820,_u=37821,xu=36492,yu=36494,vu=36495,Su=36283,bu=36284,Ll=36285,Mu=36286;var el=2300,ph=2301,ih=2302,Rf=2303,Pf=2400,If=2401,Df=2402;var $0=3200;var wu=0,Z0=1,$s="",Ti="srgb",tl="srgb-linear",nl="linear",Lt="srgb";var sh=7680;var K0=519,J0=512,j0=513,Q0=514,sp=515,e_=516,t_=517,rp=518,op=519,ap=35044;var lp="300 es",Oi=2e3,Wo=2001;function JS(n){for(let e=n.length-1;e>=0;--e)if(n[e]>=65535)return!0;return!1}function jS(n){return ArrayBuffer.isView(n)&&!(n instanceof DataView)}function il(n){return document.createElementNS("http://www.w3.org/1999/xhtml",n)}function n_(){let n=il("canvas");return n.style.display="block",n}var Xg={},Xo=null;function sl(...n){let e="THREE."+n.shift();Xo?Xo("log",e,...n):console.log(e,...n)}function i_(n){let e=n[0];if(typeof e=="string"&&e.startsWith("TSL:")){let t=n[1];t&&t.isStackTrace?n[0]+=" "+t.getLocation():n[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return n}function Ke(...n){n=i_(n);let e="THREE."+n.shift();if(Xo)Xo("warn",e,...n);else{let t=n[0];t&&t.isStackTrace?console.warn(t.getError(e)):console.warn(e,...n)}}function st(...n){n=i_(n);let e="THREE."+n.shift();if(Xo)Xo("error",e,...n);else{let t=n[0];t&&t.isStackTrace?console.error(t.getError(e)):console.error(e,...n)}}function Ja(...n){let e=n.join(" ");e in Xg||(Xg[e]=!0,Ke(...n))}function s_(n,e,t){return new Promise(function(i,s){function r(){switch(n.clientWaitSync(e,n.SYNC_FLUSH_COMMANDS_BIT,0)){case n.WAIT_FAILED:s();break;case n.TIMEOUT_EXPIRED:setTimeout(r,t);break;default:i()}}setTimeout(r,t)})}var r_={[rh]:rh,[ah]:hh,[lh]:lh,[Ho]:ch,[oh]:oh,[hh]:ah,[uh]:uh,[ch]:Ho},qi=class{addEventListener(e,t){this._listeners===void 0&&(this._listeners={});let i=this._listeners;i[e]===void 0&&(i[e]=[]),i[e].indexOf(t)===-1&&i[e].push(t)}hasEventListener(e,t){let i=this._listeners;return i===void 0?!1:i[e]!==void 0&&i[e].indexOf(t)!==-1}removeEventListener(e,t){let i=this._listeners;if(i===void 0)return;let s=i[e];if(s!==void 0){let r=s.indexOf(t);r!==-1&&s.splice(r,1)}}dispatchEvent(e){let t=this._listeners;if(t===void 0)return;let i=t[e.type];if(i!==void 0){e.target=this;let s=i.slice(0);for(let r=0,o=s.length;r<o;r++)s[r].call(this,e);e.target=null}}},Yn=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"],qg=1234567,ja=Math.PI/180,qo=180/Math.PI;function wr(){let n=Math.random()*4294967295|0,e=Math.random()*4294967295|0,t=Math.random()*4294967295|0,i=Math.random()*4294967295|0;return(Yn[n&255]+Yn[n>>8&255]+Yn[n>>16&255]+Yn[n>>24&255]+"-"+Yn[e&255]+Yn[e>>8&255]+"-"+Yn[e>>16&15|64]+Yn[e>>24&255]+"-"+Yn[t&63|128]+Yn[t>>8&255]+"-"+Yn[t>>16&255]+Yn[t>>24&255]+Yn[i&255]+Yn[i>>8&255]+Yn[i>>16&255]+Yn[i>>24&255]).toLowerCase()}function xt(n,e,t){return Math.max(e,Math.min(t,n))}function cp(n,e){return(n%e+e)%e}function QS(n,e,t,i,s){return i+(n-e)*(s-i)/(t-e)}function eb(n,e,t){return n!==e?(t-n)/(e-n):0}function Qa(n,e,t){return(1-t)*n+t*e}function tb(n,e,t,i){return Qa(n,e,1-Math.exp(-t*i))}function nb(n,e=1){return e-Math.abs(cp(n,e*2)-e)}function ib(n,e,t){return n<=e?0:n>=t?1:(n=(n-e)/(t-e),n*n*(3-2*n))}function sb(n,e,t){return n<=e?0:n>=t?1:(n=(n-e)/(t-e),n*n*n*(n*(n*6-15)+10))}function rb(n,e){return n+Math.floor(Math.random()*(e-n+1))}function ob(n,e){return n+Math.random()*(e-n)}function ab(n){return n*(.5-Math.random())}function lb(n){n!==void 0&&(qg=n);let e=qg+=1831565813;return e=Math.imul(e^e>>>15,e|1),e^=e+Math.imul(e^e>>>7,e|61),((e^e>>>14)>>>0)/4294967296}function cb(n){return n*ja}function hb(n){return n*qo}function ub(n){return n>0&&Number.isInteger(n)&&2**Math.round(Math.log2(n))===n}function db(n){return Math.pow(2,Math.ceil(Math.log(n)/Math.LN2))}function hp(n){return Math.pow(2,Math.floor(Math.log(n)/Math.LN2))}function fb(n,e,t,i,s){let r=Math.cos,o=Math.sin,a=r(t/2),l=o(t/2),c=r((e+i)/2),h=o((e+i)/2),u=r((e-i)/2),d=o((e-i)/2),f=r((i-e)/2),m=o((i-e)/2);switch(s){case"XYX":n.set(a*h,l*u,l*d,a*c);break;case"YZY":n.set(l*d,a*h,l*u,a*c);break;case"ZXZ":n.set(l*u,l*d,a*h,a*c);break;case"XZX":n.set(a*h,l*m,l*f,a*c);break;case"YXY":n.set(l*f,a*h,l*m,a*c);break;case"ZYZ":n.set(l*m,l*f,a*h,a*c);break;default:Ke("MathUtils: .setQuaternionFromProperEuler() encountered an unknown order: "+s)}}function Tu(n){switch(n.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function up(n,e){if(e.constructor===Float32Array)return n;let t=Tu(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(n/t,-1)}function dp(n,e){if(e.constructor===Float32Array)return n;let t=Tu(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(n*t)}var fp={DEG2RAD:ja,RAD2DEG:qo,generateUUID:wr,clamp:xt,euclideanModulo:cp,mapLinear:QS,inverseLerp:eb,lerp:Qa,damp:tb,pingpong:nb,smoothstep:ib,smootherstep:sb,randInt:rb,randFloat:ob,randFloatSpread:ab,seededRandom:lb,degToRad:cb,radToDeg:hb,isPowerOfTwo:ub,ceilPowerOfTwo:db,floorPowerOfTwo:hp,setQuaternionFromProperEuler:fb,normalize:dp,denormalize:up},$e=class{static{this.prototype.isVector2=!0}constructor(e=0,t=0){this.x=e,this.y=t}get width(){return this.x}set width(e){this.x=e}get height(){return this.y}set height(e){this.y=e}set(e,t){return this.x=e,this.y=t,this}setScalar(e){return this.x=e,this.y=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;default:throw new Error("THREE.Vector2: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y)}copy(e){return this.x=e.x,this.y=e.y,this}add(e){return this.x+=e.x,this.y+=e.y,this}addScalar(e){return this.x+=e,this.y+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this}subScalar(e){return this.x-=e,this.y-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this}multiply(e){return this.x*=e.x,this.y*=e.y,this}multiplyScalar(e){return this.x*=e,this.y*=e,this}divide(e){return this.x/=e.x,this.y/=e.y,this}divideScalar(e){return this.multiplyScalar(1/e)}applyMatrix3(e){let t=this.x,i=this.y,s=e.elements;return this.x=s[0]*t+s[3]*i+s[6],this.y=s[1]*t+s[4]*i+s[7],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this}clamp(e,t){return this.x=xt(this.x,e.x,t.x),this.y=xt(this.y,e.y,t.y),this}clampScalar(e,t){return this.x=xt(this.x,e,t),this.y=xt(this.y,e,t),this}clampLength(e,t){let i=this.length();return this.divideScalar(i||1).multiplyScalar(xt(i,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(e){return this.x*e.x+this.y*e.y}cross(e){return this.x*e.y-this.y*e.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let i=this.dot(e)/t;return Math.acos(xt(i,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,i=this.y-e.y;return t*t+i*i}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this}lerpVectors(e,t,i){return this.x=e.x+(t.x-e.x)*i,this.y=e.y+(t.y-e.y)*i,this}equals(e){return e.x===this.x&&e.y===this.y}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this}rotateAround(e,t){let i=Math.cos(t),s=Math.sin(t),r=this.x-e.x,o=this.y-e.y;return this.x=r*i-o*s+e.x,this.y=r*s+o*i+e.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}},oi=class{constructor(e=0,t=0,i=0,s=1){this.isQuaternion=!0,this._x=e,this._y=t,this._z=i,this._w=s}static slerpFlat(e,t,i,s,r,o,a){let l=i[s+0],c=i[s+1],h=i[s+2],u=i[s+3],d=r[o+0],f=r[o+1],m=r[o+2],y=r[o+3];if(u!==y||l!==d||c!==f||h!==m){let g=l*d+c*f+h*m+u*y;g<0&&(d=-d,f=-f,m=-m,y=-y,g=-g);let p=1-a;if(g<.9995){let S=Math.acos(g),C=Math.sin(S);p=Math.sin(p*S)/C,a=Math.sin(a*S)/C,l=l*p+d*a,c=c*p+f*a,h=h*p+m*a,u=u*p+y*a}else{l=l*p+d*a,c=c*p+f*a,h=h*p+m*a,u=u*p+y*a;let S=1/Math.sqrt(l*l+c*c+h*h+u*u);l*=S,c*=S,h*=S,u*=S}}e[t]=l,e[t+1]=c,e[t+2]=h,e[t+3]=u}static multiplyQuaternionsFlat(e,t,i,s,r,o){let a=i[s],l=i[s+1],c=i[s+2],h=i[s+3],u=r[o],d=r[o+1],f=r[o+2],m=r[o+3];return e[t]=a*m+h*u+l*f-c*d,e[t+1]=l*m+h*d+c*u-a*f,e[t+2]=c*m+h*f+a*d-l*u,e[t+3]=h*m-a*u-l*d-c*f,e}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get w(){return this._w}set w(e){this._w=e,this._onChangeCallback()}set(e,t,i,s){return this._x=e,this._y=t,this._z=i,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(e){return this._x=e.x,this._y=e.y,this._z=e.z,this._w=e.w,this._onChangeCallback(),this}setFromEuler(e,t=!0){let i=e._x,s=e._y,r=e._z,o=e._order,a=Math.cos,l=Math.sin,c=a(i/2),h=a(s/2),u=a(r/2),d=l(i/2),f=l(s/2),m=l(r/2);switch(o){case"XYZ":this._x=d*h*u+c*f*m,this._y=c*f*u-d*h*m,this._z=c*h*m+d*f*u,this._w=c*h*u-d*f*m;break;case"YXZ":this._x=d*h*u+c*f*m,this._y=c*f*u-d*h*m,this._z=c*h*m-d*f*u,this._w=c*h*u+d*f*m;break;case"ZXY":this._x=d*h*u-c*f*m,this._y=c*f*u+d*h*m,this._z=c*h*m+d*f*u,this._w=c*h*u-d*f*m;break;case"ZYX":this._x=d*h*u-c*f*m,this._y=c*f*u+d*h*m,this._z=c*h*m-d*f*u,this._w=c*h*u+d*f*m;break;case"YZX":this._x=d*h*u+c*f*m,this._y=c*f*u+d*h*m,this._z=c*h*m-d*f*u,this._w=c*h*u-d*f*m;break;case"XZY":this._x=d*h*u-c*f*m,this._y=c*f*u-d*h*m,this._z=c*h*m+d*f*u,this._w=c*h*u+d*f*m;break;default:Ke("Quaternion: .setFromEuler() encountered an unknown order: "+o)}return t===!0&&this._onChangeCallback(),this}setFromAxisAngle(e,t){let i=t/2,s=Math.sin(i);return this._x=e.x*s,this._y=e.y*s,this._z=e.z*s,this._w=Math.cos(i),this._onChangeCallback(),this}setFromRotationMatrix(e){let t=e.elements,i=t[0],s=t[4],r=t[8],o=t[1],a=t[5],l=t[9],c=t[2],h=t[6],u=t[10],d=i+a+u;if(d>0){let f=.5/Math.sqrt(d+1);this._w=.25/f,this._x=(h-l)*f,this._y=(r-c)*f,this._z=(o-s)*f}else if(i>a&&i>u){let f=2*Math.sqrt(1+i-a-u);this._w=(h-l)/f,this._x=.25*f,this._y=(s+o)/f,this._z=(r+c)/f}else if(a>u){let f=2*Math.sqrt(1+a-i-u);this._w=(r-c)/f,this._x=(s+o)/f,this._y=.25*f,this._z=(l+h)/f}else{let f=2*Math.sqrt(1+u-i-a);this._w=(o-s)/f,this._x=(r+c)/f,this._y=(l+h)/f,this._z=.25*f}return this._onChangeCallback(),this}setFromUnitVectors(e,t){let i=e.dot(t)+1;return i<1e-8?(i=0,Math.abs(e.x)>Math.abs(e.z)?(this._x=-e.y,this._y=e.x,this._z=0,this._w=i):(this._x=0,this._y=-e.z,this._z=e.y,this._w=i)):(this._x=e.y*t.z-e.z*t.y,this._y=e.z*t.x-e.x*t.z,this._z=e.x*t.y-e.y*t.x,this._w=i),this.normalize()}angleTo(e){return 2*Math.acos(Math.abs(xt(this.dot(e),-1,1)))}rotateTowards(e,t){let i=this.angleTo(e);if(i===0)return this;let s=Math.min(1,t/i);return this.slerp(e,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(e){return this._x*e._x+this._y*e._y+this._z*e._z+this._w*e._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let e=this.length();return e===0?(this._x=0,this._y=0,this._z=0,this._w=1):(e=1/e,this._x=this._x*e,this._y=this._y*e,this._z=this._z*e,this._w=this._w*e),this._onChangeCallback(),this}multiply(e){return this.multiplyQuaternions(this,e)}premultiply(e){return this.multiplyQuaternions(e,this)}multiplyQuaternions(e,t){let i=e._x,s=e._y,r=e._z,o=e._w,a=t._x,l=t._y,c=t._z,h=t._w;return this._x=i*h+o*a+s*c-r*l,this._y=s*h+o*l+r*a-i*c,this._z=r*h+o*c+i*l-s*a,this._w=o*h-i*a-s*l-r*c,this._onChangeCallback(),this}slerp(e,t){let i=e._x,s=e._y,r=e._z,o=e._w,a=this.dot(e);a<0&&(i=-i,s=-s,r=-r,o=-o,a=-a);let l=1-t;if(a<.9995){let c=Math.acos(a),h=Math.sin(c);l=Math.sin(l*c)/h,t=Math.sin(t*c)/h,this._x=this._x*l+i*t,this._y=this._y*l+s*t,this._z=this._z*l+r*t,this._w=this._w*l+o*t,this._onChangeCallback()}else this._x=this._x*l+i*t,this._y=this._y*l+s*t,this._z=this._z*l+r*t,this._w=this._w*l+o*t,this.normalize();return this}slerpQuaternions(e,t,i){return this.copy(e).slerp(t,i)}random(){let e=2*Math.PI*Math.random(),t=2*Math.PI*Math.random(),i=Math.random(),s=Math.sqrt(1-i),r=Math.sqrt(i);return this.set(s*Math.sin(e),s*Math.cos(e),r*Math.sin(t),r*Math.cos(t))}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._w===this._w}fromArray(e,t=0){return this._x=e[t],this._y=e[t+1],this._z=e[t+2],this._w=e[t+3],this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._w,e}fromBufferAttribute(e,t){return this._x=e.getX(t),this._y=e.getY(t),this._z=e.getZ(t),this._w=e.getW(t),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},O=class{static{this.prototype.isVector3=!0}constructor(e=0,t=0,i=0){this.x=e,this.y=t,this.z=i}set(e,t,i){return i===void 0&&(i=this.z),this.x=e,this.y=t,this.z=i,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;default:throw new Error("THREE.Vector3: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this}multiplyVectors(e,t){return this.x=e.x*t.x,this.y=e.y*t.y,this.z=e.z*t.z,this}applyEuler(e){return this.applyQuaternion(Yg.setFromEuler(e))}applyAxisAngle(e,t){return this.applyQuaternion(Yg.setFromAxisAngle(e,t))}applyMatrix3(e){let t=this.x,i=this.y,s=this.z,r=e.elements;return this.x=r[0]*t+r[3]*i+r[6]*s,this.y=r[1]*t+r[4]*i+r[7]*s,this.z=r[2]*t+r[5]*i+r[8]*s,this}applyNormalMatrix(e){return this.applyMatrix3(e).normalize()}applyMatrix4(e){let t=this.x,i=this.y,s=this.z,r=e.elements,o=1/(r[3]*t+r[7]*i+r[11]*s+r[15]);return this.x=(r[0]*t+r[4]*i+r[8]*s+r[12])*o,this.y=(r[1]*t+r[5]*i+r[9]*s+r[13])*o,this.z=(r[2]*t+r[6]*i+r[10]*s+r[14])*o,this}applyQuaternion(e){let t=this.x,i=this.y,s=this.z,r=e.x,o=e.y,a=e.z,l=e.w,c=2*(o*s-a*i),h=2*(a*t-r*s),u=2*(r*i-o*t);return this.x=t+l*c+o*u-a*h,this.y=i+l*h+a*c-r*u,this.z=s+l*u+r*h-o*c,this}project(e){return this.applyMatrix4(e.matrixWorldInverse).applyMatrix4(e.projectionMatrix)}unproject(e){return this.applyMatrix4(e.projectionMatrixInverse).applyMatrix4(e.matrixWorld)}transformDirection(e){let t=this.x,i=this.y,s=this.z,r=e.elements;return this.x=r[0]*t+r[4]*i+r[8]*s,this.y=r[1]*t+r[5]*i+r[9]*s,this.z=r[2]*t+r[6]*i+r[10]*s,this.normalize()}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this}divideScalar(e){return this.multiplyScalar(1/e)}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this}clamp(e,t){return this.x=xt(this.x,e.x,t.x),this.y=xt(this.y,e.y,t.y),this.z=xt(this.z,e.z,t.z),this}clampScalar(e,t){return this.x=xt(this.x,e,t),this.y=xt(this.y,e,t),this.z=xt(this.z,e,t),this}clampLength(e,t){let i=this.length();return this.divideScalar(i||1).multiplyScalar(xt(i,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this}lerpVectors(e,t,i){return this.x=e.x+(t.x-e.x)*i,this.y=e.y+(t.y-e.y)*i,this.z=e.z+(t.z-e.z)*i,this}cross(e){return this.crossVectors(this,e)}crossVectors(e,t){let i=e.x,s=e.y,r=e.z,o=t.x,a=t.y,l=t.z;return this.x=s*l-r*a,this.y=r*o-i*l,this.z=i*a-s*o,this}projectOnVector(e){let t=e.lengthSq();if(t===0)return this.set(0,0,0);let i=e.dot(this)/t;return this.copy(e).multiplyScalar(i)}projectOnPlane(e){return af.copy(this).projectOnVector(e),this.sub(af)}reflect(e){return this.sub(af.copy(e).multiplyScalar(2*this.dot(e)))}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let i=this.dot(e)/t;return Math.acos(xt(i,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,i=this.y-e.y,s=this.z-e.z;return t*t+i*i+s*s}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)+Math.abs(this.z-e.z)}setFromSpherical(e){return this.setFromSphericalCoords(e.radius,e.phi,e.theta)}setFromSphericalCoords(e,t,i){let s=Math.sin(t)*e;return this.x=s*Math.sin(i),this.y=Math.cos(t)*e,this.z=s*Math.cos(i),this}setFromCylindrical(e){return this.setFromCylindricalCoords(e.radius,e.theta,e.y)}setFromCylindricalCoords(e,t,i){return this.x=e*Math.sin(t),this.y=i,this.z=e*Math.cos(t),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this}setFromMatrixScale(e){let t=this.setFromMatrixColumn(e,0).length(),i=this.setFromMatrixColumn(e,1).length(),s=this.setFromMatrixColumn(e,2).length();return this.x=t,this.y=i,this.z=s,this}setFromMatrixColumn(e,t){return this.fromArray(e.elements,t*4)}setFromMatrix3Column(e,t){return this.fromArray(e.elements,t*3)}setFromEuler(e){return this.x=e._x,this.y=e._y,this.z=e._z,this}setFromColor(e){return this.x=e.r,this.y=e.g,this.z=e.b,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let e=Math.random()*Math.PI*2,t=Math.random()*2-1,i=Math.sqrt(1-t*t);return this.x=i*Math.cos(e),this.y=t,this.z=i*Math.sin(e),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}},af=new O,Yg=new oi,Qe=class{static{this.prototype.isMatrix3=!0}constructor(e,t,i,s,r,o,a,l,c){this.elements=[1,0,0,0,1,0,0,0,1],e!==void 0&&this.set(e,t,i,s,r,o,a,l,c)}set(e,t,i,s,r,o,a,l,c){let h=this.elements;return h[0]=e,h[1]=s,h[2]=a,h[3]=t,h[4]=r,h[5]=l,h[6]=i,h[7]=o,h[8]=c,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(e){let t=this.elements,i=e.elements;return t[0]=i[0],t[1]=i[1],t[2]=i[2],t[3]=i[3],t[4]=i[4],t[5]=i[5],t[6]=i[6],t[7]=i[7],t[8]=i[8],this}extractBasis(e,t,i){return e.setFromMatrix3Column(this,0),t.setFromMatrix3Column(this,1),i.setFromMatrix3Column(this,2),this}setFromMatrix4(e){let t=e.elements;return this.set(t[0],t[4],t[8],t[1],t[5],t[9],t[2],t[6],t[10]),this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let i=e.elements,s=t.elements,r=this.elements,o=i[0],a=i[3],l=i[6],c=i[1],h=i[4],u=i[7],d=i[2],f=i[5],m=i[8],y=s[0],g=s[3],p=s[6],S=s[1],C=s[4],w=s[7],P=s[2],E=s[5],x=s[8];return r[0]=o*y+a*S+l*P,r[3]=o*g+a*C+l*E,r[6]=o*p+a*w+l*x,r[1]=c*y+h*S+u*P,r[4]=c*g+h*C+u*E,r[7]=c*p+h*w+u*x,r[2]=d*y+f*S+m*P,r[5]=d*g+f*C+m*E,r[8]=d*p+f*w+m*x,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[3]*=e,t[6]*=e,t[1]*=e,t[4]*=e,t[7]*=e,t[2]*=e,t[5]*=e,t[8]*=e,this}determinant(){let e=this.elements,t=e[0],i=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8];return t*o*h-t*a*c-i*r*h+i*a*l+s*r*c-s*o*l}invert(){let e=this.elements,t=e[0],i=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8],u=h*o-a*c,d=a*l-h*r,f=c*r-o*l,m=t*u+i*d+s*f;if(m===0)return this.set(0,0,0,0,0,0,0,0,0);let y=1/m;return e[0]=u*y,e[1]=(s*c-h*i)*y,e[2]=(a*i-s*o)*y,e[3]=d*y,e[4]=(h*t-s*l)*y,e[5]=(s*r-a*t)*y,e[6]=f*y,e[7]=(i*l-c*t)*y,e[8]=(o*t-i*r)*y,this}transpose(){let e,t=this.elements;return e=t[1],t[1]=t[3],t[3]=e,e=t[2],t[2]=t[6],t[6]=e,e=t[5],t[5]=t[7],t[7]=e,this}getNormalMatrix(e){return this.setFromMatrix4(e).invert().transpose()}transposeIntoArray(e){let t=this.elements;return e[0]=t[0],e[1]=t[3],e[2]=t[6],e[3]=t[1],e[4]=t[4],e[5]=t[7],e[6]=t[2],e[7]=t[5],e[8]=t[8],this}setUvTransform(e,t,i,s,r,o,a){let l=Math.cos(r),c=Math.sin(r);return this.set(i*l,i*c,-i*(l*o+c*a)+o+e,-s*c,s*l,-s*(-c*o+l*a)+a+t,0,0,1),this}scale(e,t){return Ja("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(lf.makeScale(e,t)),this}rotate(e){return Ja("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(lf.makeRotation(-e)),this}translate(e,t){return Ja("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(lf.makeTranslation(e,t)),this}makeTranslation(e,t){return e.isVector2?this.set(1,0,e.x,0,1,e.y,0,0,1):this.set(1,0,e,0,1,t,0,0,1),this}makeRotation(e){let t=Math.cos(e),i=Math.sin(e);return this.set(t,-i,0,i,t,0,0,0,1),this}makeScale(e,t){return this.set(e,0,0,0,t,0,0,0,1),this}equals(e){let t=this.elements,i=e.elements;for(let s=0;s<9;s++)if(t[s]!==i[s])return!1;return!0}fromArray(e,t=0){for(let i=0;i<9;i++)this.elements[i]=e[i+t];return this}toArray(e=[],t=0){let i=this.elements;return e[t]=i[0],e[t+1]=i[1],e[t+2]=i[2],e[t+3]=i[3],e[t+4]=i[4],e[t+5]=i[5],e[t+6]=i[6],e[t+7]=i[7],e[t+8]=i[8],e}clone(){return new this.constructor().fromArray(this.elements)}},lf=new Qe,$g=new Qe().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),Zg=new Qe().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function pb(){let n={enabled:!0,workingColorSpace:tl,spaces:{},convert:function(s,r,o){return this.enabled===!1||r===o||!r||!o||(this.spaces[r].transfer===Lt&&(s.r=Vs(s.r),s.g=Vs(s.g),s.b=Vs(s.b)),this.spaces[r].primaries!==this.spaces[o].primaries&&(s.applyMatrix3(this.spaces[r].toXYZ),s.applyMatrix3(this.spaces[o].fromXYZ)),this.spaces[o].transfer===Lt&&(s.r=Go(s.r),s.g=Go(s.g),s.b=Go(s.b))),s},workingToColorSpace:function(s,r){return this.convert(s,this.workingColorSpace,r)},colorSpaceToWorking:function(s,r){return this.convert(s,r,this.workingColorSpace)},getPrimaries:function(s){return this.spaces[s].primaries},getTransfer:function(s){return s===$s?nl:this.spaces[s].transfer},getToneMappingMode:function(s){return this.spaces[s].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(s,r=this.workingColorSpace){return s.fromArray(this.spaces[r].luminanceCoefficients)},define:function(s){Object.assign(this.spaces,s)},_getMatrix:function(s,r,o){return s.copy(this.spaces[o].fromXYZ).multiply(this.spaces[r].toXYZ)},_getDrawingBufferColorSpace:function(s){return this.spaces[s].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(s=this.workingColorSpace){return this.spaces[s].workingColorSpaceConfig.unpackColorSpace}},e=[.64,.33,.3,.6,.15,.06],t=[.2126,.7152,.0722],i=[.3127,.329];return n.define({[tl]:{primaries:e,whitePoint:i,transfer:nl,toXYZ:$g,fromXYZ:Zg,luminanceCoefficients:t,workingColorSpaceConfig:{unpackColorSpace:Ti},outputColorSpaceConfig:{drawingBufferColorSpace:Ti}},[Ti]:{primaries:e,whitePoint:i,transfer:Lt,toXYZ:$g,fromXYZ:Zg,luminanceCoefficients:t,outputColorSpaceConfig:{drawingBufferColorSpace:Ti}}}),n}var bt=pb();function Vs(n){return n<.04045?n*.0773993808:Math.pow(n*.9478672986+.0521327014,2.4)}function Go(n){return n<.0031308?n*12.92:1.055*Math.pow(n,.41666)-.055}var To,mh=class{static getDataURL(e,t="image/png"){if(/^data:/i.test(e.src)||typeof HTMLCanvasElement>"u")return e.src;let i;if(e instanceof HTMLCanvasElement)i=e;else{To===void 0&&(To=il("canvas")),To.width=e.width,To.height=e.height;let s=To.getContext("2d");e instanceof ImageData?s.putImageData(e,0,0):s.drawImage(e,0,0,e.width,e.height),i=To}return i.toDataURL(t)}static sRGBToLinear(e){if(typeof HTMLImageElement<"u"&&e instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&e instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&e instanceof ImageBitmap){let t=il("canvas");t.width=e.width,t.height=e.height;let i=t.getContext("2d");i.drawImage(e,0,0,e.width,e.height);let s=i.getImageData(0,0,e.width,e.height),r=s.data;for(let o=0;o<r.length;o++)r[o]=Vs(r[o]/255)*255;return i.putImageData(s,0,0),t}else if(e.data){let t=e.data.slice(0);for(let i=0;i<t.length;i++)t instanceof Uint8Array||t instanceof Uint8ClampedArray?t[i]=Math.floor(Vs(t[i]/255)*255):t[i]=Vs(t[i]);return{data:t,width:e.width,height:e.height}}else return Ke("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),e}},mb=0,Yo=class{constructor(e=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:mb++}),this.uuid=wr(),this.data=e,this.dataReady=!0,this.version=0}getSize(e){let t=this.data;return typeof HTMLVideoElement<"u"&&t instanceof HTMLVideoElement?e.set(t.videoWidth,t.videoHeight,0):typeof VideoFrame<"u"&&t instanceof VideoFrame?e.set(t.displayWidth,t.displayHeight,0):t!==null?e.set(t.width||0,t.height||0,t.depth||0):e.set(0,0,0),e}set needsUpdate(e){e===!0&&this.version++}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.images[this.uuid]!==void 0)return e.images[this.uuid];let i={uuid:this.uuid,url:""},s=this.data;if(s!==null){let r;if(Array.isArray(s)){r=[];for(let o=0,a=s.length;o<a;o++)s[o].isDataTexture?r.push(cf(s[o].image)):r.push(cf(s[o]))}else r=cf(s);i.url=r}return t||(e.images[this.uuid]=i),i}};function cf(n){return typeof HTMLImageElement<"u"&&n instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&n instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&n instanceof ImageBitmap?mh.getDataURL(n):n.data?{data:Array.from(n.data),width:n.width,height:n.height,type:n.data.constructor.name}:(Ke("Texture: Unable to serialize Texture."),{})}var gb=0,hf=new O,ai=class n extends qi{constructor(e=n.DEFAULT_IMAGE,t=n.DEFAULT_MAPPING,i=xs,s=xs,r=ri,o=qs,a=Qi,l=ui,c=n.DEFAULT_ANISOTROPY,h=$s){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:gb++}),this.uuid=wr(),this.name="",this.source=new Yo(e),this.mipmaps=[],this.mapping=t,this.channel=0,this.wrapS=i,this.wrapT=s,this.magFilter=r,this.minFilter=o,this.anisotropy=c,this.format=a,this.internalFormat=null,this.type=l,this.offset=new $e(0,0),this.repeat=new $e(1,1),this.center=new $e(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new Qe,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=h,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(e&&e.depth&&e.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(hf).x}get height(){return this.source.getSize(hf).y}get depth(){return this.source.getSize(hf).z}get image(){return this.source.data}set image(e){this.source.data=e}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(e){return this.name=e.name,this.source=e.source,this.mipmaps=e.mipmaps.slice(0),this.mapping=e.mapping,this.channel=e.channel,this.wrapS=e.wrapS,this.wrapT=e.wrapT,this.magFilter=e.magFilter,this.minFilter=e.minFilter,this.anisotropy=e.anisotropy,this.format=e.format,this.internalFormat=e.internalFormat,this.type=e.type,this.normalized=e.normalized,this.offset.copy(e.offset),this.repeat.copy(e.repeat),this.center.copy(e.center),this.rotation=e.rotation,this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrix.copy(e.matrix),this.generateMipmaps=e.generateMipmaps,this.mipmapsAutoUpdate=e.mipmapsAutoUpdate,this.premultiplyAlpha=e.premultiplyAlpha,this.flipY=e.flipY,this.unpackAlignment=e.unpackAlignment,this.colorSpace=e.colorSpace,this.renderTarget=e.renderTarget,this.isRenderTargetTexture=e.isRenderTargetTexture,this.isPMREMTexture=e.isPMREMTexture,this.isArrayTexture=e.isArrayTexture,this.userData=JSON.parse(JSON.stringify(e.userData)),this.needsUpdate=!0,this}setValues(e){for(let t in e){let i=e[t];if(i===void 0){Ke(`Texture.setValues(): parameter '${t}' has value of undefined.`);continue}let s=this[t];if(s===void 0){Ke(`Texture.setValues(): property '${t}' does not exist.`);continue}s&&i&&s.isVector2&&i.isVector2||s&&i&&s.isVector3&&i.isVector3||s&&i&&s.isMatrix3&&i.isMatrix3?s.copy(i):this[t]=i}}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.textures[this.uuid]!==void 0)return e.textures[this.uuid];let i={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(e).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(i.userData=this.userData),t||(e.textures[this.uuid]=i),i}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(e){if(this.mapping!==Kf)return e;if(e.applyMatrix3(this.matrix),e.x<0||e.x>1)switch(this.wrapS){case dh:e.x=e.x-Math.floor(e.x);break;case xs:e.x=e.x<0?0:1;break;case fh:Math.abs(Math.floor(e.x)%2)===1?e.x=Math.ceil(e.x)-e.x:e.x=e.x-Math.floor(e.x);break}if(e.y<0||e.y>1)switch(this.wrapT){case dh:e.y=e.y-Math.floor(e.y);break;case xs:e.y=e.y<0?0:1;break;case fh:Math.abs(Math.floor(e.y)%2)===1?e.y=Math.ceil(e.y)-e.y:e.y=e.y-Math.floor(e.y);break}return this.flipY&&(e.y=1-e.y),e}set needsUpdate(e){e===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(e){e===!0&&this.pmremVersion++}};ai.DEFAULT_IMAGE=null;ai.DEFAULT_MAPPING=Kf;ai.DEFAULT_ANISOTROPY=1;var nn=class{static{this.prototype.isVector4=!0}constructor(e=0,t=0,i=0,s=1){this.x=e,this.y=t,this.z=i,this.w=s}get width(){return this.z}set width(e){this.z=e}get height(){return this.w}set height(e){this.w=e}set(e,t,i,s){return this.x=e,this.y=t,this.z=i,this.w=s,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this.w=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setW(e){return this.w=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;case 3:this.w=t;break;default:throw new Error("THREE.Vector4: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this.w=e.w!==void 0?e.w:1,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this.w+=e.w,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this.w+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this.w=e.w+t.w,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this.w+=e.w*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this.w-=e.w,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this.w-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this.w=e.w-t.w,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this.w*=e.w,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this.w*=e,this}applyMatrix4(e){let t=this.x,i=this.y,s=this.z,r=this.w,o=e.elements;return this.x=o[0]*t+o[4]*i+o[8]*s+o[12]*r,this.y=o[1]*t+o[5]*i+o[9]*s+o[13]*r,this.z=o[2]*t+o[6]*i+o[10]*s+o[14]*r,this.w=o[3]*t+o[7]*i+o[11]*s+o[15]*r,this}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this.w/=e.w,this}divideScalar(e){return this.multiplyScalar(1/e)}setAxisAngleFromQuaternion(e){this.w=2*Math.acos(e.w);let t=Math.sqrt(1-e.w*e.w);return t<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=e.x/t,this.y=e.y/t,this.z=e.z/t),this}setAxisAngleFromRotationMatrix(e){let t,i,s,r,l=e.elements,c=l[0],h=l[4],u=l[8],d=l[1],f=l[5],m=l[9],y=l[2],g=l[6],p=l[10];if(Math.abs(h-d)<.01&&Math.abs(u-y)<.01&&Math.abs(m-g)<.01){if(Math.abs(h+d)<.1&&Math.abs(u+y)<.1&&Math.abs(m+g)<.1&&Math.abs(c+f+p-3)<.1)return this.set(1,0,0,0),this;t=Math.PI;let C=(c+1)/2,w=(f+1)/2,P=(p+1)/2,E=(h+d)/4,x=(u+y)/4,T=(m+g)/4;return C>w&&C>P?C<.01?(i=0,s=.707106781,r=.707106781):(i=Math.sqrt(C),s=E/i,r=x/i):w>P?w<.01?(i=.707106781,s=0,r=.707106781):(s=Math.sqrt(w),i=E/s,r=T/s):P<.01?(i=.707106781,s=.707106781,r=0):(r=Math.sqrt(P),i=x/r,s=T/r),this.set(i,s,r,t),this}let S=Math.sqrt((g-m)*(g-m)+(u-y)*(u-y)+(d-h)*(d-h));return Math.abs(S)<.001&&(S=1),this.x=(g-m)/S,this.y=(u-y)/S,this.z=(d-h)/S,this.w=Math.acos((c+f+p-1)/2),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this.w=t[15],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this.w=Math.min(this.w,e.w),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this.w=Math.max(this.w,e.w),this}clamp(e,t){return this.x=xt(this.x,e.x,t.x),this.y=xt(this.y,e.y,t.y),this.z=xt(this.z,e.z,t.z),this.w=xt(this.w,e.w,t.w),this}clampScalar(e,t){return this.x=xt(this.x,e,t),this.y=xt(this.y,e,t),this.z=xt(this.z,e,t),this.w=xt(this.w,e,t),this}clampLength(e,t){let i=this.length();return this.divideScalar(i||1).multiplyScalar(xt(i,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z+this.w*e.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this.w+=(e.w-this.w)*t,this}lerpVectors(e,t,i){return this.x=e.x+(t.x-e.x)*i,this.y=e.y+(t.y-e.y)*i,this.z=e.z+(t.z-e.z)*i,this.w=e.w+(t.w-e.w)*i,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z&&e.w===this.w}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this.w=e[t+3],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e[t+3]=this.w,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this.w=e.getW(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}},gh=class extends qi{constructor(e=1,t=1,i={}){super(),i=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:ri,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},i),this.isRenderTarget=!0,this.width=e,this.height=t,this.depth=i.depth,this.scissor=new nn(0,0,e,t),this.scissorTest=!1,this.viewport=new nn(0,0,e,t),this.textures=[];let s=i.count;for(let r=0;r<s;r++)this.textures[r]=new ai({width:e,height:t,depth:i.depth}),this.textures[r].isRenderTargetTexture=!0,this.textures[r].renderTarget=this;this._setTextureOptions(i),this.depthBuffer=i.depthBuffer,this.stencilBuffer=i.stencilBuffer,this.resolveColorBuffer=i.resolveColorBuffer,this.resolveDepthBuffer=i.resolveDepthBuffer,this.resolveStencilBuffer=i.resolveStencilBuffer,this.storeMultisampledColorBuffer=i.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=i.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=i.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=i.depthTexture,this.samples=i.samples,this.multiview=i.multiview,this.useArrayDepthTexture=i.useArrayDepthTexture}_setTextureOptions(e={}){let t={minFilter:ri,generateMipmaps:!1,flipY:!1,internalFormat:null};e.mapping!==void 0&&(t.mapping=e.mapping),e.wrapS!==void 0&&(t.wrapS=e.wrapS),e.wrapT!==void 0&&(t.wrapT=e.wrapT),e.wrapR!==void 0&&(t.wrapR=e.wrapR),e.magFilter!==void 0&&(t.magFilter=e.magFilter),e.minFilter!==void 0&&(t.minFilter=e.minFilter),e.format!==void 0&&(t.format=e.format),e.type!==void 0&&(t.type=e.type),e.anisotropy!==void 0&&(t.anisotropy=e.anisotropy),e.colorSpace!==void 0&&(t.colorSpace=e.colorSpace),e.flipY!==void 0&&(t.flipY=e.flipY),e.generateMipmaps!==void 0&&(t.generateMipmaps=e.generateMipmaps),e.mipmapsAutoUpdate!==void 0&&(t.mipmapsAutoUpdate=e.mipmapsAutoUpdate),e.internalFormat!==void 0&&(t.internalFormat=e.internalFormat);for(let i=0;i<this.textures.length;i++)this.textures[i].setValues(t)}get texture(){return this.textures[0]}set texture(e){this.textures[0]=e}set depthTexture(e){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),e!==null&&e.renderTarget===null&&(e.renderTarget=this),this._depthTexture=e}get depthTexture(){return this._depthTexture}setSize(e,t,i=1){if(this.width!==e||this.height!==t||this.depth!==i){this.width=e,this.height=t,this.depth=i;for(let s=0,r=this.textures.length;s<r;s++)this.textures[s].image.width=e,this.textures[s].image.height=t,this.textures[s].image.depth=i,this.textures[s].isData3DTexture!==!0&&(this.textures[s].isArrayTexture=this.textures[s].image.depth>1);this.dispose()}this.viewport.set(0,0,e,t),this.scissor.set(0,0,e,t)}clone(){return new this.constructor().copy(this)}copy(e){this.width=e.width,this.height=e.height,this.depth=e.depth,this.scissor.copy(e.scissor),this.scissorTest=e.scissorTest,this.viewport.copy(e.viewport),this.textures.length=0;for(let t=0,i=e.textures.length;t<i;t++){this.textures[t]=e.textures[t].clone(),this.textures[t].isRenderTargetTexture=!0,this.textures[t].renderTarget=this;let s=Object.assign({},e.textures[t].image);this.textures[t].source=new Yo(s)}if(this.depthBuffer=e.depthBuffer,this.stencilBuffer=e.stencilBuffer,this.resolveColorBuffer=e.resolveColorBuffer,this.resolveDepthBuffer=e.resolveDepthBuffer,this.resolveStencilBuffer=e.resolveStencilBuffer,this.storeMultisampledColorBuffer=e.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=e.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=e.storeMultisampledStencilBuffer,e.depthTexture!==null)if(e.depthTexture.renderTarget===e){let t=e.depthTexture.clone();t.renderTarget=null,this.depthTexture=t}else this.depthTexture=e.depthTexture;else this.depthTexture=null;return this.samples=e.samples,this.multiview=e.multiview,this.useArrayDepthTexture=e.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},Ai=class extends gh{constructor(e=1,t=1,i={}){super(e,t,i),this.isWebGLRenderTarget=!0}},rl=class extends ai{constructor(e=null,t=1,i=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:e,width:t,height:i,depth:s},this.magFilter=Vn,this.minFilter=Vn,this.wrapR=xs,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}addLayerUpdate(e){this.layerUpdates.add(e)}clearLayerUpdates(){this.layerUpdates.clear()}};var _h=class extends ai{constructor(e=null,t=1,i=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:e,width:t,height:i,depth:s},this.magFilter=Vn,this.minFilter=Vn,this.wrapR=xs,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}};var Pt=class n{static{this.prototype.isMatrix4=!0}constructor(e,t,i,s,r,o,a,l,c,h,u,d,f,m,y,g){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],e!==void 0&&this.set(e,t,i,s,r,o,a,l,c,h,u,d,f,m,y,g)}set(e,t,i,s,r,o,a,l,c,h,u,d,f,m,y,g){let p=this.elements;return p[0]=e,p[4]=t,p[8]=i,p[12]=s,p[1]=r,p[5]=o,p[9]=a,p[13]=l,p[2]=c,p[6]=h,p[10]=u,p[14]=d,p[3]=f,p[7]=m,p[11]=y,p[15]=g,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new n().fromArray(this.elements)}copy(e){let t=this.elements,i=e.elements;return t[0]=i[0],t[1]=i[1],t[2]=i[2],t[3]=i[3],t[4]=i[4],t[5]=i[5],t[6]=i[6],t[7]=i[7],t[8]=i[8],t[9]=i[9],t[10]=i[10],t[11]=i[11],t[12]=i[12],t[13]=i[13],t[14]=i[14],t[15]=i[15],this}copyPosition(e){let t=this.elements,i=e.elements;return t[12]=i[12],t[13]=i[13],t[14]=i[14],this}setFromMatrix3(e){let t=e.elements;return this.set(t[0],t[3],t[6],0,t[1],t[4],t[7],0,t[2],t[5],t[8],0,0,0,0,1),this}extractBasis(e,t,i){return this.determinantAffine()===0?(e.set(1,0,0),t.set(0,1,0),i.set(0,0,1),this):(e.setFromMatrixColumn(this,0),t.setFromMatrixColumn(this,1),i.setFromMatrixColumn(this,2),this)}makeBasis(e,t,i){return this.set(e.x,t.x,i.x,0,e.y,t.y,i.y,0,e.z,t.z,i.z,0,0,0,0,1),this}extractRotation(e){if(e.determinantAffine()===0)return this.identity();let t=this.elements,i=e.elements,s=1/Eo.setFromMatrixColumn(e,0).length(),r=1/Eo.setFromMatrixColumn(e,1).length(),o=1/Eo.setFromMatrixColumn(e,2).length();return t[0]=i[0]*s,t[1]=i[1]*s,t[2]=i[2]*s,t[3]=0,t[4]=i[4]*r,t[5]=i[5]*r,t[6]=i[6]*r,t[7]=0,t[8]=i[8]*o,t[9]=i[9]*o,t[10]=i[10]*o,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromEuler(e){let t=this.elements,i=e.x,s=e.y,r=e.z,o=Math.cos(i),a=Math.sin(i),l=Math.cos(s),c=Math.sin(s),h=Math.cos(r),u=Math.sin(r);if(e.order==="XYZ"){let d=o*h,f=o*u,m=a*h,y=a*u;t[0]=l*h,t[4]=-l*u,t[8]=c,t[1]=f+m*c,t[5]=d-y*c,t[9]=-a*l,t[2]=y-d*c,t[6]=m+f*c,t[10]=o*l}else if(e.order==="YXZ"){let d=l*h,f=l*u,m=c*h,y=c*u;t[0]=d+y*a,t[4]=m*a-f,t[8]=o*c,t[1]=o*u,t[5]=o*h,t[9]=-a,t[2]=f*a-m,t[6]=y+d*a,t[10]=o*l}else if(e.order==="ZXY"){let d=l*h,f=l*u,m=c*h,y=c*u;t[0]=d-y*a,t[4]=-o*u,t[8]=m+f*a,t[1]=f+m*a,t[5]=o*h,t[9]=y-d*a,t[2]=-o*c,t[6]=a,t[10]=o*l}else if(e.order==="ZYX"){let d=o*h,f=o*u,m=a*h,y=a*u;t[0]=l*h,t[4]=m*c-f,t[8]=d*c+y,t[1]=l*u,t[5]=y*c+d,t[9]=f*c-m,t[2]=-c,t[6]=a*l,t[10]=o*l}else if(e.order==="YZX"){let d=o*l,f=o*c,m=a*l,y=a*c;t[0]=l*h,t[4]=y-d*u,t[8]=m*u+f,t[1]=u,t[5]=o*h,t[9]=-a*h,t[2]=-c*h,t[6]=f*u+m,t[10]=d-y*u}else if(e.order==="XZY"){let d=o*l,f=o*c,m=a*l,y=a*c;t[0]=l*h,t[4]=-u,t[8]=c*h,t[1]=d*u+y,t[5]=o*h,t[9]=f*u-m,t[2]=m*u-f,t[6]=a*h,t[10]=y*u+d}return t[3]=0,t[7]=0,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromQuaternion(e){return this.compose(_b,e,xb)}lookAt(e,t,i){let s=this.elements;return Mi.subVectors(e,t),Mi.lengthSq()===0&&(Mi.z=1),Mi.normalize(),ar.crossVectors(i,Mi),ar.lengthSq()===0&&(Math.abs(i.z)===1?Mi.x+=1e-4:Mi.z+=1e-4,Mi.normalize(),ar.crossVectors(i,Mi)),ar.normalize(),Pc.crossVectors(Mi,ar),s[0]=ar.x,s[4]=Pc.x,s[8]=Mi.x,s[1]=ar.y,s[5]=Pc.y,s[9]=Mi.y,s[2]=ar.z,s[6]=Pc.z,s[10]=Mi.z,this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let i=e.elements,s=t.elements,r=this.elements,o=i[0],a=i[4],l=i[8],c=i[12],h=i[1],u=i[5],d=i[9],f=i[13],m=i[2],y=i[6],g=i[10],p=i[14],S=i[3],C=i[7],w=i[11],P=i[15],E=s[0],x=s[4],T=s[8],k=s[12],N=s[1],L=s[5],z=s[9],W=s[13],D=s[2],X=s[6],Z=s[10],H=s[14],he=s[3],j=s[7],ee=s[11],re=s[15];return r[0]=o*E+a*N+l*D+c*he,r[4]=o*x+a*L+l*X+c*j,r[8]=o*T+a*z+l*Z+c*ee,r[12]=o*k+a*W+l*H+c*re,r[1]=h*E+u*N+d*D+f*he,r[5]=h*x+u*L+d*X+f*j,r[9]=h*T+u*z+d*Z+f*ee,r[13]=h*k+u*W+d*H+f*re,r[2]=m*E+y*N+g*D+p*he,r[6]=m*x+y*L+g*X+p*j,r[10]=m*T+y*z+g*Z+p*ee,r[14]=m*k+y*W+g*H+p*re,r[3]=S*E+C*N+w*D+P*he,r[7]=S*x+C*L+w*X+P*j,r[11]=S*T+C*z+w*Z+P*ee,r[15]=S*k+C*W+w*H+P*re,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[4]*=e,t[8]*=e,t[12]*=e,t[1]*=e,t[5]*=e,t[9]*=e,t[13]*=e,t[2]*=e,t[6]*=e,t[10]*=e,t[14]*=e,t[3]*=e,t[7]*=e,t[11]*=e,t[15]*=e,this}determinant(){let e=this.elements,t=e[0],i=e[4],s=e[8],r=e[12],o=e[1],a=e[5],l=e[9],c=e[13],h=e[2],u=e[6],d=e[10],f=e[14],m=e[3],y=e[7],g=e[11],p=e[15],S=l*f-c*d,C=a*f-c*u,w=a*d-l*u,P=o*f-c*h,E=o*d-l*h,x=o*u-a*h;return t*(y*S-g*C+p*w)-i*(m*S-g*P+p*E)+s*(m*C-y*P+p*x)-r*(m*w-y*E+g*x)}determinantAffine(){let e=this.elements,t=e[0],i=e[4],s=e[8],r=e[1],o=e[5],a=e[9],l=e[2],c=e[6],h=e[10];return t*(o*h-a*c)-i*(r*h-a*l)+s*(r*c-o*l)}transpose(){let e=this.elements,t;return t=e[1],e[1]=e[4],e[4]=t,t=e[2],e[2]=e[8],e[8]=t,t=e[6],e[6]=e[9],e[9]=t,t=e[3],e[3]=e[12],e[12]=t,t=e[7],e[7]=e[13],e[13]=t,t=e[11],e[11]=e[14],e[14]=t,this}setPosition(e,t,i){let s=this.elements;return e.isVector3?(s[12]=e.x,s[13]=e.y,s[14]=e.z):(s[12]=e,s[13]=t,s[14]=i),this}invert(){let e=this.elements,t=e[0],i=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8],u=e[9],d=e[10],f=e[11],m=e[12],y=e[13],g=e[14],p=e[15],S=t*a-i*o,C=t*l-s*o,w=t*c-r*o,P=i*l-s*a,E=i*c-r*a,x=s*c-r*l,T=h*y-u*m,k=h*g-d*m,N=h*p-f*m,L=u*g-d*y,z=u*p-f*y,W=d*p-f*g,D=S*W-C*z+w*L+P*N-E*k+x*T;if(D===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let X=1/D;return e[0]=(a*W-l*z+c*L)*X,e[1]=(s*z-i*W-r*L)*X,e[2]=(y*x-g*E+p*P)*X,e[3]=(d*E-u*x-f*P)*X,e[4]=(l*N-o*W-c*k)*X,e[5]=(t*W-s*N+r*k)*X,e[6]=(g*w-m*x-p*C)*X,e[7]=(h*x-d*w+f*C)*X,e[8]=(o*z-a*N+c*T)*X,e[9]=(i*N-t*z-r*T)*X,e[10]=(m*E-y*w+p*S)*X,e[11]=(u*w-h*E-f*S)*X,e[12]=(a*k-o*L-l*T)*X,e[13]=(t*L-i*k+s*T)*X,e[14]=(y*C-m*P-g*S)*X,e[15]=(h*P-u*C+d*S)*X,this}scale(e){let t=this.elements,i=e.x,s=e.y,r=e.z;return t[0]*=i,t[4]*=s,t[8]*=r,t[1]*=i,t[5]*=s,t[9]*=r,t[2]*=i,t[6]*=s,t[10]*=r,t[3]*=i,t[7]*=s,t[11]*=r,this}getMaxScaleOnAxis(){let e=this.elements,t=e[0]*e[0]+e[1]*e[1]+e[2]*e[2],i=e[4]*e[4]+e[5]*e[5]+e[6]*e[6],s=e[8]*e[8]+e[9]*e[9]+e[10]*e[10];return Math.sqrt(Math.max(t,i,s))}makeTranslation(e,t,i){return e.isVector3?this.set(1,0,0,e.x,0,1,0,e.y,0,0,1,e.z,0,0,0,1):this.set(1,0,0,e,0,1,0,t,0,0,1,i,0,0,0,1),this}makeRotationX(e){let t=Math.cos(e),i=Math.sin(e);return this.set(1,0,0,0,0,t,-i,0,0,i,t,0,0,0,0,1),this}makeRotationY(e){let t=Math.cos(e),i=Math.sin(e);return this.set(t,0,i,0,0,1,0,0,-i,0,t,0,0,0,0,1),this}makeRotationZ(e){let t=Math.cos(e),i=Math.sin(e);return this.set(t,-i,0,0,i,t,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(e,t){let i=Math.cos(t),s=Math.sin(t),r=1-i,o=e.x,a=e.y,l=e.z,c=r*o,h=r*a;return this.set(c*o+i,c*a-s*l,c*l+s*a,0,c*a+s*l,h*a+i,h*l-s*o,0,c*l-s*a,h*l+s*o,r*l*l+i,0,0,0,0,1),this}makeScale(e,t,i){return this.set(e,0,0,0,0,t,0,0,0,0,i,0,0,0,0,1),this}makeShear(e,t,i,s,r,o){return this.set(1,i,r,0,e,1,o,0,t,s,1,0,0,0,0,1),this}compose(e,t,i){let s=this.elements,r=t._x,o=t._y,a=t._z,l=t._w,c=r+r,h=o+o,u=a+a,d=r*c,f=r*h,m=r*u,y=o*h,g=o*u,p=a*u,S=l*c,C=l*h,w=l*u,P=i.x,E=i.y,x=i.z;return s[0]=(1-(y+p))*P,s[1]=(f+w)*P,s[2]=(m-C)*P,s[3]=0,s[4]=(f-w)*E,s[5]=(1-(d+p))*E,s[6]=(g+S)*E,s[7]=0,s[8]=(m+C)*x,s[9]=(g-S)*x,s[10]=(1-(d+y))*x,s[11]=0,s[12]=e.x,s[13]=e.y,s[14]=e.z,s[15]=1,this}decompose(e,t,i){let s=this.elements;e.x=s[12],e.y=s[13],e.z=s[14];let r=this.determinantAffine();if(r===0)return i.set(1,1,1),t.identity(),this;let o=Eo.set(s[0],s[1],s[2]).length(),a=Eo.set(s[4],s[5],s[6]).length(),l=Eo.set(s[8],s[9],s[10]).length();r<0&&(o=-o),Hi.copy(this);let c=1/o,h=1/a,u=1/l;return Hi.elements[0]*=c,Hi.elements[1]*=c,Hi.elements[2]*=c,Hi.elements[4]*=h,Hi.elements[5]*=h,Hi.elements[6]*=h,Hi.elements[8]*=u,Hi.elements[9]*=u,Hi.elements[10]*=u,t.setFromRotationMatrix(Hi),i.x=o,i.y=a,i.z=l,this}makePerspective(e,t,i,s,r,o,a=Oi,l=!1){let c=this.elements,h=2*r/(t-e),u=2*r/(i-s),d=(t+e)/(t-e),f=(i+s)/(i-s),m,y;if(l)m=r/(o-r),y=o*r/(o-r);else if(a===Oi)m=-(o+r)/(o-r),y=-2*o*r/(o-r);else if(a===Wo)m=-o/(o-r),y=-o*r/(o-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=d,c[12]=0,c[1]=0,c[5]=u,c[9]=f,c[13]=0,c[2]=0,c[6]=0,c[10]=m,c[14]=y,c[3]=0,c[7]=0,c[11]=-1,c[15]=0,this}makeOrthographic(e,t,i,s,r,o,a=Oi,l=!1){let c=this.elements,h=2/(t-e),u=2/(i-s),d=-(t+e)/(t-e),f=-(i+s)/(i-s),m,y;if(l)m=1/(o-r),y=o/(o-r);else if(a===Oi)m=-2/(o-r),y=-(o+r)/(o-r);else if(a===Wo)m=-1/(o-r),y=-r/(o-r);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=0,c[12]=d,c[1]=0,c[5]=u,c[9]=0,c[13]=f,c[2]=0,c[6]=0,c[10]=m,c[14]=y,c[3]=0,c[7]=0,c[11]=0,c[15]=1,this}equals(e){let t=this.elements,i=e.elements;for(let s=0;s<16;s++)if(t[s]!==i[s])return!1;return!0}fromArray(e,t=0){for(let i=0;i<16;i++)this.elements[i]=e[i+t];return this}toArray(e=[],t=0){let i=this.elements;return e[t]=i[0],e[t+1]=i[1],e[t+2]=i[2],e[t+3]=i[3],e[t+4]=i[4],e[t+5]=i[5],e[t+6]=i[6],e[t+7]=i[7],e[t+8]=i[8],e[t+9]=i[9],e[t+10]=i[10],e[t+11]=i[11],e[t+12]=i[12],e[t+13]=i[13],e[t+14]=i[14],e[t+15]=i[15],e}},Eo=new O,Hi=new Pt,_b=new O(0,0,0),xb=new O(1,1,1),ar=new O,Pc=new O,Mi=new O,Kg=new Pt,Jg=new oi,Hs=class n{constructor(e=0,t=0,i=0,s=n.DEFAULT_ORDER){this.isEuler=!0,this._x=e,this._y=t,this._z=i,this._order=s}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get order(){return this._order}set order(e){this._order=e,this._onChangeCallback()}set(e,t,i,s=this._order){return this._x=e,this._y=t,this._z=i,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(e){return this._x=e._x,this._y=e._y,this._z=e._z,this._order=e._order,this._onChangeCallback(),this}setFromRotationMatrix(e,t=this._order,i=!0){let s=e.elements,r=s[0],o=s[4],a=s[8],l=s[1],c=s[5],h=s[9],u=s[2],d=s[6],f=s[10];switch(t){case"XYZ":this._y=Math.asin(xt(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(-h,f),this._z=Math.atan2(-o,r)):(this._x=Math.atan2(d,c),this._z=0);break;case"YXZ":this._x=Math.asin(-xt(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(a,f),this._z=Math.atan2(l,c)):(this._y=Math.atan2(-u,r),this._z=0);break;case"ZXY":this._x=Math.asin(xt(d,-1,1)),Math.abs(d)<.9999999?(this._y=Math.atan2(-u,f),this._z=Math.atan2(-o,c)):(this._y=0,this._z=Math.atan2(l,r));break;case"ZYX":this._y=Math.asin(-xt(u,-1,1)),Math.abs(u)<.9999999?(this._x=Math.atan2(d,f),this._z=Math.atan2(l,r)):(this._x=0,this._z=Math.atan2(-o,c));break;case"YZX":this._z=Math.asin(xt(l,-1,1)),Math.abs(l)<.9999999?(this._x=Math.atan2(-h,c),this._y=Math.atan2(-u,r)):(this._x=0,this._y=Math.atan2(a,f));break;case"XZY":this._z=Math.asin(-xt(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(d,c),this._y=Math.atan2(a,r)):(this._x=Math.atan2(-h,f),this._y=0);break;default:Ke("Euler: .setFromRotationMatrix() encountered an unknown order: "+t)}return this._order=t,i===!0&&this._onChangeCallback(),this}setFromQuaternion(e,t,i){return Kg.makeRotationFromQuaternion(e),this.setFromRotationMatrix(Kg,t,i)}setFromVector3(e,t=this._order){return this.set(e.x,e.y,e.z,t)}reorder(e){return Jg.setFromEuler(this),this.setFromQuaternion(Jg,e)}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._order===this._order}fromArray(e){return this._x=e[0],this._y=e[1],this._z=e[2],e[3]!==void 0&&(this._order=e[3]),this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._order,e}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};Hs.DEFAULT_ORDER="XYZ";var ol=class{constructor(){this.mask=1}set(e){this.mask=(1<<e|0)>>>0}enable(e){this.mask|=1<<e|0}enableAll(){this.mask=-1}toggle(e){this.mask^=1<<e|0}disable(e){this.mask&=~(1<<e|0)}disableAll(){this.mask=0}test(e){return(this.mask&e.mask)!==0}isEnabled(e){return(this.mask&(1<<e|0))!==0}},yb=0,jg=new O,Ao=new oi,Us=new Pt,Ic=new O,Ha=new O,vb=new O,Sb=new oi,Qg=new O(1,0,0),e0=new O(0,1,0),t0=new O(0,0,1),n0={type:"added"},bb={type:"removed"},Co={type:"childadded",child:null},uf={type:"childremoved",child:null},An=class n extends qi{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:yb++}),this.uuid=wr(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=n.DEFAULT_UP.clone();let e=new O,t=new Hs,i=new oi,s=new O(1,1,1);function r(){i.setFromEuler(t,!1)}function o(){t.setFromQuaternion(i,void 0,!1)}t._onChange(r),i._onChange(o),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:e},rotation:{configurable:!0,enumerable:!0,value:t},quaternion:{configurable:!0,enumerable:!0,value:i},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new Pt},normalMatrix:{value:new Qe}}),this.matrix=new Pt,this.matrixWorld=new Pt,this.matrixAutoUpdate=n.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=n.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new ol,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(e){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(e),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(e){return this.quaternion.premultiply(e),this}setRotationFromAxisAngle(e,t){this.quaternion.setFromAxisAngle(e,t)}setRotationFromEuler(e){this.quaternion.setFromEuler(e,!0)}setRotationFromMatrix(e){this.quaternion.setFromRotationMatrix(e)}setRotationFromQuaternion(e){this.quaternion.copy(e)}rotateOnAxis(e,t){return Ao.setFromAxisAngle(e,t),this.quaternion.multiply(Ao),this}rotateOnWorldAxis(e,t){return Ao.setFromAxisAngle(e,t),this.quaternion.premultiply(Ao),this}rotateX(e){return this.rotateOnAxis(Qg,e)}rotateY(e){return this.rotateOnAxis(e0,e)}rotateZ(e){return this.rotateOnAxis(t0,e)}translateOnAxis(e,t){return jg.copy(e).applyQuaternion(this.quaternion),this.position.add(jg.multiplyScalar(t)),this}translateX(e){return this.translateOnAxis(Qg,e)}translateY(e){return this.translateOnAxis(e0,e)}translateZ(e){return this.translateOnAxis(t0,e)}localToWorld(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(this.matrixWorld)}worldToLocal(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(Us.copy(this.matrixWorld).invert())}lookAt(e,t,i){e.isVector3?Ic.copy(e):Ic.set(e,t,i);let s=this.parent;this.updateWorldMatrix(!0,!1),Ha.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?Us.lookAt(Ha,Ic,this.up):Us.lookAt(Ic,Ha,this.up),this.quaternion.setFromRotationMatrix(Us),s&&(Us.extractRotation(s.matrixWorld),Ao.setFromRotationMatrix(Us),this.quaternion.premultiply(Ao.invert()))}add(e){if(arguments.length>1){for(let t=0;t<arguments.length;t++)this.add(arguments[t]);return this}return e===this?(st("Object3D.add: object can't be added as a child of itself.",e),this):(e&&e.isObject3D?(e.removeFromParent(),e.parent=this,this.children.push(e),e.dispatchEvent(n0),Co.child=e,this.dispatchEvent(Co),Co.child=null):st("Object3D.add: object not an instance of THREE.Object3D.",e),this)}remove(e){if(arguments.length>1){for(let i=0;i<arguments.length;i++)this.remove(arguments[i]);return this}let t=this.children.indexOf(e);return t!==-1&&(e.parent=null,this.children.splice(t,1),e.dispatchEvent(bb),uf.child=e,this.dispatchEvent(uf),uf.child=null),this}removeFromParent(){let e=this.parent;return e!==null&&e.remove(this),this}clear(){return this.remove(...this.children)}attach(e){return this.updateWorldMatrix(!0,!1),Us.copy(this.matrixWorld).invert(),e.parent!==null&&(e.parent.updateWorldMatrix(!0,!1),Us.multiply(e.parent.matrixWorld)),e.applyMatrix4(Us),e.removeFromParent(),e.parent=this,this.children.push(e),e.updateWorldMatrix(!1,!0),e.dispatchEvent(n0),Co.child=e,this.dispatchEvent(Co),Co.child=null,this}getObjectById(e){return this.getObjectByProperty("id",e)}getObjectByName(e){return this.getObjectByProperty("name",e)}getObjectByProperty(e,t){if(this[e]===t)return this;for(let i=0,s=this.children.length;i<s;i++){let o=this.children[i].getObjectByProperty(e,t);if(o!==void 0)return o}}getObjectsByProperty(e,t,i=[]){this[e]===t&&i.push(this);let s=this.children;for(let r=0,o=s.length;r<o;r++)s[r].getObjectsByProperty(e,t,i);return i}getWorldPosition(e){return this.updateWorldMatrix(!0,!1),e.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Ha,e,vb),e}getWorldScale(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Ha,Sb,e),e}getWorldDirection(e){this.updateWorldMatrix(!0,!1);let t=this.matrixWorld.elements;return e.set(t[8],t[9],t[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(e){e(this);let t=this.children;for(let i=0,s=t.length;i<s;i++)t[i].traverse(e)}traverseVisible(e){if(this.visible===!1)return;e(this);let t=this.children;for(let i=0,s=t.length;i<s;i++)t[i].traverseVisible(e)}traverseAncestors(e){let t=this.parent;t!==null&&(e(t),t.traverseAncestors(e))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let e=this.pivot;if(e!==null){let t=e.x,i=e.y,s=e.z,r=this.matrix.elements;r[12]+=t-r[0]*t-r[4]*i-r[8]*s,r[13]+=i-r[1]*t-r[5]*i-r[9]*s,r[14]+=s-r[2]*t-r[6]*i-r[10]*s}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(e){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||e)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,e=!0);let t=this.children;for(let i=0,s=t.length;i<s;i++)t[i].updateMatrixWorld(e)}updateWorldMatrix(e,t,i=!1){let s=this.parent;if(e===!0&&s!==null&&s.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||i)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,i=!0),t===!0){let r=this.children;for(let o=0,a=r.length;o<a;o++)r[o].updateWorldMatrix(!1,!0,i)}}toJSON(e){let t=e===void 0||typeof e=="string",i={};t&&(e={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},i.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let s={};s.uuid=this.uuid,s.type=this.type,s.name=this.name,s.castShadow=this.castShadow,s.receiveShadow=this.receiveShadow,s.visible=this.visible,s.frustumCulled=this.frustumCulled,s.renderOrder=this.renderOrder,s.static=this.static,s.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.pivot!==null&&(s.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(s.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(s.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.geometryInfo=this._geometryInfo.map(a=>({...a,boundingBox:a.boundingBox?a.boundingBox.toJSON():void 0,boundingSphere:a.boundingSphere?a.boundingSphere.toJSON():void 0})),s.instanceInfo=this._instanceInfo.map(a=>({...a})),s.availableInstanceIds=this._availableInstanceIds.slice(),s.availableGeometryIds=this._availableGeometryIds.slice(),s.nextIndexStart=this._nextIndexStart,s.nextVertexStart=this._nextVertexStart,s.geometryCount=this._geometryCount,s.maxInstanceCount=this._maxInstanceCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.matricesTexture=this._matricesTexture.toJSON(e),s.indirectTexture=this._indirectTexture.toJSON(e),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(e)),this.boundingSphere!==null&&(s.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(s.boundingBox=this.boundingBox.toJSON()));function r(a,l){return a[l.uuid]===void 0&&(a[l.uuid]=l.toJSON(e)),l.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(e).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(e).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=r(e.geometries,this.geometry);let a=this.geometry.parameters;if(a!==void 0&&a.shapes!==void 0){let l=a.shapes;if(Array.isArray(l))for(let c=0,h=l.length;c<h;c++){let u=l[c];r(e.shapes,u)}else r(e.shapes,l)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(e.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let a=[];for(let l=0,c=this.material.length;l<c;l++)a.push(r(e.materials,this.material[l]));s.material=a}else s.material=r(e.materials,this.material);if(this.children.length>0){s.children=[];for(let a=0;a<this.children.length;a++)s.children.push(this.children[a].toJSON(e).object)}if(this.animations.length>0){s.animations=[];for(let a=0;a<this.animations.length;a++){let l=this.animations[a];s.animations.push(r(e.animations,l))}}if(t){let a=o(e.geometries),l=o(e.materials),c=o(e.textures),h=o(e.images),u=o(e.shapes),d=o(e.skeletons),f=o(e.animations),m=o(e.nodes);a.length>0&&(i.geometries=a),l.length>0&&(i.materials=l),c.length>0&&(i.textures=c),h.length>0&&(i.images=h),u.length>0&&(i.shapes=u),d.length>0&&(i.skeletons=d),f.length>0&&(i.animations=f),m.length>0&&(i.nodes=m)}return i.object=s,i;function o(a){let l=[];for(let c in a){let h=a[c];delete h.metadata,l.push(h)}return l}}clone(e){return new this.constructor().copy(this,e)}copy(e,t=!0){if(this.name=e.name,this.up.copy(e.up),this.position.copy(e.position),this.rotation.order=e.rotation.order,this.quaternion.copy(e.quaternion),this.scale.copy(e.scale),this.pivot=e.pivot!==null?e.pivot.clone():null,this.matrix.copy(e.matrix),this.matrixWorld.copy(e.matrixWorld),this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrixWorldAutoUpdate=e.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=e.matrixWorldNeedsUpdate,this.layers.mask=e.layers.mask,this.visible=e.visible,this.castShadow=e.castShadow,this.receiveShadow=e.receiveShadow,this.frustumCulled=e.frustumCulled,this.renderOrder=e.renderOrder,this.static=e.static,this.animations=e.animations.slice(),this.userData=JSON.parse(JSON.stringify(e.userData)),t===!0)for(let i=0;i<e.children.length;i++){let s=e.children[i];this.add(s.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};An.DEFAULT_UP=new O(0,1,0);An.DEFAULT_MATRIX_AUTO_UPDATE=!0;An.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var Vt=class extends An{constructor(){super(),this.isGroup=!0,this.type="Group"}},Mb={type:"move"},$o=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new Vt,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new Vt,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new O,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new O),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new Vt,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new O,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new O,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(e){return this._targetRay!==null&&this._targetRay.dispatchEvent(e),this._grip!==null&&this._grip.dispatchEvent(e),this._hand!==null&&this._hand.dispatchEvent(e),this}connect(e){if(e&&e.hand){let t=this._hand;if(t)for(let i of e.hand.values())this._getHandJoint(t,i)}return this.dispatchEvent({type:"connected",data:e}),this}disconnect(e){return this.dispatchEvent({type:"disconnected",data:e}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(e,t,i){let s=null,r=null,o=null,a=this._targetRay,l=this._grip,c=this._hand;if(e&&t.session.visibilityState!=="visible-blurred"){if(c&&e.hand){o=!0;for(let y of e.hand.values()){let g=t.getJointPose(y,i),p=this._getHandJoint(c,y);g!==null&&(p.matrix.fromArray(g.transform.matrix),p.matrix.decompose(p.position,p.quaternion,p.scale),p.matrixWorldNeedsUpdate=!0,p.jointRadius=g.radius),p.visible=g!==null}let h=c.joints["index-finger-tip"],u=c.joints["thumb-tip"],d=h.position.distanceTo(u.position),f=.02,m=.005;c.inputState.pinching&&d>f+m?(c.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:e.handedness,target:this})):!c.inputState.pinching&&d<=f-m&&(c.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:e.handedness,target:this}))}else l!==null&&e.gripSpace&&(r=t.getPose(e.gripSpace,i),r!==null&&(l.matrix.fromArray(r.transform.matrix),l.matrix.decompose(l.position,l.quaternion,l.scale),l.matrixWorldNeedsUpdate=!0,r.linearVelocity?(l.hasLinearVelocity=!0,l.linearVelocity.copy(r.linearVelocity)):l.hasLinearVelocity=!1,r.angularVelocity?(l.hasAngularVelocity=!0,l.angularVelocity.copy(r.angularVelocity)):l.hasAngularVelocity=!1,l.eventsEnabled&&l.dispatchEvent({type:"gripUpdated",data:e,target:this})));a!==null&&(s=t.getPose(e.targetRaySpace,i),s===null&&r!==null&&(s=r),s!==null&&(a.matrix.fromArray(s.transform.matrix),a.matrix.decompose(a.position,a.quaternion,a.scale),a.matrixWorldNeedsUpdate=!0,s.linearVelocity?(a.hasLinearVelocity=!0,a.linearVelocity.copy(s.linearVelocity)):a.hasLinearVelocity=!1,s.angularVelocity?(a.hasAngularVelocity=!0,a.angularVelocity.copy(s.angularVelocity)):a.hasAngularVelocity=!1,this.dispatchEvent(Mb)))}return a!==null&&(a.visible=s!==null),l!==null&&(l.visible=r!==null),c!==null&&(c.visible=o!==null),this}_getHandJoint(e,t){if(e.joints[t.jointName]===void 0){let i=new Vt;i.matrixAutoUpdate=!1,i.visible=!1,e.joints[t.jointName]=i,e.add(i)}return e.joints[t.jointName]}},o_={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},lr={h:0,s:0,l:0},Dc={h:0,s:0,l:0};function df(n,e,t){return t<0&&(t+=1),t>1&&(t-=1),t<1/6?n+(e-n)*6*t:t<1/2?e:t<2/3?n+(e-n)*6*(2/3-t):n}var Je=class{constructor(e,t,i){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(e,t,i)}set(e,t,i){if(t===void 0&&i===void 0){let s=e;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(e,t,i);return this}setScalar(e){return this.r=e,this.g=e,this.b=e,this}setHex(e,t=Ti){return e=Math.floor(e),this.r=(e>>16&255)/255,this.g=(e>>8&255)/255,this.b=(e&255)/255,bt.colorSpaceToWorking(this,t),this}setRGB(e,t,i,s=bt.workingColorSpace){return this.r=e,this.g=t,this.b=i,bt.colorSpaceToWorking(this,s),this}setHSL(e,t,i,s=bt.workingColorSpace){if(e=cp(e,1),t=xt(t,0,1),i=xt(i,0,1),t===0)this.r=this.g=this.b=i;else{let r=i<=.5?i*(1+t):i+t-i*t,o=2*i-r;this.r=df(o,r,e+1/3),this.g=df(o,r,e),this.b=df(o,r,e-1/3)}return bt.colorSpaceToWorking(this,s),this}setStyle(e,t=Ti){function i(r){r!==void 0&&parseFloat(r)<1&&Ke("Color: Alpha component of "+e+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(e)){let r,o=s[1],a=s[2];switch(o){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,t);if(r=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setRGB(Math.min(100,parseFloat(r[1]))/100,Math.min(100,parseFloat(r[2]))/100,Math.min(100,parseFloat(r[3]))/100,t);break;case"hsl":case"hsla":if(r=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,t);break;default:Ke("Color: Unknown color model "+e)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(e)){let r=s[1],o=r.length;if(o===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,t);if(o===6)return this.setHex(parseInt(r,16),t);Ke("Color: Invalid hex color "+e)}else if(e&&e.length>0)return this.setColorName(e,t);return this}setColorName(e,t=Ti){let i=o_[e.toLowerCase()];return i!==void 0?this.setHex(i,t):Ke("Color: Unknown color "+e),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(e){return this.r=e.r,this.g=e.g,this.b=e.b,this}copySRGBToLinear(e){return this.r=Vs(e.r),this.g=Vs(e.g),this.b=Vs(e.b),this}copyLinearToSRGB(e){return this.r=Go(e.r),this.g=Go(e.g),this.b=Go(e.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(e=Ti){return bt.workingToColorSpace($n.copy(this),e),Math.round(xt($n.r*255,0,255))*65536+Math.round(xt($n.g*255,0,255))*256+Math.round(xt($n.b*255,0,255))}getHexString(e=Ti){return("000000"+this.getHex(e).toString(16)).slice(-6)}getHSL(e,t=bt.workingColorSpace){bt.workingToColorSpace($n.copy(this),t);let i=$n.r,s=$n.g,r=$n.b,o=Math.max(i,s,r),a=Math.min(i,s,r),l,c,h=(a+o)/2;if(a===o)l=0,c=0;else{let u=o-a;switch(c=h<=.5?u/(o+a):u/(2-o-a),o){case i:l=(s-r)/u+(s<r?6:0);break;case s:l=(r-i)/u+2;break;case r:l=(i-s)/u+4;break}l/=6}return e.h=l,e.s=c,e.l=h,e}getRGB(e,t=bt.workingColorSpace){return bt.workingToColorSpace($n.copy(this),t),e.r=$n.r,e.g=$n.g,e.b=$n.b,e}getStyle(e=Ti){bt.workingToColorSpace($n.copy(this),e);let t=$n.r,i=$n.g,s=$n.b;return e!==Ti?`color(${e} ${t.toFixed(3)} ${i.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(t*255)},${Math.round(i*255)},${Math.round(s*255)})`}offsetHSL(e,t,i){return this.getHSL(lr),this.setHSL(lr.h+e,lr.s+t,lr.l+i)}add(e){return this.r+=e.r,this.g+=e.g,this.b+=e.b,this}addColors(e,t){return this.r=e.r+t.r,this.g=e.g+t.g,this.b=e.b+t.b,this}addScalar(e){return this.r+=e,this.g+=e,this.b+=e,this}sub(e){return this.r=Math.max(0,this.r-e.r),this.g=Math.max(0,this.g-e.g),this.b=Math.max(0,this.b-e.b),this}multiply(e){return this.r*=e.r,this.g*=e.g,this.b*=e.b,this}multiplyScalar(e){return this.r*=e,this.g*=e,this.b*=e,this}lerp(e,t){return this.r+=(e.r-this.r)*t,this.g+=(e.g-this.g)*t,this.b+=(e.b-this.b)*t,this}lerpColors(e,t,i){return this.r=e.r+(t.r-e.r)*i,this.g=e.g+(t.g-e.g)*i,this.b=e.b+(t.b-e.b)*i,this}lerpHSL(e,t){this.getHSL(lr),e.getHSL(Dc);let i=Qa(lr.h,Dc.h,t),s=Qa(lr.s,Dc.s,t),r=Qa(lr.l,Dc.l,t);return this.setHSL(i,s,r),this}setFromVector3(e){return this.r=e.x,this.g=e.y,this.b=e.z,this}applyMatrix3(e){let t=this.r,i=this.g,s=this.b,r=e.elements;return this.r=r[0]*t+r[3]*i+r[6]*s,this.g=r[1]*t+r[4]*i+r[7]*s,this.b=r[2]*t+r[5]*i+r[8]*s,this}equals(e){return e.r===this.r&&e.g===this.g&&e.b===this.b}fromArray(e,t=0){return this.r=e[t],this.g=e[t+1],this.b=e[t+2],this}toArray(e=[],t=0){return e[t]=this.r,e[t+1]=this.g,e[t+2]=this.b,e}fromBufferAttribute(e,t){return this.r=e.getX(t),this.g=e.getY(t),this.b=e.getZ(t),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},$n=new Je;Je.NAMES=o_;var al=class extends An{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new Hs,this.environmentIntensity=1,this.environmentRotation=new Hs,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(e,t){return super.copy(e,t),this.background=e.background!==null?e.background.clone():null,this.environment=e.environment!==null?e.environment.clone():null,this.fog=e.fog!==null?e.fog.clone():null,this.backgroundBlurriness=e.backgroundBlurriness,this.backgroundIntensity=e.backgroundIntensity,this.backgroundRotation.copy(e.backgroundRotation),this.environmentIntensity=e.environmentIntensity,this.environmentRotation.copy(e.environmentRotation),this.overrideMaterial=e.overrideMaterial!==null?e.overrideMaterial.clone():null,this.matrixAutoUpdate=e.matrixAutoUpdate,this}toJSON(e){let t=super.toJSON(e);return this.fog!==null&&(t.object.fog=this.fog.toJSON()),t.object.backgroundBlurriness=this.backgroundBlurriness,t.object.backgroundIntensity=this.backgroundIntensity,t.object.backgroundRotation=this.backgroundRotation.toArray(),t.object.environmentIntensity=this.environmentIntensity,t.object.environmentRotation=this.environmentRotation.toArray(),t}},Wi=new O,Fs=new O,ff=new O,Os=new O,Ro=new O,Po=new O,i0=new O,pf=new O,mf=new O,gf=new O,_f=new nn,xf=new nn,yf=new nn,zs=class n{constructor(e=new O,t=new O,i=new O){this.a=e,this.b=t,this.c=i}static getNormal(e,t,i,s){s.subVectors(i,t),Wi.subVectors(e,t),s.cross(Wi);let r=s.lengthSq();return r>0?s.multiplyScalar(1/Math.sqrt(r)):s.set(0,0,0)}static getBarycoord(e,t,i,s,r){Wi.subVectors(s,t),Fs.subVectors(i,t),ff.subVectors(e,t);let o=Wi.dot(Wi),a=Wi.dot(Fs),l=Wi.dot(ff),c=Fs.dot(Fs),h=Fs.dot(ff),u=o*c-a*a;if(u===0)return r.set(0,0,0),null;let d=1/u,f=(c*l-a*h)*d,m=(o*h-a*l)*d;return r.set(1-f-m,m,f)}static containsPoint(e,t,i,s){return this.getBarycoord(e,t,i,s,Os)===null?!1:Os.x>=0&&Os.y>=0&&Os.x+Os.y<=1}static getInterpolation(e,t,i,s,r,o,a,l){return this.getBarycoord(e,t,i,s,Os)===null?(l.x=0,l.y=0,"z"in l&&(l.z=0),"w"in l&&(l.w=0),null):(l.setScalar(0),l.addScaledVector(r,Os.x),l.addScaledVector(o,Os.y),l.addScaledVector(a,Os.z),l)}static getInterpolatedAttribute(e,t,i,s,r,o){return _f.setScalar(0),xf.setScalar(0),yf.setScalar(0),_f.fromBufferAttribute(e,t),xf.fromBufferAttribute(e,i),yf.fromBufferAttribute(e,s),o.setScalar(0),o.addScaledVector(_f,r.x),o.addScaledVector(xf,r.y),o.addScaledVector(yf,r.z),o}static isFrontFacing(e,t,i,s){return Wi.subVectors(i,t),Fs.subVectors(e,t),Wi.cross(Fs).dot(s)<0}set(e,t,i){return this.a.copy(e),this.b.copy(t),this.c.copy(i),this}setFromPointsAndIndices(e,t,i,s){return this.a.copy(e[t]),this.b.copy(e[i]),this.c.copy(e[s]),this}setFromAttributeAndIndices(e,t,i,s){return this.a.fromBufferAttribute(e,t),this.b.fromBufferAttribute(e,i),this.c.fromBufferAttribute(e,s),this}clone(){return new this.constructor().copy(this)}copy(e){return this.a.copy(e.a),this.b.copy(e.b),this.c.copy(e.c),this}getArea(){return Wi.subVectors(this.c,this.b),Fs.subVectors(this.a,this.b),Wi.cross(Fs).length()*.5}getMidpoint(e){return e.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(e){return n.getNormal(this.a,this.b,this.c,e)}getPlane(e){return e.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(e,t){return n.getBarycoord(e,this.a,this.b,this.c,t)}getInterpolation(e,t,i,s,r){return n.getInterpolation(e,this.a,this.b,this.c,t,i,s,r)}containsPoint(e){return n.containsPoint(e,this.a,this.b,this.c)}isFrontFacing(e){return n.isFrontFacing(this.a,this.b,this.c,e)}intersectsBox(e){return e.intersectsTriangle(this)}closestPointToPoint(e,t){let i=this.a,s=this.b,r=this.c,o,a;Ro.subVectors(s,i),Po.subVectors(r,i),pf.subVectors(e,i);let l=Ro.dot(pf),c=Po.dot(pf);if(l<=0&&c<=0)return t.copy(i);mf.subVectors(e,s);let h=Ro.dot(mf),u=Po.dot(mf);if(h>=0&&u<=h)return t.copy(s);let d=l*u-h*c;if(d<=0&&l>=0&&h<=0&&l-h>0)return o=l/(l-h),t.copy(i).addScaledVector(Ro,o);gf.subVectors(e,r);let f=Ro.dot(gf),m=Po.dot(gf);if(m>=0&&f<=m)return t.copy(r);let y=f*c-l*m;if(y<=0&&c>=0&&m<=0)return a=c/(c-m),t.copy(i).addScaledVector(Po,a);let g=h*m-f*u;if(g<=0&&u-h>=0&&f-m>=0)return i0.subVectors(r,s),a=(u-h)/(u-h+(f-m)),t.copy(s).addScaledVector(i0,a);let p=1/(g+y+d);return o=y*p,a=d*p,t.copy(i).addScaledVector(Ro,o).addScaledVector(Po,a)}equals(e){return e.a.equals(this.a)&&e.b.equals(this.b)&&e.c.equals(this.c)}},Yi=class{constructor(e=new O(1/0,1/0,1/0),t=new O(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=e,this.max=t}set(e,t){return this.min.copy(e),this.max.copy(t),this}setFromArray(e){this.makeEmpty();for(let t=0,i=e.length;t<i;t+=3)this.expandByPoint(Xi.fromArray(e,t));return this}setFromBufferAttribute(e){this.makeEmpty();for(let t=0,i=e.count;t<i;t++)this.expandByPoint(Xi.fromBufferAttribute(e,t));return this}setFromPoints(e){this.makeEmpty();for(let t=0,i=e.length;t<i;t++)this.expandByPoint(e[t]);return this}setFromCenterAndSize(e,t){let i=Xi.copy(t).multiplyScalar(.5);return this.min.copy(e).sub(i),this.max.copy(e).add(i),this}setFromObject(e,t=!1){return this.makeEmpty(),this.expandByObject(e,t)}clone(){return new this.constructor().copy(this)}copy(e){return this.min.copy(e.min),this.max.copy(e.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(e){return this.isEmpty()?e.set(0,0,0):e.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(e){return this.isEmpty()?e.set(0,0,0):e.subVectors(this.max,this.min)}expandByPoint(e){return this.min.min(e),this.max.max(e),this}expandByVector(e){return this.min.sub(e),this.max.add(e),this}expandByScalar(e){return this.min.addScalar(-e),this.max.addScalar(e),this}expandByObject(e,t=!1){e.updateWorldMatrix(!1,!1);let i=e.geometry;if(i!==void 0){let r=i.getAttribute("position");if(t===!0&&r!==void 0&&e.isInstancedMesh!==!0&&e.isBatchedMesh!==!0)for(let o=0,a=r.count;o<a;o++)e.isMesh===!0?e.getVertexPosition(o,Xi):Xi.fromBufferAttribute(r,o),Xi.applyMatrix4(e.matrixWorld),this.expandByPoint(Xi);else e.boundingBox!==void 0?(e.boundingBox===null&&e.computeBoundingBox(),Lc.copy(e.boundingBox)):(i.boundingBox===null&&i.computeBoundingBox(),Lc.copy(i.boundingBox)),Lc.applyMatrix4(e.matrixWorld),this.union(Lc)}let s=e.children;for(let r=0,o=s.length;r<o;r++)this.expandByObject(s[r],t);return this}containsPoint(e){return e.x>=this.min.x&&e.x<=this.max.x&&e.y>=this.min.y&&e.y<=this.max.y&&e.z>=this.min.z&&e.z<=this.max.z}containsBox(e){return this.min.x<=e.min.x&&e.max.x<=this.max.x&&this.min.y<=e.min.y&&e.max.y<=this.max.y&&this.min.z<=e.min.z&&e.max.z<=this.max.z}getParameter(e,t){return t.set((e.x-this.min.x)/(this.max.x-this.min.x),(e.y-this.min.y)/(this.max.y-this.min.y),(e.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(e){return e.max.x>=this.min.x&&e.min.x<=this.max.x&&e.max.y>=this.min.y&&e.min.y<=this.max.y&&e.max.z>=this.min.z&&e.min.z<=this.max.z}intersectsSphere(e){return this.clampPoint(e.center,Xi),Xi.distanceToSquared(e.center)<=e.radius*e.radius}intersectsPlane(e){let t,i;return e.normal.x>0?(t=e.normal.x*this.min.x,i=e.normal.x*this.max.x):(t=e.normal.x*this.max.x,i=e.normal.x*this.min.x),e.normal.y>0?(t+=e.normal.y*this.min.y,i+=e.normal.y*this.max.y):(t+=e.normal.y*this.max.y,i+=e.normal.y*this.min.y),e.normal.z>0?(t+=e.normal.z*this.min.z,i+=e.normal.z*this.max.z):(t+=e.normal.z*this.max.z,i+=e.normal.z*this.min.z),t<=-e.constant&&i>=-e.constant}intersectsTriangle(e){if(this.isEmpty())return!1;this.getCenter(Wa),Nc.subVectors(this.max,Wa),Io.subVectors(e.a,Wa),Do.subVectors(e.b,Wa),Lo.subVectors(e.c,Wa),cr.subVectors(Do,Io),hr.subVectors(Lo,Do),Vr.subVectors(Io,Lo);let t=[0,-cr.z,cr.y,0,-hr.z,hr.y,0,-Vr.z,Vr.y,cr.z,0,-cr.x,hr.z,0,-hr.x,Vr.z,0,-Vr.x,-cr.y,cr.x,0,-hr.y,hr.x,0,-Vr.y,Vr.x,0];return!vf(t,Io,Do,Lo,Nc)||(t=[1,0,0,0,1,0,0,0,1],!vf(t,Io,Do,Lo,Nc))?!1:(Uc.crossVectors(cr,hr),t=[Uc.x,Uc.y,Uc.z],vf(t,Io,Do,Lo,Nc))}clampPoint(e,t){return t.copy(e).clamp(this.min,this.max)}distanceToPoint(e){return this.clampPoint(e,Xi).distanceTo(e)}getBoundingSphere(e){return this.isEmpty()?e.makeEmpty():(this.getCenter(e.center),e.radius=this.getSize(Xi).length()*.5),e}intersect(e){return this.min.max(e.min),this.max.min(e.max),this.isEmpty()&&this.makeEmpty(),this}union(e){return this.min.min(e.min),this.max.max(e.max),this}applyMatrix4(e){return this.isEmpty()?this:(Bs[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(e),Bs[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(e),Bs[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(e),Bs[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(e),Bs[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(e),Bs[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(e),Bs[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(e),Bs[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(e),this.setFromPoints(Bs),this)}translate(e){return this.min.add(e),this.max.add(e),this}equals(e){return e.min.equals(this.min)&&e.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(e){return this.min.fromArray(e.min),this.max.fromArray(e.max),this}},Bs=[new O,new O,new O,new O,new O,new O,new O,new O],Xi=new O,Lc=new Yi,Io=new O,Do=new O,Lo=new O,cr=new O,hr=new O,Vr=new O,Wa=new O,Nc=new O,Uc=new O,Gr=new O;function vf(n,e,t,i,s){for(let r=0,o=n.length-3;r<=o;r+=3){Gr.fromArray(n,r);let a=s.x*Math.abs(Gr.x)+s.y*Math.abs(Gr.y)+s.z*Math.abs(Gr.z),l=e.dot(Gr),c=t.dot(Gr),h=i.dot(Gr);if(Math.max(-Math.max(l,c,h),Math.min(l,c,h))>a)return!1}return!0}var bn=new O,Fc=new $e,wb=0,un=class extends qi{constructor(e,t,i=!1){if(super(),Array.isArray(e))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:wb++}),this.name="",this.array=e,this.itemSize=t,this.count=e!==void 0?e.length/t:0,this.normalized=i,this.usage=ap,this.updateRanges=[],this.gpuType=Ji,this.version=0,this._normalizationScale=e!==void 0?Tu(e):void 0}onUploadCallback(){}set needsUpdate(e){e===!0&&this.version++}setUsage(e){return this.usage=e,this}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}copy(e){return this.name=e.name,this.array=new e.array.constructor(e.array),this.itemSize=e.itemSize,this.count=e.count,this.normalized=e.normalized,this.usage=e.usage,this.gpuType=e.gpuType,this._normalizationScale=e._normalizationScale,this}copyAt(e,t,i){e*=this.itemSize,i*=t.itemSize;for(let s=0,r=this.itemSize;s<r;s++)this.array[e+s]=t.array[i+s];return this}copyArray(e){return this.array.set(e),this}applyMatrix3(e){if(this.itemSize===2)for(let t=0,i=this.count;t<i;t++)Fc.fromBufferAttribute(this,t),Fc.applyMatrix3(e),this.setXY(t,Fc.x,Fc.y);else if(this.itemSize===3)for(let t=0,i=this.count;t<i;t++)bn.fromBufferAttribute(this,t),bn.applyMatrix3(e),this.setXYZ(t,bn.x,bn.y,bn.z);return this}applyMatrix4(e){for(let t=0,i=this.count;t<i;t++)bn.fromBufferAttribute(this,t),bn.applyMatrix4(e),this.setXYZ(t,bn.x,bn.y,bn.z);return this}applyNormalMatrix(e){for(let t=0,i=this.count;t<i;t++)bn.fromBufferAttribute(this,t),bn.applyNormalMatrix(e),this.setXYZ(t,bn.x,bn.y,bn.z);return this}transformDirection(e){for(let t=0,i=this.count;t<i;t++)bn.fromBufferAttribute(this,t),bn.transformDirection(e),this.setXYZ(t,bn.x,bn.y,bn.z);return this}set(e,t=0){return this.array.set(e,t),this}getComponent(e,t){let i=this.array[e*this.itemSize+t];return this.normalized&&(i=this._denormalize(i)),i}setComponent(e,t,i){return this.normalized&&(i=this._normalize(i)),this.array[e*this.itemSize+t]=i,this}getX(e){let t=this.array[e*this.itemSize];return this.normalized&&(t=this._denormalize(t)),t}setX(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize]=t,this}getY(e){let t=this.array[e*this.itemSize+1];return this.normalized&&(t=this._denormalize(t)),t}setY(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+1]=t,this}getZ(e){let t=this.array[e*this.itemSize+2];return this.normalized&&(t=this._denormalize(t)),t}setZ(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+2]=t,this}getW(e){let t=this.array[e*this.itemSize+3];return this.normalized&&(t=this._denormalize(t)),t}setW(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+3]=t,this}setXY(e,t,i){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),i=this._normalize(i)),this.array[e+0]=t,this.array[e+1]=i,this}setXYZ(e,t,i,s){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),i=this._normalize(i),s=this._normalize(s)),this.array[e+0]=t,this.array[e+1]=i,this.array[e+2]=s,this}setXYZW(e,t,i,s,r){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),i=this._normalize(i),s=this._normalize(s),r=this._normalize(r)),this.array[e+0]=t,this.array[e+1]=i,this.array[e+2]=s,this.array[e+3]=r,this}onUpload(e){return this.onUploadCallback=e,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let e={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return e.name=this.name,e.usage=this.usage,e.gpuType=this.gpuType,e}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(e){let t=this._normalizationScale;return t!==void 0?Math.max(e/t,-1):up(e,this.array)}_normalize(e){let t=this._normalizationScale;return t!==void 0?Math.round(e*t):dp(e,this.array)}};var ll=class extends un{constructor(e,t,i){super(new Uint16Array(e),t,i)}};var cl=class extends un{constructor(e,t,i){super(new Uint32Array(e),t,i)}};var dn=class extends un{constructor(e,t,i){super(new Float32Array(e),t,i)}},Tb=new Yi,Xa=new O,Sf=new O,dr=class{constructor(e=new O,t=-1){this.isSphere=!0,this.center=e,this.radius=t}set(e,t){return this.center.copy(e),this.radius=t,this}setFromPoints(e,t){let i=this.center;t!==void 0?i.copy(t):Tb.setFromPoints(e).getCenter(i);let s=0;for(let r=0,o=e.length;r<o;r++)s=Math.max(s,i.distanceToSquared(e[r]));return this.radius=Math.sqrt(s),this}copy(e){return this.center.copy(e.center),this.radius=e.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(e){return e.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(e){return e.distanceTo(this.center)-this.radius}intersectsSphere(e){let t=this.radius+e.radius;return e.center.distanceToSquared(this.center)<=t*t}intersectsBox(e){return e.intersectsSphere(this)}intersectsPlane(e){return Math.abs(e.distanceToPoint(this.center))<=this.radius}clampPoint(e,t){let i=this.center.distanceToSquared(e);return t.copy(e),i>this.radius*this.radius&&(t.sub(this.center).normalize(),t.multiplyScalar(this.radius).add(this.center)),t}getBoundingBox(e){return this.isEmpty()?(e.makeEmpty(),e):(e.set(this.center,this.center),e.expandByScalar(this.radius),e)}applyMatrix4(e){return this.center.applyMatrix4(e),this.radius=this.radius*e.getMaxScaleOnAxis(),this}translate(e){return this.center.add(e),this}expandByPoint(e){if(this.isEmpty())return this.center.copy(e),this.radius=0,this;Xa.subVectors(e,this.center);let t=Xa.lengthSq();if(t>this.radius*this.radius){let i=Math.sqrt(t),s=(i-this.radius)*.5;this.center.addScaledVector(Xa,s/i),this.radius+=s}return this}union(e){return e.isEmpty()?this:this.isEmpty()?(this.copy(e),this):(this.center.equals(e.center)===!0?this.radius=Math.max(this.radius,e.radius):(Sf.subVectors(e.center,this.center).setLength(e.radius),this.expandByPoint(Xa.copy(e.center).add(Sf)),this.expandByPoint(Xa.copy(e.center).sub(Sf))),this)}equals(e){return e.center.equals(this.center)&&e.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(e){return this.radius=e.radius,this.center.fromArray(e.center),this}},Eb=0,Fi=new Pt,bf=new An,No=new O,wi=new Yi,qa=new Yi,zn=new O,qt=class n extends qi{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:Eb++}),this.uuid=wr(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(e){return Array.isArray(e)?this.index=new(JS(e)?cl:ll)(e,1):this.index=e,this}setIndirect(e,t=0){return this.indirect=e,this.indirectOffset=t,this}getIndirect(){return this.indirect}getAttribute(e){return this.attributes[e]}setAttribute(e,t){return this.attributes[e]=t,this}deleteAttribute(e){return delete this.attributes[e],this}hasAttribute(e){return this.attributes[e]!==void 0}addGroup(e,t,i=0){this.groups.push({start:e,count:t,materialIndex:i})}clearGroups(){this.groups=[]}setDrawRange(e,t){this.drawRange.start=e,this.drawRange.count=t}applyMatrix4(e){let t=this.attributes.position;t!==void 0&&(t.applyMatrix4(e),t.needsUpdate=!0);let i=this.attributes.normal;if(i!==void 0){let r=new Qe().getNormalMatrix(e);i.applyNormalMatrix(r),i.needsUpdate=!0}let s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(e),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(e){return Fi.makeRotationFromQuaternion(e),this.applyMatrix4(Fi),this}rotateX(e){return Fi.makeRotationX(e),this.applyMatrix4(Fi),this}rotateY(e){return Fi.makeRotationY(e),this.applyMatrix4(Fi),this}rotateZ(e){return Fi.makeRotationZ(e),this.applyMatrix4(Fi),this}translate(e,t,i){return Fi.makeTranslation(e,t,i),this.applyMatrix4(Fi),this}scale(e,t,i){return Fi.makeScale(e,t,i),this.applyMatrix4(Fi),this}lookAt(e){return bf.lookAt(e),bf.updateMatrix(),this.applyMatrix4(bf.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(No).negate(),this.translate(No.x,No.y,No.z),this}setFromPoints(e){let t=this.getAttribute("position");if(t===void 0){let i=[];for(let s=0,r=e.length;s<r;s++){let o=e[s];i.push(o.x,o.y,o.z||0)}this.setAttribute("position",new dn(i,3))}else{let i=Math.min(e.length,t.count);for(let s=0;s<i;s++){let r=e[s];t.setXYZ(s,r.x,r.y,r.z||0)}e.length>t.count&&Ke("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),t.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new Yi);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){st("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new O(-1/0,-1/0,-1/0),new O(1/0,1/0,1/0));return}if(e!==void 0){if(this.boundingBox.setFromBufferAttribute(e),t)for(let i=0,s=t.length;i<s;i++){let r=t[i];wi.setFromBufferAttribute(r),this.morphTargetsRelative?(zn.addVectors(this.boundingBox.min,wi.min),this.boundingBox.expandByPoint(zn),zn.addVectors(this.boundingBox.max,wi.max),this.boundingBox.expandByPoint(zn)):(this.boundingBox.expandByPoint(wi.min),this.boundingBox.expandByPoint(wi.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&st('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new dr);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){st("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new O,1/0);return}if(e){let i=this.boundingSphere.center;if(wi.setFromBufferAttribute(e),t)for(let r=0,o=t.length;r<o;r++){let a=t[r];qa.setFromBufferAttribute(a),this.morphTargetsRelative?(zn.addVectors(wi.min,qa.min),wi.expandByPoint(zn),zn.addVectors(wi.max,qa.max),wi.expandByPoint(zn)):(wi.expandByPoint(qa.min),wi.expandByPoint(qa.max))}wi.getCenter(i);let s=0;for(let r=0,o=e.count;r<o;r++)zn.fromBufferAttribute(e,r),s=Math.max(s,i.distanceToSquared(zn));if(t)for(let r=0,o=t.length;r<o;r++){let a=t[r],l=this.morphTargetsRelative;for(let c=0,h=a.count;c<h;c++)zn.fromBufferAttribute(a,c),l&&(No.fromBufferAttribute(e,c),zn.add(No)),s=Math.max(s,i.distanceToSquared(zn))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&st('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let e=this.index,t=this.attributes;if(e===null||t.position===void 0||t.normal===void 0||t.uv===void 0){st("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let i=t.position,s=t.normal,r=t.uv,o=this.getAttribute("tangent");(o===void 0||o.count!==i.count)&&(o=new un(new Float32Array(4*i.count),4),this.setAttribute("tangent",o));let a=[],l=[],c=new Uint8Array(i.count);for(let k=0;k<i.count;k++)a[k]=new O,l[k]=new O;let h=new O,u=new O,d=new O,f=new $e,m=new $e,y=new $e,g=new O,p=new O;function S(k,N,L){c[k]=c[N]=c[L]=1,h.fromBufferAttribute(i,k),u.fromBufferAttribute(i,N),d.fromBufferAttribute(i,L),f.fromBufferAttribute(r,k),m.fromBufferAttribute(r,N),y.fromBufferAttribute(r,L),u.sub(h),d.sub(h),m.sub(f),y.sub(f);let z=1/(m.x*y.y-y.x*m.y);isFinite(z)&&(g.copy(u).multiplyScalar(y.y).addScaledVector(d,-m.y).multiplyScalar(z),p.copy(d).multiplyScalar(m.x).addScaledVector(u,-y.x).multiplyScalar(z),a[k].add(g),a[N].add(g),a[L].add(g),l[k].add(p),l[N].add(p),l[L].add(p))}let C=this.groups;C.length===0&&(C=[{start:0,count:e.count}]);for(let k=0,N=C.length;k<N;++k){let L=C[k],z=L.start,W=L.count;for(let D=z,X=z+W;D<X;D+=3)S(e.getX(D+0),e.getX(D+1),e.getX(D+2))}let w=new O,P=new O,E=new O,x=new O;function T(k){E.fromBufferAttribute(s,k),x.copy(E);let N=a[k];w.copy(N),w.sub(E.multiplyScalar(E.dot(N))).normalize(),P.crossVectors(x,N);let z=P.dot(l[k])<0?-1:1;o.setXYZW(k,w.x,w.y,w.z,z)}for(let k=0,N=i.count;k<N;++k)c[k]&&T(k);this._transformed=!0}computeVertexNormals(){let e=this.index,t=this.getAttribute("position");if(t!==void 0){let i=this.getAttribute("normal");if(i===void 0||i.count!==t.count)i=new un(new Float32Array(t.count*3),3),this.setAttribute("normal",i);else for(let d=0,f=i.count;d<f;d++)i.setXYZ(d,0,0,0);let s=new O,r=new O,o=new O,a=new O,l=new O,c=new O,h=new O,u=new O;if(e)for(let d=0,f=e.count;d<f;d+=3){let m=e.getX(d+0),y=e.getX(d+1),g=e.getX(d+2);s.fromBufferAttribute(t,m),r.fromBufferAttribute(t,y),o.fromBufferAttribute(t,g),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),a.fromBufferAttribute(i,m),l.fromBufferAttribute(i,y),c.fromBufferAttribute(i,g),a.add(h),l.add(h),c.add(h),i.setXYZ(m,a.x,a.y,a.z),i.setXYZ(y,l.x,l.y,l.z),i.setXYZ(g,c.x,c.y,c.z)}else for(let d=0,f=t.count;d<f;d+=3)s.fromBufferAttribute(t,d+0),r.fromBufferAttribute(t,d+1),o.fromBufferAttribute(t,d+2),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),i.setXYZ(d+0,h.x,h.y,h.z),i.setXYZ(d+1,h.x,h.y,h.z),i.setXYZ(d+2,h.x,h.y,h.z);this.normalizeNormals(),i.needsUpdate=!0}}normalizeNormals(){let e=this.attributes.normal;for(let t=0,i=e.count;t<i;t++)zn.fromBufferAttribute(e,t),zn.normalize(),e.setXYZ(t,zn.x,zn.y,zn.z)}toNonIndexed(){function e(a,l){let c=a.array,h=a.itemSize,u=a.normalized,d=new c.constructor(l.length*h),f=0,m=0;for(let y=0,g=l.length;y<g;y++){a.isInterleavedBufferAttribute?f=l[y]*a.data.stride+a.offset:f=l[y]*h;for(let p=0;p<h;p++)d[m++]=c[f++]}return new un(d,h,u)}if(this.index===null)return Ke("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let t=new n,i=this.index.array,s=this.attributes;for(let a in s){let l=s[a],c=e(l,i);t.setAttribute(a,c)}let r=this.morphAttributes;for(let a in r){let l=[],c=r[a];for(let h=0,u=c.length;h<u;h++){let d=c[h],f=e(d,i);l.push(f)}t.morphAttributes[a]=l}t.morphTargetsRelative=this.morphTargetsRelative;let o=this.groups;for(let a=0,l=o.length;a<l;a++){let c=o[a];t.addGroup(c.start,c.count,c.materialIndex)}return t}toJSON(){let e={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(e.uuid=this.uuid,e.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,e.name=this.name,Object.keys(this.userData).length>0&&(e.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let l=this.parameters;for(let c in l)l[c]!==void 0&&(e[c]=l[c]);return e}e.data={attributes:{}};let t=this.index;t!==null&&(e.data.index={type:t.array.constructor.name,array:Array.prototype.slice.call(t.array)});let i=this.attributes;for(let l in i){let c=i[l];e.data.attributes[l]=c.toJSON(e.data)}let s={},r=!1;for(let l in this.morphAttributes){let c=this.morphAttributes[l],h=[];for(let u=0,d=c.length;u<d;u++){let f=c[u];h.push(f.toJSON(e.data))}h.length>0&&(s[l]=h,r=!0)}r&&(e.data.morphAttributes=s,e.data.morphTargetsRelative=this.morphTargetsRelative);let o=this.groups;o.length>0&&(e.data.groups=JSON.parse(JSON.stringify(o)));let a=this.boundingSphere;return a!==null&&(e.data.boundingSphere=a.toJSON()),e}clone(){return new this.constructor().copy(this)}copy(e){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let t={};this.name=e.name;let i=e.index;i!==null&&this.setIndex(i.clone());let s=e.attributes;for(let c in s){let h=s[c];this.setAttribute(c,h.clone(t))}let r=e.morphAttributes;for(let c in r){let h=[],u=r[c];for(let d=0,f=u.length;d<f;d++)h.push(u[d].clone(t));this.morphAttributes[c]=h}this.morphTargetsRelative=e.morphTargetsRelative;let o=e.groups;for(let c=0,h=o.length;c<h;c++){let u=o[c];this.addGroup(u.start,u.count,u.materialIndex)}let a=e.boundingBox;a!==null&&(this.boundingBox=a.clone());let l=e.boundingSphere;return l!==null&&(this.boundingSphere=l.clone()),this.drawRange.start=e.drawRange.start,this.drawRange.count=e.drawRange.count,this.userData=e.userData,this._transformed=e._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}},xh=class{constructor(e,t){this.isInterleavedBuffer=!0,this.array=e,this.stride=t,this.count=e!==void 0?e.length/t:0,this.usage=ap,this.updateRanges=[],this.version=0,this.uuid=wr()}onUploadCallback(){}set needsUpdate(e){e===!0&&this.version++}setUsage(e){return this.usage=e,this}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}copy(e){return this.array=new e.array.constructor(e.array),this.count=e.count,this.stride=e.stride,this.usage=e.usage,this}copyAt(e,t,i){e*=this.stride,i*=t.stride;for(let s=0,r=this.stride;s<r;s++)this.array[e+s]=t.array[i+s];return this}set(e,t=0){return this.array.set(e,t),this}clone(e){e.arrayBuffers===void 0&&(e.arrayBuffers={});let t=s0(this.array);e.arrayBuffers[t]===void 0&&(e.arrayBuffers[t]=this.array.slice(0).buffer);let i=new this.array.constructor(e.arrayBuffers[t]),s=new this.constructor(i,this.stride);return s.setUsage(this.usage),s}onUpload(e){return this.onUploadCallback=e,this}toJSON(e){e.arrayBuffers===void 0&&(e.arrayBuffers={});let t=s0(this.array);e.arrayBuffers[t]===void 0&&(e.arrayBuffers[t]=Array.from(new Uint32Array(this.array.slice(0).buffer)));let i={uuid:this.uuid,buffer:t,type:this.array.constructor.name,stride:this.stride};return i.usage=this.usage,i}};function s0(n){return n.buffer._uuid===void 0&&(n.buffer._uuid=wr()),n.byteOffset===0&&n.byteLength===n.buffer.byteLength?n.buffer._uuid:n.buffer._uuid+":"+n.byteOffset+":"+n.byteLength}var ii=new O,hl=class n{constructor(e,t,i,s=!1){this.isInterleavedBufferAttribute=!0,this.name="",this.data=e,this.itemSize=t,this.offset=i,this.normalized=s,this._normalizationScale=e!==void 0?Tu(e.array):void 0}get count(){return this.data.count}get array(){return this.data.array}set needsUpdate(e){this.data.needsUpdate=e}applyMatrix4(e){for(let t=0,i=this.data.count;t<i;t++)ii.fromBufferAttribute(this,t),ii.applyMatrix4(e),this.setXYZ(t,ii.x,ii.y,ii.z);return this}applyNormalMatrix(e){for(let t=0,i=this.count;t<i;t++)ii.fromBufferAttribute(this,t),ii.applyNormalMatrix(e),this.setXYZ(t,ii.x,ii.y,ii.z);return this}transformDirection(e){for(let t=0,i=this.count;t<i;t++)ii.fromBufferAttribute(this,t),ii.transformDirection(e),this.setXYZ(t,ii.x,ii.y,ii.z);return this}getComponent(e,t){let i=this.array[e*this.data.stride+this.offset+t];return this.normalized&&(i=this._denormalize(i)),i}setComponent(e,t,i){return this.normalized&&(i=this._normalize(i)),this.data.array[e*this.data.stride+this.offset+t]=i,this}setX(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset]=t,this}setY(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+1]=t,this}setZ(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+2]=t,this}setW(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+3]=t,this}getX(e){let t=this.data.array[e*this.data.stride+this.offset];return this.normalized&&(t=this._denormalize(t)),t}getY(e){let t=this.data.array[e*this.data.stride+this.offset+1];return this.normalized&&(t=this._denormalize(t)),t}getZ(e){let t=this.data.array[e*this.data.stride+this.offset+2];return this.normalized&&(t=this._denormalize(t)),t}getW(e){let t=this.data.array[e*this.data.stride+this.offset+3];return this.normalized&&(t=this._denormalize(t)),t}setXY(e,t,i){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),i=this._normalize(i)),this.data.array[e+0]=t,this.data.array[e+1]=i,this}setXYZ(e,t,i,s){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),i=this._normalize(i),s=this._normalize(s)),this.data.array[e+0]=t,this.data.array[e+1]=i,this.data.array[e+2]=s,this}setXYZW(e,t,i,s,r){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),i=this._normalize(i),s=this._normalize(s),r=this._normalize(r)),this.data.array[e+0]=t,this.data.array[e+1]=i,this.data.array[e+2]=s,this.data.array[e+3]=r,this}clone(e){if(e===void 0){sl("InterleavedBufferAttribute.clone(): Cloning an interleaved buffer attribute will de-interleave buffer data.");let t=[];for(let i=0;i<this.count;i++){let s=i*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)t.push(this.data.array[s+r])}return new un(new this.array.constructor(t),this.itemSize,this.normalized)}else return e.interleavedBuffers===void 0&&(e.interleavedBuffers={}),e.interleavedBuffers[this.data.uuid]===void 0&&(e.interleavedBuffers[this.data.uuid]=this.data.clone(e)),new n(e.interleavedBuffers[this.data.uuid],this.itemSize,this.offset,this.normalized)}toJSON(e){if(e===void 0){sl("InterleavedBufferAttribute.toJSON(): Serializing an interleaved buffer attribute will de-interleave buffer data.");let t=[];for(let i=0;i<this.count;i++){let s=i*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)t.push(this.data.array[s+r])}return{itemSize:this.itemSize,type:this.array.constructor.name,array:t,normalized:this.normalized}}else return e.interleavedBuffers===void 0&&(e.interleavedBuffers={}),e.interleavedBuffers[this.data.uuid]===void 0&&(e.interleavedBuffers[this.data.uuid]=this.data.toJSON(e)),{isInterleavedBufferAttribute:!0,itemSize:this.itemSize,data:this.data.uuid,offset:this.offset,normalized:this.normalized}}_denormalize(e){let t=this._normalizationScale;return t!==void 0?Math.max(e/t,-1):up(e,this.data.array)}_normalize(e){let t=this._normalizationScale;return t!==void 0?Math.round(e*t):dp(e,this.data.array)}},Mf=new O,Ab=new O,Cb=new Qe,Ei=class{constructor(e=new O(1,0,0),t=0){this.isPlane=!0,this.normal=e,this.constant=t}set(e,t){return this.normal.copy(e),this.constant=t,this}setComponents(e,t,i,s){return this.normal.set(e,t,i),this.constant=s,this}setFromNormalAndCoplanarPoint(e,t){return this.normal.copy(e),this.constant=-t.dot(this.normal),this}setFromCoplanarPoints(e,t,i){let s=Mf.subVectors(i,t).cross(Ab.subVectors(e,t)).normalize();return this.setFromNormalAndCoplanarPoint(s,e),this}copy(e){return this.normal.copy(e.normal),this.constant=e.constant,this}normalize(){let e=1/this.normal.length();return this.normal.multiplyScalar(e),this.constant*=e,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(e){return this.normal.dot(e)+this.constant}distanceToSphere(e){return this.distanceToPoint(e.center)-e.radius}projectPoint(e,t){return t.copy(e).addScaledVector(this.normal,-this.distanceToPoint(e))}intersectLine(e,t,i=!0){let s=e.delta(Mf),r=this.normal.dot(s);if(r===0)return this.distanceToPoint(e.start)===0?t.copy(e.start):null;let o=-(e.start.dot(this.normal)+this.constant)/r;return i===!0&&(o<0||o>1)?null:t.copy(e.start).addScaledVector(s,o)}intersectsLine(e){let t=this.distanceToPoint(e.start),i=this.distanceToPoint(e.end);return t<0&&i>0||i<0&&t>0}intersectsBox(e){return e.intersectsPlane(this)}intersectsSphere(e){return e.intersectsPlane(this)}coplanarPoint(e){return e.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(e,t){let i=t||Cb.getNormalMatrix(e),s=this.coplanarPoint(Mf).applyMatrix4(e),r=this.normal.applyMatrix3(i).normalize();return this.constant=-s.dot(r),this}translate(e){return this.constant-=e.dot(this.normal),this}equals(e){return e.normal.equals(this.normal)&&e.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(e){return this.normal.fromArray(e.normal),this.constant=e.constant,this}},Rb=0,$i=class extends qi{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:Rb++}),this.uuid=wr(),this.name="",this.type="Material",this.blending=ta,this.side=br,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=Vf,this.blendDst=Gf,this.blendEquation=Zr,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new Je(0,0,0),this.blendAlpha=0,this.depthFunc=Ho,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=K0,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=sh,this.stencilZFail=sh,this.stencilZPass=sh,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(e){this._alphaTest>0!=e>0&&this.version++,this._alphaTest=e}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(e){if(e!==void 0)for(let t in e){let i=e[t];if(i===void 0){Ke(`Material: parameter '${t}' has value of undefined.`);continue}let s=this[t];if(s===void 0){Ke(`Material: '${t}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(i):s&&s.isVector2&&i&&i.isVector2||s&&s.isEuler&&i&&i.isEuler||s&&s.isVector3&&i&&i.isVector3?s.copy(i):this[t]=i}}toJSON(e){let t=e===void 0||typeof e=="string";t&&(e={textures:{},images:{}});let i={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};i.uuid=this.uuid,i.type=this.type,i.blending=this.blending,i.side=this.side,i.shadowSide=this.shadowSide,i.vertexColors=this.vertexColors,i.opacity=this.opacity,i.transparent=this.transparent,i.blendSrc=this.blendSrc,i.blendDst=this.blendDst,i.blendEquation=this.blendEquation,i.blendSrcAlpha=this.blendSrcAlpha,i.blendDstAlpha=this.blendDstAlpha,i.blendEquationAlpha=this.blendEquationAlpha,i.blendColor=this.blendColor.getHex(),i.blendAlpha=this.blendAlpha,i.depthFunc=this.depthFunc,i.depthTest=this.depthTest,i.depthWrite=this.depthWrite,i.colorWrite=this.colorWrite,i.clipIntersection=this.clipIntersection,i.clipShadows=this.clipShadows,i.stencilWriteMask=this.stencilWriteMask,i.stencilFunc=this.stencilFunc,i.stencilRef=this.stencilRef,i.stencilFuncMask=this.stencilFuncMask,i.stencilFail=this.stencilFail,i.stencilZFail=this.stencilZFail,i.stencilZPass=this.stencilZPass,i.stencilWrite=this.stencilWrite,i.polygonOffset=this.polygonOffset,i.polygonOffsetFactor=this.polygonOffsetFactor,i.polygonOffsetUnits=this.polygonOffsetUnits,i.dithering=this.dithering,i.alphaTest=this.alphaTest,i.alphaHash=this.alphaHash,i.alphaToCoverage=this.alphaToCoverage,i.premultipliedAlpha=this.premultipliedAlpha,i.forceSinglePass=this.forceSinglePass,i.allowOverride=this.allowOverride,i.visible=this.visible,i.toneMapped=this.toneMapped,i.name=this.name,this.color&&this.color.isColor&&(i.color=this.color.getHex()),this.roughness!==void 0&&(i.roughness=this.roughness),this.metalness!==void 0&&(i.metalness=this.metalness),this.sheen!==void 0&&(i.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(i.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(i.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(i.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(i.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(i.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(i.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(i.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(i.shininess=this.shininess),this.clearcoat!==void 0&&(i.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(i.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(i.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(i.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(e).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(i.clearcoatMap=this.clearcoatMap.toJSON(e).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(i.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(e).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(i.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(e).uuid,i.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(i.sheenColorMap=this.sheenColorMap.toJSON(e).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(i.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(e).uuid),this.dispersion!==void 0&&(i.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(i.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(i.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(i.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(i.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(i.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(i.iridescenceMap=this.iridescenceMap.toJSON(e).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(i.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(e).uuid),this.anisotropy!==void 0&&(i.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(i.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(i.anisotropyMap=this.anisotropyMap.toJSON(e).uuid),this.map&&this.map.isTexture&&(i.map=this.map.toJSON(e).uuid),this.matcap&&this.matcap.isTexture&&(i.matcap=this.matcap.toJSON(e).uuid),this.alphaMap&&this.alphaMap.isTexture&&(i.alphaMap=this.alphaMap.toJSON(e).uuid),this.lightMap&&this.lightMap.isTexture&&(i.lightMap=this.lightMap.toJSON(e).uuid,i.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(i.aoMap=this.aoMap.toJSON(e).uuid,i.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(i.bumpMap=this.bumpMap.toJSON(e).uuid,i.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(i.normalMap=this.normalMap.toJSON(e).uuid,i.normalMapType=this.normalMapType,i.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(i.displacementMap=this.displacementMap.toJSON(e).uuid,i.displacementScale=this.displacementScale,i.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(i.roughnessMap=this.roughnessMap.toJSON(e).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(i.metalnessMap=this.metalnessMap.toJSON(e).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(i.emissiveMap=this.emissiveMap.toJSON(e).uuid),this.specularMap&&this.specularMap.isTexture&&(i.specularMap=this.specularMap.toJSON(e).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(i.specularIntensityMap=this.specularIntensityMap.toJSON(e).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(i.specularColorMap=this.specularColorMap.toJSON(e).uuid),this.envMap&&this.envMap.isTexture&&(i.envMap=this.envMap.toJSON(e).uuid,this.combine!==void 0&&(i.combine=this.combine)),this.envMapRotation!==void 0&&(i.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(i.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(i.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(i.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(i.gradientMap=this.gradientMap.toJSON(e).uuid),this.transmission!==void 0&&(i.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(i.transmissionMap=this.transmissionMap.toJSON(e).uuid),this.thickness!==void 0&&(i.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(i.thicknessMap=this.thicknessMap.toJSON(e).uuid),this.attenuationDistance!==void 0&&(i.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(i.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(i.size=this.size),this.sizeAttenuation!==void 0&&(i.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(i.clippingPlanes=this.clippingPlanes.map(r=>r.toJSON())),this.rotation!==void 0&&(i.rotation=this.rotation),this.depthPacking!==void 0&&(i.depthPacking=this.depthPacking),this.linewidth!==void 0&&(i.linewidth=this.linewidth),this.linecap!==void 0&&(i.linecap=this.linecap),this.linejoin!==void 0&&(i.linejoin=this.linejoin),this.dashSize!==void 0&&(i.dashSize=this.dashSize),this.gapSize!==void 0&&(i.gapSize=this.gapSize),this.scale!==void 0&&(i.scale=this.scale),this.wireframe!==void 0&&(i.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(i.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(i.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(i.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(i.flatShading=this.flatShading),this.fog!==void 0&&(i.fog=this.fog),Object.keys(this.userData).length>0&&(i.userData=this.userData);function s(r){let o=[];for(let a in r){let l=r[a];delete l.metadata,o.push(l)}return o}if(t){let r=s(e.textures),o=s(e.images);r.length>0&&(i.textures=r),o.length>0&&(i.images=o)}return i}fromJSON(e,t){if(e.uuid!==void 0&&(this.uuid=e.uuid),e.name!==void 0&&(this.name=e.name),e.color!==void 0&&this.color!==void 0&&this.color.setHex(e.color),e.roughness!==void 0&&(this.roughness=e.roughness),e.metalness!==void 0&&(this.metalness=e.metalness),e.sheen!==void 0&&(this.sheen=e.sheen),e.sheenColor!==void 0&&(this.sheenColor=new Je().setHex(e.sheenColor)),e.sheenRoughness!==void 0&&(this.sheenRoughness=e.sheenRoughness),e.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(e.emissive),e.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(e.specular),e.specularIntensity!==void 0&&(this.specularIntensity=e.specularIntensity),e.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(e.specularColor),e.shininess!==void 0&&(this.shininess=e.shininess),e.clearcoat!==void 0&&(this.clearcoat=e.clearcoat),e.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=e.clearcoatRoughness),e.diffuseRoughness!==void 0&&(this.diffuseRoughness=e.diffuseRoughness),e.dispersion!==void 0&&(this.dispersion=e.dispersion),e.retroreflectivity!==void 0&&(this.retroreflectivity=e.retroreflectivity),e.iridescence!==void 0&&(this.iridescence=e.iridescence),e.iridescenceIOR!==void 0&&(this.iridescenceIOR=e.iridescenceIOR),e.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessMinimum),e.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=e.iridescenceThicknessMaximum),e.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=e.iridescenceThicknessRange[1]),e.transmission!==void 0&&(this.transmission=e.transmission),e.thickness!==void 0&&(this.thickness=e.thickness),e.attenuationDistance!==void 0&&(this.attenuationDistance=e.attenuationDistance),e.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(e.attenuationColor),e.anisotropy!==void 0&&(this.anisotropy=e.anisotropy),e.anisotropyRotation!==void 0&&(this.anisotropyRotation=e.anisotropyRotation),e.fog!==void 0&&(this.fog=e.fog),e.flatShading!==void 0&&(this.flatShading=e.flatShading),e.blending!==void 0&&(this.blending=e.blending),e.combine!==void 0&&(this.combine=e.combine),e.side!==void 0&&(this.side=e.side),e.shadowSide!==void 0&&(this.shadowSide=e.shadowSide),e.opacity!==void 0&&(this.opacity=e.opacity),e.transparent!==void 0&&(this.transparent=e.transparent),e.alphaTest!==void 0&&(this.alphaTest=e.alphaTest),e.alphaHash!==void 0&&(this.alphaHash=e.alphaHash),e.depthFunc!==void 0&&(this.depthFunc=e.depthFunc),e.depthTest!==void 0&&(this.depthTest=e.depthTest),e.depthWrite!==void 0&&(this.depthWrite=e.depthWrite),e.colorWrite!==void 0&&(this.colorWrite=e.colorWrite),e.clippingPlanes!==void 0&&(this.clippingPlanes=e.clippingPlanes.map(i=>new Ei().fromJSON(i))),e.clipIntersection!==void 0&&(this.clipIntersection=e.clipIntersection),e.clipShadows!==void 0&&(this.clipShadows=e.clipShadows),e.depthPacking!==void 0&&(this.depthPacking=e.depthPacking),e.blendSrc!==void 0&&(this.blendSrc=e.blendSrc),e.blendDst!==void 0&&(this.blendDst=e.blendDst),e.blendEquation!==void 0&&(this.blendEquation=e.blendEquation),e.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=e.blendSrcAlpha),e.blendDstAlpha!==void 0&&(this.blendDstAlpha=e.blendDstAlpha),e.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=e.blendEquationAlpha),e.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(e.blendColor),e.blendAlpha!==void 0&&(this.blendAlpha=e.blendAlpha),e.stencilWriteMask!==void 0&&(this.stencilWriteMask=e.stencilWriteMask),e.stencilFunc!==void 0&&(this.stencilFunc=e.stencilFunc),e.stencilRef!==void 0&&(this.stencilRef=e.stencilRef),e.stencilFuncMask!==void 0&&(this.stencilFuncMask=e.stencilFuncMask),e.stencilFail!==void 0&&(this.stencilFail=e.stencilFail),e.stencilZFail!==void 0&&(this.stencilZFail=e.stencilZFail),e.stencilZPass!==void 0&&(this.stencilZPass=e.stencilZPass),e.stencilWrite!==void 0&&(this.stencilWrite=e.stencilWrite),e.wireframe!==void 0&&(this.wireframe=e.wireframe),e.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=e.wireframeLinewidth),e.wireframeLinecap!==void 0&&(this.wireframeLinecap=e.wireframeLinecap),e.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=e.wireframeLinejoin),e.rotation!==void 0&&(this.rotation=e.rotation),e.linewidth!==void 0&&(this.linewidth=e.linewidth),e.linecap!==void 0&&(this.linecap=e.linecap),e.linejoin!==void 0&&(this.linejoin=e.linejoin),e.dashSize!==void 0&&(this.dashSize=e.dashSize),e.gapSize!==void 0&&(this.gapSize=e.gapSize),e.scale!==void 0&&(this.scale=e.scale),e.polygonOffset!==void 0&&(this.polygonOffset=e.polygonOffset),e.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=e.polygonOffsetFactor),e.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=e.polygonOffsetUnits),e.dithering!==void 0&&(this.dithering=e.dithering),e.alphaToCoverage!==void 0&&(this.alphaToCoverage=e.alphaToCoverage),e.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=e.premultipliedAlpha),e.forceSinglePass!==void 0&&(this.forceSinglePass=e.forceSinglePass),e.allowOverride!==void 0&&(this.allowOverride=e.allowOverride),e.visible!==void 0&&(this.visible=e.visible),e.toneMapped!==void 0&&(this.toneMapped=e.toneMapped),e.userData!==void 0&&(this.userData=e.userData),e.vertexColors!==void 0&&(typeof e.vertexColors=="number"?this.vertexColors=e.vertexColors>0:this.vertexColors=e.vertexColors),e.size!==void 0&&(this.size=e.size),e.sizeAttenuation!==void 0&&(this.sizeAttenuation=e.sizeAttenuation),e.map!==void 0&&(this.map=t[e.map]||null),e.matcap!==void 0&&(this.matcap=t[e.matcap]||null),e.alphaMap!==void 0&&(this.alphaMap=t[e.alphaMap]||null),e.bumpMap!==void 0&&(this.bumpMap=t[e.bumpMap]||null),e.bumpScale!==void 0&&(this.bumpScale=e.bumpScale),e.normalMap!==void 0&&(this.normalMap=t[e.normalMap]||null),e.normalMapType!==void 0&&(this.normalMapType=e.normalMapType),e.normalScale!==void 0){let i=e.normalScale;Array.isArray(i)===!1&&(i=[i,i]),this.normalScale=new $e().fromArray(i)}return e.displacementMap!==void 0&&(this.displacementMap=t[e.displacementMap]||null),e.displacementScale!==void 0&&(this.displacementScale=e.displacementScale),e.displacementBias!==void 0&&(this.displacementBias=e.displacementBias),e.roughnessMap!==void 0&&(this.roughnessMap=t[e.roughnessMap]||null),e.metalnessMap!==void 0&&(this.metalnessMap=t[e.metalnessMap]||null),e.emissiveMap!==void 0&&(this.emissiveMap=t[e.emissiveMap]||null),e.emissiveIntensity!==void 0&&(this.emissiveIntensity=e.emissiveIntensity),e.specularMap!==void 0&&(this.specularMap=t[e.specularMap]||null),e.specularIntensityMap!==void 0&&(this.specularIntensityMap=t[e.specularIntensityMap]||null),e.specularColorMap!==void 0&&(this.specularColorMap=t[e.specularColorMap]||null),e.envMap!==void 0&&(this.envMap=t[e.envMap]||null),e.envMapRotation!==void 0&&this.envMapRotation.fromArray(e.envMapRotation),e.envMapIntensity!==void 0&&(this.envMapIntensity=e.envMapIntensity),e.reflectivity!==void 0&&(this.reflectivity=e.reflectivity),e.refractionRatio!==void 0&&(this.refractionRatio=e.refractionRatio),e.lightMap!==void 0&&(this.lightMap=t[e.lightMap]||null),e.lightMapIntensity!==void 0&&(this.lightMapIntensity=e.lightMapIntensity),e.aoMap!==void 0&&(this.aoMap=t[e.aoMap]||null),e.aoMapIntensity!==void 0&&(this.aoMapIntensity=e.aoMapIntensity),e.gradientMap!==void 0&&(this.gradientMap=t[e.gradientMap]||null),e.clearcoatMap!==void 0&&(this.clearcoatMap=t[e.clearcoatMap]||null),e.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=t[e.clearcoatRoughnessMap]||null),e.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=t[e.clearcoatNormalMap]||null),e.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new $e().fromArray(e.clearcoatNormalScale)),e.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=t[e.diffuseRoughnessMap]||null),e.iridescenceMap!==void 0&&(this.iridescenceMap=t[e.iridescenceMap]||null),e.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=t[e.iridescenceThicknessMap]||null),e.transmissionMap!==void 0&&(this.transmissionMap=t[e.transmissionMap]||null),e.thicknessMap!==void 0&&(this.thicknessMap=t[e.thicknessMap]||null),e.anisotropyMap!==void 0&&(this.anisotropyMap=t[e.anisotropyMap]||null),e.sheenColorMap!==void 0&&(this.sheenColorMap=t[e.sheenColorMap]||null),e.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=t[e.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(e){this.name=e.name,this.blending=e.blending,this.side=e.side,this.vertexColors=e.vertexColors,this.opacity=e.opacity,this.transparent=e.transparent,this.blendSrc=e.blendSrc,this.blendDst=e.blendDst,this.blendEquation=e.blendEquation,this.blendSrcAlpha=e.blendSrcAlpha,this.blendDstAlpha=e.blendDstAlpha,this.blendEquationAlpha=e.blendEquationAlpha,this.blendColor.copy(e.blendColor),this.blendAlpha=e.blendAlpha,this.depthFunc=e.depthFunc,this.depthTest=e.depthTest,this.depthWrite=e.depthWrite,this.stencilWriteMask=e.stencilWriteMask,this.stencilFunc=e.stencilFunc,this.stencilRef=e.stencilRef,this.stencilFuncMask=e.stencilFuncMask,this.stencilFail=e.stencilFail,this.stencilZFail=e.stencilZFail,this.stencilZPass=e.stencilZPass,this.stencilWrite=e.stencilWrite;let t=e.clippingPlanes,i=null;if(t!==null){let s=t.length;i=new Array(s);for(let r=0;r!==s;++r)i[r]=t[r].clone()}return this.clippingPlanes=i,this.clipIntersection=e.clipIntersection,this.clipShadows=e.clipShadows,this.shadowSide=e.shadowSide,this.colorWrite=e.colorWrite,this.precision=e.precision,this.polygonOffset=e.polygonOffset,this.polygonOffsetFactor=e.polygonOffsetFactor,this.polygonOffsetUnits=e.polygonOffsetUnits,this.dithering=e.dithering,this.alphaTest=e.alphaTest,this.alphaHash=e.alphaHash,this.alphaToCoverage=e.alphaToCoverage,this.premultipliedAlpha=e.premultipliedAlpha,this.forceSinglePass=e.forceSinglePass,this.allowOverride=e.allowOverride,this.visible=e.visible,this.toneMapped=e.toneMapped,this.userData=JSON.parse(JSON.stringify(e.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(e){e===!0&&this.version++}},Zo=class extends $i{constructor(e){super(),this.isSpriteMaterial=!0,this.type="SpriteMaterial",this.color=new Je(16777215),this.map=null,this.alphaMap=null,this.rotation=0,this.sizeAttenuation=!0,this.transparent=!0,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.alphaMap=e.alphaMap,this.rotation=e.rotation,this.sizeAttenuation=e.sizeAttenuation,this.fog=e.fog,this}},Uo,Ya=new O,Fo=new O,Oo=new O,Bo=new $e,$a=new $e,a_=new Pt,Oc=new O,Za=new O,Bc=new O,r0=new $e,wf=new $e,o0=new $e,Xr=class extends An{constructor(e=new Zo){if(super(),this.isSprite=!0,this.type="Sprite",Uo===void 0){Uo=new qt;let t=new Float32Array([-.5,-.5,0,0,0,.5,-.5,0,1,0,.5,.5,0,1,1,-.5,.5,0,0,1]),i=new xh(t,5);Uo.setIndex([0,1,2,0,2,3]),Uo.setAttribute("position",new hl(i,3,0,!1)),Uo.setAttribute("uv",new hl(i,2,3,!1))}this.geometry=Uo,this.material=e,this.center=new $e(.5,.5),this.count=1}intersectsFrustum(e){return e.intersectsSprite(this)}raycast(e,t){e.camera===null&&st('Sprite: "Raycaster.camera" needs to be set in order to raycast against sprites.'),Fo.setFromMatrixScale(this.matrixWorld),a_.copy(e.camera.matrixWorld),this.modelViewMatrix.multiplyMatrices(e.camera.matrixWorldInverse,this.matrixWorld),Oo.setFromMatrixPosition(this.modelViewMatrix),e.camera.isPerspectiveCamera&&this.material.sizeAttenuation===!1&&Fo.multiplyScalar(-Oo.z);let i=this.material.rotation,s,r;i!==0&&(r=Math.cos(i),s=Math.sin(i));let o=this.center;kc(Oc.set(-.5,-.5,0),Oo,o,Fo,s,r),kc(Za.set(.5,-.5,0),Oo,o,Fo,s,r),kc(Bc.set(.5,.5,0),Oo,o,Fo,s,r),r0.set(0,0),wf.set(1,0),o0.set(1,1);let a=e.ray.intersectTriangle(Oc,Za,Bc,!1,Ya);if(a===null&&(kc(Za.set(-.5,.5,0),Oo,o,Fo,s,r),wf.set(0,1),a=e.ray.intersectTriangle(Oc,Bc,Za,!1,Ya),a===null))return;let l=e.ray.origin.distanceTo(Ya);l<e.near||l>e.far||t.push({distance:l,point:Ya.clone(),uv:zs.getInterpolation(Ya,Oc,Za,Bc,r0,wf,o0,new $e),face:null,object:this})}copy(e,t){return super.copy(e,t),e.center!==void 0&&this.center.copy(e.center),this.material=e.material,this}toJSON(e){let t=super.toJSON(e);return t.object.center=this.center.toArray(),t}};function kc(n,e,t,i,s,r){Bo.subVectors(n,t).addScalar(.5).multiply(i),s!==void 0?($a.x=r*Bo.x-s*Bo.y,$a.y=s*Bo.x+r*Bo.y):$a.copy(Bo),n.copy(e),n.x+=$a.x,n.y+=$a.y,n.applyMatrix4(a_)}var ks=new O,Tf=new O,zc=new O,Vc=new O,fr=class{constructor(e=new O,t=new O(0,0,-1)){this.origin=e,this.direction=t}set(e,t){return this.origin.copy(e),this.direction.copy(t),this}copy(e){return this.origin.copy(e.origin),this.direction.copy(e.direction),this}at(e,t){return t.copy(this.origin).addScaledVector(this.direction,e)}lookAt(e){return this.direction.copy(e).sub(this.origin).normalize(),this}recast(e){return this.origin.copy(this.at(e,ks)),this}closestPointToPoint(e,t){t.subVectors(e,this.origin);let i=t.dot(this.direction);return i<0?t.copy(this.origin):t.copy(this.origin).addScaledVector(this.direction,i)}distanceToPoint(e){return Math.sqrt(this.distanceSqToPoint(e))}distanceSqToPoint(e){let t=ks.subVectors(e,this.origin).dot(this.direction);return t<0?this.origin.distanceToSquared(e):(ks.copy(this.origin).addScaledVector(this.direction,t),ks.distanceToSquared(e))}distanceSqToSegment(e,t,i,s){Tf.copy(e).add(t).multiplyScalar(.5),zc.copy(t).sub(e).normalize(),Vc.copy(this.origin).sub(Tf);let r=e.distanceTo(t)*.5,o=-this.direction.dot(zc),a=Vc.dot(this.direction),l=-Vc.dot(zc),c=Vc.lengthSq(),h=Math.abs(1-o*o),u,d,f,m;if(h>0)if(u=o*l-a,d=o*a-l,m=r*h,u>=0)if(d>=-m)if(d<=m){let y=1/h;u*=y,d*=y,f=u*(u+o*d+2*a)+d*(o*u+d+2*l)+c}else d=r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;else d=-r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;else d<=-m?(u=Math.max(0,-(-o*r+a)),d=u>0?-r:Math.min(Math.max(-r,-l),r),f=-u*u+d*(d+2*l)+c):d<=m?(u=0,d=Math.min(Math.max(-r,-l),r),f=d*(d+2*l)+c):(u=Math.max(0,-(o*r+a)),d=u>0?r:Math.min(Math.max(-r,-l),r),f=-u*u+d*(d+2*l)+c);else d=o>0?-r:r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;return i&&i.copy(this.origin).addScaledVector(this.direction,u),s&&s.copy(Tf).addScaledVector(zc,d),f}intersectSphere(e,t){if(e.radius<0)return null;ks.subVectors(e.center,this.origin);let i=ks.dot(this.direction),s=ks.dot(ks)-i*i,r=e.radius*e.radius;if(s>r)return null;let o=Math.sqrt(r-s),a=i-o,l=i+o;return l<0?null:a<0?this.at(l,t):this.at(a,t)}intersectsSphere(e){return e.radius<0?!1:this.distanceSqToPoint(e.center)<=e.radius*e.radius}distanceToPlane(e){let t=e.normal.dot(this.direction);if(t===0)return e.distanceToPoint(this.origin)===0?0:null;let i=-(this.origin.dot(e.normal)+e.constant)/t;return i>=0?i:null}intersectPlane(e,t){let i=this.distanceToPlane(e);return i===null?null:this.at(i,t)}intersectsPlane(e){let t=e.distanceToPoint(this.origin);return t===0||e.normal.dot(this.direction)*t<0}intersectBox(e,t){let i,s,r,o,a,l,c=1/this.direction.x,h=1/this.direction.y,u=1/this.direction.z,d=this.origin;return c>=0?(i=(e.min.x-d.x)*c,s=(e.max.x-d.x)*c):(i=(e.max.x-d.x)*c,s=(e.min.x-d.x)*c),h>=0?(r=(e.min.y-d.y)*h,o=(e.max.y-d.y)*h):(r=(e.max.y-d.y)*h,o=(e.min.y-d.y)*h),i>o||r>s||((r>i||isNaN(i))&&(i=r),(o<s||isNaN(s))&&(s=o),u>=0?(a=(e.min.z-d.z)*u,l=(e.max.z-d.z)*u):(a=(e.max.z-d.z)*u,l=(e.min.z-d.z)*u),i>l||a>s)||((a>i||i!==i)&&(i=a),(l<s||s!==s)&&(s=l),s<0)?null:this.at(i>=0?i:s,t)}intersectsBox(e){return this.intersectBox(e,ks)!==null}intersectTriangle(e,t,i,s,r){let o=this.origin,a=this.direction,l=a.x,c=a.y,h=a.z,u=e.x-o.x,d=e.y-o.y,f=e.z-o.z,m=t.x-o.x,y=t.y-o.y,g=t.z-o.z,p=i.x-o.x,S=i.y-o.y,C=i.z-o.z,w=Math.abs(l),P=Math.abs(c),E=Math.abs(h),x,T,k,N,L,z,W,D,X,Z,H,he;if(w>=P&&w>=E?(k=l,z=u,X=m,he=p,l>=0?(x=c,T=h,N=d,L=f,W=y,D=g,Z=S,H=C):(x=h,T=c,N=f,L=d,W=g,D=y,Z=C,H=S)):P>=E?(k=c,z=d,X=y,he=S,c>=0?(x=h,T=l,N=f,L=u,W=g,D=m,Z=C,H=p):(x=l,T=h,N=u,L=f,W=m,D=g,Z=p,H=C)):(k=h,z=f,X=g,he=C,h>=0?(x=l,T=c,N=u,L=d,W=m,D=y,Z=p,H=S):(x=c,T=l,N=d,L=u,W=y,D=m,Z=S,H=p)),k===0)return null;let j=x/k,ee=T/k,re=1/k,fe=N-j*z,de=L-ee*z,te=W-j*X,ge=D-ee*X,ye=Z-j*he,Ce=H-ee*he,Me=ye*ge-Ce*te,Xe=fe*Ce-de*ye,lt=te*de-ge*fe;if(s){if(Me<0||Xe<0||lt<0)return null}else if((Me<0||Xe<0||lt<0)&&(Me>0||Xe>0||lt>0))return null;let He=Me+Xe+lt;if(He===0)return null;let mt=re*(Me*z+Xe*X+lt*he);return(He>0?mt<0:mt>0)?null:this.at(mt/He,r)}applyMatrix4(e){return this.origin.applyMatrix4(e),this.direction.transformDirection(e),this}equals(e){return e.origin.equals(this.origin)&&e.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},Ws=class extends $i{constructor(e){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new Je(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new Hs,this.combine=Bh,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.specularMap=e.specularMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.combine=e.combine,this.reflectivity=e.reflectivity,this.refractionRatio=e.refractionRatio,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.fog=e.fog,this}},a0=new Pt,Hr=new fr,Gc=new dr,l0=new O,Hc=new O,Wc=new O,Xc=new O,Ef=new O,qc=new O,c0=new O,Yc=new O,Gn=class extends An{constructor(e=new qt,t=new Ws){super(),this.isMesh=!0,this.type="Mesh",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}updateMorphTargets(){let t=this.geometry.morphAttributes,i=Object.keys(t);if(i.length>0){let s=t[i[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}getVertexPosition(e,t){let i=this.geometry,s=i.attributes.position,r=i.morphAttributes.position,o=i.morphTargetsRelative;t.fromBufferAttribute(s,e);let a=this.morphTargetInfluences;if(r&&a){qc.set(0,0,0);for(let l=0,c=r.length;l<c;l++){let h=a[l],u=r[l];h!==0&&(Ef.fromBufferAttribute(u,e),o?qc.addScaledVector(Ef,h):qc.addScaledVector(Ef.sub(t),h))}t.add(qc)}return t}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let i=this.geometry,s=this.material,r=this.matrixWorld;s!==void 0&&(i.boundingSphere===null&&i.computeBoundingSphere(),Gc.copy(i.boundingSphere),Gc.applyMatrix4(r),Hr.copy(e.ray).recast(e.near),!(Gc.containsPoint(Hr.origin)===!1&&(Hr.intersectSphere(Gc,l0)===null||Hr.origin.distanceToSquared(l0)>(e.far-e.near)**2))&&(a0.copy(r).invert(),Hr.copy(e.ray).applyMatrix4(a0),!(i.boundingBox!==null&&Hr.intersectsBox(i.boundingBox)===!1)&&this._computeIntersections(e,t,Hr)))}_computeIntersections(e,t,i){let s,r=this.geometry,o=this.material,a=r.index,l=r.attributes.position,c=r.attributes.uv,h=r.attributes.uv1,u=r.attributes.normal,d=r.groups,f=r.drawRange;if(a!==null)if(Array.isArray(o))for(let m=0,y=d.length;m<y;m++){let g=d[m],p=o[g.materialIndex],S=Math.max(g.start,f.start),C=Math.min(a.count,Math.min(g.start+g.count,f.start+f.count));for(let w=S,P=C;w<P;w+=3){let E=a.getX(w),x=a.getX(w+1),T=a.getX(w+2);s=$c(this,p,e,i,c,h,u,E,x,T),s&&(s.faceIndex=Math.floor(w/3),s.face.materialIndex=g.materialIndex,t.push(s))}}else{let m=Math.max(0,f.start),y=Math.min(a.count,f.start+f.count);for(let g=m,p=y;g<p;g+=3){let S=a.getX(g),C=a.getX(g+1),w=a.getX(g+2);s=$c(this,o,e,i,c,h,u,S,C,w),s&&(s.faceIndex=Math.floor(g/3),t.push(s))}}else if(l!==void 0)if(Array.isArray(o))for(let m=0,y=d.length;m<y;m++){let g=d[m],p=o[g.materialIndex],S=Math.max(g.start,f.start),C=Math.min(l.count,Math.min(g.start+g.count,f.start+f.count));for(let w=S,P=C;w<P;w+=3){let E=w,x=w+1,T=w+2;s=$c(this,p,e,i,c,h,u,E,x,T),s&&(s.faceIndex=Math.floor(w/3),s.face.materialIndex=g.materialIndex,t.push(s))}}else{let m=Math.max(0,f.start),y=Math.min(l.count,f.start+f.count);for(let g=m,p=y;g<p;g+=3){let S=g,C=g+1,w=g+2;s=$c(this,o,e,i,c,h,u,S,C,w),s&&(s.faceIndex=Math.floor(g/3),t.push(s))}}}};function Pb(n,e,t,i,s,r,o,a){let l;if(e.side===li?l=i.intersectTriangle(o,r,s,!0,a):l=i.intersectTriangle(s,r,o,e.side===br,a),l===null)return null;Yc.copy(a),Yc.applyMatrix4(n.matrixWorld);let c=t.ray.origin.distanceTo(Yc);return c<t.near||c>t.far?null:{distance:c,point:Yc.clone(),object:n}}function $c(n,e,t,i,s,r,o,a,l,c){n.getVertexPosition(a,Hc),n.getVertexPosition(l,Wc),n.getVertexPosition(c,Xc);let h=Pb(n,e,t,i,Hc,Wc,Xc,c0);if(h){let u=new O;zs.getBarycoord(c0,Hc,Wc,Xc,u),s&&(h.uv=zs.getInterpolatedAttribute(s,a,l,c,u,new $e)),r&&(h.uv1=zs.getInterpolatedAttribute(r,a,l,c,u,new $e)),o&&(h.normal=zs.getInterpolatedAttribute(o,a,l,c,u,new O),h.normal.dot(i.direction)>0&&h.normal.multiplyScalar(-1));let d={a,b:l,c,normal:new O,materialIndex:0};zs.getNormal(Hc,Wc,Xc,d.normal),h.face=d,h.barycoord=u}return h}var Ko=class extends ai{constructor(e=null,t=1,i=1,s,r,o,a,l,c=Vn,h=Vn,u,d){super(null,o,a,l,c,h,s,r,u,d),this.isDataTexture=!0,this.image={data:e,width:t,height:i},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}};var Wr=new dr,Ib=new $e(.5,.5),Zc=new O,pr=class{constructor(e=new Ei,t=new Ei,i=new Ei,s=new Ei,r=new Ei,o=new Ei){this.planes=[e,t,i,s,r,o]}set(e,t,i,s,r,o){let a=this.planes;return a[0].copy(e),a[1].copy(t),a[2].copy(i),a[3].copy(s),a[4].copy(r),a[5].copy(o),this}copy(e){let t=this.planes;for(let i=0;i<6;i++)t[i].copy(e.planes[i]);return this}setFromProjectionMatrix(e,t=Oi,i=!1){let s=this.planes,r=e.elements,o=r[0],a=r[1],l=r[2],c=r[3],h=r[4],u=r[5],d=r[6],f=r[7],m=r[8],y=r[9],g=r[10],p=r[11],S=r[12],C=r[13],w=r[14],P=r[15];if(s[0].setComponents(c-o,f-h,p-m,P-S).normalize(),s[1].setComponents(c+o,f+h,p+m,P+S).normalize(),s[2].setComponents(c+a,f+u,p+y,P+C).normalize(),s[3].setComponents(c-a,f-u,p-y,P-C).normalize(),i)s[4].setComponents(l,d,g,w).normalize(),s[5].setComponents(c-l,f-d,p-g,P-w).normalize();else if(s[4].setComponents(c-l,f-d,p-g,P-w).normalize(),t===Oi)s[5].setComponents(c+l,f+d,p+g,P+w).normalize();else if(t===Wo)s[5].setComponents(l,d,g,w).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+t);return this}intersectsObject(e){if(e.boundingSphere!==void 0)e.boundingSphere===null&&e.computeBoundingSphere(),Wr.copy(e.boundingSphere).applyMatrix4(e.matrixWorld);else{let t=e.geometry;t.boundingSphere===null&&t.computeBoundingSphere(),Wr.copy(t.boundingSphere).applyMatrix4(e.matrixWorld)}return this.intersectsSphere(Wr)}intersectsSprite(e){Wr.center.set(0,0,0);let t=Ib.distanceTo(e.center);return Wr.radius=.7071067811865476+t,Wr.applyMatrix4(e.matrixWorld),this.intersectsSphere(Wr)}intersectsSphere(e){let t=this.planes,i=e.center,s=-e.radius;for(let r=0;r<6;r++)if(t[r].distanceToPoint(i)<s)return!1;return!0}intersectsBox(e){let t=this.planes;for(let i=0;i<6;i++){let s=t[i];if(Zc.x=s.normal.x>0?e.max.x:e.min.x,Zc.y=s.normal.y>0?e.max.y:e.min.y,Zc.z=s.normal.z>0?e.max.z:e.min.z,s.distanceToPoint(Zc)<0)return!1}return!0}containsPoint(e){let t=this.planes;for(let i=0;i<6;i++)if(t[i].distanceToPoint(e)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},h0=new Pt,yh=class n{constructor(){this.coordinateSystem=Oi,this._frustums=[],this._count=0}setFromArrayCamera(e){let t=e.cameras,i=this._frustums;for(let s=0;s<t.length;s++){let r=t[s];h0.multiplyMatrices(r.projectionMatrix,r.matrixWorldInverse),i[s]===void 0&&(i[s]=new pr),i[s].setFromProjectionMatrix(h0,r.coordinateSystem,r.reversedDepth)}return this._count=t.length,this}getFrustum(e){return this._frustums[e]}intersectsObject(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].intersectsObject(e))return!0;return!1}intersectsSprite(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].intersectsSprite(e))return!0;return!1}intersectsSphere(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].intersectsSphere(e))return!0;return!1}intersectsBox(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].intersectsBox(e))return!0;return!1}containsPoint(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].containsPoint(e))return!0;return!1}copy(e){this.coordinateSystem=e.coordinateSystem;let t=this._frustums,i=e._frustums;for(let s=0;s<e._count;s++)t[s]===void 0&&(t[s]=new pr),t[s].copy(i[s]);return this._count=e._count,this}clone(){return new n().copy(this)}};var Zi=class extends $i{constructor(e){super(),this.isLineBasicMaterial=!0,this.type="LineBasicMaterial",this.color=new Je(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.linewidth=e.linewidth,this.linecap=e.linecap,this.linejoin=e.linejoin,this.fog=e.fog,this}},vh=new O,Sh=new O,u0=new Pt,Ka=new fr,Kc=new dr,Af=new O,d0=new O,bh=class extends An{constructor(e=new qt,t=new Zi){super(),this.isLine=!0,this.type="Line",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}computeLineDistances(){let e=this.geometry;if(e.index===null){let t=e.attributes.position,i=[0];for(let s=1,r=t.count;s<r;s++)vh.fromBufferAttribute(t,s-1),Sh.fromBufferAttribute(t,s),i[s]=i[s-1],i[s]+=vh.distanceTo(Sh);e.setAttribute("lineDistance",new dn(i,1))}else Ke("Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let i=this.geometry,s=this.matrixWorld,r=e.params.Line.threshold,o=i.drawRange;if(i.boundingSphere===null&&i.computeBoundingSphere(),Kc.copy(i.boundingSphere),Kc.applyMatrix4(s),Kc.radius+=r,e.ray.intersectsSphere(Kc)===!1)return;u0.copy(s).invert(),Ka.copy(e.ray).applyMatrix4(u0);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=this.isLineSegments?2:1,h=i.index,d=i.attributes.position;if(h!==null){let f=Math.max(0,o.start),m=Math.min(h.count,o.start+o.count);for(let y=f,g=m-1;y<g;y+=c){let p=h.getX(y),S=h.getX(y+1),C=Jc(this,e,Ka,l,p,S,y);C&&t.push(C)}if(this.isLineLoop){let y=h.getX(m-1),g=h.getX(f),p=Jc(this,e,Ka,l,y,g,m-1);p&&t.push(p)}}else{let f=Math.max(0,o.start),m=Math.min(d.count,o.start+o.count);for(let y=f,g=m-1;y<g;y+=c){let p=Jc(this,e,Ka,l,y,y+1,y);p&&t.push(p)}if(this.isLineLoop){let y=Jc(this,e,Ka,l,m-1,f,m-1);y&&t.push(y)}}}updateMorphTargets(){let t=this.geometry.morphAttributes,i=Object.keys(t);if(i.length>0){let s=t[i[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function Jc(n,e,t,i,s,r,o){let a=n.geometry.attributes.position;if(vh.fromBufferAttribute(a,s),Sh.fromBufferAttribute(a,r),t.distanceSqToSegment(vh,Sh,Af,d0)>i)return;Af.applyMatrix4(n.matrixWorld);let c=e.ray.origin.distanceTo(Af);if(!(c<e.near||c>e.far))return{distance:c,point:d0.clone().applyMatrix4(n.matrixWorld),index:o,face:null,faceIndex:null,barycoord:null,object:n}}var f0=new O,p0=new O,ys=class extends bh{constructor(e,t){super(e,t),this.isLineSegments=!0,this.type="LineSegments"}computeLineDistances(){let e=this.geometry;if(e.index===null){let t=e.attributes.position,i=[];for(let s=0,r=t.count;s<r;s+=2)f0.fromBufferAttribute(t,s),p0.fromBufferAttribute(t,s+1),i[s]=s===0?0:i[s-1],i[s+1]=i[s]+f0.distanceTo(p0);e.setAttribute("lineDistance",new dn(i,1))}else Ke("LineSegments.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}};var qr=class extends $i{constructor(e){super(),this.isPointsMaterial=!0,this.type="PointsMaterial",this.color=new Je(16777215),this.map=null,this.alphaMap=null,this.size=1,this.sizeAttenuation=!0,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.alphaMap=e.alphaMap,this.size=e.size,this.sizeAttenuation=e.sizeAttenuation,this.fog=e.fog,this}},m0=new Pt,Lf=new fr,jc=new dr,Qc=new O,Jo=class extends An{constructor(e=new qt,t=new qr){super(),this.isPoints=!0,this.type="Points",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let i=this.geometry,s=this.matrixWorld,r=e.params.Points.threshold,o=i.drawRange;if(i.boundingSphere===null&&i.computeBoundingSphere(),jc.copy(i.boundingSphere),jc.applyMatrix4(s),jc.radius+=r,e.ray.intersectsSphere(jc)===!1)return;m0.copy(s).invert(),Lf.copy(e.ray).applyMatrix4(m0);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=i.index,u=i.attributes.position;if(c!==null){let d=Math.max(0,o.start),f=Math.min(c.count,o.start+o.count);for(let m=d,y=f;m<y;m++){let g=c.getX(m);Qc.fromBufferAttribute(u,g),g0(Qc,g,l,s,e,t,this)}}else{let d=Math.max(0,o.start),f=Math.min(u.count,o.start+o.count);for(let m=d,y=f;m<y;m++)Qc.fromBufferAttribute(u,m),g0(Qc,m,l,s,e,t,this)}}updateMorphTargets(){let t=this.geometry.morphAttributes,i=Object.keys(t);if(i.length>0){let s=t[i[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function g0(n,e,t,i,s,r,o){let a=Lf.distanceSqToPoint(n);if(a<t){let l=new O;Lf.closestPointToPoint(n,l),l.applyMatrix4(i);let c=s.ray.origin.distanceTo(l);if(c<s.near||c>s.far)return;r.push({distance:c,distanceToRay:Math.sqrt(a),point:l,index:e,face:null,faceIndex:null,barycoord:null,object:o})}}var ul=class extends ai{constructor(e=[],t=Kr,i,s,r,o,a,l,c,h){super(e,t,i,s,r,o,a,l,c,h),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(e){this.image=e}},dl=class extends ai{constructor(e,t,i,s,r,o,a,l,c){super(e,t,i,s,r,o,a,l,c),this.isCanvasTexture=!0,this.needsUpdate=!0}};var Xs=class extends ai{constructor(e,t,i=Ki,s,r,o,a=Vn,l=Vn,c,h=Gs,u=1){if(h!==Gs&&h!==Ys)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let d={width:e,height:t,depth:u};super(d,s,r,o,a,l,h,i,c),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(e){return super.copy(e),this.source=new Yo(Object.assign({},e.image)),this.compareFunction=e.compareFunction,this}toJSON(e){let t=super.toJSON(e);return t.compareFunction=this.compareFunction,t}},fl=class extends Xs{constructor(e,t=Ki,i=Kr,s,r,o=Vn,a=Vn,l,c=Gs){let h={width:e,height:e,depth:1},u=[h,h,h,h,h,h];super(e,e,t,i,s,r,o,a,l,c),this.image=u,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(e){this.image=e}},pl=class extends ai{constructor(e=null){super(),this.sourceTexture=e,this.isExternalTexture=!0}copy(e){return super.copy(e),this.sourceTexture=e.sourceTexture,this}},mr=class n extends qt{constructor(e=1,t=1,i=1,s=1,r=1,o=1){super(),this.type="BoxGeometry",this.parameters={width:e,height:t,depth:i,widthSegments:s,heightSegments:r,depthSegments:o};let a=this;s=Math.floor(s),r=Math.floor(r),o=Math.floor(o);let l=[],c=[],h=[],u=[],d=0,f=0;m("z","y","x",-1,-1,i,t,e,o,r,0),m("z","y","x",1,-1,i,t,-e,o,r,1),m("x","z","y",1,1,e,i,t,s,o,2),m("x","z","y",1,-1,e,i,-t,s,o,3),m("x","y","z",1,-1,e,t,i,s,r,4),m("x","y","z",-1,-1,e,t,-i,s,r,5),this.setIndex(l),this.setAttribute("position",new dn(c,3)),this.setAttribute("normal",new dn(h,3)),this.setAttribute("uv",new dn(u,2));function m(y,g,p,S,C,w,P,E,x,T,k){let N=w/x,L=P/T,z=w/2,W=P/2,D=E/2,X=x+1,Z=T+1,H=0,he=0,j=new O;for(let ee=0;ee<Z;ee++){let re=ee*L-W;for(let fe=0;fe<X;fe++){let de=fe*N-z;j[y]=de*S,j[g]=re*C,j[p]=D,c.push(j.x,j.y,j.z),j[y]=0,j[g]=0,j[p]=E>0?1:-1,h.push(j.x,j.y,j.z),u.push(fe/x),u.push(1-ee/T),H+=1}}for(let ee=0;ee<T;ee++)for(let re=0;re<x;re++){let fe=d+re+X*ee,de=d+re+X*(ee+1),te=d+(re+1)+X*(ee+1),ge=d+(re+1)+X*ee;l.push(fe,de,ge),l.push(de,te,ge),he+=6}a.addGroup(f,he,k),f+=he,d+=H}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new n(e.width,e.height,e.depth,e.widthSegments,e.heightSegments,e.depthSegments)}};var gr=class n extends qt{constructor(e=1,t=1,i=1,s=32,r=1,o=!1,a=0,l=Math.PI*2){super(),this.type="CylinderGeometry",this.parameters={radiusTop:e,radiusBottom:t,height:i,radialSegments:s,heightSegments:r,openEnded:o,thetaStart:a,thetaLength:l};let c=this;s=Math.floor(s),r=Math.floor(r);let h=[],u=[],d=[],f=[],m=0,y=[],g=i/2,p=0;S(),o===!1&&(e>0&&C(!0),t>0&&C(!1)),this.setIndex(h),this.setAttribute("position",new dn(u,3)),this.setAttribute("normal",new dn(d,3)),this.setAttribute("uv",new dn(f,2));function S(){let w=new O,P=new O,E=0,x=(t-e)/i;for(let T=0;T<=r;T++){let k=[],N=T/r,L=N*(t-e)+e;for(let z=0;z<=s;z++){let W=z/s,D=W*l+a,X=Math.sin(D),Z=Math.cos(D);P.x=L*X,P.y=-N*i+g,P.z=L*Z,u.push(P.x,P.y,P.z),w.set(X,x,Z).normalize(),d.push(w.x,w.y,w.z),f.push(W,1-N),k.push(m++)}y.push(k)}for(let T=0;T<s;T++)for(let k=0;k<r;k++){let N=y[k][T],L=y[k+1][T],z=y[k+1][T+1],W=y[k][T+1];(e>0||k!==0)&&(h.push(N,L,W),E+=3),(t>0||k!==r-1)&&(h.push(L,z,W),E+=3)}c.addGroup(p,E,0),p+=E}function C(w){let P=m,E=new $e,x=new O,T=0,k=w===!0?e:t,N=w===!0?1:-1;for(let z=1;z<=s;z++)u.push(0,g*N,0),d.push(0,N,0),f.push(.5,.5),m++;let L=m;for(let z=0;z<=s;z++){let D=z/s*l+a,X=Math.cos(D),Z=Math.sin(D);x.x=k*Z,x.y=g*N,x.z=k*X,u.push(x.x,x.y,x.z),d.push(0,N,0),E.x=X*.5+.5,E.y=Z*.5*N+.5,f.push(E.x,E.y),m++}for(let z=0;z<s;z++){let W=P+z,D=L+z;w===!0?h.push(D,D+1,W):h.push(D+1,D,W),T+=3}c.addGroup(p,T,w===!0?1:2),p+=T}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new n(e.radiusTop,e.radiusBottom,e.height,e.radialSegments,e.heightSegments,e.openEnded,e.thetaStart,e.thetaLength)}},ml=class n extends gr{constructor(e=1,t=1,i=32,s=1,r=!1,o=0,a=Math.PI*2){super(0,e,t,i,s,r,o,a),this.type="ConeGeometry",this.parameters={radius:e,height:t,radialSegments:i,heightSegments:s,openEnded:r,thetaStart:o,thetaLength:a}}static fromJSON(e){return new n(e.radius,e.height,e.radialSegments,e.heightSegments,e.openEnded,e.thetaStart,e.thetaLength)}};var gl=class n extends qt{constructor(e=1,t=1,i=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:e,height:t,widthSegments:i,heightSegments:s};let r=e/2,o=t/2,a=Math.floor(i),l=Math.floor(s),c=a+1,h=l+1,u=e/a,d=t/l,f=[],m=[],y=[],g=[];for(let p=0;p<h;p++){let S=p*d-o;for(let C=0;C<c;C++){let w=C*u-r;m.push(w,-S,0),y.push(0,0,1),g.push(C/a),g.push(1-p/l)}}for(let p=0;p<l;p++)for(let S=0;S<a;S++){let C=S+c*p,w=S+c*(p+1),P=S+1+c*(p+1),E=S+1+c*p;f.push(C,w,E),f.push(w,P,E)}this.setIndex(f),this.setAttribute("position",new dn(m,3)),this.setAttribute("normal",new dn(y,3)),this.setAttribute("uv",new dn(g,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new n(e.width,e.height,e.widthSegments,e.heightSegments)}};var Yr=class n extends qt{constructor(e=1,t=32,i=16,s=0,r=Math.PI*2,o=0,a=Math.PI){super(),this.type="SphereGeometry",this.parameters={radius:e,widthSegments:t,heightSegments:i,phiStart:s,phiLength:r,thetaStart:o,thetaLength:a},t=Math.max(3,Math.floor(t)),i=Math.max(2,Math.floor(i));let l=Math.min(o+a,Math.PI),c=0,h=[],u=new O,d=new O,f=[],m=[],y=[],g=[];for(let p=0;p<=i;p++){let S=[],C=p/i,w=o+C*a,P=e*Math.cos(w),E=Math.sqrt(e*e-P*P),x=0;p===0&&o===0?x=.5/t:p===i&&l===Math.PI&&(x=-.5/t);for(let T=0;T<=t;T++){let k=T/t,N=s+k*r;u.x=-E*Math.cos(N),u.y=P,u.z=E*Math.sin(N),m.push(u.x,u.y,u.z),d.copy(u).normalize(),y.push(d.x,d.y,d.z),g.push(k+x,1-C),S.push(c++)}h.push(S)}for(let p=0;p<i;p++)for(let S=0;S<t;S++){let C=h[p][S+1],w=h[p][S],P=h[p+1][S],E=h[p+1][S+1];(p!==0||o>0)&&f.push(C,w,E),(p!==i-1||l<Math.PI)&&f.push(w,P,E)}this.setIndex(f),this.setAttribute("position",new dn(m,3)),this.setAttribute("normal",new dn(y,3)),this.setAttribute("uv",new dn(g,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new n(e.radius,e.widthSegments,e.heightSegments,e.phiStart,e.phiLength,e.thetaStart,e.thetaLength)}};function jr(n){let e={};for(let t in n){e[t]={};for(let i in n[t]){let s=n[t][i];if(_0(s))s.isRenderTargetTexture?(Ke("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),e[t][i]=null):e[t][i]=s.clone();else if(Array.isArray(s))if(_0(s[0])){let r=[];for(let o=0,a=s.length;o<a;o++)r[o]=s[o].clone();e[t][i]=r}else e[t][i]=s.slice();else e[t][i]=s}}return e}function Zn(n){let e={};for(let t=0;t<n.length;t++){let i=jr(n[t]);for(let s in i)e[s]=i[s]}return e}function _0(n){return n&&(n.isColor||n.isMatrix3||n.isMatrix4||n.isVector2||n.isVector3||n.isVector4||n.isTexture||n.isQuaternion)}function Db(n){let e=[];for(let t=0;t<n.length;t++)e.push(n[t].clone());return e}function pp(n){let e=n.getRenderTarget();return e===null?n.outputColorSpace:e.isXRRenderTarget===!0?e.texture.colorSpace:bt.workingColorSpace}var l_={clone:jr,merge:Zn},Lb=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,Nb=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,vs=class extends $i{constructor(e){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=Lb,this.fragmentShader=Nb,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,e!==void 0&&this.setValues(e)}copy(e){return super.copy(e),this.fragmentShader=e.fragmentShader,this.vertexShader=e.vertexShader,this.uniforms=jr(e.uniforms),this.uniformsGroups=Db(e.uniformsGroups),this.defines=Object.assign({},e.defines),this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.fog=e.fog,this.lights=e.lights,this.clipping=e.clipping,this.extensions=Object.assign({},e.extensions),this.glslVersion=e.glslVersion,this.defaultAttributeValues=Object.assign({},e.defaultAttributeValues),this.index0AttributeName=e.index0AttributeName,this.uniformsNeedUpdate=e.uniformsNeedUpdate,this}toJSON(e){let t=super.toJSON(e);t.glslVersion=this.glslVersion,t.uniforms={};for(let s in this.uniforms){let o=this.uniforms[s].value;o&&o.isTexture?t.uniforms[s]={type:"t",value:o.toJSON(e).uuid}:o&&o.isColor?t.uniforms[s]={type:"c",value:o.getHex()}:o&&o.isVector2?t.uniforms[s]={type:"v2",value:o.toArray()}:o&&o.isVector3?t.uniforms[s]={type:"v3",value:o.toArray()}:o&&o.isVector4?t.uniforms[s]={type:"v4",value:o.toArray()}:o&&o.isMatrix3?t.uniforms[s]={type:"m3",value:o.toArray()}:o&&o.isMatrix4?t.uniforms[s]={type:"m4",value:o.toArray()}:t.uniforms[s]={value:o}}Object.keys(this.defines).length>0&&(t.defines=this.defines),t.vertexShader=this.vertexShader,t.fragmentShader=this.fragmentShader,t.lights=this.lights,t.clipping=this.clipping;let i={};for(let s in this.extensions)this.extensions[s]===!0&&(i[s]=!0);return Object.keys(i).length>0&&(t.extensions=i),t}fromJSON(e,t){if(super.fromJSON(e,t),e.uniforms!==void 0)for(let i in e.uniforms){let s=e.uniforms[i];switch(this.uniforms[i]={},s.type){case"t":this.uniforms[i].value=t[s.value]||null;break;case"c":this.uniforms[i].value=new Je().setHex(s.value);break;case"v2":this.uniforms[i].value=new $e().fromArray(s.value);break;case"v3":this.uniforms[i].value=new O().fromArray(s.value);break;case"v4":this.uniforms[i].value=new nn().fromArray(s.value);break;case"m3":this.uniforms[i].value=new Qe().fromArray(s.value);break;case"m4":this.uniforms[i].value=new Pt().fromArray(s.value);break;default:this.uniforms[i].value=s.value}}if(e.defines!==void 0&&(this.defines=e.defines),e.vertexShader!==void 0&&(this.vertexShader=e.vertexShader),e.fragmentShader!==void 0&&(this.fragmentShader=e.fragmentShader),e.glslVersion!==void 0&&(this.glslVersion=e.glslVersion),e.extensions!==void 0)for(let i in e.extensions)this.extensions[i]=e.extensions[i];return e.lights!==void 0&&(this.lights=e.lights),e.clipping!==void 0&&(this.clipping=e.clipping),this}},Mh=class extends vs{constructor(e){super(e),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}};var _l=class extends $i{constructor(e){super(),this.isMeshLambertMaterial=!0,this.type="MeshLambertMaterial",this.color=new Je(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new Je(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=wu,this.normalScale=new $e(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new Hs,this.combine=Bh,this.reflectivity=1,this.envMapIntensity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.emissive.copy(e.emissive),this.emissiveMap=e.emissiveMap,this.emissiveIntensity=e.emissiveIntensity,this.bumpMap=e.bumpMap,this.bumpScale=e.bumpScale,this.normalMap=e.normalMap,this.normalMapType=e.normalMapType,this.normalScale.copy(e.normalScale),this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.specularMap=e.specularMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.combine=e.combine,this.reflectivity=e.reflectivity,this.envMapIntensity=e.envMapIntensity,this.refractionRatio=e.refractionRatio,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.flatShading=e.flatShading,this.fog=e.fog,this}},wh=class extends $i{constructor(e){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=$0,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(e)}copy(e){return super.copy(e),this.depthPacking=e.depthPacking,this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this}},Th=class extends $i{constructor(e){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(e)}copy(e){return super.copy(e),this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this}};function ko(n,e){return!n||n.constructor===e?n:typeof e.BYTES_PER_ELEMENT=="number"?new e(n):Array.prototype.slice.call(n)}function eh(n){return n!==void 0&&n.inTangents!==void 0&&n.outTangents!==void 0}var _r=class{constructor(e,t,i,s){this.parameterPositions=e,this._cachedIndex=0,this.resultBuffer=s!==void 0?s:new t.constructor(i),this.sampleValues=t,this.valueSize=i,this.settings=null,this.DefaultSettings_={}}evaluate(e){let t=this.parameterPositions,i=this._cachedIndex,s=t[i],r=t[i-1];n:{e:{let o;t:{i:if(!(e<s)){for(let a=i+2;;){if(s===void 0){if(e<r)break i;return i=t.length,this._cachedIndex=i,this.copySampleValue_(i-1)}if(i===a)break;if(r=s,s=t[++i],e<s)break e}o=t.length;break t}if(!(e>=r)){let a=t[1];e<a&&(i=2,r=a);for(let l=i-2;;){if(r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(i===l)break;if(s=r,r=t[--i-1],e>=r)break e}o=i,i=0;break t}break n}for(;i<o;){let a=i+o>>>1;e<t[a]?o=a:i=a+1}if(s=t[i],r=t[i-1],r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(s===void 0)return i=t.length,this._cachedIndex=i,this.copySampleValue_(i-1)}this._cachedIndex=i,this.intervalChanged_(i,r,s)}return this.interpolate_(i,r,e,s)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(e){let t=this.resultBuffer,i=this.sampleValues,s=this.valueSize,r=e*s;for(let o=0;o!==s;++o)t[o]=i[r+o];return t}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},Eh=class extends _r{constructor(e,t,i,s){super(e,t,i,s),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:Pf,endingEnd:Pf}}intervalChanged_(e,t,i){let s=this.parameterPositions,r=e-2,o=e+1,a=s[r],l=s[o];if(a===void 0)switch(this.getSettings_().endingStart){case If:r=e,a=2*t-i;break;case Df:r=s.length-2,a=t+s[r]-s[r+1];break;default:r=e,a=i}if(l===void 0)switch(this.getSettings_().endingEnd){case If:o=e,l=2*i-t;break;case Df:o=1,l=i+s[1]-s[0];break;default:o=e-1,l=t}let c=(i-t)*.5,h=this.valueSize;this._weightPrev=c/(t-a),this._weightNext=c/(l-i),this._offsetPrev=r*h,this._offsetNext=o*h}interpolate_(e,t,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=this._offsetPrev,u=this._offsetNext,d=this._weightPrev,f=this._weightNext,m=(i-t)/(s-t),y=m*m,g=y*m,p=-d*g+2*d*y-d*m,S=(1+d)*g+(-1.5-2*d)*y+(-.5+d)*m+1,C=(-1-f)*g+(1.5+f)*y+.5*m,w=f*g-f*y;for(let P=0;P!==a;++P)r[P]=p*o[h+P]+S*o[c+P]+C*o[l+P]+w*o[u+P];return r}},Ah=class extends _r{constructor(e,t,i,s){super(e,t,i,s)}interpolate_(e,t,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=(i-t)/(s-t),u=1-h;for(let d=0;d!==a;++d)r[d]=o[c+d]*u+o[l+d]*h;return r}},Ch=class extends _r{constructor(e,t,i,s){super(e,t,i,s)}interpolate_(e){return this.copySampleValue_(e-1)}},Rh=class extends _r{interpolate_(e,t,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=this.inTangents,u=this.outTangents;if(!h||!u){let m=(i-t)/(s-t),y=1-m;for(let g=0;g!==a;++g)r[g]=o[c+g]*y+o[l+g]*m;return r}let d=a*2,f=e-1;for(let m=0;m!==a;++m){let y=o[c+m],g=o[l+m],p=f*d+m*2,S=u[p],C=u[p+1],w=e*d+m*2,P=h[w],E=h[w+1],x=Fb(i,t,S,P,s);r[m]=c_(x,y,C,E,g)}return r}};function c_(n,e,t,i,s){let r=1-n;return r*r*r*e+3*r*r*n*t+3*r*n*n*i+n*n*n*s}function Ub(n,e,t,i,s){let r=1-n;return 3*r*r*(t-e)+6*r*n*(i-t)+3*n*n*(s-i)}function Fb(n,e,t,i,s){let r=(n-e)/(s-e);for(let o=0;o<8;o++){let a=c_(r,e,t,i,s)-n;if(Math.abs(a)<1e-10)break;let l=Ub(r,e,t,i,s);if(Math.abs(l)<1e-10)break;r=Math.max(0,Math.min(1,r-a/l))}return r}var Ci=class{constructor(e,t,i,s){if(e===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(t===void 0||t.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+e);this.name=e,this.times=ko(t,this.TimeBufferType),this.values=ko(i,this.ValueBufferType),this.setInterpolation(s||this.DefaultInterpolation)}static toJSON(e){let t=e.constructor,i;if(t.toJSON!==this.toJSON)i=t.toJSON(e);else{i={name:e.name,times:ko(e.times,Array),values:ko(e.values,Array)};let s=e.getInterpolation();s!==e.DefaultInterpolation&&(i.interpolation=s),eh(e.settings)&&(i.settings={inTangents:ko(e.settings.inTangents,Array),outTangents:ko(e.settings.outTangents,Array)})}return i.type=e.ValueTypeName,i}InterpolantFactoryMethodDiscrete(e){return new Ch(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodLinear(e){return new Ah(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodSmooth(e){return new Eh(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodBezier(e){let t=new Rh(this.times,this.values,this.getValueSize(),e);return this.settings&&(t.inTangents=this.settings.inTangents,t.outTangents=this.settings.outTangents),t}setInterpolation(e){let t;switch(e){case el:t=this.InterpolantFactoryMethodDiscrete;break;case ph:t=this.InterpolantFactoryMethodLinear;break;case ih:t=this.InterpolantFactoryMethodSmooth;break;case Rf:t=this.InterpolantFactoryMethodBezier;break}if(t===void 0){let i="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(e!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(i);return Ke("KeyframeTrack:",i),this}return this.createInterpolant=t,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return el;case this.InterpolantFactoryMethodLinear:return ph;case this.InterpolantFactoryMethodSmooth:return ih;case this.InterpolantFactoryMethodBezier:return Rf}}getValueSize(){return this.values.length/this.times.length}shift(e){if(e!==0){let t=this.times;for(let i=0,s=t.length;i!==s;++i)t[i]+=e;eh(this.settings)&&(x0(this.settings.inTangents,e),x0(this.settings.outTangents,e))}return this}scale(e){if(e!==1){let t=this.times;for(let i=0,s=t.length;i!==s;++i)t[i]*=e;eh(this.settings)&&(y0(this.settings.inTangents,e),y0(this.settings.outTangents,e))}return this}trim(e,t){let i=this.times,s=i.length,r=0,o=s-1;for(;r!==s&&i[r]<e;)++r;for(;o!==-1&&i[o]>t;)--o;if(++o,r!==0||o!==s){r>=o&&(o=Math.max(o,1),r=o-1);let a=this.getValueSize();this.times=i.slice(r,o),this.values=this.values.slice(r*a,o*a)}return this}validate(){let e=!0,t=this.getValueSize();t-Math.floor(t)!==0&&(st("KeyframeTrack: Invalid value size in track.",this),e=!1);let i=this.times,s=this.values,r=i.length;r===0&&(st("KeyframeTrack: Track is empty.",this),e=!1);let o=null;for(let a=0;a!==r;a++){let l=i[a];if(typeof l=="number"&&isNaN(l)){st("KeyframeTrack: Time is not a valid number.",this,a,l),e=!1;break}if(o!==null&&o>l){st("KeyframeTrack: Out of order keys.",this,a,l,o),e=!1;break}o=l}if(s!==void 0&&jS(s))for(let a=0,l=s.length;a!==l;++a){let c=s[a];if(isNaN(c)){st("KeyframeTrack: Value is not a valid number.",this,a,c),e=!1;break}}return e}optimize(){let e=this.times.slice(),t=this.values.slice(),i=this.getValueSize(),s=this.getInterpolation()===ih,r=e.length-1,o=1;for(let a=1;a<r;++a){let l=!1,c=e[a],h=e[a+1];if(c!==h&&(a!==1||c!==e[0]))if(s)l=!0;else{let u=a*i,d=u-i,f=u+i;for(let m=0;m!==i;++m){let y=t[u+m];if(y!==t[d+m]||y!==t[f+m]){l=!0;break}}}if(l){if(a!==o){e[o]=e[a];let u=a*i,d=o*i;for(let f=0;f!==i;++f)t[d+f]=t[u+f]}++o}}if(r>0){e[o]=e[r];for(let a=r*i,l=o*i,c=0;c!==i;++c)t[l+c]=t[a+c];++o}return o!==e.length?(this.times=e.slice(0,o),this.values=t.slice(0,o*i)):(this.times=e,this.values=t),this}clone(){let e=this.times.slice(),t=this.values.slice(),i=this.constructor,s=new i(this.name,e,t);return s.createInterpolant=this.createInterpolant,eh(this.settings)&&(s.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),s}};function x0(n,e){for(let t=0,i=n.length;t!==i;t+=2)n[t]+=e}function y0(n,e){for(let t=0,i=n.length;t!==i;t+=2)n[t]*=e}Ci.prototype.ValueTypeName="";Ci.prototype.TimeBufferType=Float32Array;Ci.prototype.ValueBufferType=Float32Array;Ci.prototype.DefaultInterpolation=ph;var xr=class extends Ci{constructor(e,t,i){super(e,t,i)}};xr.prototype.ValueTypeName="bool";xr.prototype.ValueBufferType=Array;xr.prototype.DefaultInterpolation=el;xr.prototype.InterpolantFactoryMethodLinear=void 0;xr.prototype.InterpolantFactoryMethodSmooth=void 0;var Ph=class extends Ci{constructor(e,t,i,s){super(e,t,i,s)}};Ph.prototype.ValueTypeName="color";var Ih=class extends Ci{constructor(e,t,i,s){super(e,t,i,s)}};Ih.prototype.ValueTypeName="number";var Dh=class extends _r{constructor(e,t,i,s){super(e,t,i,s)}interpolate_(e,t,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=(i-t)/(s-t),c=e*a;for(let h=c+a;c!==h;c+=4)oi.slerpFlat(r,0,o,c-a,o,c,l);return r}},xl=class extends Ci{constructor(e,t,i,s){super(e,t,i,s)}InterpolantFactoryMethodLinear(e){return new Dh(this.times,this.values,this.getValueSize(),e)}};xl.prototype.ValueTypeName="quaternion";xl.prototype.InterpolantFactoryMethodSmooth=void 0;var yr=class extends Ci{constructor(e,t,i){super(e,t,i)}};yr.prototype.ValueTypeName="string";yr.prototype.ValueBufferType=Array;yr.prototype.DefaultInterpolation=el;yr.prototype.InterpolantFactoryMethodLinear=void 0;yr.prototype.InterpolantFactoryMethodSmooth=void 0;var Lh=class extends Ci{constructor(e,t,i,s){super(e,t,i,s)}};Lh.prototype.ValueTypeName="vector";var Nh=class{constructor(e,t,i){let s=this,r=!1,o=0,a=0,l,c=[];this.onStart=void 0,this.onLoad=e,this.onProgress=t,this.onError=i,this._abortController=null,this.itemStart=function(h){a++,r===!1&&s.onStart!==void 0&&s.onStart(h,o,a),r=!0},this.itemEnd=function(h){o++,s.onProgress!==void 0&&s.onProgress(h,o,a),o===a&&(r=!1,s.onLoad!==void 0&&s.onLoad())},this.itemError=function(h){s.onError!==void 0&&s.onError(h)},this.resolveURL=function(h){return h=h.normalize("NFC"),l?l(h):h},this.setURLModifier=function(h){return l=h,this},this.addHandler=function(h,u){return c.push(h,u),this},this.removeHandler=function(h){let u=c.indexOf(h);return u!==-1&&c.splice(u,2),this},this.getHandler=function(h){for(let u=0,d=c.length;u<d;u+=2){let f=c[u],m=c[u+1];if(f.global&&(f.lastIndex=0),f.test(h))return m}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},h_=new Nh,Uh=class{constructor(e){this.manager=e!==void 0?e:h_,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(e,t){let i=this;return new Promise(function(s,r){i.load(e,s,t,r)})}parse(){}setCrossOrigin(e){return this.crossOrigin=e,this}setWithCredentials(e){return this.withCredentials=e,this}setPath(e){return this.path=e,this}setResourcePath(e){return this.resourcePath=e,this}setRequestHeader(e){return this.requestHeader=e,this}setPriority(e){return this.priority=e,this}setCache(e){return this.cache=e,this}abort(){return this}};Uh.DEFAULT_MATERIAL_NAME="__DEFAULT";var yl=class extends An{static registerNode(e){this.prototype._lightNode=e}constructor(e,t=1){super(),this.isLight=!0,this.type="Light",this.color=new Je(e),this.intensity=t}copy(e,t){return super.copy(e,t),this.color.copy(e.color),this.intensity=e.intensity,this}toJSON(e){let t=super.toJSON(e);return t.object.color=this.color.getHex(),t.object.intensity=this.intensity,t}},vl=class extends yl{constructor(e,t,i){super(e,i),this.isHemisphereLight=!0,this.type="HemisphereLight",this.position.copy(An.DEFAULT_UP),this.updateMatrix(),this.groundColor=new Je(t)}copy(e,t){return super.copy(e,t),this.groundColor.copy(e.groundColor),this}toJSON(e){let t=super.toJSON(e);return t.object.groundColor=this.groundColor.getHex(),t}},Cf=new Pt,v0=new O,S0=new O,Fh=class{constructor(e){this.camera=e,this.intensity=1,this.bias=0,this.biasNode=null,this.normalBias=0,this.radius=1,this.blurSamples=8,this.mapSize=new $e(512,512),this.mapType=ui,this.map=null,this.mapPass=null,this.matrix=new Pt,this.autoUpdate=!0,this.needsUpdate=!1,this._frustum=new pr,this._frameExtents=new $e(1,1),this._viewportCount=1,this._viewports=[new nn(0,0,1,1)]}getViewportCount(){return this._viewportCount}getCamera(){return this.camera}getFrustum(){return this._frustum}updateMatrices(e){let t=this.camera;v0.setFromMatrixPosition(e.matrixWorld),t.position.copy(v0),S0.setFromMatrixPosition(e.target.matrixWorld),t.lookAt(S0),t.updateMatrixWorld(),this._updateMatrix(t,this.matrix,this._frustum)}_updateMatrix(e,t,i,s){Cf.multiplyMatrices(e.projectionMatrix,e.matrixWorldInverse),i.setFromProjectionMatrix(Cf,e.coordinateSystem,e.reversedDepth);let r=this._frameExtents,o=s?s.z/r.x:1,a=s?s.w/r.y:1,l=s?s.x/r.x:0,c=s?s.y/r.y:0;e.coordinateSystem===Wo||e.reversedDepth?t.set(.5*o,0,0,.5*o+l,0,.5*a,0,.5*a+c,0,0,1,0,0,0,0,1):t.set(.5*o,0,0,.5*o+l,0,.5*a,0,.5*a+c,0,0,.5,.5,0,0,0,1),t.multiply(Cf)}getViewport(e){return this._viewports[e]}getFrameExtents(){return this._frameExtents}dispose(){this.map&&this.map.dispose(),this.mapPass&&this.mapPass.dispose()}copy(e){return this.camera=e.camera.clone(),this.intensity=e.intensity,this.bias=e.bias,this.radius=e.radius,this.autoUpdate=e.autoUpdate,this.needsUpdate=e.needsUpdate,this.normalBias=e.normalBias,this.blurSamples=e.blurSamples,this.mapSize.copy(e.mapSize),this.mapType=e.mapType,this.biasNode=e.biasNode,this}clone(){return new this.constructor().copy(this)}toJSON(){let e={};return e.intensity=this.intensity,e.bias=this.bias,e.normalBias=this.normalBias,e.radius=this.radius,e.blurSamples=this.blurSamples,e.mapSize=this.mapSize.toArray(),e.mapType=this.mapType,e.camera=this.camera.toJSON(!1).object,delete e.camera.matrix,e}},th=new O,nh=new oi,_s=new O,Sl=class extends An{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new Pt,this.projectionMatrix=new Pt,this.projectionMatrixInverse=new Pt,this.coordinateSystem=Oi,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(e,t){return super.copy(e,t),this.matrixWorldInverse.copy(e.matrixWorldInverse),this.projectionMatrix.copy(e.projectionMatrix),this.projectionMatrixInverse.copy(e.projectionMatrixInverse),this.coordinateSystem=e.coordinateSystem,this}getWorldDirection(e){return super.getWorldDirection(e).negate()}updateMatrixWorld(e){super.updateMatrixWorld(e),this.matrixWorld.decompose(th,nh,_s),_s.x===1&&_s.y===1&&_s.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(th,nh,_s.set(1,1,1)).invert()}updateWorldMatrix(e,t,i=!1){super.updateWorldMatrix(e,t,i),this.matrixWorld.decompose(th,nh,_s),_s.x===1&&_s.y===1&&_s.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(th,nh,_s.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},ur=new O,b0=new $e,M0=new $e,si=class extends Sl{constructor(e=50,t=1,i=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=e,this.zoom=1,this.near=i,this.far=s,this.focus=10,this.aspect=t,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.fov=e.fov,this.zoom=e.zoom,this.near=e.near,this.far=e.far,this.focus=e.focus,this.aspect=e.aspect,this.view=e.view===null?null:Object.assign({},e.view),this.filmGauge=e.filmGauge,this.filmOffset=e.filmOffset,this}setFocalLength(e){let t=.5*this.getFilmHeight()/e;this.fov=qo*2*Math.atan(t),this.updateProjectionMatrix()}getFocalLength(){let e=Math.tan(ja*.5*this.fov);return .5*this.getFilmHeight()/e}getEffectiveFOV(){return qo*2*Math.atan(Math.tan(ja*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(e,t,i){ur.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),t.set(ur.x,ur.y).multiplyScalar(-e/ur.z),ur.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),i.set(ur.x,ur.y).multiplyScalar(-e/ur.z)}getViewSize(e,t){return this.getViewBounds(e,b0,M0),t.subVectors(M0,b0)}setViewOffset(e,t,i,s,r,o){this.aspect=e/t,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=i,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=this.near,t=e*Math.tan(ja*.5*this.fov)/this.zoom,i=2*t,s=this.aspect*i,r=-.5*s,o=this.view;if(this.view!==null&&this.view.enabled){let l=o.fullWidth,c=o.fullHeight;r+=o.offsetX*s/l,t-=o.offsetY*i/c,s*=o.width/l,i*=o.height/c}let a=this.filmOffset;a!==0&&(r+=e*a/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+s,t,t-i,e,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.fov=this.fov,t.object.zoom=this.zoom,t.object.near=this.near,t.object.far=this.far,t.object.focus=this.focus,t.object.aspect=this.aspect,this.view!==null&&(t.object.view=Object.assign({},this.view)),t.object.filmGauge=this.filmGauge,t.object.filmOffset=this.filmOffset,t}};var bl=class extends Sl{constructor(e=-1,t=1,i=1,s=-1,r=.1,o=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=e,this.right=t,this.top=i,this.bottom=s,this.near=r,this.far=o,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.left=e.left,this.right=e.right,this.top=e.top,this.bottom=e.bottom,this.near=e.near,this.far=e.far,this.zoom=e.zoom,this.view=e.view===null?null:Object.assign({},e.view),this}setViewOffset(e,t,i,s,r,o){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=i,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=(this.right-this.left)/(2*this.zoom),t=(this.top-this.bottom)/(2*this.zoom),i=(this.right+this.left)/2,s=(this.top+this.bottom)/2,r=i-e,o=i+e,a=s+t,l=s-t;if(this.view!==null&&this.view.enabled){let c=(this.right-this.left)/this.view.fullWidth/this.zoom,h=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=c*this.view.offsetX,o=r+c*this.view.width,a-=h*this.view.offsetY,l=a-h*this.view.height}this.projectionMatrix.makeOrthographic(r,o,a,l,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.zoom=this.zoom,t.object.left=this.left,t.object.right=this.right,t.object.top=this.top,t.object.bottom=this.bottom,t.object.near=this.near,t.object.far=this.far,this.view!==null&&(t.object.view=Object.assign({},this.view)),t}},Nf=class extends Fh{constructor(){super(new bl(-5,5,5,-5,.5,500)),this.isDirectionalLightShadow=!0}},Ml=class extends yl{constructor(e,t){super(e,t),this.isDirectionalLight=!0,this.type="DirectionalLight",this.position.copy(An.DEFAULT_UP),this.updateMatrix(),this.target=new An,this.shadow=new Nf}dispose(){super.dispose(),this.shadow.dispose()}copy(e){return super.copy(e),this.target=e.target.clone(),this.shadow=e.shadow.clone(),this}toJSON(e){let t=super.toJSON(e);return t.object.shadow=this.shadow.toJSON(),t.object.target=this.target.uuid,t}};var zo=-90,Vo=1,jo=class extends An{constructor(e,t,i){super(),this.type="CubeCamera",this.renderTarget=i,this.coordinateSystem=null,this.activeMipmapLevel=0;let s=new si(zo,Vo,e,t);s.layers=this.layers,this.add(s);let r=new si(zo,Vo,e,t);r.layers=this.layers,this.add(r);let o=new si(zo,Vo,e,t);o.layers=this.layers,this.add(o);let a=new si(zo,Vo,e,t);a.layers=this.layers,this.add(a);let l=new si(zo,Vo,e,t);l.layers=this.layers,this.add(l);let c=new si(zo,Vo,e,t);c.layers=this.layers,this.add(c)}updateCoordinateSystem(){let e=this.coordinateSystem,t=this.children.concat(),[i,s,r,o,a,l]=t;for(let c of t)this.remove(c);if(e===Oi)i.up.set(0,1,0),i.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),o.up.set(0,0,1),o.lookAt(0,-1,0),a.up.set(0,1,0),a.lookAt(0,0,1),l.up.set(0,1,0),l.lookAt(0,0,-1);else if(e===Wo)i.up.set(0,-1,0),i.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),o.up.set(0,0,-1),o.lookAt(0,-1,0),a.up.set(0,-1,0),a.lookAt(0,0,1),l.up.set(0,-1,0),l.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+e);for(let c of t)this.add(c),c.updateMatrixWorld()}update(e,t){this.parent===null&&this.updateMatrixWorld();let{renderTarget:i,activeMipmapLevel:s}=this;this.coordinateSystem!==e.coordinateSystem&&(this.coordinateSystem=e.coordinateSystem,this.updateCoordinateSystem());let[r,o,a,l,c,h]=this.children,u=e.getRenderTarget(),d=e.getActiveCubeFace(),f=e.getActiveMipmapLevel(),m=e.xr.enabled;e.xr.enabled=!1;let y=i.texture.mipmapsAutoUpdate;i.texture.mipmapsAutoUpdate=!1;let g=!1;e.isWebGLRenderer===!0?g=e.state.buffers.depth.getReversed():g=e.reversedDepthBuffer,e.setRenderTarget(i,0,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,r),e.setRenderTarget(i,1,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,o),e.setRenderTarget(i,2,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,a),e.setRenderTarget(i,3,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,l),e.setRenderTarget(i,4,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,c),i.texture.mipmapsAutoUpdate=y,e.setRenderTarget(i,5,s),g&&e.autoClear===!1&&e.clearDepth(),e.render(t,h),e.setRenderTarget(u,d,f),e.xr.enabled=m,i.texture.needsPMREMUpdate=!0}},Oh=class extends si{constructor(e=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=e,this.perCameraFrustumCulled=!1}};var mp="\\[\\]\\.:\\/",Ob=new RegExp("["+mp+"]","g"),gp="[^"+mp+"]",Bb="[^"+mp.replace("\\.","")+"]",kb=/((?:WC+[\/:])*)/.source.replace("WC",gp),zb=/(WCOD+)?/.source.replace("WCOD",Bb),Vb=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",gp),Gb=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",gp),Hb=new RegExp("^"+kb+zb+Vb+Gb+"$"),Wb=["material","materials","bones","map"],Uf=class{constructor(e,t,i){let s=i||jt.parseTrackName(t);this._targetGroup=e,this._bindings=e.subscribe_(t,s)}getValue(e,t){this.bind();let i=this._targetGroup.nCachedObjects_,s=this._bindings[i];s!==void 0&&s.getValue(e,t)}setValue(e,t){let i=this._bindings;for(let s=this._targetGroup.nCachedObjects_,r=i.length;s!==r;++s)i[s].setValue(e,t)}bind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,i=e.length;t!==i;++t)e[t].bind()}unbind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,i=e.length;t!==i;++t)e[t].unbind()}},jt=class n{constructor(e,t,i){this.path=t,this.parsedPath=i||n.parseTrackName(t),this.node=n.findNode(e,this.parsedPath.nodeName),this.rootNode=e,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(e,t,i){return e&&e.isAnimationObjectGroup?new n.Composite(e,t,i):new n(e,t,i)}static sanitizeNodeName(e){return e.replace(/\s/g,"_").replace(Ob,"")}static parseTrackName(e){let t=Hb.exec(e);if(t===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+e);let i={nodeName:t[2],objectName:t[3],objectIndex:t[4],propertyName:t[5],propertyIndex:t[6]},s=i.nodeName&&i.nodeName.lastIndexOf(".");if(s!==void 0&&s!==-1){let r=i.nodeName.substring(s+1);Wb.indexOf(r)!==-1&&(i.nodeName=i.nodeName.substring(0,s),i.objectName=r)}if(i.propertyName===null||i.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+e);return i}static findNode(e,t){if(t===void 0||t===""||t==="."||t===-1||t===e.name||t===e.uuid)return e;if(e.skeleton){let i=e.skeleton.getBoneByName(t);if(i!==void 0)return i}if(e.children){let i=function(r){for(let o=0;o<r.length;o++){let a=r[o];if(a.name===t||a.uuid===t)return a;let l=i(a.children);if(l)return l}return null},s=i(e.children);if(s)return s}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(e,t){e[t]=this.targetObject[this.propertyName]}_getValue_array(e,t){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)e[t++]=i[s]}_getValue_arrayElement(e,t){e[t]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(e,t){this.resolvedProperty.toArray(e,t)}_setValue_direct(e,t){this.targetObject[this.propertyName]=e[t]}_setValue_direct_setNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(e,t){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=e[t++]}_setValue_array_setNeedsUpdate(e,t){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=e[t++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(e,t){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=e[t++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(e,t){this.resolvedProperty[this.propertyIndex]=e[t]}_setValue_arrayElement_setNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(e,t){this.resolvedProperty.fromArray(e,t)}_setValue_fromArray_setNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(e,t){this.bind(),this.getValue(e,t)}_setValue_unbound(e,t){this.bind(),this.setValue(e,t)}bind(){let e=this.node,t=this.parsedPath,i=t.objectName,s=t.propertyName,r=t.propertyIndex;if(e||(e=n.findNode(this.rootNode,t.nodeName),this.node=e),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!e){Ke("PropertyBinding: No target node found for track: "+this.path+".");return}if(i){let c=t.objectIndex;switch(i){case"materials":if(!e.material){st("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.materials){st("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}e=e.material.materials;break;case"bones":if(!e.skeleton){st("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}e=e.skeleton.bones;for(let h=0;h<e.length;h++)if(e[h].name===c){c=h;break}break;case"map":if("map"in e){e=e.map;break}if(!e.material){st("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.map){st("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}e=e.material.map;break;default:if(e[i]===void 0){st("PropertyBinding: Can not bind to objectName of node undefined.",this);return}e=e[i]}if(c!==void 0){if(e[c]===void 0){st("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,e);return}e=e[c]}}let o=e[s];if(o===void 0){let c=t.nodeName;st("PropertyBinding: Trying to update property for track: "+c+"."+s+" but it wasn't found.",e);return}let a=this.Versioning.None;this.targetObject=e,e.isMaterial===!0?a=this.Versioning.NeedsUpdate:e.isObject3D===!0&&(a=this.Versioning.MatrixWorldNeedsUpdate);let l=this.BindingType.Direct;if(r!==void 0){if(s==="morphTargetInfluences"){if(!e.geometry){st("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!e.geometry.morphAttributes){st("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}e.morphTargetDictionary[r]!==void 0&&(r=e.morphTargetDictionary[r])}l=this.BindingType.ArrayElement,this.resolvedProperty=o,this.propertyIndex=r}else o.fromArray!==void 0&&o.toArray!==void 0?(l=this.BindingType.HasFromToArray,this.resolvedProperty=o):Array.isArray(o)?(l=this.BindingType.EntireArray,this.resolvedProperty=o):this.propertyName=s;this.getValue=this.GetterByBindingType[l],this.setValue=this.SetterByBindingTypeAndVersioning[l][a]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};jt.Composite=Uf;jt.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};jt.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};jt.prototype.GetterByBindingType=[jt.prototype._getValue_direct,jt.prototype._getValue_array,jt.prototype._getValue_arrayElement,jt.prototype._getValue_toArray];jt.prototype.SetterByBindingTypeAndVersioning=[[jt.prototype._setValue_direct,jt.prototype._setValue_direct_setNeedsUpdate,jt.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[jt.prototype._setValue_array,jt.prototype._setValue_array_setNeedsUpdate,jt.prototype._setValue_array_setMatrixWorldNeedsUpdate],[jt.prototype._setValue_arrayElement,jt.prototype._setValue_arrayElement_setNeedsUpdate,jt.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[jt.prototype._setValue_fromArray,jt.prototype._setValue_fromArray_setNeedsUpdate,jt.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var WP=new Float32Array(1);var Qo=class{constructor(e=1,t=0,i=0){this.radius=e,this.phi=t,this.theta=i}set(e,t,i){return this.radius=e,this.phi=t,this.theta=i,this}copy(e){return this.radius=e.radius,this.phi=e.phi,this.theta=e.theta,this}makeSafe(){return this.phi=xt(this.phi,1e-6,Math.PI-1e-6),this}setFromVector3(e){return this.setFromCartesianCoords(e.x,e.y,e.z)}setFromCartesianCoords(e,t,i){return this.radius=Math.sqrt(e*e+t*t+i*i),this.radius===0?(this.theta=0,this.phi=0):(this.theta=Math.atan2(e,i),this.phi=Math.acos(xt(t/this.radius,-1,1))),this}clone(){return new this.constructor().copy(this)}};var Ff=class{static{this.prototype.isMatrix2=!0}constructor(e,t,i,s){this.elements=[1,0,0,1],e!==void 0&&this.set(e,t,i,s)}identity(){return this.set(1,0,0,1),this}fromArray(e,t=0){for(let i=0;i<4;i++)this.elements[i]=e[i+t];return this}set(e,t,i,s){let r=this.elements;return r[0]=e,r[2]=t,r[1]=i,r[3]=s,this}};var wl=class extends ys{constructor(e=10,t=10,i=4473924,s=8947848){i=new Je(i),s=new Je(s);let r=t/2,o=e/t,a=e/2,l=[],c=[];for(let d=0,f=0,m=-a;d<=t;d++,m+=o){l.push(-a,0,m,a,0,m),l.push(m,0,-a,m,0,a);let y=d===r?i:s;y.toArray(c,f),f+=3,y.toArray(c,f),f+=3,y.toArray(c,f),f+=3,y.toArray(c,f),f+=3}let h=new qt;h.setAttribute("position",new dn(l,3)),h.setAttribute("color",new dn(c,3));let u=new Zi({vertexColors:!0,toneMapped:!1});super(h,u),this.type="GridHelper"}dispose(){super.dispose(),this.geometry.dispose(),this.material.dispose()}};var Tl=class extends qi{constructor(e,t=null){super(),this.object=e,this.domElement=t,this.enabled=!0,this.state=-1,this.keys={},this.mouseButtons={LEFT:null,MIDDLE:null,RIGHT:null},this.touches={ONE:null,TWO:null}}connect(e){this.domElement!==null&&this.disconnect(),this.domElement=e}disconnect(){}dispose(){}update(){}};function _p(n,e,t,i){let s=Xb(i);switch(t){case tp:return n*e;case ip:return n*e/s.components*s.byteLength;case Xh:return n*e/s.components*s.byteLength;case Mr:return n*e*2/s.components*s.byteLength;case qh:return n*e*2/s.components*s.byteLength;case np:return n*e*3/s.components*s.byteLength;case Qi:return n*e*4/s.components*s.byteLength;case Yh:return n*e*4/s.components*s.byteLength;case Cl:case Rl:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*8;case Pl:case Il:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*16;case Zh:case Jh:return Math.max(n,16)*Math.max(e,8)/4;case $h:case Kh:return Math.max(n,8)*Math.max(e,8)/2;case jh:case Qh:case tu:case nu:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*8;case eu:case Dl:case iu:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*16;case su:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*16;case ru:return Math.floor((n+4)/5)*Math.floor((e+3)/4)*16;case ou:return Math.floor((n+4)/5)*Math.floor((e+4)/5)*16;case au:return Math.floor((n+5)/6)*Math.floor((e+4)/5)*16;case lu:return Math.floor((n+5)/6)*Math.floor((e+5)/6)*16;case cu:return Math.floor((n+7)/8)*Math.floor((e+4)/5)*16;case hu:return Math.floor((n+7)/8)*Math.floor((e+5)/6)*16;case uu:return Math.floor((n+7)/8)*Math.floor((e+7)/8)*16;case du:return Math.floor((n+9)/10)*Math.floor((e+4)/5)*16;case fu:return Math.floor((n+9)/10)*Math.floor((e+5)/6)*16;case pu:return Math.floor((n+9)/10)*Math.floor((e+7)/8)*16;case mu:return Math.floor((n+9)/10)*Math.floor((e+9)/10)*16;case gu:return Math.floor((n+11)/12)*Math.floor((e+9)/10)*16;case _u:return Math.floor((n+11)/12)*Math.floor((e+11)/12)*16;case xu:case yu:case vu:return Math.ceil(n/4)*Math.ceil(e/4)*16;case Su:case bu:return Math.ceil(n/4)*Math.ceil(e/4)*8;case Ll:case Mu:return Math.ceil(n/4)*Math.ceil(e/4)*16}throw new Error(`Unable to determine texture byte length for ${t} format.`)}function Xb(n){switch(n){case ui:case Jf:return{byteLength:1,components:1};case ia:case jf:case ji:return{byteLength:2,components:1};case Hh:case Wh:return{byteLength:2,components:4};case Ki:case Gh:case Ji:return{byteLength:4,components:1};case Qf:case ep:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${n}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?Ke("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");function D_(){let n=null,e=!1,t=null,i=null;function s(r,o){i=n.requestAnimationFrame(s),t(r,o)}return{start:function(){e!==!0&&t!==null&&n!==null&&(i=n.requestAnimationFrame(s),e=!0)},stop:function(){n!==null&&n.cancelAnimationFrame(i),e=!1},setAnimationLoop:function(r){t=r},setContext:function(r){n=r}}}function Yb(n){let e=new WeakMap;function t(a,l){let c=a.array,h=a.usage,u=c.byteLength,d=n.createBuffer();n.bindBuffer(l,d),n.bufferData(l,c,h),a.onUploadCallback();let f;if(c instanceof Float32Array)f=n.FLOAT;else if(typeof Float16Array<"u"&&c instanceof Float16Array)f=n.HALF_FLOAT;else if(c instanceof Uint16Array)a.isFloat16BufferAttribute?f=n.HALF_FLOAT:f=n.UNSIGNED_SHORT;else if(c instanceof Int16Array)f=n.SHORT;else if(c instanceof Uint32Array)f=n.UNSIGNED_INT;else if(c instanceof Int32Array)f=n.INT;else if(c instanceof Int8Array)f=n.BYTE;else if(c instanceof Uint8Array)f=n.UNSIGNED_BYTE;else if(c instanceof Uint8ClampedArray)f=n.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+c);return{buffer:d,type:f,bytesPerElement:c.BYTES_PER_ELEMENT,version:a.version,size:u}}function i(a,l,c){let h=l.array,u=l.updateRanges;if(n.bindBuffer(c,a),u.length===0)n.bufferSubData(c,0,h);else{u.sort((f,m)=>f.start-m.start);let d=0;for(let f=1;f<u.length;f++){let m=u[d],y=u[f];y.start<=m.start+m.count+1?m.count=Math.max(m.count,y.start+y.count-m.start):(++d,u[d]=y)}u.length=d+1;for(let f=0,m=u.length;f<m;f++){let y=u[f];n.bufferSubData(c,y.start*h.BYTES_PER_ELEMENT,h,y.start,y.count)}l.clearUpdateRanges()}l.onUploadCallback()}function s(a){return a.isInterleavedBufferAttribute&&(a=a.data),e.get(a)}function r(a){a.isInterleavedBufferAttribute&&(a=a.data);let l=e.get(a);l&&(n.deleteBuffer(l.buffer),e.delete(a))}function o(a,l){if(a.isInterleavedBufferAttribute&&(a=a.data),a.isGLBufferAttribute){let h=e.get(a);(!h||h.version<a.version)&&e.set(a,{buffer:a.buffer,type:a.type,bytesPerElement:a.elementSize,version:a.version});return}let c=e.get(a);if(c===void 0)e.set(a,t(a,l));else if(c.version<a.version){if(c.size!==a.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");i(c.buffer,a,l),c.version=a.version}}return{get:s,remove:r,update:o}}var $b=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,Zb=`#ifdef USE_ALPHAHASH
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
#endif`,Kb=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,Jb=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,jb=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,Qb=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,eM=`#ifdef USE_AOMAP
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
#endif`,tM=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,nM=`#ifdef USE_BATCHING
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
#endif`,iM=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,sM=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,rM=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,oM=`float G_BlinnPhong_Implicit( ) {
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
} // validated`,aM=`#ifdef USE_IRIDESCENCE
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
#endif`,lM=`#ifdef USE_BUMPMAP
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
#endif`,cM=`#if NUM_CLIPPING_PLANES > 0
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
#endif`,hM=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,uM=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,dM=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,fM=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#endif`,pM=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#endif`,mM=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec4 vColor;
#endif`,gM=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
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
#endif`,_M=`#define PI 3.141592653589793
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
} // validated`,xM=`vec3 transformedNormal = objectNormal;
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
#endif`,yM=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,vM=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,SM=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,bM=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,MM="gl_FragColor = linearToOutputTexel( gl_FragColor );",wM=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,TM=`#ifdef USE_ENVMAP
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
#endif`,EM=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform mat3 envMapRotation;
	uniform samplerCube envMap;
	#ifdef ENVMAP_TYPE_PMREM
		float roughnessToMip( const in float roughness ) {
			float r = clamp( roughness, 0.0, 1.0 );
			return ENVMAP_MAX_LOD * r * ( 2.0 - r );
		}
	#endif
#endif`,AM=`#ifdef USE_ENVMAP
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
#endif`,CM=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,RM=`#ifdef USE_ENVMAP
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
#endif`,PM=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,IM=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,DM=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,LM=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,NM=`#ifdef USE_GRADIENTMAP
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
}`,UM=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,FM=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,OM=`varying vec3 vViewPosition;
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
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,BM=`uniform bool receiveShadow;
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
#include <lightprobes_pars_fragment>`,kM=`#ifdef USE_ENVMAP
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
#endif`,zM=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,VM=`varying vec3 vViewPosition;
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
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,GM=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,HM=`varying vec3 vViewPosition;
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
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,WM=`PhysicalMaterial material;
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
#endif`,XM=`uniform sampler2D dfgLUT;
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
}`,qM=`
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
#endif`,YM=`#if defined( RE_IndirectDiffuse )
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
#endif`,$M=`#if defined( RE_IndirectDiffuse )
	#if defined( LAMBERT ) || defined( PHONG )
		irradiance += iblIrradiance;
	#endif
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,ZM=`#if NUM_LIGHT_PROBE_GRIDS > 0
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
#endif`,KM=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,JM=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,jM=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,QM=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,ew=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,tw=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,nw=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
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
#endif`,iw=`#if defined( USE_POINTS_UV )
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
#endif`,sw=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,rw=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,ow=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,aw=`#if defined( USE_MORPHCOLORS )
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
#endif`,lw=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,cw=`#ifdef USE_MORPHTARGETS
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
#endif`,hw=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,uw=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
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
vec3 nonPerturbedNormal = normal;`,dw=`#ifdef USE_NORMALMAP_OBJECTSPACE
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
#endif`,fw=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,pw=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,mw=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
		#ifdef FLIP_SIDED
			vBitangent = - vBitangent;
		#endif
	#endif
#endif`,gw=`#ifdef USE_NORMALMAP
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
#endif`,_w=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,xw=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,yw=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,vw=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,Sw=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,bw=`vec3 packNormalToRGB( const in vec3 normal ) {
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
}`,Mw=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,ww=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,Tw=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,Ew=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,Aw=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,Cw=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,Rw=`#if NUM_SPOT_LIGHT_COORDS > 0
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
#endif`,Pw=`#if NUM_SPOT_LIGHT_COORDS > 0
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
#endif`,Iw=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
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
#endif`,Dw=`float getShadowMask() {
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
}`,Lw=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,Nw=`#ifdef USE_SKINNING
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
#endif`,Uw=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,Fw=`#ifdef USE_SKINNING
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
#endif`,Ow=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,Bw=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,kw=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,zw=`#ifndef saturate
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
vec3 CustomToneMapping( vec3 color ) { return color; }`,Vw=`#ifdef USE_TRANSMISSION
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
#endif`,Gw=`#ifdef USE_TRANSMISSION
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
#endif`,Hw=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
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
#endif`,Ww=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
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
#endif`,Xw=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
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
#endif`,qw=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,Yw=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,$w=`uniform sampler2D t2D;
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
}`,Zw=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,Kw=`uniform float backgroundBlurriness;
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
}`,Jw=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,jw=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,Qw=`#include <common>
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
}`,eT=`#if DEPTH_PACKING == 3200
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
}`,tT=`#define DISTANCE
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
}`,nT=`#define DISTANCE
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
}`,iT=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,sT=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,rT=`uniform float scale;
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
}`,oT=`uniform vec3 diffuse;
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
}`,aT=`#include <common>
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
}`,lT=`uniform vec3 diffuse;
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
}`,cT=`#define LAMBERT
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
}`,hT=`#define LAMBERT
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
}`,uT=`#define MATCAP
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
}`,dT=`#define MATCAP
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
}`,fT=`#define NORMAL
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
}`,pT=`#define NORMAL
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
}`,mT=`#define PHONG
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
}`,gT=`#define PHONG
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
}`,_T=`#define STANDARD
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
}`,xT=`#define STANDARD
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
}`,yT=`#define TOON
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
}`,vT=`#define TOON
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
}`,ST=`uniform float size;
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
}`,bT=`uniform vec3 diffuse;
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
}`,MT=`#include <common>
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
}`,wT=`uniform vec3 color;
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
}`,TT=`uniform float rotation;
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
}`,ET=`uniform vec3 diffuse;
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
}`,pt={alphahash_fragment:$b,alphahash_pars_fragment:Zb,alphamap_fragment:Kb,alphamap_pars_fragment:Jb,alphatest_fragment:jb,alphatest_pars_fragment:Qb,aomap_fragment:eM,aomap_pars_fragment:tM,batching_pars_vertex:nM,batching_vertex:iM,begin_vertex:sM,beginnormal_vertex:rM,bsdfs:oM,iridescence_fragment:aM,bumpmap_pars_fragment:lM,clipping_planes_fragment:cM,clipping_planes_pars_fragment:hM,clipping_planes_pars_vertex:uM,clipping_planes_vertex:dM,color_fragment:fM,color_pars_fragment:pM,color_pars_vertex:mM,color_vertex:gM,common:_M,defaultnormal_vertex:xM,displacementmap_pars_vertex:yM,displacementmap_vertex:vM,emissivemap_fragment:SM,emissivemap_pars_fragment:bM,colorspace_fragment:MM,colorspace_pars_fragment:wM,envmap_fragment:TM,envmap_common_pars_fragment:EM,envmap_pars_fragment:AM,envmap_pars_vertex:CM,envmap_physical_pars_fragment:kM,envmap_vertex:RM,fog_vertex:PM,fog_pars_vertex:IM,fog_fragment:DM,fog_pars_fragment:LM,gradientmap_pars_fragment:NM,lightmap_pars_fragment:UM,lights_lambert_fragment:FM,lights_lambert_pars_fragment:OM,lights_pars_begin:BM,lights_toon_fragment:zM,lights_toon_pars_fragment:VM,lights_phong_fragment:GM,lights_phong_pars_fragment:HM,lights_physical_fragment:WM,lights_physical_pars_fragment:XM,lights_fragment_begin:qM,lights_fragment_maps:YM,lights_fragment_end:$M,lightprobes_pars_fragment:ZM,logdepthbuf_fragment:KM,logdepthbuf_pars_fragment:JM,logdepthbuf_pars_vertex:jM,logdepthbuf_vertex:QM,map_fragment:ew,map_pars_fragment:tw,map_particle_fragment:nw,map_particle_pars_fragment:iw,metalnessmap_fragment:sw,metalnessmap_pars_fragment:rw,morphinstance_vertex:ow,morphcolor_vertex:aw,morphnormal_vertex:lw,morphtarget_pars_vertex:cw,morphtarget_vertex:hw,normal_fragment_begin:uw,normal_fragment_maps:dw,normal_pars_fragment:fw,normal_pars_vertex:pw,normal_vertex:mw,normalmap_pars_fragment:gw,clearcoat_normal_fragment_begin:_w,clearcoat_normal_fragment_maps:xw,clearcoat_pars_fragment:yw,iridescence_pars_fragment:vw,opaque_fragment:Sw,packing:bw,premultiplied_alpha_fragment:Mw,project_vertex:ww,dithering_fragment:Tw,dithering_pars_fragment:Ew,roughnessmap_fragment:Aw,roughnessmap_pars_fragment:Cw,shadowmap_pars_fragment:Rw,shadowmap_pars_vertex:Pw,shadowmap_vertex:Iw,shadowmask_pars_fragment:Dw,skinbase_vertex:Lw,skinning_pars_vertex:Nw,skinning_vertex:Uw,skinnormal_vertex:Fw,specularmap_fragment:Ow,specularmap_pars_fragment:Bw,tonemapping_fragment:kw,tonemapping_pars_fragment:zw,transmission_fragment:Vw,transmission_pars_fragment:Gw,uv_pars_fragment:Hw,uv_pars_vertex:Ww,uv_vertex:Xw,worldpos_vertex:qw,background_vert:Yw,background_frag:$w,backgroundCube_vert:Zw,backgroundCube_frag:Kw,cube_vert:Jw,cube_frag:jw,depth_vert:Qw,depth_frag:eT,distance_vert:tT,distance_frag:nT,equirect_vert:iT,equirect_frag:sT,linedashed_vert:rT,linedashed_frag:oT,meshbasic_vert:aT,meshbasic_frag:lT,meshlambert_vert:cT,meshlambert_frag:hT,meshmatcap_vert:uT,meshmatcap_frag:dT,meshnormal_vert:fT,meshnormal_frag:pT,meshphong_vert:mT,meshphong_frag:gT,meshphysical_vert:_T,meshphysical_frag:xT,meshtoon_vert:yT,meshtoon_frag:vT,points_vert:ST,points_frag:bT,shadow_vert:MT,shadow_frag:wT,sprite_vert:TT,sprite_frag:ET},Le={common:{diffuse:{value:new Je(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new Qe},alphaMap:{value:null},alphaMapTransform:{value:new Qe},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new Qe}},envmap:{envMap:{value:null},envMapRotation:{value:new Qe},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new Qe}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new Qe}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new Qe},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new Qe},normalScale:{value:new $e(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new Qe},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new Qe}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new Qe}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new Qe}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new Je(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new Je(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new Qe},alphaTest:{value:0},uvTransform:{value:new Qe}},sprite:{diffuse:{value:new Je(16777215)},opacity:{value:1},center:{value:new $e(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new Qe},alphaMap:{value:null},alphaMapTransform:{value:new Qe},alphaTest:{value:0}}},Ms={basic:{uniforms:Zn([Le.common,Le.specularmap,Le.envmap,Le.aomap,Le.lightmap,Le.fog]),vertexShader:pt.meshbasic_vert,fragmentShader:pt.meshbasic_frag},lambert:{uniforms:Zn([Le.common,Le.specularmap,Le.envmap,Le.aomap,Le.lightmap,Le.emissivemap,Le.bumpmap,Le.normalmap,Le.displacementmap,Le.fog,Le.lights,{emissive:{value:new Je(0)},envMapIntensity:{value:1}}]),vertexShader:pt.meshlambert_vert,fragmentShader:pt.meshlambert_frag},phong:{uniforms:Zn([Le.common,Le.specularmap,Le.envmap,Le.aomap,Le.lightmap,Le.emissivemap,Le.bumpmap,Le.normalmap,Le.displacementmap,Le.fog,Le.lights,{emissive:{value:new Je(0)},specular:{value:new Je(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:pt.meshphong_vert,fragmentShader:pt.meshphong_frag},standard:{uniforms:Zn([Le.common,Le.envmap,Le.aomap,Le.lightmap,Le.emissivemap,Le.bumpmap,Le.normalmap,Le.displacementmap,Le.roughnessmap,Le.metalnessmap,Le.fog,Le.lights,{emissive:{value:new Je(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:pt.meshphysical_vert,fragmentShader:pt.meshphysical_frag},toon:{uniforms:Zn([Le.common,Le.aomap,Le.lightmap,Le.emissivemap,Le.bumpmap,Le.normalmap,Le.displacementmap,Le.gradientmap,Le.fog,Le.lights,{emissive:{value:new Je(0)}}]),vertexShader:pt.meshtoon_vert,fragmentShader:pt.meshtoon_frag},matcap:{uniforms:Zn([Le.common,Le.bumpmap,Le.normalmap,Le.displacementmap,Le.fog,{matcap:{value:null}}]),vertexShader:pt.meshmatcap_vert,fragmentShader:pt.meshmatcap_frag},points:{uniforms:Zn([Le.points,Le.fog]),vertexShader:pt.points_vert,fragmentShader:pt.points_frag},dashed:{uniforms:Zn([Le.common,Le.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:pt.linedashed_vert,fragmentShader:pt.linedashed_frag},depth:{uniforms:Zn([Le.common,Le.displacementmap]),vertexShader:pt.depth_vert,fragmentShader:pt.depth_frag},normal:{uniforms:Zn([Le.common,Le.bumpmap,Le.normalmap,Le.displacementmap,{opacity:{value:1}}]),vertexShader:pt.meshnormal_vert,fragmentShader:pt.meshnormal_frag},sprite:{uniforms:Zn([Le.sprite,Le.fog]),vertexShader:pt.sprite_vert,fragmentShader:pt.sprite_frag},background:{uniforms:{uvTransform:{value:new Qe},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:pt.background_vert,fragmentShader:pt.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new Qe}},vertexShader:pt.backgroundCube_vert,fragmentShader:pt.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:pt.cube_vert,fragmentShader:pt.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:pt.equirect_vert,fragmentShader:pt.equirect_frag},distance:{uniforms:Zn([Le.common,Le.displacementmap,{referencePosition:{value:new O},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:pt.distance_vert,fragmentShader:pt.distance_frag},shadow:{uniforms:Zn([Le.lights,Le.fog,{color:{value:new Je(0)},opacity:{value:1}}]),vertexShader:pt.shadow_vert,fragmentShader:pt.shadow_frag}};Ms.physical={uniforms:Zn([Ms.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new Qe},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new Qe},clearcoatNormalScale:{value:new $e(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new Qe},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new Qe},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new Qe},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new Qe},sheen:{value:0},sheenColor:{value:new Je(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new Qe},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new Qe},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new Qe},transmissionSamplerSize:{value:new $e},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new Qe},attenuationDistance:{value:0},attenuationColor:{value:new Je(0)},specularColor:{value:new Je(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new Qe},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new Qe},anisotropyVector:{value:new $e},anisotropyMap:{value:null},anisotropyMapTransform:{value:new Qe}}]),vertexShader:pt.meshphysical_vert,fragmentShader:pt.meshphysical_frag};var Eu={r:0,b:0,g:0},AT=new Pt,L_=new Qe;L_.set(-1,0,0,0,1,0,0,0,1);function CT(n,e,t,i,s,r){let o=new Je(0),a=s===!0?0:1,l,c,h=null,u=0,d=null;function f(S){let C=S.isScene===!0?S.background:null;if(C&&C.isTexture){let w=S.backgroundBlurriness>0;C=e.get(C,w)}return C}function m(S){let C=!1,w=f(S);w===null?g(o,a):w&&w.isColor&&(g(w,1),C=!0);let P=n.xr.getEnvironmentBlendMode();P==="additive"?t.buffers.color.setClear(0,0,0,1,r):P==="alpha-blend"&&t.buffers.color.setClear(0,0,0,0,r),(n.autoClear||C)&&(t.buffers.depth.setTest(!0),t.buffers.depth.setMask(!0),t.buffers.color.setMask(!0),n.clear(n.autoClearColor,n.autoClearDepth,n.autoClearStencil))}function y(S,C){let w=f(C);w&&w.isCubeTexture?(c===void 0&&(c=new Gn(new mr(1,1,1),new vs({name:"BackgroundCubeMaterial",uniforms:jr(Ms.backgroundCube.uniforms),vertexShader:Ms.backgroundCube.vertexShader,fragmentShader:Ms.backgroundCube.fragmentShader,side:li,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),c.geometry.deleteAttribute("normal"),c.geometry.deleteAttribute("uv"),c.onBeforeRender=function(P,E,x){this.matrixWorld.copyPosition(x.matrixWorld)},Object.defineProperty(c.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),i.update(c)),c.material.uniforms.envMap.value=w,c.material.uniforms.backgroundBlurriness.value=C.backgroundBlurriness,c.material.uniforms.backgroundIntensity.value=C.backgroundIntensity,c.material.uniforms.backgroundRotation.value.setFromMatrix4(AT.makeRotationFromEuler(C.backgroundRotation)).transpose(),w.isRenderTargetTexture===!1&&c.material.uniforms.backgroundRotation.value.premultiply(L_),c.material.toneMapped=bt.getTransfer(w.colorSpace)!==Lt,(h!==w||u!==w.version||d!==n.toneMapping)&&(c.material.needsUpdate=!0,h=w,u=w.version,d=n.toneMapping),c.layers.enableAll(),S.unshift(c,c.geometry,c.material,0,0,null)):w&&w.isTexture&&(l===void 0&&(l=new Gn(new gl(2,2),new vs({name:"BackgroundMaterial",uniforms:jr(Ms.background.uniforms),vertexShader:Ms.background.vertexShader,fragmentShader:Ms.background.fragmentShader,side:br,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),l.geometry.deleteAttribute("normal"),Object.defineProperty(l.material,"map",{get:function(){return this.uniforms.t2D.value}}),i.update(l)),l.material.uniforms.t2D.value=w,l.material.uniforms.backgroundIntensity.value=C.backgroundIntensity,l.material.toneMapped=bt.getTransfer(w.colorSpace)!==Lt,w.matrixAutoUpdate===!0&&w.updateMatrix(),l.material.uniforms.uvTransform.value.copy(w.matrix),(h!==w||u!==w.version||d!==n.toneMapping)&&(l.material.needsUpdate=!0,h=w,u=w.version,d=n.toneMapping),l.layers.enableAll(),S.unshift(l,l.geometry,l.material,0,0,null))}function g(S,C){S.getRGB(Eu,pp(n)),t.buffers.color.setClear(Eu.r,Eu.g,Eu.b,C,r)}function p(){c!==void 0&&(c.geometry.dispose(),c.material.dispose(),c=void 0),l!==void 0&&(l.geometry.dispose(),l.material.dispose(),l=void 0)}return{getClearColor:function(){return o},setClearColor:function(S,C=1){o.set(S),a=C,g(o,a)},getClearAlpha:function(){return a},setClearAlpha:function(S){a=S,g(o,a)},render:m,addToRenderList:y,dispose:p}}function RT(n,e){let t=n.getParameter(n.MAX_VERTEX_ATTRIBS),i={},s=d(null),r=s,o=!1;function a(L,z,W,D,X){let Z=!1,H=u(L,D,W,z);r!==H&&(r=H,c(r.object)),Z=f(L,D,W,X),Z&&m(L,D,W,X),X!==null&&e.update(X,n.ELEMENT_ARRAY_BUFFER),(Z||o)&&(o=!1,w(L,z,W,D),X!==null&&n.bindBuffer(n.ELEMENT_ARRAY_BUFFER,e.get(X).buffer))}function l(){return n.createVertexArray()}function c(L){return n.bindVertexArray(L)}function h(L){return n.deleteVertexArray(L)}function u(L,z,W,D){let X=D.wireframe===!0,Z=i[z.id];Z===void 0&&(Z={},i[z.id]=Z);let H=L.isInstancedMesh===!0?L.id:0,he=Z[H];he===void 0&&(he={},Z[H]=he);let j=he[W.id];j===void 0&&(j={},he[W.id]=j);let ee=j[X];return ee===void 0&&(ee=d(l()),j[X]=ee),ee}function d(L){let z=[],W=[],D=[];for(let X=0;X<t;X++)z[X]=0,W[X]=0,D[X]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:z,enabledAttributes:W,attributeDivisors:D,object:L,attributes:{},index:null}}function f(L,z,W,D){let X=r.attributes,Z=z.attributes,H=0,he=W.getAttributes();for(let j in he)if(he[j].location>=0){let re=X[j],fe=Z[j];if(fe===void 0&&(j==="instanceMatrix"&&L.instanceMatrix&&(fe=L.instanceMatrix),j==="instanceColor"&&L.instanceColor&&(fe=L.instanceColor)),re===void 0||re.attribute!==fe||fe&&re.data!==fe.data)return!0;H++}return r.attributesNum!==H||r.index!==D}function m(L,z,W,D){let X={},Z=z.attributes,H=0,he=W.getAttributes();for(let j in he)if(he[j].location>=0){let re=Z[j];re===void 0&&(j==="instanceMatrix"&&L.instanceMatrix&&(re=L.instanceMatrix),j==="instanceColor"&&L.instanceColor&&(re=L.instanceColor));let fe={};fe.attribute=re,re&&re.data&&(fe.data=re.data),X[j]=fe,H++}r.attributes=X,r.attributesNum=H,r.index=D}function y(){let L=r.newAttributes;for(let z=0,W=L.length;z<W;z++)L[z]=0}function g(L){p(L,0)}function p(L,z){let W=r.newAttributes,D=r.enabledAttributes,X=r.attributeDivisors;W[L]=1,D[L]===0&&(n.enableVertexAttribArray(L),D[L]=1),X[L]!==z&&(n.vertexAttribDivisor(L,z),X[L]=z)}function S(){let L=r.newAttributes,z=r.enabledAttributes;for(let W=0,D=z.length;W<D;W++)z[W]!==L[W]&&(n.disableVertexAttribArray(W),z[W]=0)}function C(L,z,W,D,X,Z,H){H===!0?n.vertexAttribIPointer(L,z,W,X,Z):n.vertexAttribPointer(L,z,W,D,X,Z)}function w(L,z,W,D){y();let X=D.attributes,Z=W.getAttributes(),H=z.defaultAttributeValues;for(let he in Z){let j=Z[he];if(j.location>=0){let ee=X[he];if(ee===void 0&&(he==="instanceMatrix"&&L.instanceMatrix&&(ee=L.instanceMatrix),he==="instanceColor"&&L.instanceColor&&(ee=L.instanceColor)),ee!==void 0){let re=ee.normalized,fe=ee.itemSize,de=e.get(ee);if(de===void 0)continue;let te=de.buffer,ge=de.type,ye=de.bytesPerElement,Ce=ge===n.INT||ge===n.UNSIGNED_INT||ee.gpuType===Gh;if(ee.isInterleavedBufferAttribute){let Me=ee.data,Xe=Me.isInterleavedBuffer===!0?Me.stride:Me.itemSize,lt=ee.offset;if(Me.isInstancedInterleavedBuffer||Me.isInstancedBufferAttribute){for(let He=0;He<j.locationSize;He++)p(j.location+He,Me.meshPerAttribute);L.isInstancedMesh!==!0&&D._maxInstanceCount===void 0&&(D._maxInstanceCount=Me.meshPerAttribute*Me.count)}else for(let He=0;He<j.locationSize;He++)g(j.location+He);n.bindBuffer(n.ARRAY_BUFFER,te);for(let He=0;He<j.locationSize;He++)C(j.location+He,fe/j.locationSize,ge,re,Xe*ye,(lt+fe/j.locationSize*He)*ye,Ce)}else{if(ee.isInstancedBufferAttribute){for(let Me=0;Me<j.locationSize;Me++)p(j.location+Me,ee.meshPerAttribute);L.isInstancedMesh!==!0&&D._maxInstanceCount===void 0&&(D._maxInstanceCount=ee.meshPerAttribute*ee.count)}else for(let Me=0;Me<j.locationSize;Me++)g(j.location+Me);n.bindBuffer(n.ARRAY_BUFFER,te);for(let Me=0;Me<j.locationSize;Me++)C(j.location+Me,fe/j.locationSize,ge,re,fe*ye,fe/j.locationSize*Me*ye,Ce)}}else if(H!==void 0){let re=H[he];if(re!==void 0)switch(re.length){case 2:n.vertexAttrib2fv(j.location,re);break;case 3:n.vertexAttrib3fv(j.location,re);break;case 4:n.vertexAttrib4fv(j.location,re);break;default:n.vertexAttrib1fv(j.location,re)}}}}S()}function P(){k();for(let L in i){let z=i[L];for(let W in z){let D=z[W];for(let X in D){let Z=D[X];for(let H in Z)h(Z[H].object),delete Z[H];delete D[X]}}delete i[L]}}function E(L){if(i[L.id]===void 0)return;let z=i[L.id];for(let W in z){let D=z[W];for(let X in D){let Z=D[X];for(let H in Z)h(Z[H].object),delete Z[H];delete D[X]}}delete i[L.id]}function x(L){for(let z in i){let W=i[z];for(let D in W){let X=W[D];if(X[L.id]===void 0)continue;let Z=X[L.id];for(let H in Z)h(Z[H].object),delete Z[H];delete X[L.id]}}}function T(L){for(let z in i){let W=i[z],D=L.isInstancedMesh===!0?L.id:0,X=W[D];if(X!==void 0){for(let Z in X){let H=X[Z];for(let he in H)h(H[he].object),delete H[he];delete X[Z]}delete W[D],Object.keys(W).length===0&&delete i[z]}}}function k(){N(),o=!0,r!==s&&(r=s,c(r.object))}function N(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:a,reset:k,resetDefaultState:N,dispose:P,releaseStatesOfGeometry:E,releaseStatesOfObject:T,releaseStatesOfProgram:x,initAttributes:y,enableAttribute:g,disableUnusedAttributes:S}}function PT(n,e,t){let i;function s(l){i=l}function r(l,c){n.drawArrays(i,l,c),t.update(c,i,1)}function o(l,c,h){h!==0&&(n.drawArraysInstanced(i,l,c,h),t.update(c,i,h))}function a(l,c,h){if(h===0)return;e.get("WEBGL_multi_draw").multiDrawArraysWEBGL(i,l,0,c,0,h);let d=0;for(let f=0;f<h;f++)d+=c[f];t.update(d,i,1)}this.setMode=s,this.render=r,this.renderInstances=o,this.renderMultiDraw=a}function IT(n,e,t,i){let s;function r(){if(s!==void 0)return s;if(e.has("EXT_texture_filter_anisotropic")===!0){let x=e.get("EXT_texture_filter_anisotropic");s=n.getParameter(x.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function o(x){return!(x!==Qi&&i.convert(x)!==n.getParameter(n.IMPLEMENTATION_COLOR_READ_FORMAT))}function a(x){let T=x===ji&&(e.has("EXT_color_buffer_half_float")||e.has("EXT_color_buffer_float"));return!(x!==ui&&x!==Ji&&!T&&i.convert(x)!==n.getParameter(n.IMPLEMENTATION_COLOR_READ_TYPE))}function l(x){if(x==="highp"){if(n.getShaderPrecisionFormat(n.VERTEX_SHADER,n.HIGH_FLOAT).precision>0&&n.getShaderPrecisionFormat(n.FRAGMENT_SHADER,n.HIGH_FLOAT).precision>0)return"highp";x="mediump"}return x==="mediump"&&n.getShaderPrecisionFormat(n.VERTEX_SHADER,n.MEDIUM_FLOAT).precision>0&&n.getShaderPrecisionFormat(n.FRAGMENT_SHADER,n.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let c=t.precision!==void 0?t.precision:"highp",h=l(c);h!==c&&(Ke("WebGLRenderer:",c,"not supported, using",h,"instead."),c=h);let u=t.reversedDepthBuffer===!0&&e.has("EXT_clip_control"),d=t.logarithmicDepthBuffer===!0&&u===!1;t.reversedDepthBuffer===!0&&u===!1&&Ke("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),t.logarithmicDepthBuffer===!0&&u===!0&&Ke("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let f=n.getParameter(n.MAX_TEXTURE_IMAGE_UNITS),m=n.getParameter(n.MAX_VERTEX_TEXTURE_IMAGE_UNITS),y=n.getParameter(n.MAX_TEXTURE_SIZE),g=n.getParameter(n.MAX_CUBE_MAP_TEXTURE_SIZE),p=n.getParameter(n.MAX_VERTEX_ATTRIBS),S=n.getParameter(n.MAX_VERTEX_UNIFORM_VECTORS),C=n.getParameter(n.MAX_VARYING_VECTORS),w=n.getParameter(n.MAX_FRAGMENT_UNIFORM_VECTORS),P=n.getParameter(n.MAX_SAMPLES),E=n.getParameter(n.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:l,textureFormatReadable:o,textureTypeReadable:a,precision:c,logarithmicDepthBuffer:d,reversedDepthBuffer:u,maxTextures:f,maxVertexTextures:m,maxTextureSize:y,maxCubemapSize:g,maxAttributes:p,maxVertexUniforms:S,maxVaryings:C,maxFragmentUniforms:w,maxSamples:P,samples:E}}function DT(n){let e=this,t=null,i=0,s=!1,r=!1,o=new Ei,a=new Qe,l={value:null,needsUpdate:!1};this.uniform=l,this.numPlanes=0,this.numIntersection=0,this.init=function(u,d){let f=u.length!==0||d||i!==0||s;return s=d,i=u.length,f},this.beginShadows=function(){r=!0,h(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(u,d){t=h(u,d,0)},this.setState=function(u,d,f){let m=u.clippingPlanes,y=u.clipIntersection,g=u.clipShadows,p=n.get(u);if(!s||m===null||m.length===0||r&&!g)r?h(null):c();else{let S=r?0:i,C=S*4,w=p.clippingState||null;l.value=w,w=h(m,d,C,f);for(let P=0;P!==C;++P)w[P]=t[P];p.clippingState=w,this.numIntersection=y?this.numPlanes:0,this.numPlanes+=S}};function c(){l.value!==t&&(l.value=t,l.needsUpdate=i>0),e.numPlanes=i,e.numIntersection=0}function h(u,d,f,m){let y=u!==null?u.length:0,g=null;if(y!==0){if(g=l.value,m!==!0||g===null){let p=f+y*4,S=d.matrixWorldInverse;a.getNormalMatrix(S),(g===null||g.length<p)&&(g=new Float32Array(p));for(let C=0,w=f;C!==y;++C,w+=4)o.copy(u[C]).applyMatrix4(S,a),o.normal.toArray(g,w),g[w+3]=o.constant}l.value=g,l.needsUpdate=!0}return e.numPlanes=y,e.numIntersection=0,g}}var Fl=class extends Ai{constructor(e=1,t={}){super(e,e,t),this.isWebGLCubeRenderTarget=!0;let i={width:e,height:e,depth:1},s=[i,i,i,i,i,i];this.texture=new ul(s),this._setTextureOptions(t),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(e,t){this.texture.type=t.type,this.texture.colorSpace=t.colorSpace,this.texture.generateMipmaps=t.generateMipmaps,this.texture.minFilter=t.minFilter,this.texture.magFilter=t.magFilter;let i={uniforms:{tEquirect:{value:null}},vertexShader:`

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
			`},s=new mr(5,5,5),r=new vs({name:"CubemapFromEquirect",uniforms:jr(i.uniforms),vertexShader:i.vertexShader,fragmentShader:i.fragmentShader,side:li,blending:$r});r.uniforms.tEquirect.value=t;let o=new Gn(s,r),a=t.minFilter;return t.minFilter===qs&&(t.minFilter=ri),new jo(1,10,this).update(e,o),t.minFilter=a,o.geometry.dispose(),o.material.dispose(),this}clear(e,t=!0,i=!0,s=!0){let r=e.getRenderTarget();for(let o=0;o<6;o++)e.setRenderTarget(this,o),e.clear(t,i,s);e.setRenderTarget(r)}},u_=256,LT=3,NT=20,N_=256,U_=16,UT=3,FT=new O,OT=new Je,Cu=class n{constructor(e){this._renderer=e,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new jo(1,10,null),this._boxMesh=new Gn(new mr(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(e,t=0,i=.1,s=100,r={}){let{size:o=256,position:a=FT}=r,l=this._renderer;this._setSize(o);let c=this._allocateTarget(),h=this._getSourceTarget(!0);t>0&&(h.texture.mipmapsAutoUpdate=!1);let u=l.autoClear,d=l.autoClearColor,f=l.autoClearDepth,m=l.autoClearStencil,y=e.background;l.autoClear=!0,l.autoClearColor=!0,l.autoClearDepth=!0,l.autoClearStencil=!0,y===null&&(e.background=l.getClearColor(OT));let g=new jo(i,s,h);return g.position.copy(a),g.update(l,e),l.autoClear=u,l.autoClearColor=d,l.autoClearDepth=f,l.autoClearStencil=m,e.background=y,t>0&&(h.texture.mipmapsAutoUpdate=!0,this._blur(c,t)),this._applyPMREM(c),c}fromEquirectangular(e,t=null){return this._fromTexture(e,t)}fromCubemap(e,t=null){return this._fromTexture(e,t)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=p_(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=f_(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(e,t){return t>0?1-Math.sqrt(1-e/t):0}_setSize(e){this._cubeSize=Math.max(u_,hp(e))}_fromTexture(e,t){e.mapping===Kr||e.mapping===na?this._setSize(e.image.length===0?u_:e.image[0].width||e.image[0].image.width):this._setSize(e.image.width/4);let i=t||this._allocateTarget();return this._textureToCubemap(e),this._applyPMREM(i),i}_allocateTarget(){let e=this._cubeSize,t=d_(e,!1,!1),i=Math.log2(e)-LT;for(let s=0;s<=i;s++)t.texture.mipmaps.push({width:e>>s,height:e>>s});return t.texture.name="PMREM",t.texture.isPMREMTexture=!0,t}_getSourceTarget(e=!1){let t=this._cubeSize,i=this._sourceTarget;return(i===null||i.width!==t||e&&i.depthBuffer===!1)&&(i!==null&&i.dispose(),this._sourceTarget=d_(t,!0,e)),this._sourceTarget}_compileMaterial(e){this._boxMesh.material=e,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(e,t,i){let s=this._boxMesh,r=this._cubeCamera;s.material=i,r.renderTarget=e,r.activeMipmapLevel=t;let o=e.width>>t;e.viewport.set(0,0,o,o),r.update(this._renderer,s),e.viewport.set(0,0,e.width,e.height)}_textureToCubemap(e){let t;e.mapping===Kr||e.mapping===na?(this._cubemapMaterial===null&&(this._cubemapMaterial=p_()),t=this._cubemapMaterial,t.uniforms.flipEnvMap.value=e.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=f_()),t=this._equirectMaterial),t.uniforms.envMap.value=e,this._renderCube(this._getSourceTarget(),0,t)}_applyPMREM(e){this._ggxMaterial===null&&(this._ggxMaterial=BT(),this._integrationMaterial=kT());let t=this._cubeSize,i=e.texture.mipmaps.length-1,s=this._ggxMaterial.uniforms;s.envMap.value=this._sourceTarget.texture;let r=this._integrationMaterial.uniforms;r.envMap.value=this._sourceTarget.texture,r.sourceLod.value=Math.log2(t/U_);for(let o=0;o<=i;o++){let a=n.lodToRoughness(o,i);if(o>i-UT)r.roughness.value=a,this._renderCube(e,o,this._integrationMaterial);else{let l=a>0?Math.log2(t)+.5*Math.log2(6/(N_*Math.pow(a,4)))+.5:0;s.roughness.value=a,s.lodBias.value=l,this._renderCube(e,o,this._ggxMaterial)}}}_blur(e,t){this._blurMaterial===null&&(this._blurMaterial=zT());let i=this._blurMaterial,s=i.uniforms,r=this._sourceTarget;s.sigma.value=Math.min(t,Math.PI)/Math.SQRT2,s.envMap.value=r.texture,this._renderCube(e,0,i),s.envMap.value=e.texture,this._renderCube(r,0,i)}};function d_(n,e,t){return new Fl(n,{minFilter:qs,generateMipmaps:e,type:ji,colorSpace:tl,depthBuffer:t})}function Ol(n,e,t){return new vs({name:n,uniforms:e,vertexShader:pt.cube_vert,fragmentShader:t,side:li,blending:$r,depthTest:!1,depthWrite:!1})}function BT(){return Ol("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${N_}u

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
	`)}function kT(){return Ol("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:U_}},`

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
	`)}function zT(){return Ol("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${NT}
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
	`)}function f_(){return Ol("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

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
	`)}function p_(){return Ol("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function VT(n){let e=new WeakMap,t=new WeakMap,i=null;function s(d,f=!1){return d==null?null:f?o(d):r(d)}function r(d){if(d&&d.isTexture){let f=d.mapping;if(f===kh||f===zh)if(e.has(d)){let m=e.get(d).texture;return a(m,d.mapping)}else{let m=d.image;if(m&&m.height>0){let y=new Fl(m.height);return y.fromEquirectangularTexture(n,d),e.set(d,y),d.addEventListener("dispose",c),a(y.texture,d.mapping)}else return null}}return d}function o(d){if(d&&d.isTexture&&d.isPMREMTexture!==!0){let f=d.mapping,m=f===kh||f===zh,y=f===Kr||f===na;if(m||y){let g=t.get(d),p=g!==void 0?g.texture.pmremVersion:0;if(d.isRenderTargetTexture&&d.pmremVersion!==p)return i===null&&(i=new Cu(n)),g=m?i.fromEquirectangular(d,g):i.fromCubemap(d,g),g.texture.pmremVersion=d.pmremVersion,t.set(d,g),g.texture;if(g!==void 0)return g.texture;{let S=d.image;return m&&S&&S.height>0||y&&S&&l(S)?(i===null&&(i=new Cu(n)),g=m?i.fromEquirectangular(d):i.fromCubemap(d),g.texture.pmremVersion=d.pmremVersion,t.set(d,g),d.addEventListener("dispose",h),g.texture):null}}}return d}function a(d,f){return f===kh?d.mapping=Kr:f===zh&&(d.mapping=na),d}function l(d){let f=0,m=6;for(let y=0;y<m;y++)d[y]!==void 0&&f++;return f===m}function c(d){let f=d.target;f.removeEventListener("dispose",c);let m=e.get(f);m!==void 0&&(e.delete(f),m.dispose())}function h(d){let f=d.target;f.removeEventListener("dispose",h);let m=t.get(f);m!==void 0&&(t.delete(f),m.dispose())}function u(){e=new WeakMap,t=new WeakMap,i!==null&&(i.dispose(),i=null)}return{get:s,dispose:u}}function GT(n){let e={};function t(i){if(e[i]!==void 0)return e[i];let s=n.getExtension(i);return e[i]=s,s}return{has:function(i){return t(i)!==null},init:function(){t("EXT_color_buffer_float"),t("WEBGL_clip_cull_distance"),t("OES_texture_float_linear"),t("EXT_color_buffer_half_float"),t("WEBGL_multisampled_render_to_texture"),t("WEBGL_render_shared_exponent")},get:function(i){let s=t(i);return s===null&&Ja("WebGLRenderer: "+i+" extension not supported."),s}}}function HT(n,e,t,i){let s={},r=new WeakMap,o=new FinalizationRegistry(m=>delete s[m]);function a(m){l(m.target)}function l(m){m.index!==null&&e.remove(m.index);for(let g in m.attributes)e.remove(m.attributes[g]);m.removeEventListener("dispose",a),delete s[m.id],o.unregister(m);let y=r.get(m);y&&(e.remove(y),r.delete(m)),i.releaseStatesOfGeometry(m),m.isInstancedBufferGeometry===!0&&delete m._maxInstanceCount,t.memory.geometries--}function c(m,y){return s[y.id]!==void 0||(y.addEventListener("dispose",a),s[y.id]=new WeakRef(y),o.register(y,y.id,y),t.memory.geometries++),y}function h(m){let y=m.attributes;for(let g in y)e.update(y[g],n.ARRAY_BUFFER)}function u(m){let y=m.index,g=m.attributes.position,p=0;if(g===void 0)return;let S=y!==null?y.array.length:g.array.length/3-1,C=g.count>=65535?cl:ll,w=new C(Math.ceil(S/3)*6,1),P=w.array;if(y!==null){let x=y.array;p=y.version;for(let T=0,k=0;T<S;T+=3){let N=x[T+0],L=x[T+1],z=x[T+2];P[k++]=N,P[k++]=L,P[k++]=L,P[k++]=z,P[k++]=z,P[k++]=N}}else{p=g.version;for(let x=0,T=0;x<S;x+=3){let k=x+0,N=x+1,L=x+2;P[T++]=k,P[T++]=N,P[T++]=N,P[T++]=L,P[T++]=L,P[T++]=k}}w.version=p;let E=r.get(m);E&&e.remove(E),r.set(m,w)}function d(m){let y=r.get(m);if(y){let g=m.index;g!==null&&y.version<g.version&&u(m)}else u(m);return r.get(m)}function f(){for(let m in s){let y=s[m].deref();y!==void 0&&l(y)}}return{get:c,update:h,getWireframeAttribute:d,dispose:f}}function WT(n,e,t){let i;function s(u){i=u}let r,o;function a(u){r=u.type,o=u.bytesPerElement}function l(u,d){n.drawElements(i,d,r,u*o),t.update(d,i,1)}function c(u,d,f){f!==0&&(n.drawElementsInstanced(i,d,r,u*o,f),t.update(d,i,f))}function h(u,d,f){if(f===0)return;e.get("WEBGL_multi_draw").multiDrawElementsWEBGL(i,d,0,r,u,0,f);let y=0;for(let g=0;g<f;g++)y+=d[g];t.update(y,i,1)}this.setMode=s,this.setIndex=a,this.render=l,this.renderInstances=c,this.renderMultiDraw=h}function XT(n){let e={geometries:0,textures:0},t={frame:0,calls:0,triangles:0,points:0,lines:0};function i(r,o,a){switch(t.calls++,o){case n.TRIANGLES:t.triangles+=a*(r/3);break;case n.LINES:t.lines+=a*(r/2);break;case n.LINE_STRIP:t.lines+=a*(r-1);break;case n.LINE_LOOP:t.lines+=a*r;break;case n.POINTS:t.points+=a*r;break;default:st("WebGLInfo: Unknown draw mode:",o);break}}function s(){t.calls=0,t.triangles=0,t.points=0,t.lines=0}return{memory:e,render:t,programs:null,autoReset:!0,reset:s,update:i}}function qT(n,e,t){let i=new WeakMap,s=new nn;function r(o,a,l){let c=o.morphTargetInfluences,h=a.morphAttributes.position||a.morphAttributes.normal||a.morphAttributes.color,u=h!==void 0?h.length:0,d=i.get(a);if(d===void 0||d.count!==u){let k=function(){x.dispose(),i.delete(a),a.removeEventListener("dispose",k)};d!==void 0&&d.texture.dispose();let f=a.morphAttributes.position!==void 0,m=a.morphAttributes.normal!==void 0,y=a.morphAttributes.color!==void 0,g=a.morphAttributes.position||[],p=a.morphAttributes.normal||[],S=a.morphAttributes.color||[],C=0;f===!0&&(C=1),m===!0&&(C=2),y===!0&&(C=3);let w=a.attributes.position.count*C,P=1;w>e.maxTextureSize&&(P=Math.ceil(w/e.maxTextureSize),w=e.maxTextureSize);let E=new Float32Array(w*P*4*u),x=new rl(E,w,P,u);x.type=Ji,x.needsUpdate=!0;let T=C*4;for(let N=0;N<u;N++){let L=g[N],z=p[N],W=S[N],D=w*P*4*N;for(let X=0;X<L.count;X++){let Z=X*T;f===!0&&(s.fromBufferAttribute(L,X),E[D+Z+0]=s.x,E[D+Z+1]=s.y,E[D+Z+2]=s.z,E[D+Z+3]=0),m===!0&&(s.fromBufferAttribute(z,X),E[D+Z+4]=s.x,E[D+Z+5]=s.y,E[D+Z+6]=s.z,E[D+Z+7]=0),y===!0&&(s.fromBufferAttribute(W,X),E[D+Z+8]=s.x,E[D+Z+9]=s.y,E[D+Z+10]=s.z,E[D+Z+11]=W.itemSize===4?s.w:1)}}d={count:u,texture:x,size:new $e(w,P)},i.set(a,d),a.addEventListener("dispose",k)}if(o.isInstancedMesh===!0&&o.morphTexture!==null)l.getUniforms().setValue(n,"morphTexture",o.morphTexture,t);else{let f=0;for(let y=0;y<c.length;y++)f+=c[y];let m=a.morphTargetsRelative?1:1-f;l.getUniforms().setValue(n,"morphTargetBaseInfluence",m),l.getUniforms().setValue(n,"morphTargetInfluences",c)}l.getUniforms().setValue(n,"morphTargetsTexture",d.texture,t),l.getUniforms().setValue(n,"morphTargetsTextureSize",d.size)}return{update:r}}function YT(n,e,t,i,s){let r=new WeakMap;function o(c){let h=s.render.frame,u=c.geometry,d=e.get(c,u);if(r.get(d)!==h&&(e.update(d),r.set(d,h)),c.isInstancedMesh&&(c.hasEventListener("dispose",l)===!1&&c.addEventListener("dispose",l),r.get(c)!==h&&(t.update(c.instanceMatrix,n.ARRAY_BUFFER),c.instanceColor!==null&&t.update(c.instanceColor,n.ARRAY_BUFFER),r.set(c,h))),c.isSkinnedMesh){let f=c.skeleton;r.get(f)!==h&&(f.update(),r.set(f,h))}return d}function a(){r=new WeakMap}function l(c){let h=c.target;h.removeEventListener("dispose",l),i.releaseStatesOfObject(h),t.remove(h.instanceMatrix),h.instanceColor!==null&&t.remove(h.instanceColor)}return{update:o,dispose:a}}var $T={[Hf]:"LINEAR_TONE_MAPPING",[Wf]:"REINHARD_TONE_MAPPING",[Xf]:"CINEON_TONE_MAPPING",[qf]:"ACES_FILMIC_TONE_MAPPING",[$f]:"AGX_TONE_MAPPING",[Zf]:"NEUTRAL_TONE_MAPPING",[Yf]:"CUSTOM_TONE_MAPPING"};function ZT(n,e,t,i,s,r){let o=new Ai(e,t,{type:n,depthBuffer:s,stencilBuffer:r,samples:i?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),a=null,l=null,c=null,h=new qt;h.setAttribute("position",new dn([-1,3,0,-1,-1,0,3,-1,0],3)),h.setAttribute("uv",new dn([0,2,0,0,2,0],2));let u=new Mh({uniforms:{tDiffuse:{value:null}},vertexShader:`
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
			}`,depthTest:!1,depthWrite:!1}),d=new Gn(h,u),f=new bl(-1,1,1,-1,0,1),m=null,y=null,g=!1,p,S=null,C=[],w=!1;this.setSize=function(P,E){o.setSize(P,E),a!==null&&a.setSize(P,E),l!==null&&l.setSize(P,E);for(let x=0;x<C.length;x++){let T=C[x];T.setSize&&T.setSize(P,E)}},this.setEffects=function(P){C=P,w=C.length>0&&C[0].isRenderPass===!0;let E=o.width,x=o.height;C.length>0&&a===null&&(a=new Ai(E,x,{type:ji,depthBuffer:!1,stencilBuffer:!1}),l=new Ai(E,x,{type:ji,depthBuffer:!1,stencilBuffer:!1}));let T=s===!0&&C.some(k=>k.needsDepthTexture===!0);T!==(o.depthTexture!==null)&&(T===!0&&c===null&&(c=new Xs(E,x),r===!0&&(c.format=Ys,c.type=Jr)),o.dispose(),o.depthTexture=T?c:null,o.resolveDepthBuffer=T,o.storeMultisampledDepthBuffer=T);for(let k=0;k<C.length;k++){let N=C[k];N.setSize&&N.setSize(E,x),T&&N.needsDepthTexture===!0&&N.setDepthTexture&&N.setDepthTexture(c)}},this.begin=function(P,E){if(g||P.toneMapping===Ss&&C.length===0)return!1;if(S=E,E!==null){let x=E.width,T=E.height;(o.width!==x||o.height!==T)&&this.setSize(x,T)}return w===!1&&P.setRenderTarget(o),p=P.toneMapping,P.toneMapping=Ss,!0},this.hasRenderPass=function(){return w},this.end=function(P,E){P.toneMapping=p,g=!0;let x=o,T=a;for(let k=0;k<C.length;k++){let N=C[k];N.enabled!==!1&&(N.render(P,T,x,E),N.needsSwap!==!1&&(x=T,T=T===a?l:a))}if(m!==P.outputColorSpace||y!==P.toneMapping){m=P.outputColorSpace,y=P.toneMapping,u.defines={},bt.getTransfer(m)===Lt&&(u.defines.SRGB_TRANSFER="");let k=$T[y];k&&(u.defines[k]=""),u.needsUpdate=!0}u.uniforms.tDiffuse.value=x.texture,P.setRenderTarget(S),P.render(d,f),S=null,g=!1},this.isCompositing=function(){return g},this.dispose=function(){o.dispose(),a!==null&&a.dispose(),l!==null&&l.dispose(),h.dispose(),u.dispose()}}var F_=new ai,O_=new Xs(1,1),B_=new fl(1),k_=new rl,z_=new _h,V_=new ul,m_=[],g_=[],__=new Float32Array(16),x_=new Float32Array(9),y_=new Float32Array(4);function ra(n,e,t){let i=n[0];if(i<=0||i>0)return n;let s=e*t,r=m_[s];if(r===void 0&&(r=new Float32Array(s),m_[s]=r),e!==0){i.toArray(r,0);for(let o=1,a=0;o!==e;++o)a+=t,n[o].toArray(r,a)}return r}function Cn(n,e){if(n.length!==e.length)return!1;for(let t=0,i=n.length;t<i;t++)if(n[t]!==e[t])return!1;return!0}function Rn(n,e){for(let t=0,i=e.length;t<i;t++)n[t]=e[t]}function Pu(n,e){let t=g_[e];t===void 0&&(t=new Int32Array(e),g_[e]=t);for(let i=0;i!==e;++i)t[i]=n.allocateTextureUnit();return t}function KT(n,e){let t=this.cache;t[0]!==e&&(n.uniform1f(this.addr,e),t[0]=e)}function JT(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(n.uniform2f(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(Cn(t,e))return;n.uniform2fv(this.addr,e),Rn(t,e)}}function jT(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(n.uniform3f(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else if(e.r!==void 0)(t[0]!==e.r||t[1]!==e.g||t[2]!==e.b)&&(n.uniform3f(this.addr,e.r,e.g,e.b),t[0]=e.r,t[1]=e.g,t[2]=e.b);else{if(Cn(t,e))return;n.uniform3fv(this.addr,e),Rn(t,e)}}function QT(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(n.uniform4f(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(Cn(t,e))return;n.uniform4fv(this.addr,e),Rn(t,e)}}function eE(n,e){let t=this.cache,i=e.elements;if(i===void 0){if(Cn(t,e))return;n.uniformMatrix2fv(this.addr,!1,e),Rn(t,e)}else{if(Cn(t,i))return;y_.set(i),n.uniformMatrix2fv(this.addr,!1,y_),Rn(t,i)}}function tE(n,e){let t=this.cache,i=e.elements;if(i===void 0){if(Cn(t,e))return;n.uniformMatrix3fv(this.addr,!1,e),Rn(t,e)}else{if(Cn(t,i))return;x_.set(i),n.uniformMatrix3fv(this.addr,!1,x_),Rn(t,i)}}function nE(n,e){let t=this.cache,i=e.elements;if(i===void 0){if(Cn(t,e))return;n.uniformMatrix4fv(this.addr,!1,e),Rn(t,e)}else{if(Cn(t,i))return;__.set(i),n.uniformMatrix4fv(this.addr,!1,__),Rn(t,i)}}function iE(n,e){let t=this.cache;t[0]!==e&&(n.uniform1i(this.addr,e),t[0]=e)}function sE(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(n.uniform2i(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(Cn(t,e))return;n.uniform2iv(this.addr,e),Rn(t,e)}}function rE(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(n.uniform3i(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(Cn(t,e))return;n.uniform3iv(this.addr,e),Rn(t,e)}}function oE(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(n.uniform4i(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(Cn(t,e))return;n.uniform4iv(this.addr,e),Rn(t,e)}}function aE(n,e){let t=this.cache;t[0]!==e&&(n.uniform1ui(this.addr,e),t[0]=e)}function lE(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(n.uniform2ui(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(Cn(t,e))return;n.uniform2uiv(this.addr,e),Rn(t,e)}}function cE(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(n.uniform3ui(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(Cn(t,e))return;n.uniform3uiv(this.addr,e),Rn(t,e)}}function hE(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(n.uniform4ui(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(Cn(t,e))return;n.uniform4uiv(this.addr,e),Rn(t,e)}}function Iu(n){return n.version===0&&(n.compareFunction=op,n.needsUpdate=!0),n}function uE(n,e,t){let i=this.cache,s=t.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s);let r;this.type===n.SAMPLER_2D_SHADOW?r=Iu(O_):r=F_,t.setTexture2D(e||r,s)}function dE(n,e,t){let i=this.cache,s=t.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s),t.setTexture3D(e||z_,s)}function fE(n,e,t){let i=this.cache,s=t.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s);let r;this.type===n.SAMPLER_CUBE_SHADOW?r=Iu(B_):r=V_,t.setTextureCube(e||r,s)}function pE(n,e,t){let i=this.cache,s=t.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s),t.setTexture2DArray(e||k_,s)}function mE(n){switch(n){case 5126:return KT;case 35664:return JT;case 35665:return jT;case 35666:return QT;case 35674:return eE;case 35675:return tE;case 35676:return nE;case 5124:case 35670:return iE;case 35667:case 35671:return sE;case 35668:case 35672:return rE;case 35669:case 35673:return oE;case 5125:return aE;case 36294:return lE;case 36295:return cE;case 36296:return hE;case 35678:case 36198:case 36298:case 36306:case 35682:return uE;case 35679:case 36299:case 36307:return dE;case 35680:case 36300:case 36308:case 36293:return fE;case 36289:case 36303:case 36311:case 36292:return pE}}function gE(n,e){n.uniform1fv(this.addr,e)}function _E(n,e){let t=ra(e,this.size,2);n.uniform2fv(this.addr,t)}function xE(n,e){let t=ra(e,this.size,3);n.uniform3fv(this.addr,t)}function yE(n,e){let t=ra(e,this.size,4);n.uniform4fv(this.addr,t)}function vE(n,e){let t=ra(e,this.size,4);n.uniformMatrix2fv(this.addr,!1,t)}function SE(n,e){let t=ra(e,this.size,9);n.uniformMatrix3fv(this.addr,!1,t)}function bE(n,e){let t=ra(e,this.size,16);n.uniformMatrix4fv(this.addr,!1,t)}function ME(n,e){n.uniform1iv(this.addr,e)}function wE(n,e){n.uniform2iv(this.addr,e)}function TE(n,e){n.uniform3iv(this.addr,e)}function EE(n,e){n.uniform4iv(this.addr,e)}function AE(n,e){n.uniform1uiv(this.addr,e)}function CE(n,e){n.uniform2uiv(this.addr,e)}function RE(n,e){n.uniform3uiv(this.addr,e)}function PE(n,e){n.uniform4uiv(this.addr,e)}function IE(n,e,t){let i=this.cache,s=e.length,r=Pu(t,s);Cn(i,r)||(n.uniform1iv(this.addr,r),Rn(i,r));let o;this.type===n.SAMPLER_2D_SHADOW?o=Iu(O_):o=F_;for(let a=0;a!==s;++a)t.setTexture2D(e[a]||o,r[a])}function DE(n,e,t){let i=this.cache,s=e.length,r=Pu(t,s);Cn(i,r)||(n.uniform1iv(this.addr,r),Rn(i,r));for(let o=0;o!==s;++o)t.setTexture3D(e[o]||z_,r[o])}function LE(n,e,t){let i=this.cache,s=e.length,r=Pu(t,s);Cn(i,r)||(n.uniform1iv(this.addr,r),Rn(i,r));let o;this.type===n.SAMPLER_CUBE_SHADOW?o=Iu(B_):o=V_;for(let a=0;a!==s;++a)t.setTextureCube(e[a]||o,r[a])}function NE(n,e,t){let i=this.cache,s=e.length,r=Pu(t,s);Cn(i,r)||(n.uniform1iv(this.addr,r),Rn(i,r));for(let o=0;o!==s;++o)t.setTexture2DArray(e[o]||k_,r[o])}function UE(n){switch(n){case 5126:return gE;case 35664:return _E;case 35665:return xE;case 35666:return yE;case 35674:return vE;case 35675:return SE;case 35676:return bE;case 5124:case 35670:return ME;case 35667:case 35671:return wE;case 35668:case 35672:return TE;case 35669:case 35673:return EE;case 5125:return AE;case 36294:return CE;case 36295:return RE;case 36296:return PE;case 35678:case 36198:case 36298:case 36306:case 35682:return IE;case 35679:case 36299:case 36307:return DE;case 35680:case 36300:case 36308:case 36293:return LE;case 36289:case 36303:case 36311:case 36292:return NE}}var vp=class{constructor(e,t,i){this.id=e,this.addr=i,this.cache=[],this.type=t.type,this.setValue=mE(t.type)}},Sp=class{constructor(e,t,i){this.id=e,this.addr=i,this.cache=[],this.type=t.type,this.size=t.size,this.setValue=UE(t.type)}},bp=class{constructor(e){this.id=e,this.seq=[],this.map={}}setValue(e,t,i){let s=this.seq;for(let r=0,o=s.length;r!==o;++r){let a=s[r];a.setValue(e,t[a.id],i)}}},xp=/(\w+)(\])?(\[|\.)?/g;function v_(n,e){n.seq.push(e),n.map[e.id]=e}function FE(n,e,t){let i=n.name,s=i.length;for(xp.lastIndex=0;;){let r=xp.exec(i),o=xp.lastIndex,a=r[1],l=r[2]==="]",c=r[3];if(l&&(a=a|0),c===void 0||c==="["&&o+2===s){v_(t,c===void 0?new vp(a,n,e):new Sp(a,n,e));break}else{let u=t.map[a];u===void 0&&(u=new bp(a),v_(t,u)),t=u}}}var sa=class{constructor(e,t){this.seq=[],this.map={};let i=e.getProgramParameter(t,e.ACTIVE_UNIFORMS);for(let o=0;o<i;++o){let a=e.getActiveUniform(t,o),l=e.getUniformLocation(t,a.name);FE(a,l,this)}let s=[],r=[];for(let o of this.seq)o.type===e.SAMPLER_2D_SHADOW||o.type===e.SAMPLER_CUBE_SHADOW||o.type===e.SAMPLER_2D_ARRAY_SHADOW?s.push(o):r.push(o);s.length>0&&(this.seq=s.concat(r))}setValue(e,t,i,s){let r=this.map[t];r!==void 0&&r.setValue(e,i,s)}setOptional(e,t,i){let s=t[i];s!==void 0&&this.setValue(e,i,s)}static upload(e,t,i,s){for(let r=0,o=t.length;r!==o;++r){let a=t[r],l=i[a.id];l.needsUpdate!==!1&&a.setValue(e,l.value,s)}}static seqWithValue(e,t){let i=[];for(let s=0,r=e.length;s!==r;++s){let o=e[s];o.id in t&&i.push(o)}return i}};function S_(n,e,t){let i=n.createShader(e);return n.shaderSource(i,t),n.compileShader(i),i}var OE=37297,BE=0;function kE(n,e){let t=n.split(`
`),i=[],s=Math.max(e-6,0),r=Math.min(e+6,t.length);for(let o=s;o<r;o++){let a=o+1;i.push(`${a===e?">":" "} ${a}: ${t[o]}`)}return i.join(`
`)}var b_=new Qe;function zE(n){bt._getMatrix(b_,bt.workingColorSpace,n);let e=`mat3( ${b_.elements.map(t=>t.toFixed(4))} )`;switch(bt.getTransfer(n)){case nl:return[e,"LinearTransferOETF"];case Lt:return[e,"sRGBTransferOETF"];default:return Ke("WebGLProgram: Unsupported color space: ",n),[e,"LinearTransferOETF"]}}function M_(n,e,t){let i=n.getShaderParameter(e,n.COMPILE_STATUS),r=(n.getShaderInfoLog(e)||"").trim();if(i&&r==="")return"";let o=/ERROR: 0:(\d+)/.exec(r);if(o){let a=parseInt(o[1]);return t.toUpperCase()+`

`+r+`

`+kE(n.getShaderSource(e),a)}else return r}function VE(n,e){let t=zE(e);return[`vec4 ${n}( vec4 value ) {`,`	return ${t[1]}( vec4( ${t[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var GE={[Hf]:"Linear",[Wf]:"Reinhard",[Xf]:"Cineon",[qf]:"ACESFilmic",[$f]:"AgX",[Zf]:"Neutral",[Yf]:"Custom"};function HE(n,e){let t=GE[e];return t===void 0?(Ke("WebGLProgram: Unsupported toneMapping:",e),"vec3 "+n+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+n+"( vec3 color ) { return "+t+"ToneMapping( color ); }"}var Au=new O;function WE(){bt.getLuminanceCoefficients(Au);let n=Au.x.toFixed(4),e=Au.y.toFixed(4),t=Au.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${n}, ${e}, ${t} );`,"	return dot( weights, rgb );","}"].join(`
`)}function XE(n){return[n.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",n.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(Ul).join(`
`)}function qE(n){let e=[];for(let t in n){let i=n[t];i!==!1&&e.push("#define "+t+" "+i)}return e.join(`
`)}function YE(n,e){let t={},i=n.getProgramParameter(e,n.ACTIVE_ATTRIBUTES);for(let s=0;s<i;s++){let r=n.getActiveAttrib(e,s),o=r.name,a=1;r.type===n.FLOAT_MAT2&&(a=2),r.type===n.FLOAT_MAT3&&(a=3),r.type===n.FLOAT_MAT4&&(a=4),t[o]={type:r.type,location:n.getAttribLocation(e,o),locationSize:a}}return t}function Ul(n){return n!==""}function w_(n,e){let t=e.numSpotLightShadows+e.numSpotLightMaps-e.numSpotLightShadowsWithMaps;return n.replace(/NUM_SUN_LIGHTS/g,e.numSunLights).replace(/NUM_DIR_LIGHTS/g,e.numDirLights).replace(/NUM_SPOT_LIGHTS/g,e.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,e.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,t).replace(/NUM_RECT_AREA_LIGHTS/g,e.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,e.numPointLights).replace(/NUM_HEMI_LIGHTS/g,e.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,e.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,e.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,e.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,e.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,e.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,e.numLightProbeGrids)}function T_(n,e){return n.replace(/NUM_CLIPPING_PLANES/g,e.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,e.numClippingPlanes-e.numClipIntersection)}var $E=/^[ \t]*#include +<([\w\d./]+)>/gm;function Mp(n){return n.replace($E,ZE)}function ZE(n,e){let t=pt[e];if(t===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+e+">");return Mp(t)}var KE=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function E_(n){return n.replace(KE,JE)}function JE(n,e,t,i){let s="";for(let r=parseInt(e);r<parseInt(t);r++)s+=i.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return s}function A_(n){let e=`precision ${n.precision} float;
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
#define LOW_PRECISION`),e}var jE={[El]:"SHADOWMAP_TYPE_PCF",[ea]:"SHADOWMAP_TYPE_VSM"};function QE(n){return jE[n.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var e1={[na]:"ENVMAP_MODE_REFRACTION"};function t1(n){return n.envMap===!1?"ENVMAP_MODE_REFLECTION":e1[n.envMapMode]||"ENVMAP_MODE_REFLECTION"}var n1={[Bh]:"ENVMAP_BLENDING_MULTIPLY",[X0]:"ENVMAP_BLENDING_MIX",[q0]:"ENVMAP_BLENDING_ADD"};function i1(n){return n.envMap===!1?"ENVMAP_BLENDING_NONE":n1[n.combine]||"ENVMAP_BLENDING_NONE"}function s1(n,e,t,i){let s=n.getContext(),r=t.defines,o=t.vertexShader,a=t.fragmentShader,l=QE(t),c=t.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",h=t1(t),u=i1(t),d=XE(t),f=qE(r),m=s.createProgram(),y,g,p=t.glslVersion?"#version "+t.glslVersion+`
`:"";t.isRawShaderMaterial?(y=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f].filter(Ul).join(`
`),y.length>0&&(y+=`
`),g=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f].filter(Ul).join(`
`),g.length>0&&(g+=`
`)):(y=[A_(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f,t.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",t.batching?"#define USE_BATCHING":"",t.batchingColor?"#define USE_BATCHING_COLOR":"",t.instancing?"#define USE_INSTANCING":"",t.instancingColor?"#define USE_INSTANCING_COLOR":"",t.instancingMorph?"#define USE_INSTANCING_MORPH":"",t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.map?"#define USE_MAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+h:"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.displacementMap?"#define USE_DISPLACEMENTMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.mapUv?"#define MAP_UV "+t.mapUv:"",t.alphaMapUv?"#define ALPHAMAP_UV "+t.alphaMapUv:"",t.lightMapUv?"#define LIGHTMAP_UV "+t.lightMapUv:"",t.aoMapUv?"#define AOMAP_UV "+t.aoMapUv:"",t.emissiveMapUv?"#define EMISSIVEMAP_UV "+t.emissiveMapUv:"",t.bumpMapUv?"#define BUMPMAP_UV "+t.bumpMapUv:"",t.normalMapUv?"#define NORMALMAP_UV "+t.normalMapUv:"",t.displacementMapUv?"#define DISPLACEMENTMAP_UV "+t.displacementMapUv:"",t.metalnessMapUv?"#define METALNESSMAP_UV "+t.metalnessMapUv:"",t.roughnessMapUv?"#define ROUGHNESSMAP_UV "+t.roughnessMapUv:"",t.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+t.anisotropyMapUv:"",t.clearcoatMapUv?"#define CLEARCOATMAP_UV "+t.clearcoatMapUv:"",t.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+t.clearcoatNormalMapUv:"",t.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+t.clearcoatRoughnessMapUv:"",t.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+t.diffuseRoughnessMapUv:"",t.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+t.iridescenceMapUv:"",t.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+t.iridescenceThicknessMapUv:"",t.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+t.sheenColorMapUv:"",t.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+t.sheenRoughnessMapUv:"",t.specularMapUv?"#define SPECULARMAP_UV "+t.specularMapUv:"",t.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+t.specularColorMapUv:"",t.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+t.specularIntensityMapUv:"",t.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+t.transmissionMapUv:"",t.thicknessMapUv?"#define THICKNESSMAP_UV "+t.thicknessMapUv:"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexNormals?"#define HAS_NORMAL":"",t.vertexColors?"#define USE_COLOR":"",t.vertexAlphas?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.flatShading?"#define FLAT_SHADED":"",t.skinning?"#define USE_SKINNING":"",t.morphTargets?"#define USE_MORPHTARGETS":"",t.morphNormals&&t.flatShading===!1?"#define USE_MORPHNORMALS":"",t.morphColors?"#define USE_MORPHCOLORS":"",t.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+t.morphTextureStride:"",t.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+t.morphTargetsCount:"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+l:"",t.sizeAttenuation?"#define USE_SIZEATTENUATION":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(Ul).join(`
`),g=[A_(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f,t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",t.map?"#define USE_MAP":"",t.matcap?"#define USE_MATCAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+c:"",t.envMap?"#define "+h:"",t.envMap?"#define "+u:"",t.envMapPMREM?"#define ENVMAP_MAX_LOD "+t.envMapMaxLod+".0":"",t.envMapPMREM?"#define ENVMAP_SIZE "+t.envMapSize+".0":"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoat?"#define USE_CLEARCOAT":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.dispersion?"#define USE_DISPERSION":"",t.retroreflection?"#define USE_RETROREFLECTION":"",t.iridescence?"#define USE_IRIDESCENCE":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaTest?"#define USE_ALPHATEST":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.sheen?"#define USE_SHEEN":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexColors||t.instancingColor?"#define USE_COLOR":"",t.vertexAlphas||t.batchingColor?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.gradientMap?"#define USE_GRADIENTMAP":"",t.flatShading?"#define FLAT_SHADED":"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+l:"",t.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",t.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",t.toneMapping!==Ss?"#define TONE_MAPPING":"",t.toneMapping!==Ss?pt.tonemapping_pars_fragment:"",t.toneMapping!==Ss?HE("toneMapping",t.toneMapping):"",t.dithering?"#define DITHERING":"",t.opaque?"#define OPAQUE":"",pt.colorspace_pars_fragment,VE("linearToOutputTexel",t.outputColorSpace),WE(),t.useDepthPacking?"#define DEPTH_PACKING "+t.depthPacking:"",`
`].filter(Ul).join(`
`)),o=Mp(o),o=w_(o,t),o=T_(o,t),a=Mp(a),a=w_(a,t),a=T_(a,t),o=E_(o),a=E_(a),t.isRawShaderMaterial!==!0&&(p=`#version 300 es
`,y=[d,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+y,g=["#define varying in",t.glslVersion===lp?"":"layout(location = 0) out highp vec4 pc_fragColor;",t.glslVersion===lp?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+g);let S=p+y+o,C=p+g+a,w=S_(s,s.VERTEX_SHADER,S),P=S_(s,s.FRAGMENT_SHADER,C);s.attachShader(m,w),s.attachShader(m,P),t.index0AttributeName!==void 0?s.bindAttribLocation(m,0,t.index0AttributeName):t.hasPositionAttribute===!0&&s.bindAttribLocation(m,0,"position"),s.linkProgram(m);function E(N){if(n.debug.checkShaderErrors){let L=s.getProgramInfoLog(m)||"",z=s.getShaderInfoLog(w)||"",W=s.getShaderInfoLog(P)||"",D=L.trim(),X=z.trim(),Z=W.trim(),H=!0,he=!0;if(s.getProgramParameter(m,s.LINK_STATUS)===!1)if(H=!1,typeof n.debug.onShaderError=="function")n.debug.onShaderError(s,m,w,P);else{let j=M_(s,w,"vertex"),ee=M_(s,P,"fragment");st("WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(m,s.VALIDATE_STATUS)+`

Material Name: `+N.name+`
Material Type: `+N.type+`

Program Info Log: `+D+`
`+j+`
`+ee)}else D!==""?Ke("WebGLProgram: Program Info Log:",D):(X===""||Z==="")&&(he=!1);he&&(N.diagnostics={runnable:H,programLog:D,vertexShader:{log:X,prefix:y},fragmentShader:{log:Z,prefix:g}})}s.deleteShader(w),s.deleteShader(P),x=new sa(s,m),T=YE(s,m)}let x;this.getUniforms=function(){return x===void 0&&E(this),x};let T;this.getAttributes=function(){return T===void 0&&E(this),T};let k=t.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return k===!1&&(k=s.getProgramParameter(m,OE)),k},this.destroy=function(){i.releaseStatesOfProgram(this),s.deleteProgram(m),this.program=void 0},this.type=t.shaderType,this.name=t.shaderName,this.id=BE++,this.cacheKey=e,this.usedTimes=1,this.program=m,this.vertexShader=w,this.fragmentShader=P,this}var r1=0,wp=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(e,t,i){let s=this._getShaderCacheForMaterial(e);return s.has(t)===!1&&(s.add(t),t.usedTimes++),s.has(i)===!1&&(s.add(i),i.usedTimes++),this}remove(e){let t=this.materialCache.get(e);for(let i of t)i.usedTimes--,i.usedTimes===0&&this.shaderCache.delete(i.code);return this.materialCache.delete(e),this}getVertexShaderStage(e){return this._getShaderStage(e.vertexShader)}getFragmentShaderStage(e){return this._getShaderStage(e.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(e){let t=this.materialCache,i=t.get(e);return i===void 0&&(i=new Set,t.set(e,i)),i}_getShaderStage(e){let t=this.shaderCache,i=t.get(e);return i===void 0&&(i=new Tp(e),t.set(e,i)),i}},Tp=class{constructor(e){this.id=r1++,this.code=e,this.usedTimes=0}};function o1(n){return n===Mr||n===Dl||n===Ll}function a1(n,e,t,i,s,r){let o=new ol,a=new wp,l=new Set,c=[],h=new Map,u=i.logarithmicDepthBuffer,d={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function f(x){return l.add(x),x===0?"uv":`uv${x}`}function m(x,T,k,N,L,z){let W=N.fog,D=L.geometry,X=x.isMeshStandardMaterial||x.isMeshLambertMaterial||x.isMeshPhongMaterial?N.environment:null,Z=x.isMeshStandardMaterial||x.isMeshLambertMaterial&&!x.envMap||x.isMeshPhongMaterial&&!x.envMap,H=e.get(x.envMap||X,Z),he=d[x.type],j=i.precision;x.precision!==null&&(j=i.getMaxPrecision(x.precision),j!==x.precision&&Ke("WebGLProgram.getParameters:",x.precision,"not supported, using",j,"instead."));let ee=D.morphAttributes.position||D.morphAttributes.normal||D.morphAttributes.color,re=ee!==void 0?ee.length:0,fe=0;D.morphAttributes.position!==void 0&&(fe=1),D.morphAttributes.normal!==void 0&&(fe=2),D.morphAttributes.color!==void 0&&(fe=3);let de,te,ge,ye;if(he){let Re=Ms[he];de=Re.vertexShader,te=Re.fragmentShader}else{de=x.vertexShader,te=x.fragmentShader;let Re=a.getVertexShaderStage(x),ht=a.getFragmentShaderStage(x);a.update(x,Re,ht),ge=Re.id,ye=ht.id}let Ce=n.getRenderTarget(),Me=n.state.buffers.depth.getReversed(),Xe=L.isInstancedMesh===!0,lt=L.isBatchedMesh===!0,He=!!x.map,mt=!!x.matcap,ut=!!H,ot=ut&&H.isPMREMTexture===!0,en=!!x.aoMap,Xt=!!x.lightMap,mn=!!x.bumpMap&&x.wireframe===!1,Bt=!!x.normalMap,Ln=!!x.displacementMap,wt=!!x.emissiveMap,wn=!!x.metalnessMap,rn=!!x.roughnessMap,gn=x.anisotropy>0,F=x.clearcoat>0,Pe=x.diffuseRoughness>0,je=x.dispersion>0,ct=x.retroreflectivity>0,we=x.iridescence>0,Gt=x.sheen>0,Ge=x.transmission>0,Ze=gn&&!!x.anisotropyMap,A=F&&!!x.clearcoatMap,v=F&&!!x.clearcoatNormalMap,q=F&&!!x.clearcoatRoughnessMap,ue=Pe&&!!x.diffuseRoughnessMap,ae=we&&!!x.iridescenceMap,xe=we&&!!x.iridescenceThicknessMap,ve=Gt&&!!x.sheenColorMap,ne=Gt&&!!x.sheenRoughnessMap,se=!!x.specularMap,me=!!x.specularColorMap,U=!!x.specularIntensityMap,oe=Ge&&!!x.transmissionMap,ie=Ge&&!!x.thicknessMap,Te=!!x.gradientMap,_e=!!x.alphaMap,be=x.alphaTest>0,We=!!x.alphaHash,tt=!!x.extensions,ce=Ss;x.toneMapped&&(Ce===null||Ce.isXRRenderTarget===!0)&&(ce=n.toneMapping);let ke=ot?H.isCompressedCubeTexture?H.image[0].mipmaps:H.mipmaps:null,nt={shaderID:he,shaderType:x.type,shaderName:x.name,vertexShader:de,fragmentShader:te,defines:x.defines,customVertexShaderID:ge,customFragmentShaderID:ye,isRawShaderMaterial:x.isRawShaderMaterial===!0,glslVersion:x.glslVersion,precision:j,batching:lt,batchingColor:lt&&L._colorsTexture!==null,instancing:Xe,instancingColor:Xe&&L.instanceColor!==null,instancingMorph:Xe&&L.morphTexture!==null,outputColorSpace:Ce===null?n.outputColorSpace:Ce.isXRRenderTarget===!0?Ce.texture.colorSpace:bt.workingColorSpace,alphaToCoverage:!!x.alphaToCoverage,map:He,matcap:mt,envMap:ut,envMapMode:ut&&H.mapping,envMapPMREM:ot,envMapMaxLod:ot?ke.length-1:null,envMapSize:ot?ke[0].width:null,aoMap:en,lightMap:Xt,bumpMap:mn,normalMap:Bt,displacementMap:Ln,emissiveMap:wt,normalMapObjectSpace:Bt&&x.normalMapType===Z0,normalMapTangentSpace:Bt&&x.normalMapType===wu,packedNormalMap:Bt&&x.normalMapType===wu&&o1(x.normalMap.format),metalnessMap:wn,roughnessMap:rn,anisotropy:gn,anisotropyMap:Ze,clearcoat:F,clearcoatMap:A,clearcoatNormalMap:v,clearcoatRoughnessMap:q,diffuseRoughness:Pe,diffuseRoughnessMap:ue,dispersion:je,retroreflection:ct,iridescence:we,iridescenceMap:ae,iridescenceThicknessMap:xe,sheen:Gt,sheenColorMap:ve,sheenRoughnessMap:ne,specularMap:se,specularColorMap:me,specularIntensityMap:U,transmission:Ge,transmissionMap:oe,thicknessMap:ie,gradientMap:Te,opaque:x.transparent===!1&&x.blending===ta&&x.alphaToCoverage===!1,alphaMap:_e,alphaTest:be,alphaHash:We,combine:x.combine,mapUv:He&&f(x.map.channel),aoMapUv:en&&f(x.aoMap.channel),lightMapUv:Xt&&f(x.lightMap.channel),bumpMapUv:mn&&f(x.bumpMap.channel),normalMapUv:Bt&&f(x.normalMap.channel),displacementMapUv:Ln&&f(x.displacementMap.channel),emissiveMapUv:wt&&f(x.emissiveMap.channel),metalnessMapUv:wn&&f(x.metalnessMap.channel),roughnessMapUv:rn&&f(x.roughnessMap.channel),anisotropyMapUv:Ze&&f(x.anisotropyMap.channel),clearcoatMapUv:A&&f(x.clearcoatMap.channel),clearcoatNormalMapUv:v&&f(x.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:q&&f(x.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:ue&&f(x.diffuseRoughnessMap.channel),iridescenceMapUv:ae&&f(x.iridescenceMap.channel),iridescenceThicknessMapUv:xe&&f(x.iridescenceThicknessMap.channel),sheenColorMapUv:ve&&f(x.sheenColorMap.channel),sheenRoughnessMapUv:ne&&f(x.sheenRoughnessMap.channel),specularMapUv:se&&f(x.specularMap.channel),specularColorMapUv:me&&f(x.specularColorMap.channel),specularIntensityMapUv:U&&f(x.specularIntensityMap.channel),transmissionMapUv:oe&&f(x.transmissionMap.channel),thicknessMapUv:ie&&f(x.thicknessMap.channel),alphaMapUv:_e&&f(x.alphaMap.channel),vertexTangents:!!D.attributes.tangent&&(Bt||gn),vertexNormals:!!D.attributes.normal,vertexColors:x.vertexColors,vertexAlphas:x.vertexColors===!0&&!!D.attributes.color&&D.attributes.color.itemSize===4,pointsUvs:L.isPoints===!0&&!!D.attributes.uv&&(He||_e),fog:!!W,useFog:x.fog===!0,fogExp2:!!W&&W.isFogExp2,flatShading:x.wireframe===!1&&(x.flatShading===!0||D.attributes.normal===void 0&&Bt===!1&&(x.isMeshLambertMaterial||x.isMeshPhongMaterial||x.isMeshStandardMaterial||x.isMeshPhysicalMaterial)),sizeAttenuation:x.sizeAttenuation===!0,logarithmicDepthBuffer:u,reversedDepthBuffer:Me,skinning:L.isSkinnedMesh===!0,hasPositionAttribute:D.attributes.position!==void 0,morphTargets:D.morphAttributes.position!==void 0,morphNormals:D.morphAttributes.normal!==void 0,morphColors:D.morphAttributes.color!==void 0,morphTargetsCount:re,morphTextureStride:fe,numSunLights:T.sun.length,numDirLights:T.directional.length,numPointLights:T.point.length,numSpotLights:T.spot.length,numSpotLightMaps:T.spotLightMap.length,numRectAreaLights:T.rectArea.length,numHemiLights:T.hemi.length,numSunLightShadows:T.sunShadowMap.length,numDirLightShadows:T.directionalShadowMap.length,numPointLightShadows:T.pointShadowMap.length,numSpotLightShadows:T.spotShadowMap.length,numSpotLightShadowsWithMaps:T.numSpotLightShadowsWithMaps,numLightProbes:T.numLightProbes,numLightProbeGrids:z.filter(Re=>Re.texture!==null).length,numClippingPlanes:r.numPlanes,numClipIntersection:r.numIntersection,dithering:x.dithering,shadowMapEnabled:n.shadowMap.enabled&&k.length>0,shadowMapType:n.shadowMap.type,toneMapping:ce,decodeVideoTexture:He&&x.map.isVideoTexture===!0&&bt.getTransfer(x.map.colorSpace)===Lt,decodeVideoTextureEmissive:wt&&x.emissiveMap.isVideoTexture===!0&&bt.getTransfer(x.emissiveMap.colorSpace)===Lt,premultipliedAlpha:x.premultipliedAlpha,doubleSided:x.side===ci,flipSided:x.side===li,useDepthPacking:x.depthPacking>=0,depthPacking:x.depthPacking||0,index0AttributeName:x.index0AttributeName,extensionClipCullDistance:tt&&x.extensions.clipCullDistance===!0&&t.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(tt&&x.extensions.multiDraw===!0||lt)&&t.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:t.has("KHR_parallel_shader_compile"),customProgramCacheKey:x.customProgramCacheKey()};return nt.vertexUv1s=l.has(1),nt.vertexUv2s=l.has(2),nt.vertexUv3s=l.has(3),l.clear(),nt}function y(x){let T=[];if(x.shaderID?T.push(x.shaderID):(T.push(x.customVertexShaderID),T.push(x.customFragmentShaderID)),x.defines!==void 0)for(let k in x.defines)T.push(k),T.push(x.defines[k]);return x.isRawShaderMaterial===!1&&(g(T,x),p(T,x),T.push(n.outputColorSpace)),T.push(x.customProgramCacheKey),T.join()}function g(x,T){x.push(T.precision),x.push(T.outputColorSpace),x.push(T.envMapMode),x.push(T.envMapPMREM),x.push(T.envMapMaxLod),x.push(T.envMapSize),x.push(T.mapUv),x.push(T.alphaMapUv),x.push(T.lightMapUv),x.push(T.aoMapUv),x.push(T.bumpMapUv),x.push(T.normalMapUv),x.push(T.displacementMapUv),x.push(T.emissiveMapUv),x.push(T.metalnessMapUv),x.push(T.roughnessMapUv),x.push(T.anisotropyMapUv),x.push(T.clearcoatMapUv),x.push(T.clearcoatNormalMapUv),x.push(T.clearcoatRoughnessMapUv),x.push(T.diffuseRoughnessMapUv),x.push(T.iridescenceMapUv),x.push(T.iridescenceThicknessMapUv),x.push(T.sheenColorMapUv),x.push(T.sheenRoughnessMapUv),x.push(T.specularMapUv),x.push(T.specularColorMapUv),x.push(T.specularIntensityMapUv),x.push(T.transmissionMapUv),x.push(T.thicknessMapUv),x.push(T.combine),x.push(T.fogExp2),x.push(T.sizeAttenuation),x.push(T.morphTargetsCount),x.push(T.numSunLights),x.push(T.numDirLights),x.push(T.numPointLights),x.push(T.numSpotLights),x.push(T.numSpotLightMaps),x.push(T.numHemiLights),x.push(T.numRectAreaLights),x.push(T.numSunLightShadows),x.push(T.numDirLightShadows),x.push(T.numPointLightShadows),x.push(T.numSpotLightShadows),x.push(T.numSpotLightShadowsWithMaps),x.push(T.numLightProbes),x.push(T.numLightProbeGrids),x.push(T.shadowMapType),x.push(T.toneMapping),x.push(T.numClippingPlanes),x.push(T.numClipIntersection),x.push(T.depthPacking)}function p(x,T){o.disableAll(),T.instancing&&o.enable(0),T.instancingColor&&o.enable(1),T.instancingMorph&&o.enable(2),T.matcap&&o.enable(3),T.envMap&&o.enable(4),T.normalMapObjectSpace&&o.enable(5),T.normalMapTangentSpace&&o.enable(6),T.clearcoat&&o.enable(7),T.iridescence&&o.enable(8),T.alphaTest&&o.enable(9),T.vertexColors&&o.enable(10),T.vertexAlphas&&o.enable(11),T.vertexUv1s&&o.enable(12),T.vertexUv2s&&o.enable(13),T.vertexUv3s&&o.enable(14),T.vertexTangents&&o.enable(15),T.anisotropy&&o.enable(16),T.alphaHash&&o.enable(17),T.batching&&o.enable(18),T.dispersion&&o.enable(19),T.retroreflection&&o.enable(24),T.diffuseRoughness&&o.enable(25),T.batchingColor&&o.enable(20),T.gradientMap&&o.enable(21),T.packedNormalMap&&o.enable(22),T.vertexNormals&&o.enable(23),x.push(o.mask),o.disableAll(),T.fog&&o.enable(0),T.useFog&&o.enable(1),T.flatShading&&o.enable(2),T.logarithmicDepthBuffer&&o.enable(3),T.reversedDepthBuffer&&o.enable(4),T.skinning&&o.enable(5),T.morphTargets&&o.enable(6),T.morphNormals&&o.enable(7),T.morphColors&&o.enable(8),T.premultipliedAlpha&&o.enable(9),T.shadowMapEnabled&&o.enable(10),T.doubleSided&&o.enable(11),T.flipSided&&o.enable(12),T.useDepthPacking&&o.enable(13),T.dithering&&o.enable(14),T.transmission&&o.enable(15),T.sheen&&o.enable(16),T.opaque&&o.enable(17),T.pointsUvs&&o.enable(18),T.decodeVideoTexture&&o.enable(19),T.decodeVideoTextureEmissive&&o.enable(20),T.alphaToCoverage&&o.enable(21),T.numLightProbeGrids>0&&o.enable(22),T.hasPositionAttribute&&o.enable(23),x.push(o.mask)}function S(x){let T=d[x.type],k;if(T){let N=Ms[T];k=l_.clone(N.uniforms)}else k=x.uniforms;return k}function C(x,T){let k=h.get(T);return k!==void 0?++k.usedTimes:(k=new s1(n,T,x,s),c.push(k),h.set(T,k)),k}function w(x){if(--x.usedTimes===0){let T=c.indexOf(x);c[T]=c[c.length-1],c.pop(),h.delete(x.cacheKey),x.destroy()}}function P(x){a.remove(x)}function E(){a.dispose()}return{getParameters:m,getProgramCacheKey:y,getUniforms:S,acquireProgram:C,releaseProgram:w,releaseShaderCache:P,programs:c,dispose:E}}function l1(){let n=new WeakMap;function e(o){return n.has(o)}function t(o){let a=n.get(o);return a===void 0&&(a={},n.set(o,a)),a}function i(o){n.delete(o)}function s(o,a,l){n.get(o)[a]=l}function r(){n=new WeakMap}return{has:e,get:t,remove:i,update:s,dispose:r}}function c1(n,e){return n.groupOrder!==e.groupOrder?n.groupOrder-e.groupOrder:n.renderOrder!==e.renderOrder?n.renderOrder-e.renderOrder:n.material.id!==e.material.id?n.material.id-e.material.id:n.materialVariant!==e.materialVariant?n.materialVariant-e.materialVariant:n.z!==e.z?n.z-e.z:n.id-e.id}function C_(n,e){return n.groupOrder!==e.groupOrder?n.groupOrder-e.groupOrder:n.renderOrder!==e.renderOrder?n.renderOrder-e.renderOrder:n.z!==e.z?e.z-n.z:n.id-e.id}function R_(){let n=[],e=0,t=[],i=[],s=[];function r(){e=0,t.length=0,i.length=0,s.length=0}function o(d){let f=0;return d.isInstancedMesh&&(f+=2),d.isSkinnedMesh&&(f+=1),f}function a(d,f,m,y,g,p){let S=n[e];return S===void 0?(S={id:d.id,object:d,geometry:f,material:m,materialVariant:o(d),groupOrder:y,renderOrder:d.renderOrder,z:g,group:p},n[e]=S):(S.id=d.id,S.object=d,S.geometry=f,S.material=m,S.materialVariant=o(d),S.groupOrder=y,S.renderOrder=d.renderOrder,S.z=g,S.group=p),e++,S}function l(d,f,m,y,g,p,S){S.reversedDepth===!0&&(g=-g);let C=a(d,f,m,y,g,p);m.transmission>0?i.push(C):m.transparent===!0?s.push(C):t.push(C)}function c(d,f,m,y,g,p){let S=a(d,f,m,y,g,p);m.transmission>0?i.unshift(S):m.transparent===!0?s.unshift(S):t.unshift(S)}function h(d,f){t.length>1&&t.sort(d||c1),i.length>1&&i.sort(f||C_),s.length>1&&s.sort(f||C_)}function u(){for(let d=e,f=n.length;d<f;d++){let m=n[d];if(m.id===null)break;m.id=null,m.object=null,m.geometry=null,m.material=null,m.group=null}}return{opaque:t,transmissive:i,transparent:s,init:r,push:l,unshift:c,finish:u,sort:h}}function h1(){let n=new WeakMap;function e(i,s){let r=n.get(i),o;return r===void 0?(o=new R_,n.set(i,[o])):s>=r.length?(o=new R_,r.push(o)):o=r[s],o}function t(){n=new WeakMap}return{get:e,dispose:t}}function u1(){let n={};return{get:function(e){if(n[e.id]!==void 0)return n[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={direction:new O,color:new Je};break;case"SpotLight":t={position:new O,direction:new O,color:new Je,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":t={position:new O,color:new Je,distance:0,decay:0};break;case"HemisphereLight":t={direction:new O,skyColor:new Je,groundColor:new Je};break;case"RectAreaLight":t={color:new Je,position:new O,halfWidth:new O,halfHeight:new O};break}return n[e.id]=t,t}}}function d1(){let n={};return{get:function(e){if(n[e.id]!==void 0)return n[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new $e};break;case"SpotLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new $e};break;case"PointLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new $e,shadowCameraNear:1,shadowCameraFar:1e3};break}return n[e.id]=t,t}}}var f1=0;function p1(n,e){return(e.castShadow?2:0)-(n.castShadow?2:0)+(e.map?1:0)-(n.map?1:0)}function m1(n){let e=new u1,t=d1(),i={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let c=0;c<9;c++)i.probe.push(new O);let s=new O,r=new Pt,o=new Pt;function a(c){let h=0,u=0,d=0;for(let z=0;z<9;z++)i.probe[z].set(0,0,0);let f=0,m=0,y=0,g=0,p=0,S=0,C=0,w=0,P=0,E=0,x=0,T=0,k=0,N=0;c.sort(p1);for(let z=0,W=c.length;z<W;z++){let D=c[z],X=D.color,Z=D.intensity,H=D.distance,he=null;if(D.shadow&&D.shadow.map&&(D.shadow.map.texture.format===Mr?he=D.shadow.map.texture:he=D.shadow.map.depthTexture||D.shadow.map.texture),D.isAmbientLight)h+=X.r*Z,u+=X.g*Z,d+=X.b*Z;else if(D.isLightProbe){for(let j=0;j<9;j++)i.probe[j].addScaledVector(D.sh.coefficients[j],Z);N++}else if(D.isSunLight){let j=e.get(D);if(j.color.copy(D.color).multiplyScalar(D.intensity),D.castShadow){let ee=D.shadow,re=t.get(D);re.shadowIntensity=ee.intensity,re.shadowBias=ee.bias,re.shadowNormalBias=ee.normalBias,re.shadowRadius=ee.radius,re.shadowMapSize.copy(ee.mapSize).multiply(ee.getFrameExtents()),i.sunShadow[m]=re,i.sunShadowMap[m]=he;let fe=ee.getViewportCount();for(let de=0;de<fe;de++)i.sunShadowMatrix[y+de]=ee.getMatrix(de),i.sunShadowCascade[y+de]=ee._cascadeData[de];y+=fe,m++}i.sun[f]=j,f++}else if(D.isDirectionalLight){let j=e.get(D);if(j.color.copy(D.color).multiplyScalar(D.intensity),D.castShadow){let ee=D.shadow,re=t.get(D);re.shadowIntensity=ee.intensity,re.shadowBias=ee.bias,re.shadowNormalBias=ee.normalBias,re.shadowRadius=ee.radius,re.shadowMapSize=ee.mapSize,i.directionalShadow[g]=re,i.directionalShadowMap[g]=he,i.directionalShadowMatrix[g]=D.shadow.matrix,P++}i.directional[g]=j,g++}else if(D.isSpotLight){let j=e.get(D);j.position.setFromMatrixPosition(D.matrixWorld),j.color.copy(X).multiplyScalar(Z),j.distance=H,j.coneCos=Math.cos(D.angle),j.penumbraCos=Math.cos(D.angle*(1-D.penumbra)),j.decay=D.decay,i.spot[S]=j;let ee=D.shadow;if(D.map&&(i.spotLightMap[T]=D.map,T++,ee.updateMatrices(D),D.castShadow&&k++),i.spotLightMatrix[S]=ee.matrix,D.castShadow){let re=t.get(D);re.shadowIntensity=ee.intensity,re.shadowBias=ee.bias,re.shadowNormalBias=ee.normalBias,re.shadowRadius=ee.radius,re.shadowMapSize=ee.mapSize,i.spotShadow[S]=re,i.spotShadowMap[S]=he,x++}S++}else if(D.isRectAreaLight){let j=e.get(D);j.color.copy(X).multiplyScalar(Z),j.halfWidth.set(D.width*.5,0,0),j.halfHeight.set(0,D.height*.5,0),i.rectArea[C]=j,C++}else if(D.isPointLight){let j=e.get(D);if(j.color.copy(D.color).multiplyScalar(D.intensity),j.distance=D.distance,j.decay=D.decay,D.castShadow){let ee=D.shadow,re=t.get(D);re.shadowIntensity=ee.intensity,re.shadowBias=ee.bias,re.shadowNormalBias=ee.normalBias,re.shadowRadius=ee.radius,re.shadowMapSize=ee.mapSize,re.shadowCameraNear=ee.camera.near,re.shadowCameraFar=ee.camera.far,i.pointShadow[p]=re,i.pointShadowMap[p]=he,i.pointShadowMatrix[p]=D.shadow.matrix,E++}i.point[p]=j,p++}else if(D.isHemisphereLight){let j=e.get(D);j.skyColor.copy(D.color).multiplyScalar(Z),j.groundColor.copy(D.groundColor).multiplyScalar(Z),i.hemi[w]=j,w++}}C>0&&(n.has("OES_texture_float_linear")===!0?(i.rectAreaLTC1=Le.LTC_FLOAT_1,i.rectAreaLTC2=Le.LTC_FLOAT_2):(i.rectAreaLTC1=Le.LTC_HALF_1,i.rectAreaLTC2=Le.LTC_HALF_2)),i.ambient[0]=h,i.ambient[1]=u,i.ambient[2]=d;let L=i.hash;(L.sunLength!==f||L.directionalLength!==g||L.pointLength!==p||L.spotLength!==S||L.rectAreaLength!==C||L.hemiLength!==w||L.numSunShadows!==m||L.numDirectionalShadows!==P||L.numPointShadows!==E||L.numSpotShadows!==x||L.numSpotMaps!==T||L.numLightProbes!==N)&&(i.sun.length=f,i.directional.length=g,i.spot.length=S,i.rectArea.length=C,i.point.length=p,i.hemi.length=w,i.sunShadow.length=m,i.sunShadowMap.length=m,i.sunShadowMatrix.length=y,i.sunShadowCascade.length=y,i.directionalShadow.length=P,i.directionalShadowMap.length=P,i.directionalShadowMatrix.length=P,i.pointShadow.length=E,i.pointShadowMap.length=E,i.pointShadowMatrix.length=E,i.spotShadow.length=x,i.spotShadowMap.length=x,i.spotLightMatrix.length=x+T-k,i.spotLightMap.length=T,i.numSpotLightShadowsWithMaps=k,i.numLightProbes=N,L.sunLength=f,L.directionalLength=g,L.pointLength=p,L.spotLength=S,L.rectAreaLength=C,L.hemiLength=w,L.numSunShadows=m,L.numDirectionalShadows=P,L.numPointShadows=E,L.numSpotShadows=x,L.numSpotMaps=T,L.numLightProbes=N,i.version=f1++)}function l(c,h){let u=0,d=0,f=0,m=0,y=0,g=0,p=h.matrixWorldInverse;for(let S=0,C=c.length;S<C;S++){let w=c[S];if(w.isSunLight){let P=i.sun[u];P.direction.setFromMatrixPosition(w.matrixWorld),P.direction.transformDirection(p),u++}else if(w.isDirectionalLight){let P=i.directional[d];P.direction.setFromMatrixPosition(w.matrixWorld),s.setFromMatrixPosition(w.target.matrixWorld),P.direction.sub(s),P.direction.transformDirection(p),d++}else if(w.isSpotLight){let P=i.spot[m];P.position.setFromMatrixPosition(w.matrixWorld),P.position.applyMatrix4(p),P.direction.setFromMatrixPosition(w.matrixWorld),s.setFromMatrixPosition(w.target.matrixWorld),P.direction.sub(s),P.direction.transformDirection(p),m++}else if(w.isRectAreaLight){let P=i.rectArea[y];P.position.setFromMatrixPosition(w.matrixWorld),P.position.applyMatrix4(p),o.identity(),r.copy(w.matrixWorld),r.premultiply(p),o.extractRotation(r),P.halfWidth.set(w.width*.5,0,0),P.halfHeight.set(0,w.height*.5,0),P.halfWidth.applyMatrix4(o),P.halfHeight.applyMatrix4(o),y++}else if(w.isPointLight){let P=i.point[f];P.position.setFromMatrixPosition(w.matrixWorld),P.position.applyMatrix4(p),f++}else if(w.isHemisphereLight){let P=i.hemi[g];P.direction.setFromMatrixPosition(w.matrixWorld),P.direction.transformDirection(p),g++}}}return{setup:a,setupView:l,state:i}}function P_(n){let e=new m1(n),t=[],i=[],s=[];function r(u){h.camera=u,t.length=0,i.length=0,s.length=0}function o(u){u.isLightProbeGrid?s.push(u):t.push(u)}function a(u){i.push(u)}function l(){e.setup(t),s.sort((u,d)=>u.priority-d.priority||u.id-d.id)}function c(u){e.setupView(t,u)}let h={lightsArray:t,shadowsArray:i,lightProbeGridArray:s,camera:null,lights:e,transmissionRenderTarget:{},textureUnits:0};return{init:r,state:h,setupLights:l,setupLightsView:c,pushLight:o,pushShadow:a}}function g1(n){let e=new WeakMap;function t(s,r=0){let o=e.get(s),a;return o===void 0?(a=new P_(n),e.set(s,[a])):r>=o.length?(a=new P_(n),o.push(a)):a=o[r],a}function i(){e=new WeakMap}return{get:t,dispose:i}}var _1=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,x1=`uniform sampler2D shadow_pass;
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
}`,y1=[new O(1,0,0),new O(-1,0,0),new O(0,1,0),new O(0,-1,0),new O(0,0,1),new O(0,0,-1)],v1=[new O(0,-1,0),new O(0,-1,0),new O(0,0,1),new O(0,0,-1),new O(0,-1,0),new O(0,-1,0)],I_=new Pt,Nl=new O,yp=new O;function S1(n,e,t){let i=new pr,s=new $e,r=new $e,o=new nn,a=new wh,l=new Th,c={},h=t.maxTextureSize,u={[br]:li,[li]:br,[ci]:ci},d=new vs({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new $e},radius:{value:4}},vertexShader:_1,fragmentShader:x1}),f=d.clone();f.defines.HORIZONTAL_PASS=1;let m=new qt;m.setAttribute("position",new un(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let y=new Gn(m,d),g=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=El;let p=this.type;this.render=function(E,x,T){if(g.enabled===!1||g.autoUpdate===!1&&g.needsUpdate===!1||E.length===0)return;this.type===E0&&(Ke("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=El);let k=n.getRenderTarget(),N=n.getActiveCubeFace(),L=n.getActiveMipmapLevel(),z=n.state;z.setBlending($r),z.buffers.depth.getReversed()===!0?z.buffers.color.setClear(0,0,0,0):z.buffers.color.setClear(1,1,1,1),z.buffers.depth.setTest(!0),z.setScissorTest(!1);let W=p!==this.type;W&&x.traverse(function(D){D.material&&(Array.isArray(D.material)?D.material.forEach(X=>X.needsUpdate=!0):D.material.needsUpdate=!0)});for(let D=0,X=E.length;D<X;D++){let Z=E[D],H=Z.shadow;if(H===void 0){Ke("WebGLShadowMap:",Z,"has no shadow.");continue}if(H.autoUpdate===!1&&H.needsUpdate===!1)continue;s.copy(H.mapSize);let he=H.getFrameExtents();s.multiply(he),r.copy(H.mapSize),(s.x>h||s.y>h)&&(s.x>h&&(r.x=Math.floor(h/he.x),s.x=r.x*he.x,H.mapSize.x=r.x),s.y>h&&(r.y=Math.floor(h/he.y),s.y=r.y*he.y,H.mapSize.y=r.y));let j=n.state.buffers.depth.getReversed();if(H.camera._reversedDepth=j,H.map===null||W===!0){if(H.map!==null&&(H.map.depthTexture!==null&&(H.map.depthTexture.dispose(),H.map.depthTexture=null),H.map.dispose()),this.type===ea){if(Z.isPointLight){Ke("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}H.map=new Ai(s.x,s.y,{format:Mr,type:ji,minFilter:ri,magFilter:ri,generateMipmaps:!1}),H.map.texture.name=Z.name+".shadowMap",H.map.depthTexture=new Xs(s.x,s.y,Ji),H.map.depthTexture.name=Z.name+".shadowMapDepth",H.map.depthTexture.format=Gs,H.map.depthTexture.compareFunction=null,H.map.depthTexture.minFilter=Vn,H.map.depthTexture.magFilter=Vn}else Z.isPointLight?(H.map=new Fl(s.x),H.map.depthTexture=new fl(s.x,Ki)):(H.map=new Ai(s.x,s.y),H.map.depthTexture=new Xs(s.x,s.y,Ki)),H.map.depthTexture.name=Z.name+".shadowMap",H.map.depthTexture.format=Gs,this.type===El?(H.map.depthTexture.compareFunction=j?rp:sp,H.map.depthTexture.minFilter=ri,H.map.depthTexture.magFilter=ri):(H.map.depthTexture.compareFunction=null,H.map.depthTexture.minFilter=Vn,H.map.depthTexture.magFilter=Vn);H.camera.updateProjectionMatrix()}H.map.isWebGLCubeRenderTarget!==!0&&(H.map.width!==s.x||H.map.height!==s.y)&&H.map.setSize(s.x,s.y);let ee=H.map.isWebGLCubeRenderTarget?6:H.getViewportCount();Z.isPointLight!==!0&&H.updateMatrices(Z,T);let re=(H.camera.layers.mask&4294967294)!==0?H.camera.layers:T.layers;for(let fe=0;fe<ee;fe++){let de=H.getCamera(fe);if(Z.isPointLight){let te=H.camera,ge=H.matrix,ye=Z.distance||te.far;ye!==te.far&&(te.far=ye,te.updateProjectionMatrix()),Nl.setFromMatrixPosition(Z.matrixWorld),te.position.copy(Nl),yp.copy(te.position),yp.add(y1[fe]),te.up.copy(v1[fe]),te.lookAt(yp),te.updateMatrixWorld(),ge.makeTranslation(-Nl.x,-Nl.y,-Nl.z),I_.multiplyMatrices(te.projectionMatrix,te.matrixWorldInverse),H._frustum.setFromProjectionMatrix(I_,te.coordinateSystem,te.reversedDepth)}if(H.map.isWebGLCubeRenderTarget)n.setRenderTarget(H.map,fe),n.clear();else{fe===0&&(n.setRenderTarget(H.map),n.clear());let te=H.getViewport(fe);o.set(r.x*te.x,r.y*te.y,r.x*te.z,r.y*te.w),z.viewport(o)}i=H.getFrustum(fe),w(x,T,de,Z,re,this.type)}H.isPointLightShadow!==!0&&this.type===ea&&S(H,T),H.needsUpdate=!1}p=this.type,g.needsUpdate=!1,n.setRenderTarget(k,N,L)};function S(E,x){let T=e.update(y);d.defines.VSM_SAMPLES!==E.blurSamples&&(d.defines.VSM_SAMPLES=E.blurSamples,f.defines.VSM_SAMPLES=E.blurSamples,d.needsUpdate=!0,f.needsUpdate=!0),E.mapPass===null?E.mapPass=new Ai(s.x,s.y,{format:Mr,type:ji}):(E.mapPass.width!==E.map.width||E.mapPass.height!==E.map.height)&&E.mapPass.setSize(E.map.width,E.map.height),d.uniforms.shadow_pass.value=E.map.depthTexture,d.uniforms.resolution.value.set(E.map.width,E.map.height),d.uniforms.radius.value=E.radius,n.setRenderTarget(E.mapPass),n.clear(),n.renderBufferDirect(x,null,T,d,y,null),f.uniforms.shadow_pass.value=E.mapPass.texture,f.uniforms.resolution.value.set(E.map.width,E.map.height),f.uniforms.radius.value=E.radius,n.setRenderTarget(E.map),n.clear(),n.renderBufferDirect(x,null,T,f,y,null)}function C(E,x,T,k){let N=null,L=T.isPointLight===!0?E.customDistanceMaterial:E.customDepthMaterial;if(L!==void 0)N=L;else if(N=T.isPointLight===!0?l:a,n.localClippingEnabled&&x.clipShadows===!0&&Array.isArray(x.clippingPlanes)&&x.clippingPlanes.length!==0||x.displacementMap&&x.displacementScale!==0||x.alphaMap&&x.alphaTest>0||x.map&&x.alphaTest>0||x.alphaToCoverage===!0){let z=N.uuid,W=x.uuid,D=c[z];D===void 0&&(D={},c[z]=D);let X=D[W];X===void 0&&(X=N.clone(),D[W]=X,x.addEventListener("dispose",P)),N=X}if(N.visible=x.visible,N.wireframe=x.wireframe,k===ea?N.side=x.shadowSide!==null?x.shadowSide:x.side:N.side=x.shadowSide!==null?x.shadowSide:u[x.side],N.alphaMap=x.alphaMap,N.alphaTest=x.alphaToCoverage===!0?.5:x.alphaTest,N.map=x.map,N.clipShadows=x.clipShadows,N.clippingPlanes=x.clippingPlanes,N.clipIntersection=x.clipIntersection,N.displacementMap=x.displacementMap,N.displacementScale=x.displacementScale,N.displacementBias=x.displacementBias,N.wireframeLinewidth=x.wireframeLinewidth,N.linewidth=x.linewidth,T.isPointLight===!0&&N.isMeshDistanceMaterial===!0){let z=n.properties.get(N);z.light=T}return N}function w(E,x,T,k,N,L){if(E.visible===!1)return;if(E.layers.test(N)&&(E.isMesh||E.isLine||E.isPoints)&&(E.castShadow||E.receiveShadow&&L===ea)&&(!E.frustumCulled||E.intersectsFrustum(i))){E.modelViewMatrix.multiplyMatrices(T.matrixWorldInverse,E.matrixWorld);let D=e.update(E),X=E.material;if(Array.isArray(X)){let Z=D.groups;for(let H=0,he=Z.length;H<he;H++){let j=Z[H],ee=X[j.materialIndex];if(ee&&ee.visible){let re=C(E,ee,k,L);E.onBeforeShadow(n,E,x,T,D,re,j),n.renderBufferDirect(T,null,D,re,E,j),E.onAfterShadow(n,E,x,T,D,re,j)}}}else if(X.visible){let Z=C(E,X,k,L);E.onBeforeShadow(n,E,x,T,D,Z,null),n.renderBufferDirect(T,null,D,Z,E,null),E.onAfterShadow(n,E,x,T,D,Z,null)}}let W=E.children;for(let D=0,X=W.length;D<X;D++)w(W[D],x,T,k,N,L)}function P(E){E.target.removeEventListener("dispose",P);for(let T in c){let k=c[T],N=E.target.uuid;N in k&&(k[N].dispose(),delete k[N])}}}function b1(n,e){function t(){let U=!1,oe=new nn,ie=null,Te=new nn(0,0,0,0);return{setMask:function(_e){ie!==_e&&!U&&(n.colorMask(_e,_e,_e,_e),ie=_e)},setLocked:function(_e){U=_e},setClear:function(_e,be,We,tt,ce){ce===!0&&(_e*=tt,be*=tt,We*=tt),oe.set(_e,be,We,tt),Te.equals(oe)===!1&&(n.clearColor(_e,be,We,tt),Te.copy(oe))},reset:function(){U=!1,ie=null,Te.set(-1,0,0,0)}}}function i(){let U=!1,oe=!1,ie=null,Te=null,_e=null;return{setReversed:function(be){if(oe!==be){let We=e.get("EXT_clip_control");be?We.clipControlEXT(We.LOWER_LEFT_EXT,We.ZERO_TO_ONE_EXT):We.clipControlEXT(We.LOWER_LEFT_EXT,We.NEGATIVE_ONE_TO_ONE_EXT),oe=be;let tt=_e;_e=null,this.setClear(tt)}},getReversed:function(){return oe},setTest:function(be){be?Me(n.DEPTH_TEST):Xe(n.DEPTH_TEST)},setMask:function(be){ie!==be&&!U&&(n.depthMask(be),ie=be)},setFunc:function(be){if(oe&&(be=r_[be]),Te!==be){switch(be){case rh:n.depthFunc(n.NEVER);break;case oh:n.depthFunc(n.ALWAYS);break;case ah:n.depthFunc(n.LESS);break;case Ho:n.depthFunc(n.LEQUAL);break;case lh:n.depthFunc(n.EQUAL);break;case ch:n.depthFunc(n.GEQUAL);break;case hh:n.depthFunc(n.GREATER);break;case uh:n.depthFunc(n.NOTEQUAL);break;default:n.depthFunc(n.LEQUAL)}Te=be}},setLocked:function(be){U=be},setClear:function(be){_e!==be&&(_e=be,oe&&(be=1-be),n.clearDepth(be))},reset:function(){U=!1,ie=null,Te=null,_e=null,oe=!1}}}function s(){let U=!1,oe=null,ie=null,Te=null,_e=null,be=null,We=null,tt=null,ce=null;return{setTest:function(ke){U||(ke?Me(n.STENCIL_TEST):Xe(n.STENCIL_TEST))},setMask:function(ke){oe!==ke&&!U&&(n.stencilMask(ke),oe=ke)},setFunc:function(ke,nt,Re){(ie!==ke||Te!==nt||_e!==Re)&&(n.stencilFunc(ke,nt,Re),ie=ke,Te=nt,_e=Re)},setOp:function(ke,nt,Re){(be!==ke||We!==nt||tt!==Re)&&(n.stencilOp(ke,nt,Re),be=ke,We=nt,tt=Re)},setLocked:function(ke){U=ke},setClear:function(ke){ce!==ke&&(n.clearStencil(ke),ce=ke)},reset:function(){U=!1,oe=null,ie=null,Te=null,_e=null,be=null,We=null,tt=null,ce=null}}}let r=new t,o=new i,a=new s,l={},c=new WeakMap,h={},u={},d={},f=new WeakMap,m=[],y=null,g=!1,p=null,S=null,C=null,w=null,P=null,E=null,x=null,T=new Je(0,0,0),k=0,N=!1,L=null,z=null,W=null,D=null,X=null,Z=n.getParameter(n.MAX_COMBINED_TEXTURE_IMAGE_UNITS),H=!1,he=0,j=n.getParameter(n.VERSION);j.indexOf("WebGL")!==-1?(he=parseFloat(/^WebGL (\d)/.exec(j)[1]),H=he>=1):j.indexOf("OpenGL ES")!==-1&&(he=parseFloat(/^OpenGL ES (\d)/.exec(j)[1]),H=he>=2);let ee=null,re={},fe=n.getParameter(n.SCISSOR_BOX),de=n.getParameter(n.VIEWPORT),te=new nn().fromArray(fe),ge=new nn().fromArray(de);function ye(U,oe,ie,Te){let _e=new Uint8Array(4),be=n.createTexture();n.bindTexture(U,be),n.texParameteri(U,n.TEXTURE_MIN_FILTER,n.NEAREST),n.texParameteri(U,n.TEXTURE_MAG_FILTER,n.NEAREST);for(let We=0;We<ie;We++)U===n.TEXTURE_3D||U===n.TEXTURE_2D_ARRAY?n.texImage3D(oe,0,n.RGBA,1,1,Te,0,n.RGBA,n.UNSIGNED_BYTE,_e):n.texImage2D(oe+We,0,n.RGBA,1,1,0,n.RGBA,n.UNSIGNED_BYTE,_e);return be}let Ce={};Ce[n.TEXTURE_2D]=ye(n.TEXTURE_2D,n.TEXTURE_2D,1),Ce[n.TEXTURE_CUBE_MAP]=ye(n.TEXTURE_CUBE_MAP,n.TEXTURE_CUBE_MAP_POSITIVE_X,6),Ce[n.TEXTURE_2D_ARRAY]=ye(n.TEXTURE_2D_ARRAY,n.TEXTURE_2D_ARRAY,1,1),Ce[n.TEXTURE_3D]=ye(n.TEXTURE_3D,n.TEXTURE_3D,1,1),r.setClear(0,0,0,1),o.setClear(1),a.setClear(0),Me(n.DEPTH_TEST),o.setFunc(Ho),mn(!1),Bt(Of),Me(n.CULL_FACE),en($r);function Me(U){h[U]!==!0&&(n.enable(U),h[U]=!0)}function Xe(U){h[U]!==!1&&(n.disable(U),h[U]=!1)}function lt(U,oe){return d[U]!==oe?(n.bindFramebuffer(U,oe),d[U]=oe,U===n.DRAW_FRAMEBUFFER&&(d[n.FRAMEBUFFER]=oe),U===n.FRAMEBUFFER&&(d[n.DRAW_FRAMEBUFFER]=oe),!0):!1}function He(U,oe){let ie=m,Te=!1;if(U){ie=f.get(oe),ie===void 0&&(ie=[],f.set(oe,ie));let _e=U.textures;if(ie.length!==_e.length||ie[0]!==n.COLOR_ATTACHMENT0){for(let be=0,We=_e.length;be<We;be++)ie[be]=n.COLOR_ATTACHMENT0+be;ie.length=_e.length,Te=!0}}else ie[0]!==n.BACK&&(ie[0]=n.BACK,Te=!0);Te&&n.drawBuffers(ie)}function mt(U){return y!==U?(n.useProgram(U),y=U,!0):!1}let ut={[Zr]:n.FUNC_ADD,[C0]:n.FUNC_SUBTRACT,[R0]:n.FUNC_REVERSE_SUBTRACT};ut[P0]=n.MIN,ut[I0]=n.MAX;let ot={[D0]:n.ZERO,[L0]:n.ONE,[N0]:n.SRC_COLOR,[Vf]:n.SRC_ALPHA,[z0]:n.SRC_ALPHA_SATURATE,[B0]:n.DST_COLOR,[F0]:n.DST_ALPHA,[U0]:n.ONE_MINUS_SRC_COLOR,[Gf]:n.ONE_MINUS_SRC_ALPHA,[k0]:n.ONE_MINUS_DST_COLOR,[O0]:n.ONE_MINUS_DST_ALPHA,[V0]:n.CONSTANT_COLOR,[G0]:n.ONE_MINUS_CONSTANT_COLOR,[H0]:n.CONSTANT_ALPHA,[W0]:n.ONE_MINUS_CONSTANT_ALPHA};function en(U,oe,ie,Te,_e,be,We,tt,ce,ke){if(U===$r){g===!0&&(Xe(n.BLEND),g=!1);return}if(g===!1&&(Me(n.BLEND),g=!0),U!==A0){if(U!==p||ke!==N){if((S!==Zr||P!==Zr)&&(n.blendEquation(n.FUNC_ADD),S=Zr,P=Zr),ke)switch(U){case ta:n.blendFuncSeparate(n.ONE,n.ONE_MINUS_SRC_ALPHA,n.ONE,n.ONE_MINUS_SRC_ALPHA);break;case Bf:n.blendFunc(n.ONE,n.ONE);break;case kf:n.blendFuncSeparate(n.ZERO,n.ONE_MINUS_SRC_COLOR,n.ZERO,n.ONE);break;case zf:n.blendFuncSeparate(n.DST_COLOR,n.ONE_MINUS_SRC_ALPHA,n.ZERO,n.ONE);break;default:st("WebGLState: Invalid blending: ",U);break}else switch(U){case ta:n.blendFuncSeparate(n.SRC_ALPHA,n.ONE_MINUS_SRC_ALPHA,n.ONE,n.ONE_MINUS_SRC_ALPHA);break;case Bf:n.blendFuncSeparate(n.SRC_ALPHA,n.ONE,n.ONE,n.ONE);break;case kf:st("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case zf:st("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:st("WebGLState: Invalid blending: ",U);break}C=null,w=null,E=null,x=null,T.set(0,0,0),k=0,p=U,N=ke}return}_e=_e||oe,be=be||ie,We=We||Te,(oe!==S||_e!==P)&&(n.blendEquationSeparate(ut[oe],ut[_e]),S=oe,P=_e),(ie!==C||Te!==w||be!==E||We!==x)&&(n.blendFuncSeparate(ot[ie],ot[Te],ot[be],ot[We]),C=ie,w=Te,E=be,x=We),(tt.equals(T)===!1||ce!==k)&&(n.blendColor(tt.r,tt.g,tt.b,ce),T.copy(tt),k=ce),p=U,N=!1}function Xt(U,oe){U.side===ci?Xe(n.CULL_FACE):Me(n.CULL_FACE);let ie=U.side===li;oe&&(ie=!ie),mn(ie),U.blending===ta&&U.transparent===!1?en($r):en(U.blending,U.blendEquation,U.blendSrc,U.blendDst,U.blendEquationAlpha,U.blendSrcAlpha,U.blendDstAlpha,U.blendColor,U.blendAlpha,U.premultipliedAlpha),o.setFunc(U.depthFunc),o.setTest(U.depthTest),o.setMask(U.depthWrite),r.setMask(U.colorWrite);let Te=U.stencilWrite;a.setTest(Te),Te&&(a.setMask(U.stencilWriteMask),a.setFunc(U.stencilFunc,U.stencilRef,U.stencilFuncMask),a.setOp(U.stencilFail,U.stencilZFail,U.stencilZPass)),wt(U.polygonOffset,U.polygonOffsetFactor,U.polygonOffsetUnits),U.alphaToCoverage===!0?Me(n.SAMPLE_ALPHA_TO_COVERAGE):Xe(n.SAMPLE_ALPHA_TO_COVERAGE)}function mn(U){L!==U&&(U?n.frontFace(n.CW):n.frontFace(n.CCW),L=U)}function Bt(U){U!==w0?(Me(n.CULL_FACE),U!==z&&(U===Of?n.cullFace(n.BACK):U===T0?n.cullFace(n.FRONT):n.cullFace(n.FRONT_AND_BACK))):Xe(n.CULL_FACE),z=U}function Ln(U){U!==W&&(H&&n.lineWidth(U),W=U)}function wt(U,oe,ie){U?(Me(n.POLYGON_OFFSET_FILL),(D!==oe||X!==ie)&&(D=oe,X=ie,o.getReversed()&&(oe=-oe,ie=-ie),n.polygonOffset(oe,ie))):Xe(n.POLYGON_OFFSET_FILL)}function wn(U){U?Me(n.SCISSOR_TEST):Xe(n.SCISSOR_TEST)}function rn(U){U===void 0&&(U=n.TEXTURE0+Z-1),ee!==U&&(n.activeTexture(U),ee=U)}function gn(U,oe,ie){ie===void 0&&(ee===null?ie=n.TEXTURE0+Z-1:ie=ee);let Te=re[ie];Te===void 0&&(Te={type:void 0,texture:void 0},re[ie]=Te),(Te.type!==U||Te.texture!==oe)&&(ee!==ie&&(n.activeTexture(ie),ee=ie),n.bindTexture(U,oe||Ce[U]),Te.type=U,Te.texture=oe)}function F(){let U=re[ee];U!==void 0&&U.type!==void 0&&(n.bindTexture(U.type,null),U.type=void 0,U.texture=void 0)}function Pe(){try{n.compressedTexImage2D(...arguments)}catch(U){st("WebGLState:",U)}}function je(){try{n.compressedTexImage3D(...arguments)}catch(U){st("WebGLState:",U)}}function ct(){try{n.texSubImage2D(...arguments)}catch(U){st("WebGLState:",U)}}function we(){try{n.texSubImage3D(...arguments)}catch(U){st("WebGLState:",U)}}function Gt(){try{n.compressedTexSubImage2D(...arguments)}catch(U){st("WebGLState:",U)}}function Ge(){try{n.compressedTexSubImage3D(...arguments)}catch(U){st("WebGLState:",U)}}function Ze(){try{n.texStorage2D(...arguments)}catch(U){st("WebGLState:",U)}}function A(){try{n.texStorage3D(...arguments)}catch(U){st("WebGLState:",U)}}function v(){try{n.texImage2D(...arguments)}catch(U){st("WebGLState:",U)}}function q(){try{n.texImage3D(...arguments)}catch(U){st("WebGLState:",U)}}function ue(U){return u[U]!==void 0?u[U]:n.getParameter(U)}function ae(U,oe){u[U]!==oe&&(n.pixelStorei(U,oe),u[U]=oe)}function xe(U){te.equals(U)===!1&&(n.scissor(U.x,U.y,U.z,U.w),te.copy(U))}function ve(U){ge.equals(U)===!1&&(n.viewport(U.x,U.y,U.z,U.w),ge.copy(U))}function ne(U,oe){let ie=c.get(oe);ie===void 0&&(ie=new WeakMap,c.set(oe,ie));let Te=ie.get(U);Te===void 0&&(Te=n.getUniformBlockIndex(oe,U.name),n.uniformBlockBinding(oe,Te,Te),ie.set(U,Te))}function se(U,oe,ie){let _e=c.get(oe).get(U);l[_e]!==ie&&(n.bindBufferBase(n.UNIFORM_BUFFER,_e,ie),l[_e]=ie)}function me(){n.disable(n.BLEND),n.disable(n.CULL_FACE),n.disable(n.DEPTH_TEST),n.disable(n.POLYGON_OFFSET_FILL),n.disable(n.SCISSOR_TEST),n.disable(n.STENCIL_TEST),n.disable(n.SAMPLE_ALPHA_TO_COVERAGE),n.blendEquation(n.FUNC_ADD),n.blendFunc(n.ONE,n.ZERO),n.blendFuncSeparate(n.ONE,n.ZERO,n.ONE,n.ZERO),n.blendColor(0,0,0,0),n.colorMask(!0,!0,!0,!0),n.clearColor(0,0,0,0),n.depthMask(!0),n.depthFunc(n.LESS),o.setReversed(!1),n.clearDepth(1),n.stencilMask(4294967295),n.stencilFunc(n.ALWAYS,0,4294967295),n.stencilOp(n.KEEP,n.KEEP,n.KEEP),n.clearStencil(0),n.cullFace(n.BACK),n.frontFace(n.CCW),n.polygonOffset(0,0),n.activeTexture(n.TEXTURE0),n.bindFramebuffer(n.FRAMEBUFFER,null),n.bindFramebuffer(n.DRAW_FRAMEBUFFER,null),n.bindFramebuffer(n.READ_FRAMEBUFFER,null),n.useProgram(null),n.lineWidth(1),n.scissor(0,0,n.canvas.width,n.canvas.height),n.viewport(0,0,n.canvas.width,n.canvas.height),n.pixelStorei(n.PACK_ALIGNMENT,4),n.pixelStorei(n.UNPACK_ALIGNMENT,4),n.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,!1),n.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),n.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,n.BROWSER_DEFAULT_WEBGL),n.pixelStorei(n.PACK_ROW_LENGTH,0),n.pixelStorei(n.PACK_SKIP_PIXELS,0),n.pixelStorei(n.PACK_SKIP_ROWS,0),n.pixelStorei(n.UNPACK_ROW_LENGTH,0),n.pixelStorei(n.UNPACK_IMAGE_HEIGHT,0),n.pixelStorei(n.UNPACK_SKIP_PIXELS,0),n.pixelStorei(n.UNPACK_SKIP_ROWS,0),n.pixelStorei(n.UNPACK_SKIP_IMAGES,0),h={},u={},ee=null,re={},d={},l={},f=new WeakMap,m=[],y=null,g=!1,p=null,S=null,C=null,w=null,P=null,E=null,x=null,T=new Je(0,0,0),k=0,N=!1,L=null,z=null,W=null,D=null,X=null,te.set(0,0,n.canvas.width,n.canvas.height),ge.set(0,0,n.canvas.width,n.canvas.height),r.reset(),o.reset(),a.reset()}return{buffers:{color:r,depth:o,stencil:a},enable:Me,disable:Xe,bindFramebuffer:lt,drawBuffers:He,useProgram:mt,setBlending:en,setMaterial:Xt,setFlipSided:mn,setCullFace:Bt,setLineWidth:Ln,setPolygonOffset:wt,setScissorTest:wn,activeTexture:rn,bindTexture:gn,unbindTexture:F,compressedTexImage2D:Pe,compressedTexImage3D:je,texImage2D:v,texImage3D:q,pixelStorei:ae,getParameter:ue,updateUBOMapping:ne,uniformBlockBinding:se,texStorage2D:Ze,texStorage3D:A,texSubImage2D:ct,texSubImage3D:we,compressedTexSubImage2D:Gt,compressedTexSubImage3D:Ge,scissor:xe,viewport:ve,reset:me}}function M1(n,e,t,i,s,r,o){let a=e.has("WEBGL_multisampled_render_to_texture")?e.get("WEBGL_multisampled_render_to_texture"):null,l=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),c=new $e,h=new WeakMap,u=new Set,d,f=new WeakMap,m=new Set,y=new FinalizationRegistry(A=>m.delete(A)),g=!1;try{g=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function p(A,v){return g?new OffscreenCanvas(A,v):il("canvas")}function S(A,v,q){let ue=1,ae=Ze(A);if((ae.width>q||ae.height>q)&&(ue=q/Math.max(ae.width,ae.height)),ue<1)if(typeof HTMLImageElement<"u"&&A instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&A instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&A instanceof ImageBitmap||typeof VideoFrame<"u"&&A instanceof VideoFrame){let xe=Math.floor(ue*ae.width),ve=Math.floor(ue*ae.height);d===void 0&&(d=p(xe,ve));let ne=v?p(xe,ve):d;return ne.width=xe,ne.height=ve,ne.getContext("2d").drawImage(A,0,0,xe,ve),Ke("WebGLRenderer: Texture has been resized from ("+ae.width+"x"+ae.height+") to ("+xe+"x"+ve+")."),ne}else return"data"in A&&Ke("WebGLRenderer: Image in DataTexture is too big ("+ae.width+"x"+ae.height+")."),A;return A}function C(A){return A.generateMipmaps}function w(A){n.generateMipmap(A)}function P(A){return A.isWebGLCubeRenderTarget?n.TEXTURE_CUBE_MAP:A.isWebGL3DRenderTarget?n.TEXTURE_3D:A.isWebGLArrayRenderTarget||A.isCompressedArrayTexture?n.TEXTURE_2D_ARRAY:n.TEXTURE_2D}function E(A,v,q,ue,ae,xe=!1){if(A!==null){if(n[A]!==void 0)return n[A];Ke("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+A+"'")}let ve;ue&&(ve=e.get("EXT_texture_norm16"),ve||Ke("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let ne=v;if(v===n.RED&&(q===n.FLOAT&&(ne=n.R32F),q===n.HALF_FLOAT&&(ne=n.R16F),q===n.UNSIGNED_BYTE&&(ne=n.R8),q===n.UNSIGNED_SHORT&&ve&&(ne=ve.R16_EXT),q===n.SHORT&&ve&&(ne=ve.R16_SNORM_EXT)),v===n.RED_INTEGER&&(q===n.UNSIGNED_BYTE&&(ne=n.R8UI),q===n.UNSIGNED_SHORT&&(ne=n.R16UI),q===n.UNSIGNED_INT&&(ne=n.R32UI),q===n.BYTE&&(ne=n.R8I),q===n.SHORT&&(ne=n.R16I),q===n.INT&&(ne=n.R32I)),v===n.RG&&(q===n.FLOAT&&(ne=n.RG32F),q===n.HALF_FLOAT&&(ne=n.RG16F),q===n.UNSIGNED_BYTE&&(ne=n.RG8),q===n.UNSIGNED_SHORT&&ve&&(ne=ve.RG16_EXT),q===n.SHORT&&ve&&(ne=ve.RG16_SNORM_EXT)),v===n.RG_INTEGER&&(q===n.UNSIGNED_BYTE&&(ne=n.RG8UI),q===n.UNSIGNED_SHORT&&(ne=n.RG16UI),q===n.UNSIGNED_INT&&(ne=n.RG32UI),q===n.BYTE&&(ne=n.RG8I),q===n.SHORT&&(ne=n.RG16I),q===n.INT&&(ne=n.RG32I)),v===n.RGB_INTEGER&&(q===n.UNSIGNED_BYTE&&(ne=n.RGB8UI),q===n.UNSIGNED_SHORT&&(ne=n.RGB16UI),q===n.UNSIGNED_INT&&(ne=n.RGB32UI),q===n.BYTE&&(ne=n.RGB8I),q===n.SHORT&&(ne=n.RGB16I),q===n.INT&&(ne=n.RGB32I)),v===n.RGBA_INTEGER&&(q===n.UNSIGNED_BYTE&&(ne=n.RGBA8UI),q===n.UNSIGNED_SHORT&&(ne=n.RGBA16UI),q===n.UNSIGNED_INT&&(ne=n.RGBA32UI),q===n.BYTE&&(ne=n.RGBA8I),q===n.SHORT&&(ne=n.RGBA16I),q===n.INT&&(ne=n.RGBA32I)),v===n.RGB&&(q===n.UNSIGNED_SHORT&&ve&&(ne=ve.RGB16_EXT),q===n.SHORT&&ve&&(ne=ve.RGB16_SNORM_EXT),q===n.UNSIGNED_INT_5_9_9_9_REV&&(ne=n.RGB9_E5),q===n.UNSIGNED_INT_10F_11F_11F_REV&&(ne=n.R11F_G11F_B10F)),v===n.RGBA){let se=xe?nl:bt.getTransfer(ae);q===n.FLOAT&&(ne=n.RGBA32F),q===n.HALF_FLOAT&&(ne=n.RGBA16F),q===n.UNSIGNED_BYTE&&(ne=se===Lt?n.SRGB8_ALPHA8:n.RGBA8),q===n.UNSIGNED_SHORT&&ve&&(ne=ve.RGBA16_EXT),q===n.SHORT&&ve&&(ne=ve.RGBA16_SNORM_EXT),q===n.UNSIGNED_SHORT_4_4_4_4&&(ne=n.RGBA4),q===n.UNSIGNED_SHORT_5_5_5_1&&(ne=n.RGB5_A1)}return(ne===n.R16F||ne===n.R32F||ne===n.RG16F||ne===n.RG32F||ne===n.RGBA16F||ne===n.RGBA32F)&&e.get("EXT_color_buffer_float"),ne}function x(A,v){let q;return A?v===null||v===Ki||v===Jr?q=n.DEPTH24_STENCIL8:v===Ji?q=n.DEPTH32F_STENCIL8:v===ia&&(q=n.DEPTH24_STENCIL8,Ke("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):v===null||v===Ki||v===Jr?q=n.DEPTH_COMPONENT24:v===Ji?q=n.DEPTH_COMPONENT32F:v===ia&&(q=n.DEPTH_COMPONENT16),q}function T(A,v){return C(A)===!0||A.isFramebufferTexture&&A.minFilter!==Vn&&A.minFilter!==ri?Math.log2(Math.max(v.width,v.height))+1:A.mipmaps.length>0?A.mipmaps.length:A.isCompressedTexture&&Array.isArray(A.image)?v.mipmaps.length:1}function k(A){let v=new WeakRef(A);i.get(A).__ref=v,m.add(v),y.register(A,v,v)}function N(A){let v=i.get(A).__ref;v!==void 0&&(m.delete(v),y.unregister(v))}function L(A){W(A.target)}function z(A){D(A.target)}function W(A){A.removeEventListener("dispose",L),N(A),Z(A),A.isVideoTexture&&h.delete(A),A.isHTMLTexture&&u.delete(A)}function D(A){A.removeEventListener("dispose",z),N(A),he(A)}function X(){for(let A of m){let v=A.deref();v!==void 0&&(v.isRenderTarget===!0?D(v):W(v))}m.clear(),u.clear()}function Z(A){let v=i.get(A);if(v.__webglInit===void 0)return;let q=A.source,ue=f.get(q);if(ue){let ae=ue[v.__cacheKey];ae.usedTimes--,ae.usedTimes===0&&H(A),Object.keys(ue).length===0&&f.delete(q)}i.remove(A)}function H(A){let v=i.get(A);n.deleteTexture(v.__webglTexture);let q=A.source,ue=f.get(q);delete ue[v.__cacheKey],o.memory.textures--}function he(A){let v=i.get(A);v.__depthDisposeCallback&&v.__depthDisposeCallback();let q=A.depthTexture;if(q&&q.renderTarget===A&&W(q),A.isWebGLCubeRenderTarget)for(let ae=0;ae<6;ae++){if(Array.isArray(v.__webglFramebuffer[ae]))for(let xe=0;xe<v.__webglFramebuffer[ae].length;xe++)n.deleteFramebuffer(v.__webglFramebuffer[ae][xe]);else n.deleteFramebuffer(v.__webglFramebuffer[ae]);v.__webglDepthbuffer&&n.deleteRenderbuffer(v.__webglDepthbuffer[ae])}else{if(Array.isArray(v.__webglFramebuffer))for(let ae=0;ae<v.__webglFramebuffer.length;ae++)n.deleteFramebuffer(v.__webglFramebuffer[ae]);else n.deleteFramebuffer(v.__webglFramebuffer);if(v.__webglDepthbuffer&&n.deleteRenderbuffer(v.__webglDepthbuffer),v.__webglMultisampledFramebuffer&&n.deleteFramebuffer(v.__webglMultisampledFramebuffer),v.__webglColorRenderbuffer)for(let ae=0;ae<v.__webglColorRenderbuffer.length;ae++)v.__webglColorRenderbuffer[ae]&&n.deleteRenderbuffer(v.__webglColorRenderbuffer[ae]);v.__webglDepthRenderbuffer&&n.deleteRenderbuffer(v.__webglDepthRenderbuffer)}let ue=A.textures;for(let ae=0,xe=ue.length;ae<xe;ae++){let ve=i.get(ue[ae]);ve.__webglTexture&&(n.deleteTexture(ve.__webglTexture),o.memory.textures--),i.remove(ue[ae])}i.remove(A)}let j=0;function ee(){j=0}function re(){return j}function fe(A){j=A}function de(){let A=j;return A>=s.maxTextures&&Ke("WebGLTextures: Trying to use "+(A+1)+" texture units while this GPU supports only "+s.maxTextures),j+=1,A}function te(A){let v=[];return v.push(A.wrapS),v.push(A.wrapT),v.push(A.wrapR||0),v.push(A.magFilter),v.push(A.minFilter),v.push(A.anisotropy),v.push(A.internalFormat),v.push(A.format),v.push(A.type),v.push(A.generateMipmaps),v.push(A.mipmapsAutoUpdate),v.push(A.premultiplyAlpha),v.push(A.flipY),v.push(A.unpackAlignment),v.push(A.colorSpace),v.join()}function ge(A,v){let q=i.get(A);if(A.isVideoTexture&&Gt(A),A.isRenderTargetTexture===!1&&A.isExternalTexture!==!0&&A.version>0&&q.__version!==A.version){let ue=A.image;if(ue===null)Ke("WebGLRenderer: Texture marked for update but no image data found.");else if(ue.complete===!1)Ke("WebGLRenderer: Texture marked for update but image is incomplete");else{Xt(q,A,v);return}}else A.isExternalTexture&&(q.__webglTexture=A.sourceTexture?A.sourceTexture:null);t.bindTexture(n.TEXTURE_2D,q.__webglTexture,n.TEXTURE0+v)}function ye(A,v){let q=i.get(A);if(A.isRenderTargetTexture===!1&&A.version>0&&q.__version!==A.version){Xt(q,A,v);return}else A.isExternalTexture&&(q.__webglTexture=A.sourceTexture?A.sourceTexture:null);t.bindTexture(n.TEXTURE_2D_ARRAY,q.__webglTexture,n.TEXTURE0+v)}function Ce(A,v){let q=i.get(A);if(A.isRenderTargetTexture===!1&&A.version>0&&q.__version!==A.version){Xt(q,A,v);return}t.bindTexture(n.TEXTURE_3D,q.__webglTexture,n.TEXTURE0+v)}function Me(A,v){let q=i.get(A);if(A.version>0&&q.__version!==A.version){mn(q,A,v);return}t.bindTexture(n.TEXTURE_CUBE_MAP,q.__webglTexture,n.TEXTURE0+v)}let Xe={[dh]:n.REPEAT,[xs]:n.CLAMP_TO_EDGE,[fh]:n.MIRRORED_REPEAT},lt={[Vn]:n.NEAREST,[Y0]:n.NEAREST_MIPMAP_NEAREST,[Al]:n.NEAREST_MIPMAP_LINEAR,[ri]:n.LINEAR,[Vh]:n.LINEAR_MIPMAP_NEAREST,[qs]:n.LINEAR_MIPMAP_LINEAR},He={[J0]:n.NEVER,[op]:n.ALWAYS,[j0]:n.LESS,[sp]:n.LEQUAL,[Q0]:n.EQUAL,[rp]:n.GEQUAL,[e_]:n.GREATER,[t_]:n.NOTEQUAL};function mt(A,v){if(v.type===Ji&&e.has("OES_texture_float_linear")===!1&&(v.magFilter===ri||v.magFilter===Vh||v.magFilter===Al||v.magFilter===qs||v.minFilter===ri||v.minFilter===Vh||v.minFilter===Al||v.minFilter===qs)&&Ke("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),n.texParameteri(A,n.TEXTURE_WRAP_S,Xe[v.wrapS]),n.texParameteri(A,n.TEXTURE_WRAP_T,Xe[v.wrapT]),(A===n.TEXTURE_3D||A===n.TEXTURE_2D_ARRAY)&&n.texParameteri(A,n.TEXTURE_WRAP_R,Xe[v.wrapR]),n.texParameteri(A,n.TEXTURE_MAG_FILTER,lt[v.magFilter]),n.texParameteri(A,n.TEXTURE_MIN_FILTER,lt[v.minFilter]),v.compareFunction&&(n.texParameteri(A,n.TEXTURE_COMPARE_MODE,n.COMPARE_REF_TO_TEXTURE),n.texParameteri(A,n.TEXTURE_COMPARE_FUNC,He[v.compareFunction])),e.has("EXT_texture_filter_anisotropic")===!0){if(v.magFilter===Vn||v.minFilter!==Al&&v.minFilter!==qs||v.type===Ji&&e.has("OES_texture_float_linear")===!1)return;if(v.anisotropy>1||i.get(v).__currentAnisotropy){let q=e.get("EXT_texture_filter_anisotropic");n.texParameterf(A,q.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(v.anisotropy,s.getMaxAnisotropy())),i.get(v).__currentAnisotropy=v.anisotropy}}}function ut(A,v){let q=!1;A.__webglInit===void 0&&(A.__webglInit=!0,v.addEventListener("dispose",L),k(v));let ue=v.source,ae=f.get(ue);ae===void 0&&(ae={},f.set(ue,ae));let xe=te(v);if(xe!==A.__cacheKey){ae[xe]===void 0&&(ae[xe]={texture:n.createTexture(),usedTimes:0},o.memory.textures++,q=!0),ae[xe].usedTimes++;let ve=ae[A.__cacheKey];ve!==void 0&&(ae[A.__cacheKey].usedTimes--,ve.usedTimes===0&&H(v)),A.__cacheKey=xe,A.__webglTexture=ae[xe].texture}return q}function ot(A,v,q){return Math.floor(Math.floor(A/q)/v)}function en(A,v,q,ue){let xe=A.updateRanges;if(xe.length===0)t.texSubImage2D(n.TEXTURE_2D,0,0,0,v.width,v.height,q,ue,v.data);else{xe.sort((U,oe)=>U.start-oe.start);let ve=0;for(let U=1;U<xe.length;U++){let oe=xe[ve],ie=xe[U],Te=oe.start+oe.count,_e=ot(ie.start,v.width,4),be=ot(oe.start,v.width,4);ie.start<=Te+1&&_e===be&&ot(ie.start+ie.count-1,v.width,4)===_e?oe.count=Math.max(oe.count,ie.start+ie.count-oe.start):(++ve,xe[ve]=ie)}xe.length=ve+1;let ne=t.getParameter(n.UNPACK_ROW_LENGTH),se=t.getParameter(n.UNPACK_SKIP_PIXELS),me=t.getParameter(n.UNPACK_SKIP_ROWS);t.pixelStorei(n.UNPACK_ROW_LENGTH,v.width);for(let U=0,oe=xe.length;U<oe;U++){let ie=xe[U],Te=Math.floor(ie.start/4),_e=Math.ceil(ie.count/4),be=Te%v.width,We=Math.floor(Te/v.width),tt=_e,ce=1;t.pixelStorei(n.UNPACK_SKIP_PIXELS,be),t.pixelStorei(n.UNPACK_SKIP_ROWS,We),t.texSubImage2D(n.TEXTURE_2D,0,be,We,tt,ce,q,ue,v.data)}A.clearUpdateRanges(),t.pixelStorei(n.UNPACK_ROW_LENGTH,ne),t.pixelStorei(n.UNPACK_SKIP_PIXELS,se),t.pixelStorei(n.UNPACK_SKIP_ROWS,me)}}function Xt(A,v,q){let ue=n.TEXTURE_2D;(v.isDataArrayTexture||v.isCompressedArrayTexture)&&(ue=n.TEXTURE_2D_ARRAY),v.isData3DTexture&&(ue=n.TEXTURE_3D);let ae=ut(A,v),xe=v.source;t.bindTexture(ue,A.__webglTexture,n.TEXTURE0+q);let ve=i.get(xe);if(xe.version!==ve.__version||ae===!0){if(t.activeTexture(n.TEXTURE0+q),(typeof ImageBitmap<"u"&&v.image instanceof ImageBitmap)===!1){let ce=bt.getPrimaries(bt.workingColorSpace),ke=v.colorSpace===$s?null:bt.getPrimaries(v.colorSpace),nt=v.colorSpace===$s||ce===ke?n.NONE:n.BROWSER_DEFAULT_WEBGL;t.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,v.flipY),t.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,v.premultiplyAlpha),t.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,nt)}t.pixelStorei(n.UNPACK_ALIGNMENT,v.unpackAlignment);let se=S(v.image,!1,s.maxTextureSize);se=Ge(v,se);let me=r.convert(v.format,v.colorSpace),U=r.convert(v.type),oe=E(v.internalFormat,me,U,v.normalized,v.colorSpace,v.isVideoTexture);mt(ue,v);let ie,Te=v.mipmaps,_e=v.isVideoTexture!==!0,be=ve.__version===void 0||ae===!0,We=xe.dataReady,tt=T(v,se);if(v.isDepthTexture)oe=x(v.format===Ys,v.type),be&&(_e?t.texStorage2D(n.TEXTURE_2D,1,oe,se.width,se.height):t.texImage2D(n.TEXTURE_2D,0,oe,se.width,se.height,0,me,U,null));else if(v.isDataTexture)if(Te.length>0){_e&&be&&t.texStorage2D(n.TEXTURE_2D,tt,oe,Te[0].width,Te[0].height);for(let ce=0,ke=Te.length;ce<ke;ce++)ie=Te[ce],_e?We&&t.texSubImage2D(n.TEXTURE_2D,ce,0,0,ie.width,ie.height,me,U,ie.data):t.texImage2D(n.TEXTURE_2D,ce,oe,ie.width,ie.height,0,me,U,ie.data);v.generateMipmaps=!1}else _e?(be&&t.texStorage2D(n.TEXTURE_2D,tt,oe,se.width,se.height),We&&en(v,se,me,U)):t.texImage2D(n.TEXTURE_2D,0,oe,se.width,se.height,0,me,U,se.data);else if(v.isCompressedTexture)if(v.isCompressedArrayTexture){_e&&be&&t.texStorage3D(n.TEXTURE_2D_ARRAY,tt,oe,Te[0].width,Te[0].height,se.depth);for(let ce=0,ke=Te.length;ce<ke;ce++)if(ie=Te[ce],v.format!==Qi)if(me!==null)if(_e){if(We)if(v.layerUpdates.size>0){let nt=_p(ie.width,ie.height,v.format,v.type);for(let Re of v.layerUpdates){let ht=ie.data.subarray(Re*nt/ie.data.BYTES_PER_ELEMENT,(Re+1)*nt/ie.data.BYTES_PER_ELEMENT);t.compressedTexSubImage3D(n.TEXTURE_2D_ARRAY,ce,0,0,Re,ie.width,ie.height,1,me,ht)}}else t.compressedTexSubImage3D(n.TEXTURE_2D_ARRAY,ce,0,0,0,ie.width,ie.height,se.depth,me,ie.data)}else t.compressedTexImage3D(n.TEXTURE_2D_ARRAY,ce,oe,ie.width,ie.height,se.depth,0,ie.data,0,0);else Ke("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else _e?We&&t.texSubImage3D(n.TEXTURE_2D_ARRAY,ce,0,0,0,ie.width,ie.height,se.depth,me,U,ie.data):t.texImage3D(n.TEXTURE_2D_ARRAY,ce,oe,ie.width,ie.height,se.depth,0,me,U,ie.data);v.layerUpdates.size>0&&v.clearLayerUpdates()}else{_e&&be&&t.texStorage2D(n.TEXTURE_2D,tt,oe,Te[0].width,Te[0].height);for(let ce=0,ke=Te.length;ce<ke;ce++)ie=Te[ce],v.format!==Qi?me!==null?_e?We&&t.compressedTexSubImage2D(n.TEXTURE_2D,ce,0,0,ie.width,ie.height,me,ie.data):t.compressedTexImage2D(n.TEXTURE_2D,ce,oe,ie.width,ie.height,0,ie.data):Ke("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):_e?We&&t.texSubImage2D(n.TEXTURE_2D,ce,0,0,ie.width,ie.height,me,U,ie.data):t.texImage2D(n.TEXTURE_2D,ce,oe,ie.width,ie.height,0,me,U,ie.data)}else if(v.isDataArrayTexture)if(_e){if(be&&t.texStorage3D(n.TEXTURE_2D_ARRAY,tt,oe,se.width,se.height,se.depth),We)if(v.layerUpdates.size>0){let ce=_p(se.width,se.height,v.format,v.type);for(let ke of v.layerUpdates){let nt=se.data.subarray(ke*ce/se.data.BYTES_PER_ELEMENT,(ke+1)*ce/se.data.BYTES_PER_ELEMENT);t.texSubImage3D(n.TEXTURE_2D_ARRAY,0,0,0,ke,se.width,se.height,1,me,U,nt)}v.clearLayerUpdates()}else t.texSubImage3D(n.TEXTURE_2D_ARRAY,0,0,0,0,se.width,se.height,se.depth,me,U,se.data)}else t.texImage3D(n.TEXTURE_2D_ARRAY,0,oe,se.width,se.height,se.depth,0,me,U,se.data);else if(v.isData3DTexture)_e?(be&&t.texStorage3D(n.TEXTURE_3D,tt,oe,se.width,se.height,se.depth),We&&t.texSubImage3D(n.TEXTURE_3D,0,0,0,0,se.width,se.height,se.depth,me,U,se.data)):t.texImage3D(n.TEXTURE_3D,0,oe,se.width,se.height,se.depth,0,me,U,se.data);else if(v.isFramebufferTexture){if(be)if(_e)t.texStorage2D(n.TEXTURE_2D,tt,oe,se.width,se.height);else{let ce=se.width,ke=se.height;for(let nt=0;nt<tt;nt++)t.texImage2D(n.TEXTURE_2D,nt,oe,ce,ke,0,me,U,null),ce>>=1,ke>>=1}}else if(v.isHTMLTexture){if("texElementImage2D"in n){let ce=n.canvas;if(ce.hasAttribute("layoutsubtree")||ce.setAttribute("layoutsubtree","true"),se.parentNode!==ce){ce.appendChild(se),u.add(v),ce.onpaint=ke=>{let nt=ke.changedElements;for(let Re of u)nt.includes(Re.image)&&(Re.needsUpdate=!0)},ce.requestPaint();return}if(n.texElementImage2D.length===3)n.texElementImage2D(n.TEXTURE_2D,n.RGBA8,se);else{let nt=n.RGBA,Re=n.RGBA,ht=n.UNSIGNED_BYTE;n.texElementImage2D(n.TEXTURE_2D,0,nt,Re,ht,se)}n.texParameteri(n.TEXTURE_2D,n.TEXTURE_MIN_FILTER,n.LINEAR),n.texParameteri(n.TEXTURE_2D,n.TEXTURE_WRAP_S,n.CLAMP_TO_EDGE),n.texParameteri(n.TEXTURE_2D,n.TEXTURE_WRAP_T,n.CLAMP_TO_EDGE)}}else if(Te.length>0){if(_e&&be){let ce=Ze(Te[0]);t.texStorage2D(n.TEXTURE_2D,tt,oe,ce.width,ce.height)}for(let ce=0,ke=Te.length;ce<ke;ce++)ie=Te[ce],_e?We&&t.texSubImage2D(n.TEXTURE_2D,ce,0,0,me,U,ie):t.texImage2D(n.TEXTURE_2D,ce,oe,me,U,ie);v.generateMipmaps=!1}else if(_e){if(be){let ce=Ze(se);t.texStorage2D(n.TEXTURE_2D,tt,oe,ce.width,ce.height)}We&&t.texSubImage2D(n.TEXTURE_2D,0,0,0,me,U,se)}else t.texImage2D(n.TEXTURE_2D,0,oe,me,U,se);C(v)&&v.mipmapsAutoUpdate===!0&&w(ue),ve.__version=xe.version,v.onUpdate&&v.onUpdate(v)}A.__version=v.version}function mn(A,v,q){if(v.image.length!==6)return;let ue=ut(A,v),ae=v.source;t.bindTexture(n.TEXTURE_CUBE_MAP,A.__webglTexture,n.TEXTURE0+q);let xe=i.get(ae);if(ae.version!==xe.__version||ue===!0){t.activeTexture(n.TEXTURE0+q);let ve=bt.getPrimaries(bt.workingColorSpace),ne=v.colorSpace===$s?null:bt.getPrimaries(v.colorSpace),se=v.colorSpace===$s||ve===ne?n.NONE:n.BROWSER_DEFAULT_WEBGL;t.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,v.flipY),t.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,v.premultiplyAlpha),t.pixelStorei(n.UNPACK_ALIGNMENT,v.unpackAlignment),t.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,se);let me=v.isCompressedTexture||v.image[0].isCompressedTexture,U=v.image[0]&&v.image[0].isDataTexture,oe=[];for(let Re=0;Re<6;Re++)!me&&!U?oe[Re]=S(v.image[Re],!0,s.maxCubemapSize):oe[Re]=U?v.image[Re].image:v.image[Re],oe[Re]=Ge(v,oe[Re]);let ie=oe[0],Te=r.convert(v.format,v.colorSpace),_e=r.convert(v.type),be=E(v.internalFormat,Te,_e,v.normalized,v.colorSpace),We=v.isVideoTexture!==!0,tt=xe.__version===void 0||ue===!0,ce=ae.dataReady,ke=T(v,ie);mt(n.TEXTURE_CUBE_MAP,v);let nt;if(v.isDepthTexture){if(be=x(v.format===Ys,v.type),tt)if(We)t.texStorage2D(n.TEXTURE_CUBE_MAP,1,be,ie.width,ie.height);else for(let Re=0;Re<6;Re++)t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,0,be,ie.width,ie.height,0,Te,_e,null)}else if(me){We&&tt&&t.texStorage2D(n.TEXTURE_CUBE_MAP,ke,be,ie.width,ie.height);for(let Re=0;Re<6;Re++){nt=oe[Re].mipmaps;for(let ht=0;ht<nt.length;ht++){let Yt=nt[ht];v.format!==Qi?Te!==null?We?ce&&t.compressedTexSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ht,0,0,Yt.width,Yt.height,Te,Yt.data):t.compressedTexImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ht,be,Yt.width,Yt.height,0,Yt.data):Ke("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):We?ce&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ht,0,0,Yt.width,Yt.height,Te,_e,Yt.data):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ht,be,Yt.width,Yt.height,0,Te,_e,Yt.data)}}}else{if(nt=v.mipmaps,We&&tt){nt.length>0&&ke++;let Re=Ze(oe[0]);t.texStorage2D(n.TEXTURE_CUBE_MAP,ke,be,Re.width,Re.height)}for(let Re=0;Re<6;Re++)if(U){We?ce&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,0,0,0,oe[Re].width,oe[Re].height,Te,_e,oe[Re].data):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,0,be,oe[Re].width,oe[Re].height,0,Te,_e,oe[Re].data);for(let ht=0;ht<nt.length;ht++){let Jn=nt[ht].image[Re].image;We?ce&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ht+1,0,0,Jn.width,Jn.height,Te,_e,Jn.data):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ht+1,be,Jn.width,Jn.height,0,Te,_e,Jn.data)}}else{We?ce&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,0,0,0,Te,_e,oe[Re]):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,0,be,Te,_e,oe[Re]);for(let ht=0;ht<nt.length;ht++){let Yt=nt[ht];We?ce&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ht+1,0,0,Te,_e,Yt.image[Re]):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ht+1,be,Te,_e,Yt.image[Re])}}}C(v)&&v.mipmapsAutoUpdate===!0&&w(n.TEXTURE_CUBE_MAP),xe.__version=ae.version,v.onUpdate&&v.onUpdate(v)}A.__version=v.version}function Bt(A,v,q,ue,ae,xe){let ve=r.convert(q.format,q.colorSpace),ne=r.convert(q.type),se=E(q.internalFormat,ve,ne,q.normalized,q.colorSpace),me=i.get(v),U=i.get(q);if(U.__renderTarget=v,!me.__hasExternalTextures){let oe=Math.max(1,v.width>>xe),ie=Math.max(1,v.height>>xe);ae===n.TEXTURE_3D||ae===n.TEXTURE_2D_ARRAY?t.texImage3D(ae,xe,se,oe,ie,v.depth,0,ve,ne,null):t.texImage2D(ae,xe,se,oe,ie,0,ve,ne,null)}t.bindFramebuffer(n.FRAMEBUFFER,A),we(v)?a.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,ue,ae,U.__webglTexture,0,ct(v)):(ae===n.TEXTURE_2D||ae>=n.TEXTURE_CUBE_MAP_POSITIVE_X&&ae<=n.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&n.framebufferTexture2D(n.FRAMEBUFFER,ue,ae,U.__webglTexture,xe),t.bindFramebuffer(n.FRAMEBUFFER,null)}function Ln(A,v,q){if(n.bindRenderbuffer(n.RENDERBUFFER,A),v.depthBuffer){let ue=v.depthTexture,ae=ue&&ue.isDepthTexture?ue.type:null,xe=x(v.stencilBuffer,ae),ve=v.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;we(v)?a.renderbufferStorageMultisampleEXT(n.RENDERBUFFER,ct(v),xe,v.width,v.height):q?n.renderbufferStorageMultisample(n.RENDERBUFFER,ct(v),xe,v.width,v.height):n.renderbufferStorage(n.RENDERBUFFER,xe,v.width,v.height),n.framebufferRenderbuffer(n.FRAMEBUFFER,ve,n.RENDERBUFFER,A)}else{let ue=v.textures;for(let ae=0;ae<ue.length;ae++){let xe=ue[ae],ve=r.convert(xe.format,xe.colorSpace),ne=r.convert(xe.type),se=E(xe.internalFormat,ve,ne,xe.normalized,xe.colorSpace);we(v)?a.renderbufferStorageMultisampleEXT(n.RENDERBUFFER,ct(v),se,v.width,v.height):q?n.renderbufferStorageMultisample(n.RENDERBUFFER,ct(v),se,v.width,v.height):n.renderbufferStorage(n.RENDERBUFFER,se,v.width,v.height)}}n.bindRenderbuffer(n.RENDERBUFFER,null)}function wt(A,v,q){let ue=v.isWebGLCubeRenderTarget===!0;if(t.bindFramebuffer(n.FRAMEBUFFER,A),!(v.depthTexture&&v.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let ae=i.get(v.depthTexture);ae.__renderTarget=v;let xe=ue?v.depthTexture.image[0]:v.depthTexture.image;(!ae.__webglTexture||xe.width!==v.width||xe.height!==v.height)&&(xe.width=v.width,xe.height=v.height,v.depthTexture.needsUpdate=!0),ue?Me(v.depthTexture,0):ge(v.depthTexture,0);let ve=ae.__webglTexture,ne=ct(v),se=ue?n.TEXTURE_CUBE_MAP_POSITIVE_X+q:n.TEXTURE_2D,me=v.depthTexture.format===Ys?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;if(v.depthTexture.format===Gs)we(v)?a.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,me,se,ve,0,ne):n.framebufferTexture2D(n.FRAMEBUFFER,me,se,ve,0);else if(v.depthTexture.format===Ys)we(v)?a.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,me,se,ve,0,ne):n.framebufferTexture2D(n.FRAMEBUFFER,me,se,ve,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function wn(A){let v=i.get(A),q=A.isWebGLCubeRenderTarget===!0;if(v.__boundDepthTexture!==A.depthTexture){let ue=A.depthTexture;if(v.__depthDisposeCallback&&v.__depthDisposeCallback(),ue){let ae=()=>{delete v.__boundDepthTexture,delete v.__depthDisposeCallback,ue.removeEventListener("dispose",ae)};ue.addEventListener("dispose",ae),v.__depthDisposeCallback=ae}v.__boundDepthTexture=ue}if(A.depthTexture&&!v.__autoAllocateDepthBuffer)if(q)for(let ue=0;ue<6;ue++)wt(v.__webglFramebuffer[ue],A,ue);else A.texture.mipmaps.length>0?wt(v.__webglFramebuffer[0],A,0):wt(v.__webglFramebuffer,A,0);else if(q){v.__webglDepthbuffer=[];for(let ue=0;ue<6;ue++)if(t.bindFramebuffer(n.FRAMEBUFFER,v.__webglFramebuffer[ue]),v.__webglDepthbuffer[ue]===void 0)v.__webglDepthbuffer[ue]=n.createRenderbuffer(),Ln(v.__webglDepthbuffer[ue],A,!1);else{let ae=A.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,xe=v.__webglDepthbuffer[ue];n.bindRenderbuffer(n.RENDERBUFFER,xe),n.framebufferRenderbuffer(n.FRAMEBUFFER,ae,n.RENDERBUFFER,xe)}}else if(A.texture.mipmaps.length>0?t.bindFramebuffer(n.FRAMEBUFFER,v.__webglFramebuffer[0]):t.bindFramebuffer(n.FRAMEBUFFER,v.__webglFramebuffer),v.__webglDepthbuffer===void 0)v.__webglDepthbuffer=n.createRenderbuffer(),Ln(v.__webglDepthbuffer,A,!1);else{let ae=A.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,xe=v.__webglDepthbuffer;n.bindRenderbuffer(n.RENDERBUFFER,xe),n.framebufferRenderbuffer(n.FRAMEBUFFER,ae,n.RENDERBUFFER,xe)}t.bindFramebuffer(n.FRAMEBUFFER,null)}function rn(A,v,q){let ue=i.get(A);v!==void 0&&Bt(ue.__webglFramebuffer,A,A.texture,n.COLOR_ATTACHMENT0,n.TEXTURE_2D,0),q!==void 0&&wn(A)}function gn(A){let v=A.texture,q=i.get(A),ue=i.get(v);A.addEventListener("dispose",z),k(A);let ae=A.textures,xe=A.isWebGLCubeRenderTarget===!0,ve=ae.length>1;if(ve||(ue.__webglTexture===void 0&&(ue.__webglTexture=n.createTexture()),ue.__version=v.version,o.memory.textures++),xe){q.__webglFramebuffer=[];for(let ne=0;ne<6;ne++)if(v.mipmaps.length>0){q.__webglFramebuffer[ne]=[];for(let se=0;se<v.mipmaps.length;se++)q.__webglFramebuffer[ne][se]=n.createFramebuffer()}else q.__webglFramebuffer[ne]=n.createFramebuffer()}else{if(v.mipmaps.length>0){q.__webglFramebuffer=[];for(let ne=0;ne<v.mipmaps.length;ne++)q.__webglFramebuffer[ne]=n.createFramebuffer()}else q.__webglFramebuffer=n.createFramebuffer();if(ve)for(let ne=0,se=ae.length;ne<se;ne++){let me=i.get(ae[ne]);me.__webglTexture===void 0&&(me.__webglTexture=n.createTexture(),o.memory.textures++)}if(A.samples>0&&we(A)===!1){q.__webglMultisampledFramebuffer=n.createFramebuffer(),q.__webglColorRenderbuffer=[],t.bindFramebuffer(n.FRAMEBUFFER,q.__webglMultisampledFramebuffer);for(let ne=0;ne<ae.length;ne++){let se=ae[ne];q.__webglColorRenderbuffer[ne]=n.createRenderbuffer(),n.bindRenderbuffer(n.RENDERBUFFER,q.__webglColorRenderbuffer[ne]);let me=r.convert(se.format,se.colorSpace),U=r.convert(se.type),oe=E(se.internalFormat,me,U,se.normalized,se.colorSpace,A.isXRRenderTarget===!0),ie=ct(A);n.renderbufferStorageMultisample(n.RENDERBUFFER,ie,oe,A.width,A.height),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+ne,n.RENDERBUFFER,q.__webglColorRenderbuffer[ne])}n.bindRenderbuffer(n.RENDERBUFFER,null),A.depthBuffer&&(q.__webglDepthRenderbuffer=n.createRenderbuffer(),Ln(q.__webglDepthRenderbuffer,A,!0)),t.bindFramebuffer(n.FRAMEBUFFER,null)}}if(xe){t.bindTexture(n.TEXTURE_CUBE_MAP,ue.__webglTexture),mt(n.TEXTURE_CUBE_MAP,v);for(let ne=0;ne<6;ne++)if(v.mipmaps.length>0)for(let se=0;se<v.mipmaps.length;se++)Bt(q.__webglFramebuffer[ne][se],A,v,n.COLOR_ATTACHMENT0,n.TEXTURE_CUBE_MAP_POSITIVE_X+ne,se);else Bt(q.__webglFramebuffer[ne],A,v,n.COLOR_ATTACHMENT0,n.TEXTURE_CUBE_MAP_POSITIVE_X+ne,0);C(v)?w(n.TEXTURE_CUBE_MAP):v.mipmaps.length>0&&n.texParameteri(n.TEXTURE_CUBE_MAP,n.TEXTURE_MAX_LEVEL,v.mipmaps.length-1),t.unbindTexture()}else if(ve){for(let ne=0,se=ae.length;ne<se;ne++){let me=ae[ne],U=i.get(me),oe=n.TEXTURE_2D;(A.isWebGL3DRenderTarget||A.isWebGLArrayRenderTarget)&&(oe=A.isWebGL3DRenderTarget?n.TEXTURE_3D:n.TEXTURE_2D_ARRAY),t.bindTexture(oe,U.__webglTexture),mt(oe,me),Bt(q.__webglFramebuffer,A,me,n.COLOR_ATTACHMENT0+ne,oe,0),C(me)&&w(oe)}t.unbindTexture()}else{let ne=n.TEXTURE_2D;if((A.isWebGL3DRenderTarget||A.isWebGLArrayRenderTarget)&&(ne=A.isWebGL3DRenderTarget?n.TEXTURE_3D:n.TEXTURE_2D_ARRAY),t.bindTexture(ne,ue.__webglTexture),mt(ne,v),v.mipmaps.length>0)for(let se=0;se<v.mipmaps.length;se++)Bt(q.__webglFramebuffer[se],A,v,n.COLOR_ATTACHMENT0,ne,se);else Bt(q.__webglFramebuffer,A,v,n.COLOR_ATTACHMENT0,ne,0);C(v)?w(ne):v.mipmaps.length>0&&n.texParameteri(ne,n.TEXTURE_MAX_LEVEL,v.mipmaps.length-1),t.unbindTexture()}A.depthBuffer&&wn(A)}function F(A){let v=A.textures;for(let q=0,ue=v.length;q<ue;q++){let ae=v[q];if(C(ae)&&ae.mipmapsAutoUpdate===!0){let xe=P(A),ve=i.get(ae).__webglTexture;t.bindTexture(xe,ve),w(xe),t.unbindTexture()}}}let Pe=[];function je(A){if(A.samples>0){if(we(A)===!1){let v=A.textures,q=A.width,ue=A.height,ae=n.COLOR_BUFFER_BIT,xe=A.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,ve=i.get(A),ne=v.length>1;if(ne)for(let me=0;me<v.length;me++)t.bindFramebuffer(n.FRAMEBUFFER,ve.__webglMultisampledFramebuffer),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+me,n.RENDERBUFFER,null),t.bindFramebuffer(n.FRAMEBUFFER,ve.__webglFramebuffer),n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0+me,n.TEXTURE_2D,null,0);t.bindFramebuffer(n.READ_FRAMEBUFFER,ve.__webglMultisampledFramebuffer),A.texture.mipmaps.length>0?t.bindFramebuffer(n.DRAW_FRAMEBUFFER,ve.__webglFramebuffer[0]):t.bindFramebuffer(n.DRAW_FRAMEBUFFER,ve.__webglFramebuffer);for(let me=0;me<v.length;me++){if(A.resolveDepthBuffer&&(A.depthBuffer&&(ae|=n.DEPTH_BUFFER_BIT),A.stencilBuffer&&A.resolveStencilBuffer&&(ae|=n.STENCIL_BUFFER_BIT)),ne){n.framebufferRenderbuffer(n.READ_FRAMEBUFFER,n.COLOR_ATTACHMENT0,n.RENDERBUFFER,ve.__webglColorRenderbuffer[me]);let U=i.get(v[me]).__webglTexture;n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0,n.TEXTURE_2D,U,0)}n.blitFramebuffer(0,0,q,ue,0,0,q,ue,ae,n.NEAREST),l===!0&&(Pe.length=0,Pe.push(n.COLOR_ATTACHMENT0+me),A.depthBuffer&&A.storeMultisampledDepthBuffer===!1&&Pe.push(xe),n.invalidateFramebuffer(n.READ_FRAMEBUFFER,Pe))}if(t.bindFramebuffer(n.READ_FRAMEBUFFER,null),t.bindFramebuffer(n.DRAW_FRAMEBUFFER,null),ne)for(let me=0;me<v.length;me++){t.bindFramebuffer(n.FRAMEBUFFER,ve.__webglMultisampledFramebuffer),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+me,n.RENDERBUFFER,ve.__webglColorRenderbuffer[me]);let U=i.get(v[me]).__webglTexture;t.bindFramebuffer(n.FRAMEBUFFER,ve.__webglFramebuffer),n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0+me,n.TEXTURE_2D,U,0)}t.bindFramebuffer(n.DRAW_FRAMEBUFFER,ve.__webglMultisampledFramebuffer)}else if(A.depthBuffer&&A.storeMultisampledDepthBuffer===!1&&l){let v=A.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;n.invalidateFramebuffer(n.DRAW_FRAMEBUFFER,[v])}}}function ct(A){return Math.min(s.maxSamples,A.samples)}function we(A){let v=i.get(A);return A.samples>0&&e.has("WEBGL_multisampled_render_to_texture")===!0&&v.__useRenderToTexture!==!1}function Gt(A){let v=o.render.frame;h.get(A)!==v&&(h.set(A,v),A.update())}function Ge(A,v){let q=A.colorSpace,ue=A.format,ae=A.type;return A.isCompressedTexture===!0||A.isVideoTexture===!0||q!==tl&&q!==$s&&(bt.getTransfer(q)===Lt?(ue!==Qi||ae!==ui)&&Ke("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):st("WebGLTextures: Unsupported texture color space:",q)),v}function Ze(A){return typeof HTMLImageElement<"u"&&A instanceof HTMLImageElement?(c.width=A.naturalWidth||A.width,c.height=A.naturalHeight||A.height):typeof VideoFrame<"u"&&A instanceof VideoFrame?(c.width=A.displayWidth,c.height=A.displayHeight):(c.width=A.width,c.height=A.height),c}this.allocateTextureUnit=de,this.resetTextureUnits=ee,this.getTextureUnits=re,this.setTextureUnits=fe,this.setTexture2D=ge,this.setTexture2DArray=ye,this.setTexture3D=Ce,this.setTextureCube=Me,this.rebindTextures=rn,this.setupRenderTarget=gn,this.updateRenderTargetMipmap=F,this.updateMultisampleRenderTarget=je,this.setupDepthRenderbuffer=wn,this.setupFrameBufferTexture=Bt,this.useMultisampledRTT=we,this.dispose=X}function w1(n,e){function t(i,s=$s){let r,o=bt.getTransfer(s);if(i===ui)return n.UNSIGNED_BYTE;if(i===Hh)return n.UNSIGNED_SHORT_4_4_4_4;if(i===Wh)return n.UNSIGNED_SHORT_5_5_5_1;if(i===Qf)return n.UNSIGNED_INT_5_9_9_9_REV;if(i===ep)return n.UNSIGNED_INT_10F_11F_11F_REV;if(i===Jf)return n.BYTE;if(i===jf)return n.SHORT;if(i===ia)return n.UNSIGNED_SHORT;if(i===Gh)return n.INT;if(i===Ki)return n.UNSIGNED_INT;if(i===Ji)return n.FLOAT;if(i===ji)return n.HALF_FLOAT;if(i===tp)return n.ALPHA;if(i===np)return n.RGB;if(i===Qi)return n.RGBA;if(i===Gs)return n.DEPTH_COMPONENT;if(i===Ys)return n.DEPTH_STENCIL;if(i===ip)return n.RED;if(i===Xh)return n.RED_INTEGER;if(i===Mr)return n.RG;if(i===qh)return n.RG_INTEGER;if(i===Yh)return n.RGBA_INTEGER;if(i===Cl||i===Rl||i===Pl||i===Il)if(o===Lt)if(r=e.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(i===Cl)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(i===Rl)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(i===Pl)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(i===Il)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=e.get("WEBGL_compressed_texture_s3tc"),r!==null){if(i===Cl)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(i===Rl)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(i===Pl)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(i===Il)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(i===$h||i===Zh||i===Kh||i===Jh)if(r=e.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(i===$h)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(i===Zh)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(i===Kh)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(i===Jh)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(i===jh||i===Qh||i===eu||i===tu||i===nu||i===Dl||i===iu)if(r=e.get("WEBGL_compressed_texture_etc"),r!==null){if(i===jh||i===Qh)return o===Lt?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(i===eu)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC;if(i===tu)return r.COMPRESSED_R11_EAC;if(i===nu)return r.COMPRESSED_SIGNED_R11_EAC;if(i===Dl)return r.COMPRESSED_RG11_EAC;if(i===iu)return r.COMPRESSED_SIGNED_RG11_EAC}else return null;if(i===su||i===ru||i===ou||i===au||i===lu||i===cu||i===hu||i===uu||i===du||i===fu||i===pu||i===mu||i===gu||i===_u)if(r=e.get("WEBGL_compressed_texture_astc"),r!==null){if(i===su)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(i===ru)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(i===ou)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(i===au)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(i===lu)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(i===cu)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(i===hu)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(i===uu)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(i===du)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(i===fu)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(i===pu)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(i===mu)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(i===gu)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(i===_u)return o===Lt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(i===xu||i===yu||i===vu)if(r=e.get("EXT_texture_compression_bptc"),r!==null){if(i===xu)return o===Lt?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(i===yu)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(i===vu)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(i===Su||i===bu||i===Ll||i===Mu)if(r=e.get("EXT_texture_compression_rgtc"),r!==null){if(i===Su)return r.COMPRESSED_RED_RGTC1_EXT;if(i===bu)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(i===Ll)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(i===Mu)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return i===Jr?n.UNSIGNED_INT_24_8:n[i]!==void 0?n[i]:null}return{convert:t}}var T1=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,E1=`
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

}`,Ep=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(e,t){if(this.texture===null){let i=new pl(e.texture);(e.depthNear!==t.depthNear||e.depthFar!==t.depthFar)&&(this.depthNear=e.depthNear,this.depthFar=e.depthFar),this.texture=i}}getMesh(e){if(this.texture!==null&&this.mesh===null){let t=e.cameras[0].viewport,i=new vs({vertexShader:T1,fragmentShader:E1,uniforms:{depthColor:{value:this.texture},depthWidth:{value:t.z},depthHeight:{value:t.w}}});this.mesh=new Gn(new gl(20,20),i)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},Ap=class extends qi{constructor(e,t){super();let i=this,s=null,r=1,o=null,a="local-floor",l=1,c=null,h=null,u=null,d=null,f=null,m=null,y=typeof XRWebGLBinding<"u",g=new Ep,p={},S=t.getContextAttributes(),C=null,w=null,P=[],E=[],x=new $e,T=null,k=null,N=new si;N.viewport=new nn;let L=new si;L.viewport=new nn;let z=[N,L],W=new Oh,D=null,X=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(te){let ge=P[te];return ge===void 0&&(ge=new $o,P[te]=ge),ge.getTargetRaySpace()},this.getControllerGrip=function(te){let ge=P[te];return ge===void 0&&(ge=new $o,P[te]=ge),ge.getGripSpace()},this.getHand=function(te){let ge=P[te];return ge===void 0&&(ge=new $o,P[te]=ge),ge.getHandSpace()};function Z(te){let ge=E.indexOf(te.inputSource);if(ge===-1)return;let ye=P[ge];ye!==void 0&&(ye.update(te.inputSource,te.frame,c||o),ye.dispatchEvent({type:te.type,data:te.inputSource}))}function H(){s.removeEventListener("select",Z),s.removeEventListener("selectstart",Z),s.removeEventListener("selectend",Z),s.removeEventListener("squeeze",Z),s.removeEventListener("squeezestart",Z),s.removeEventListener("squeezeend",Z),s.removeEventListener("end",H),s.removeEventListener("inputsourceschange",he);for(let te=0;te<P.length;te++){let ge=E[te];ge!==null&&(E[te]=null,P[te].disconnect(ge))}D=null,X=null,g.reset();for(let te in p)delete p[te];if(e.setRenderTarget(C),f=null,d=null,u=null,s=null,w=null,de.stop(),i.isPresenting=!1,e.setPixelRatio(T),e.setSize(x.width,x.height,!1),k!==null){let te=k.camera;te.fov=k.fov,te.zoom=k.zoom,te.updateProjectionMatrix(),k=null}i.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(te){r=te,i.isPresenting===!0&&Ke("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(te){a=te,i.isPresenting===!0&&Ke("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return c||o},this.setReferenceSpace=function(te){c=te},this.getBaseLayer=function(){return d!==null?d:f},this.getBinding=function(){return u===null&&y&&(u=new XRWebGLBinding(s,t)),u},this.getFrame=function(){return m},this.getSession=function(){return s},this.setSession=async function(te){if(s=te,s!==null){if(C=e.getRenderTarget(),s.addEventListener("select",Z),s.addEventListener("selectstart",Z),s.addEventListener("selectend",Z),s.addEventListener("squeeze",Z),s.addEventListener("squeezestart",Z),s.addEventListener("squeezeend",Z),s.addEventListener("end",H),s.addEventListener("inputsourceschange",he),S.xrCompatible!==!0&&await t.makeXRCompatible(),T=e.getPixelRatio(),e.getSize(x),y&&"createProjectionLayer"in XRWebGLBinding.prototype){let ye=null,Ce=null,Me=null;S.depth&&(Me=S.stencil?t.DEPTH24_STENCIL8:t.DEPTH_COMPONENT24,ye=S.stencil?Ys:Gs,Ce=S.stencil?Jr:Ki);let Xe={colorFormat:t.RGBA8,depthFormat:Me,scaleFactor:r};u=this.getBinding(),d=u.createProjectionLayer(Xe),s.updateRenderState({layers:[d]}),e.setPixelRatio(1),e.setSize(d.textureWidth,d.textureHeight,!1),w=new Ai(d.textureWidth,d.textureHeight,{format:Qi,type:ui,depthTexture:new Xs(d.textureWidth,d.textureHeight,Ce,void 0,void 0,void 0,void 0,void 0,void 0,ye),stencilBuffer:S.stencil,colorSpace:e.outputColorSpace,samples:S.antialias?4:0,resolveDepthBuffer:d.ignoreDepthValues===!1,resolveStencilBuffer:d.ignoreDepthValues===!1,storeMultisampledDepthBuffer:d.ignoreDepthValues===!1,storeMultisampledStencilBuffer:d.ignoreDepthValues===!1})}else{let ye={antialias:S.antialias,alpha:!0,depth:S.depth,stencil:S.stencil,framebufferScaleFactor:r};f=new XRWebGLLayer(s,t,ye),s.updateRenderState({baseLayer:f}),e.setPixelRatio(1),e.setSize(f.framebufferWidth,f.framebufferHeight,!1),w=new Ai(f.framebufferWidth,f.framebufferHeight,{format:Qi,type:ui,colorSpace:e.outputColorSpace,stencilBuffer:S.stencil,resolveDepthBuffer:f.ignoreDepthValues===!1,resolveStencilBuffer:f.ignoreDepthValues===!1,storeMultisampledDepthBuffer:f.ignoreDepthValues===!1,storeMultisampledStencilBuffer:f.ignoreDepthValues===!1})}w.isXRRenderTarget=!0,this.setFoveation(l),c=null,o=await s.requestReferenceSpace(a),de.setContext(s),de.start(),i.isPresenting=!0,i.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode},this.getDepthTexture=function(){return g.getDepthTexture()};function he(te){for(let ge=0;ge<te.removed.length;ge++){let ye=te.removed[ge],Ce=E.indexOf(ye);Ce>=0&&(E[Ce]=null,P[Ce].disconnect(ye))}for(let ge=0;ge<te.added.length;ge++){let ye=te.added[ge],Ce=E.indexOf(ye);if(Ce===-1){for(let Xe=0;Xe<P.length;Xe++)if(Xe>=E.length){E.push(ye),Ce=Xe;break}else if(E[Xe]===null){E[Xe]=ye,Ce=Xe;break}if(Ce===-1)break}let Me=P[Ce];Me&&Me.connect(ye)}}function j(te,ge){ge===null?te.matrixWorld.copy(te.matrix):te.matrixWorld.multiplyMatrices(ge.matrixWorld,te.matrix),te.matrixWorldInverse.copy(te.matrixWorld).invert()}this.updateCamera=function(te){if(s===null)return;let ge=te.near,ye=te.far;g.texture!==null&&(g.depthNear>0&&(ge=g.depthNear),g.depthFar>0&&(ye=g.depthFar)),W.near=L.near=N.near=ge,W.far=L.far=N.far=ye,(D!==W.near||X!==W.far)&&(s.updateRenderState({depthNear:W.near,depthFar:W.far}),D=W.near,X=W.far),W.layers.mask=te.layers.mask|6,N.layers.mask=W.layers.mask&-5,L.layers.mask=W.layers.mask&-3;let Ce=te.parent,Me=W.cameras;j(W,Ce);for(let Xe=0;Xe<Me.length;Xe++)j(Me[Xe],Ce);W.projectionMatrix.copy(N.projectionMatrix),W.projectionMatrixInverse.copy(N.projectionMatrixInverse),k===null&&te.isPerspectiveCamera&&(k={camera:te,fov:te.fov,zoom:te.zoom}),ee(te,W,Ce)};function ee(te,ge,ye){ye===null?te.matrix.copy(ge.matrixWorld):(te.matrix.copy(ye.matrixWorld),te.matrix.invert(),te.matrix.multiply(ge.matrixWorld)),te.matrix.decompose(te.position,te.quaternion,te.scale),te.updateMatrixWorld(!0),te.projectionMatrix.copy(ge.projectionMatrix),te.projectionMatrixInverse.copy(ge.projectionMatrixInverse),te.isPerspectiveCamera&&(te.fov=qo*2*Math.atan(1/te.projectionMatrix.elements[5]),te.zoom=1)}this.getCamera=function(){return W},this.getFoveation=function(){if(!(d===null&&f===null))return l},this.setFoveation=function(te){l=te,d!==null&&(d.fixedFoveation=te),f!==null&&f.fixedFoveation!==void 0&&(f.fixedFoveation=te)},this.hasDepthSensing=function(){return g.texture!==null},this.getDepthSensingMesh=function(){return g.getMesh(W)},this.getCameraTexture=function(te){return p[te]};let re=null;function fe(te,ge){if(h=ge.getViewerPose(c||o),m=ge,h!==null){let ye=h.views;f!==null&&(e.setRenderTargetFramebuffer(w,f.framebuffer),e.setRenderTarget(w));let Ce=!1;ye.length!==W.cameras.length&&(W.cameras.length=0,Ce=!0);for(let He=0;He<ye.length;He++){let mt=ye[He],ut=null;if(f!==null)ut=f.getViewport(mt);else{let en=u.getViewSubImage(d,mt);ut=en.viewport,He===0&&(e.setRenderTargetTextures(w,en.colorTexture,en.depthStencilTexture),e.setRenderTarget(w))}let ot=z[He];ot===void 0&&(ot=new si,ot.layers.enable(He),ot.viewport=new nn,z[He]=ot),ot.matrix.fromArray(mt.transform.matrix),ot.matrix.decompose(ot.position,ot.quaternion,ot.scale),ot.projectionMatrix.fromArray(mt.projectionMatrix),ot.projectionMatrixInverse.copy(ot.projectionMatrix).invert(),ot.viewport.set(ut.x,ut.y,ut.width,ut.height),He===0&&(W.matrix.copy(ot.matrix),W.matrix.decompose(W.position,W.quaternion,W.scale)),Ce===!0&&W.cameras.push(ot)}let Me=s.enabledFeatures;if(Me&&Me.includes("depth-sensing")&&s.depthUsage=="gpu-optimized"&&y){u=i.getBinding();let He=u.getDepthInformation(ye[0]);He&&He.isValid&&He.texture&&g.init(He,s.renderState)}if(Me&&Me.includes("camera-access")&&y){e.state.unbindTexture(),u=i.getBinding();for(let He=0;He<ye.length;He++){let mt=ye[He].camera;if(mt){let ut=p[mt];ut||(ut=new pl,p[mt]=ut);let ot=u.getCameraImage(mt);ut.sourceTexture=ot}}}}for(let ye=0;ye<P.length;ye++){let Ce=E[ye],Me=P[ye];Ce!==null&&Me!==void 0&&Me.update(Ce,ge,c||o)}re&&re(te,ge),ge.detectedPlanes&&i.dispatchEvent({type:"planesdetected",data:ge}),m=null}let de=new D_;de.setAnimationLoop(fe),this.setAnimationLoop=function(te){re=te},this.dispose=function(){}}},A1=new Pt,G_=new Qe;G_.set(-1,0,0,0,1,0,0,0,1);function C1(n,e){function t(g,p){g.matrixAutoUpdate===!0&&g.updateMatrix(),p.value.copy(g.matrix)}function i(g,p){p.color.getRGB(g.fogColor.value,pp(n)),p.isFog?(g.fogNear.value=p.near,g.fogFar.value=p.far):p.isFogExp2&&(g.fogDensity.value=p.density)}function s(g,p,S,C,w){p.isNodeMaterial?p.uniformsNeedUpdate=!1:p.isMeshBasicMaterial?r(g,p):p.isMeshLambertMaterial?(r(g,p),p.envMap&&(g.envMapIntensity.value=p.envMapIntensity)):p.isMeshToonMaterial?(r(g,p),u(g,p)):p.isMeshPhongMaterial?(r(g,p),h(g,p),p.envMap&&(g.envMapIntensity.value=p.envMapIntensity)):p.isMeshStandardMaterial?(r(g,p),d(g,p),p.isMeshPhysicalMaterial&&f(g,p,w)):p.isMeshMatcapMaterial?(r(g,p),m(g,p)):p.isMeshDepthMaterial?r(g,p):p.isMeshDistanceMaterial?(r(g,p),y(g,p)):p.isMeshNormalMaterial?r(g,p):p.isLineBasicMaterial?(o(g,p),p.isLineDashedMaterial&&a(g,p)):p.isPointsMaterial?l(g,p,S,C):p.isSpriteMaterial?c(g,p):p.isShadowMaterial?(g.color.value.copy(p.color),g.opacity.value=p.opacity):p.isShaderMaterial&&(p.uniformsNeedUpdate=!1)}function r(g,p){g.opacity.value=p.opacity,p.color&&g.diffuse.value.copy(p.color),p.emissive&&g.emissive.value.copy(p.emissive).multiplyScalar(p.emissiveIntensity),p.map&&(g.map.value=p.map,t(p.map,g.mapTransform)),p.alphaMap&&(g.alphaMap.value=p.alphaMap,t(p.alphaMap,g.alphaMapTransform)),p.bumpMap&&(g.bumpMap.value=p.bumpMap,t(p.bumpMap,g.bumpMapTransform),g.bumpScale.value=p.bumpScale,p.side===li&&(g.bumpScale.value*=-1)),p.normalMap&&(g.normalMap.value=p.normalMap,t(p.normalMap,g.normalMapTransform),g.normalScale.value.copy(p.normalScale),p.side===li&&g.normalScale.value.negate()),p.displacementMap&&(g.displacementMap.value=p.displacementMap,t(p.displacementMap,g.displacementMapTransform),g.displacementScale.value=p.displacementScale,g.displacementBias.value=p.displacementBias),p.emissiveMap&&(g.emissiveMap.value=p.emissiveMap,t(p.emissiveMap,g.emissiveMapTransform)),p.specularMap&&(g.specularMap.value=p.specularMap,t(p.specularMap,g.specularMapTransform)),p.alphaTest>0&&(g.alphaTest.value=p.alphaTest);let S=e.get(p),C=S.envMap,w=S.envMapRotation;C&&(g.envMap.value=C,g.envMapRotation.value.setFromMatrix4(A1.makeRotationFromEuler(w)).transpose(),C.isCubeTexture&&C.isRenderTargetTexture===!1&&g.envMapRotation.value.premultiply(G_),g.reflectivity.value=p.reflectivity,g.ior.value=p.ior,g.refractionRatio.value=p.refractionRatio),p.lightMap&&(g.lightMap.value=p.lightMap,g.lightMapIntensity.value=p.lightMapIntensity,t(p.lightMap,g.lightMapTransform)),p.aoMap&&(g.aoMap.value=p.aoMap,g.aoMapIntensity.value=p.aoMapIntensity,t(p.aoMap,g.aoMapTransform))}function o(g,p){g.diffuse.value.copy(p.color),g.opacity.value=p.opacity,p.map&&(g.map.value=p.map,t(p.map,g.mapTransform))}function a(g,p){g.dashSize.value=p.dashSize,g.totalSize.value=p.dashSize+p.gapSize,g.scale.value=p.scale}function l(g,p,S,C){g.diffuse.value.copy(p.color),g.opacity.value=p.opacity,g.size.value=p.size*S,g.scale.value=C*.5,p.map&&(g.map.value=p.map,t(p.map,g.uvTransform)),p.alphaMap&&(g.alphaMap.value=p.alphaMap,t(p.alphaMap,g.alphaMapTransform)),p.alphaTest>0&&(g.alphaTest.value=p.alphaTest)}function c(g,p){g.diffuse.value.copy(p.color),g.opacity.value=p.opacity,g.rotation.value=p.rotation,p.map&&(g.map.value=p.map,t(p.map,g.mapTransform)),p.alphaMap&&(g.alphaMap.value=p.alphaMap,t(p.alphaMap,g.alphaMapTransform)),p.alphaTest>0&&(g.alphaTest.value=p.alphaTest)}function h(g,p){g.specular.value.copy(p.specular),g.shininess.value=Math.max(p.shininess,1e-4)}function u(g,p){p.gradientMap&&(g.gradientMap.value=p.gradientMap)}function d(g,p){g.metalness.value=p.metalness,p.metalnessMap&&(g.metalnessMap.value=p.metalnessMap,t(p.metalnessMap,g.metalnessMapTransform)),g.roughness.value=p.roughness,p.roughnessMap&&(g.roughnessMap.value=p.roughnessMap,t(p.roughnessMap,g.roughnessMapTransform)),p.envMap&&(g.envMapIntensity.value=p.envMapIntensity)}function f(g,p,S){g.ior.value=p.ior,p.diffuseRoughness>0&&(g.diffuseRoughness.value=p.diffuseRoughness,p.diffuseRoughnessMap&&(g.diffuseRoughnessMap.value=p.diffuseRoughnessMap,t(p.diffuseRoughnessMap,g.diffuseRoughnessMapTransform))),p.sheen>0&&(g.sheenColor.value.copy(p.sheenColor).multiplyScalar(p.sheen),g.sheenRoughness.value=p.sheenRoughness,p.sheenColorMap&&(g.sheenColorMap.value=p.sheenColorMap,t(p.sheenColorMap,g.sheenColorMapTransform)),p.sheenRoughnessMap&&(g.sheenRoughnessMap.value=p.sheenRoughnessMap,t(p.sheenRoughnessMap,g.sheenRoughnessMapTransform))),p.clearcoat>0&&(g.clearcoat.value=p.clearcoat,g.clearcoatRoughness.value=p.clearcoatRoughness,p.clearcoatMap&&(g.clearcoatMap.value=p.clearcoatMap,t(p.clearcoatMap,g.clearcoatMapTransform)),p.clearcoatRoughnessMap&&(g.clearcoatRoughnessMap.value=p.clearcoatRoughnessMap,t(p.clearcoatRoughnessMap,g.clearcoatRoughnessMapTransform)),p.clearcoatNormalMap&&(g.clearcoatNormalMap.value=p.clearcoatNormalMap,t(p.clearcoatNormalMap,g.clearcoatNormalMapTransform),g.clearcoatNormalScale.value.copy(p.clearcoatNormalScale),p.side===li&&g.clearcoatNormalScale.value.negate())),p.dispersion>0&&(g.dispersion.value=p.dispersion),p.retroreflectivity>0&&(g.retroreflectivity.value=p.retroreflectivity),p.iridescence>0&&(g.iridescence.value=p.iridescence,g.iridescenceIOR.value=p.iridescenceIOR,g.iridescenceThicknessMinimum.value=p.iridescenceThicknessMinimum,g.iridescenceThicknessMaximum.value=p.iridescenceThicknessMaximum,p.iridescenceMap&&(g.iridescenceMap.value=p.iridescenceMap,t(p.iridescenceMap,g.iridescenceMapTransform)),p.iridescenceThicknessMap&&(g.iridescenceThicknessMap.value=p.iridescenceThicknessMap,t(p.iridescenceThicknessMap,g.iridescenceThicknessMapTransform))),p.transmission>0&&(g.transmission.value=p.transmission,g.transmissionSamplerMap.value=S.texture,g.transmissionSamplerSize.value.set(S.width,S.height),p.transmissionMap&&(g.transmissionMap.value=p.transmissionMap,t(p.transmissionMap,g.transmissionMapTransform)),g.thickness.value=p.thickness,p.thicknessMap&&(g.thicknessMap.value=p.thicknessMap,t(p.thicknessMap,g.thicknessMapTransform)),g.attenuationDistance.value=p.attenuationDistance,g.attenuationColor.value.copy(p.attenuationColor)),p.anisotropy>0&&(g.anisotropyVector.value.set(p.anisotropy*Math.cos(p.anisotropyRotation),p.anisotropy*Math.sin(p.anisotropyRotation)),p.anisotropyMap&&(g.anisotropyMap.value=p.anisotropyMap,t(p.anisotropyMap,g.anisotropyMapTransform))),g.specularIntensity.value=p.specularIntensity,g.specularColor.value.copy(p.specularColor),p.specularColorMap&&(g.specularColorMap.value=p.specularColorMap,t(p.specularColorMap,g.specularColorMapTransform)),p.specularIntensityMap&&(g.specularIntensityMap.value=p.specularIntensityMap,t(p.specularIntensityMap,g.specularIntensityMapTransform))}function m(g,p){p.matcap&&(g.matcap.value=p.matcap)}function y(g,p){let S=e.get(p).light;g.referencePosition.value.setFromMatrixPosition(S.matrixWorld),g.nearDistance.value=S.shadow.camera.near,g.farDistance.value=S.shadow.camera.far}return{refreshFogUniforms:i,refreshMaterialUniforms:s}}function R1(n,e,t,i){let s={},r={};function o(S,C){let w=C.program;i.uniformBlockBinding(S,w,s[S.id])}function a(S,C){let w=s[S.id];w===void 0&&(m(S),w=l(S),s[S.id]=w,S.addEventListener("dispose",g));let P=C.program;i.updateUBOMapping(S,P);let E=e.render.frame;r[S.id]!==E&&(c(S),r[S.id]=E)}function l(S){let C=n.createBuffer(),w=S.__size,P=S.usage;return n.bindBuffer(n.UNIFORM_BUFFER,C),n.bufferData(n.UNIFORM_BUFFER,w,P),n.bindBuffer(n.UNIFORM_BUFFER,null),C}function c(S){let C=s[S.id],w=S.uniforms,P=S.__cache;n.bindBuffer(n.UNIFORM_BUFFER,C);for(let E=0,x=w.length;E<x;E++){let T=w[E];if(Array.isArray(T))for(let k=0,N=T.length;k<N;k++)h(T[k],E,k,P);else h(T,E,0,P)}n.bindBuffer(n.UNIFORM_BUFFER,null)}function h(S,C,w,P){if(d(S,C,w,P)===!0){let E=S.__offset,x=S.value;if(Array.isArray(x)){let T=0;for(let k=0;k<x.length;k++){let N=x[k],L=y(N,!0);u(N,S.__data,T),T+=L.storage/Float32Array.BYTES_PER_ELEMENT}}else u(x,S.__data,0);n.bufferSubData(n.UNIFORM_BUFFER,E,S.__data)}}function u(S,C,w){typeof S=="number"||typeof S=="boolean"?C[w]=S:S.isMatrix3?(C[w]=S.elements[0],C[w+1]=S.elements[1],C[w+2]=S.elements[2],C[w+3]=0,C[w+4]=S.elements[3],C[w+5]=S.elements[4],C[w+6]=S.elements[5],C[w+7]=0,C[w+8]=S.elements[6],C[w+9]=S.elements[7],C[w+10]=S.elements[8],C[w+11]=0):ArrayBuffer.isView(S)?C.set(S.subarray(0,C.length-w),w):S.toArray(C,w)}function d(S,C,w,P){let E=S.value,x=C+"_"+w;if(Array.isArray(E)){P[x]===void 0&&(P[x]=[]);let T=P[x],k=!1;for(let N=0;N<E.length;N++)f(E[N],T,N)===!0&&(k=!0);return k}return f(E,P,x)}function f(S,C,w){if(C[w]===void 0)return typeof S=="number"||typeof S=="boolean"?C[w]=S:ArrayBuffer.isView(S)?C[w]=S.slice():C[w]=S.clone(),!0;{let P=C[w];if(typeof S=="number"||typeof S=="boolean"){if(P!==S)return C[w]=S,!0}else{if(ArrayBuffer.isView(S))return!0;if(P.equals(S)===!1)return P.copy(S),!0}}return!1}function m(S){let C=S.uniforms,w=0,P=16;for(let x=0,T=C.length;x<T;x++){let k=Array.isArray(C[x])?C[x]:[C[x]];for(let N=0,L=k.length;N<L;N++){let z=k[N],W=Array.isArray(z.value)?z.value:[z.value],D=Array.isArray(C[x])||Array.isArray(z.value),X=w;for(let H=0,he=W.length;H<he;H++){let j=W[H],ee=y(j,D),re=w%P,fe=re%ee.boundary,de=re+fe;w+=fe,de!==0&&P-de<ee.storage&&(w+=P-de),H===0&&(X=w),w+=ee.storage}let Z=z.type==="int"?Int32Array:z.type==="uint"?Uint32Array:Float32Array;z.__data=new Z((w-X)/Float32Array.BYTES_PER_ELEMENT),z.__offset=X}}let E=w%P;return E>0&&(w+=P-E),S.__size=w,S.__cache={},this}function y(S,C){let w={boundary:0,storage:0};return typeof S=="number"||typeof S=="boolean"?(w.boundary=4,w.storage=4):S.isVector2?(w.boundary=8,w.storage=8):S.isVector3||S.isColor?(w.boundary=16,w.storage=12):S.isVector4?(w.boundary=16,w.storage=16):S.isMatrix3?(w.boundary=16,w.storage=48):S.isMatrix4?(w.boundary=16,w.storage=64):S.isTexture?Ke("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(S)?(w.boundary=16,w.storage=S.byteLength):Ke("WebGLRenderer: Unsupported uniform value type.",S),C===!0&&(w.boundary=16,w.storage=Math.ceil(w.storage/16)*16),w}function g(S){let C=S.target;C.removeEventListener("dispose",g),n.deleteBuffer(s[C.id]),delete s[C.id],delete r[C.id]}function p(){for(let S in s)n.deleteBuffer(s[S]);s={},r={}}return{bind:o,update:a,dispose:p}}var P1=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),bs=null;function I1(){return bs===null&&(bs=new Ko(P1,16,16,Mr,ji),bs.name="DFG_LUT",bs.minFilter=ri,bs.magFilter=ri,bs.wrapS=xs,bs.wrapT=xs,bs.generateMipmaps=!1,bs.needsUpdate=!0),bs}var Ru=class{constructor(e={}){let{canvas:t=n_(),context:i=null,depth:s=!0,stencil:r=!1,alpha:o=!1,antialias:a=!1,premultipliedAlpha:l=!0,preserveDrawingBuffer:c=!1,powerPreference:h="default",failIfMajorPerformanceCaveat:u=!1,reversedDepthBuffer:d=!1,outputBufferType:f=ui}=e;this.isWebGLRenderer=!0;let m;if(i!==null){if(typeof WebGLRenderingContext<"u"&&i instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");m=i.getContextAttributes().alpha}else m=o;let y=f,g=new Set([Yh,qh,Xh]),p=new Set([ui,Ki,ia,Jr,Hh,Wh]),S=new Uint32Array(4),C=new Int32Array(4),w={textures:[],min:[],max:[],resolution:[]},P=null,E=null,x=[],T=[],k=null;this.domElement=t,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=Ss,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let N=this,L=!1,z=null,W=null,D=null,X=null;this._outputColorSpace=Ti;let Z=0,H=0,he=null,j=-1,ee=null,re=new nn,fe=new nn,de=null,te=new Je(0),ge=0,ye=t.width,Ce=t.height,Me=1,Xe=null,lt=null,He=new nn(0,0,ye,Ce),mt=new nn(0,0,ye,Ce),ut=!1,ot=new pr,en=new yh,Xt=!1,mn=!1,Bt=new Pt,Ln=new O,wt=new nn,wn={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},rn=!1;function gn(){return he===null?Me:1}let F=i;function Pe(M,B){return t.getContext(M,B)}let je,ct,we,Gt,Ge,Ze,A,v,q,ue,ae,xe,ve,ne,se,me,U,oe,ie,Te,_e,be,We;try{let M={alpha:!0,depth:s,stencil:r,antialias:a,premultipliedAlpha:l,preserveDrawingBuffer:c,powerPreference:h,failIfMajorPerformanceCaveat:u};if("setAttribute"in t&&t.setAttribute("data-engine",`three.js r${"187"}`),t.addEventListener("webglcontextlost",ke,!1),t.addEventListener("webglcontextrestored",nt,!1),t.addEventListener("webglcontextcreationerror",Re,!1),F===null){let B="webgl2";if(F=Pe(B,M),F===null)throw Pe(B)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}tt()}catch(M){throw t.removeEventListener("webglcontextlost",ke,!1),t.removeEventListener("webglcontextrestored",nt,!1),t.removeEventListener("webglcontextcreationerror",Re,!1),st("WebGLRenderer: "+M.message),M}function tt(){je=new GT(F),je.init(),_e=new w1(F,je),ct=new IT(F,je,e,_e),we=new b1(F,je),ct.reversedDepthBuffer&&d&&we.buffers.depth.setReversed(!0),W=F.createFramebuffer(),D=F.createFramebuffer(),X=F.createFramebuffer(),Gt=new XT(F),Ge=new l1,Ze=new M1(F,je,we,Ge,ct,_e,Gt),A=new VT(N),v=new Yb(F),be=new RT(F,v),q=new HT(F,v,Gt,be),ue=new YT(F,q,v,be,Gt),oe=new qT(F,ct,Ze),se=new DT(Ge),ae=new a1(N,A,je,ct,be,se),xe=new C1(N,Ge),ve=new h1,ne=new g1(je),U=new CT(N,A,we,ue,m,l),me=new S1(N,ue,ct),We=new R1(F,Gt,ct,we),ie=new PT(F,je,Gt),Te=new WT(F,je,Gt),Gt.programs=ae.programs,N.capabilities=ct,N.extensions=je,N.properties=Ge,N.renderLists=ve,N.shadowMap=me,N.state=we,N.info=Gt}y!==ui&&(k=new ZT(y,t.width,t.height,a,s,r));let ce=new Ap(N,F);this.xr=ce,this.getContext=function(){return F},this.getContextAttributes=function(){return F.getContextAttributes()},this.forceContextLoss=function(){let M=je.get("WEBGL_lose_context");M&&M.loseContext()},this.forceContextRestore=function(){let M=je.get("WEBGL_lose_context");M&&M.restoreContext()},this.getPixelRatio=function(){return Me},this.setPixelRatio=function(M){M!==void 0&&(Me=M,this.setSize(ye,Ce,!1))},this.getSize=function(M){return M.set(ye,Ce)},this.setSize=function(M,B,Q=!0){if(ce.isPresenting){Ke("WebGLRenderer: Can't change size while VR device is presenting.");return}ye=M,Ce=B,t.width=Math.floor(M*Me),t.height=Math.floor(B*Me),Q===!0&&(t.style.width=M+"px",t.style.height=B+"px"),k!==null&&k.setSize(t.width,t.height),this.setViewport(0,0,M,B)},this.getDrawingBufferSize=function(M){return M.set(ye*Me,Ce*Me).floor()},this.setDrawingBufferSize=function(M,B,Q){ye=M,Ce=B,Me=Q,t.width=Math.floor(M*Q),t.height=Math.floor(B*Q),this.setViewport(0,0,M,B)},this.setEffects=function(M){if(y===ui){st("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(M){for(let B=0;B<M.length;B++)if(M[B].isOutputPass===!0){Ke("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}k.setEffects(M||[])},this.getCurrentViewport=function(M){return M.copy(re)},this.getViewport=function(M){return M.copy(He)},this.setViewport=function(M,B,Q,$){M.isVector4?He.set(M.x,M.y,M.z,M.w):He.set(M,B,Q,$),we.viewport(re.copy(He).multiplyScalar(gn()).round())},this.getScissor=function(M){return M.copy(mt)},this.setScissor=function(M,B,Q,$){M.isVector4?mt.set(M.x,M.y,M.z,M.w):mt.set(M,B,Q,$),we.scissor(fe.copy(mt).multiplyScalar(gn()).round())},this.getScissorTest=function(){return ut},this.setScissorTest=function(M){we.setScissorTest(ut=M)},this.setOpaqueSort=function(M){Xe=M},this.setTransparentSort=function(M){lt=M},this.getClearColor=function(M){return M.copy(U.getClearColor())},this.setClearColor=function(){U.setClearColor(...arguments)},this.getClearAlpha=function(){return U.getClearAlpha()},this.setClearAlpha=function(){U.setClearAlpha(...arguments)},this.clear=function(M=!0,B=!0,Q=!0){let $=0;if(M){let K=!1;if(he!==null){let Ee=he.texture.format;K=g.has(Ee)}if(K){let Ee=he.texture.type,Ie=p.has(Ee),Ae=U.getClearColor(),De=U.getClearAlpha(),Ve=Ae.r,rt=Ae.g,gt=Ae.b;Ie?(S[0]=Ve,S[1]=rt,S[2]=gt,S[3]=De,F.clearBufferuiv(F.COLOR,0,S)):(C[0]=Ve,C[1]=rt,C[2]=gt,C[3]=De,F.clearBufferiv(F.COLOR,0,C))}else $|=F.COLOR_BUFFER_BIT}B&&($|=F.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),Q&&($|=F.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),$!==0&&F.clear($)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(M){M.setRenderer(this),z=M},this.dispose=function(){t.removeEventListener("webglcontextlost",ke,!1),t.removeEventListener("webglcontextrestored",nt,!1),t.removeEventListener("webglcontextcreationerror",Re,!1),U.dispose(),ve.dispose(),ne.dispose(),Ze.dispose(),Ge.dispose(),A.dispose(),ue.dispose(),q.dispose(),be.dispose(),We.dispose(),ae.dispose(),ce.dispose(),ce.removeEventListener("sessionstart",Kl),ce.removeEventListener("sessionend",os),Es.stop()};function ke(M){M.preventDefault(),sl("WebGLRenderer: Context Lost."),L=!0}function nt(){sl("WebGLRenderer: Context Restored."),L=!1;let M=Gt.autoReset,B=me.enabled,Q=me.autoUpdate,$=me.needsUpdate,K=me.type;tt(),Gt.autoReset=M,me.enabled=B,me.autoUpdate=Q,me.needsUpdate=$,me.type=K}function Re(M){st("WebGLRenderer: A WebGL context could not be created. Reason: ",M.statusMessage)}function ht(M){let B=M.target;B.removeEventListener("dispose",ht),Yt(B)}function Yt(M){Jn(M),Ge.remove(M)}function Jn(M){let B=Ge.get(M).programs;B!==void 0&&(B.forEach(function(Q){ae.releaseProgram(Q)}),M.isShaderMaterial&&ae.releaseShaderCache(M))}this.renderBufferDirect=function(M,B,Q,$,K,Ee){B===null&&(B=wn);let Ie=K.isMesh&&K.matrixWorld.determinantAffine()<0,Ae=ba(M,B,Q,$,K);we.setMaterial($,Ie);let De=Q.index,Ve=1;if($.wireframe===!0){if(De=q.getWireframeAttribute(Q),De===void 0)return;Ve=2}let rt=Q.drawRange,gt=Q.attributes.position,ze=rt.start*Ve,_t=(rt.start+rt.count)*Ve;Ee!==null&&(ze=Math.max(ze,Ee.start*Ve),_t=Math.min(_t,(Ee.start+Ee.count)*Ve)),De!==null?(ze=Math.max(ze,0),_t=Math.min(_t,De.count)):gt!=null&&(ze=Math.max(ze,0),_t=Math.min(_t,gt.count));let sn=_t-ze;if(sn<0||sn===1/0)return;be.setup(K,$,Ae,Q,De);let Ut,Ft=ie;if(De!==null&&(Ut=v.get(De),Ft=Te,Ft.setIndex(Ut)),K.isMesh)$.wireframe===!0?(we.setLineWidth($.wireframeLinewidth*gn()),Ft.setMode(F.LINES)):Ft.setMode(F.TRIANGLES);else if(K.isLine){let Tn=$.linewidth;Tn===void 0&&(Tn=1),we.setLineWidth(Tn*gn()),K.isLineSegments?Ft.setMode(F.LINES):K.isLineLoop?Ft.setMode(F.LINE_LOOP):Ft.setMode(F.LINE_STRIP)}else K.isPoints?Ft.setMode(F.POINTS):K.isSprite&&Ft.setMode(F.TRIANGLES);if(K.isBatchedMesh)if(je.get("WEBGL_multi_draw"))Ft.renderMultiDraw(K._multiDrawStarts,K._multiDrawCounts,K._multiDrawCount);else{let Tn=K._multiDrawStarts,Fe=K._multiDrawCounts,_n=K._multiDrawCount,vt=De?v.get(De).bytesPerElement:1,Cs=Ge.get($).currentProgram.getUniforms();for(let xn=0;xn<_n;xn++)Cs.setValue(F,"_gl_DrawID",xn),Ft.render(Tn[xn]/vt,Fe[xn])}else if(K.isInstancedMesh)Ft.renderInstances(ze,sn,K.count);else if(Q.isInstancedBufferGeometry){let Tn=Q._maxInstanceCount!==void 0?Q._maxInstanceCount:1/0,Fe=Math.min(Q.instanceCount,Tn);Ft.renderInstances(ze,sn,Fe)}else Ft.render(ze,sn)};function ya(M,B,Q,$){z!==null&&M.isNodeMaterial&&z.setObject($,M),Xt===!0&&se.setState(M,Q,!1),M.transparent===!0&&M.side===ci&&M.forceSinglePass===!1?(M.side=li,M.needsUpdate=!0,as(M,B,$),M.side=br,M.needsUpdate=!0,as(M,B,$),M.side=ci):as(M,B,$)}this.compile=function(M,B,Q=null){Q===null&&(Q=M),z!==null&&z.renderStart(M,B,Q),E=ne.get(Q),E.init(B),T.push(E),Q.traverseVisible(function(K){K.isLight&&K.layers.test(B.layers)&&(E.pushLight(K),K.castShadow&&E.pushShadow(K))}),M!==Q&&M.traverseVisible(function(K){K.isLight&&K.layers.test(B.layers)&&(E.pushLight(K),K.castShadow&&E.pushShadow(K))}),E.setupLights(),z!==null&&z.updateLights(E.state.lightsArray),mn=this.localClippingEnabled,Xt=se.init(this.clippingPlanes,mn),Xt===!0&&se.setGlobalState(this.clippingPlanes,B),z!==null&&me.render(E.state.shadowsArray,Q,B);let $=new Set;return M.traverse(function(K){if(!(K.isMesh||K.isPoints||K.isLine||K.isSprite))return;let Ee=K.material;if(Ee)if(Array.isArray(Ee))for(let Ie=0;Ie<Ee.length;Ie++){let Ae=Ee[Ie];ya(Ae,Q,B,K),$.add(Ae)}else ya(Ee,Q,B,K),$.add(Ee)}),E=T.pop(),z!==null&&z.renderEnd(),$},this.compileAsync=function(M,B,Q=null){let $=this.compile(M,B,Q);return new Promise(K=>{function Ee(){if($.forEach(function(Ie){let De=Ge.get(Ie).currentProgram;(De===void 0||De.isReady())&&$.delete(Ie)}),$.size===0){K(M);return}setTimeout(Ee,10)}je.get("KHR_parallel_shader_compile")!==null?Ee():setTimeout(Ee,10)})};let ro=null;function pd(M){ro&&ro(M)}function Kl(){Es.stop()}function os(){Es.start()}let Es=new D_;Es.setAnimationLoop(pd),typeof self<"u"&&Es.setContext(self),this.setAnimationLoop=function(M){ro=M,ce.setAnimationLoop(M),M===null?Es.stop():Es.start()},ce.addEventListener("sessionstart",Kl),ce.addEventListener("sessionend",os),this.render=function(M,B){if(B!==void 0&&B.isCamera!==!0){st("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(L===!0)return;z!==null&&z.renderStart(M,B);let Q=ce.enabled===!0&&ce.isPresenting===!0,$=k!==null&&(he===null||Q)&&k.begin(N,he);if(M.matrixWorldAutoUpdate===!0&&M.updateMatrixWorld(),B.parent===null&&B.matrixWorldAutoUpdate===!0&&B.updateMatrixWorld(),ce.enabled===!0&&ce.isPresenting===!0&&(k===null||k.isCompositing()===!1)&&(ce.cameraAutoUpdate===!0&&ce.updateCamera(B),B=ce.getCamera()),M.isScene===!0&&M.onBeforeRender(N,M,B,he),E=ne.get(M,T.length),E.init(B),E.state.textureUnits=Ze.getTextureUnits(),T.push(E),Bt.multiplyMatrices(B.projectionMatrix,B.matrixWorldInverse),B.isArrayCamera?en.setFromArrayCamera(B):ot.setFromProjectionMatrix(Bt,Oi,B.reversedDepth),mn=this.localClippingEnabled,Xt=se.init(this.clippingPlanes,mn),P=ve.get(M,x.length),P.init(),x.push(P),this.info.render.frame++,ce.enabled===!0&&ce.isPresenting===!0){let Ie=N.xr.getDepthSensingMesh();Ie!==null&&As(Ie,B,-1/0,N.sortObjects)}As(M,B,0,N.sortObjects),P.finish(),z!==null&&z.updateLights(E.state.lightsArray),N.sortObjects===!0&&P.sort(Xe,lt),rn=ce.enabled===!1||ce.isPresenting===!1||ce.hasDepthSensing()===!1,rn&&U.addToRenderList(P,M),this.info.autoReset===!0&&this.info.reset(),Xt===!0&&se.beginShadows();let K=E.state.shadowsArray;if(me.render(K,M,B),Xt===!0&&se.endShadows(),($&&k.hasRenderPass())===!1){let Ie=P.opaque,Ae=P.transmissive;if(E.setupLights(),B.isArrayCamera){let De=B.cameras;if(Ae.length>0)for(let Ve=0,rt=De.length;Ve<rt;Ve++){let gt=De[Ve];zi(Ie,Ae,M,gt)}rn&&U.render(M);for(let Ve=0,rt=De.length;Ve<rt;Ve++){let gt=De[Ve];va(P,M,gt,gt.viewport)}}else Ae.length>0&&zi(Ie,Ae,M,B),rn&&U.render(M),va(P,M,B)}he!==null&&H===0&&(Ze.updateMultisampleRenderTarget(he),Ze.updateRenderTargetMipmap(he)),$&&k.end(N),M.isScene===!0&&M.onAfterRender(N,M,B),be.resetDefaultState(),j=-1,ee=null,T.pop(),T.length>0?(E=T[T.length-1],Ze.setTextureUnits(E.state.textureUnits),Xt===!0&&se.setGlobalState(N.clippingPlanes,E.state.camera)):E=null,x.pop(),x.length>0?P=x[x.length-1]:P=null,z!==null&&z.renderEnd()};function As(M,B,Q,$){if(M.visible===!1)return;if(M.layers.test(B.layers)){if(M.isGroup)Q=M.renderOrder;else if(M.isLOD)M.autoUpdate===!0&&M.update(B);else if(M.isLight)E.pushLight(M),M.castShadow&&E.pushShadow(M);else if(M.isSprite){let Ie=B.isArrayCamera?en:ot;if(!M.frustumCulled||M.intersectsFrustum(Ie)){$&&wt.setFromMatrixPosition(M.matrixWorld).applyMatrix4(Bt);let Ae=ue.update(M),De=M.material;De.visible&&P.push(M,Ae,De,Q,wt.z,null,B)}}else if(M.isMesh||M.isLine||M.isPoints){let Ie=B.isArrayCamera?en:ot;if(!M.frustumCulled||M.intersectsFrustum(Ie)){let Ae=ue.update(M),De=M.material;if($&&(M.boundingSphere!==void 0?(M.boundingSphere===null&&M.computeBoundingSphere(),wt.copy(M.boundingSphere.center)):(Ae.boundingSphere===null&&Ae.computeBoundingSphere(),wt.copy(Ae.boundingSphere.center)),wt.applyMatrix4(M.matrixWorld).applyMatrix4(Bt)),Array.isArray(De)){let Ve=Ae.groups;for(let rt=0,gt=Ve.length;rt<gt;rt++){let ze=Ve[rt],_t=De[ze.materialIndex];_t&&_t.visible&&P.push(M,Ae,_t,Q,wt.z,ze,B)}}else De.visible&&P.push(M,Ae,De,Q,wt.z,null,B)}}}let Ee=M.children;for(let Ie=0,Ae=Ee.length;Ie<Ae;Ie++)As(Ee[Ie],B,Q,$)}function va(M,B,Q,$){let{opaque:K,transmissive:Ee,transparent:Ie}=M;E.setupLightsView(Q),Xt===!0&&se.setGlobalState(N.clippingPlanes,Q),$&&we.viewport(re.copy($)),K.length>0&&on(K,B,Q),Ee.length>0&&on(Ee,B,Q),Ie.length>0&&on(Ie,B,Q),we.buffers.depth.setTest(!0),we.buffers.depth.setMask(!0),we.buffers.color.setMask(!0),we.setPolygonOffset(!1)}function zi(M,B,Q,$){if((Q.isScene===!0?Q.overrideMaterial:null)!==null)return;if(E.state.transmissionRenderTarget[$.id]===void 0){let ze=je.has("EXT_color_buffer_half_float")||je.has("EXT_color_buffer_float");E.state.transmissionRenderTarget[$.id]=new Ai(1,1,{generateMipmaps:!0,type:ze?ji:ui,minFilter:qs,samples:Math.max(4,ct.samples),stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:bt.workingColorSpace})}let Ee=E.state.transmissionRenderTarget[$.id],Ie=$.viewport||re;Ee.setSize(Ie.z*N.transmissionResolutionScale,Ie.w*N.transmissionResolutionScale);let Ae=N.getRenderTarget(),De=N.getActiveCubeFace(),Ve=N.getActiveMipmapLevel();N.setRenderTarget(Ee),N.getClearColor(te),ge=N.getClearAlpha(),ge<1&&N.setClearColor(16777215,.5),N.clear(),rn&&U.render(Q);let rt=N.toneMapping;N.toneMapping=Ss;let gt=$.viewport;if($.viewport!==void 0&&($.viewport=void 0),E.setupLightsView($),Xt===!0&&se.setGlobalState(N.clippingPlanes,$),on(M,Q,$),Ze.updateMultisampleRenderTarget(Ee),Ze.updateRenderTargetMipmap(Ee),je.has("WEBGL_multisampled_render_to_texture")===!1){let ze=!1;for(let _t=0,sn=B.length;_t<sn;_t++){let Ut=B[_t],{object:Ft,geometry:Tn,material:Fe,group:_n}=Ut;if(Fe.side===ci&&Ft.layers.test($.layers)){let vt=Fe.side;Fe.side=li,Fe.needsUpdate=!0,fn(Ft,Q,$,Tn,Fe,_n),Fe.side=vt,Fe.needsUpdate=!0,ze=!0}}ze===!0&&(Ze.updateMultisampleRenderTarget(Ee),Ze.updateRenderTargetMipmap(Ee))}N.setRenderTarget(Ae,De,Ve),N.setClearColor(te,ge),gt!==void 0&&($.viewport=gt),N.toneMapping=rt}function on(M,B,Q){let $=B.isScene===!0?B.overrideMaterial:null;for(let K=0,Ee=M.length;K<Ee;K++){let Ie=M[K],{object:Ae,geometry:De,group:Ve}=Ie,rt=Ie.material;rt.allowOverride===!0&&$!==null&&(rt=$),Ae.layers.test(Q.layers)&&fn(Ae,B,Q,De,rt,Ve)}}function fn(M,B,Q,$,K,Ee){z!==null&&K.isNodeMaterial&&z.setObject(M,K),M.onBeforeRender(N,B,Q,$,K,Ee),M.modelViewMatrix.multiplyMatrices(Q.matrixWorldInverse,M.matrixWorld),M.normalMatrix.getNormalMatrix(M.modelViewMatrix),K.onBeforeRender(N,B,Q,$,M,Ee),K.transparent===!0&&K.side===ci&&K.forceSinglePass===!1?(K.side=li,K.needsUpdate=!0,N.renderBufferDirect(Q,B,$,K,M,Ee),K.side=br,K.needsUpdate=!0,N.renderBufferDirect(Q,B,$,K,M,Ee),K.side=ci):N.renderBufferDirect(Q,B,$,K,M,Ee),M.onAfterRender(N,B,Q,$,K,Ee)}function pn(M){let B=0;for(let Q of M)Q.texture!==null&&B++;return B}function as(M,B,Q){B.isScene!==!0&&(B=wn);let $=Ge.get(M),K=E.state.lights,Ee=E.state.shadowsArray,Ie=K.state.version,Ae=ae.getParameters(M,K.state,Ee,B,Q,E.state.lightProbeGridArray),De=ae.getProgramCacheKey(Ae),Ve=$.programs;$.environment=M.isMeshStandardMaterial||M.isMeshLambertMaterial||M.isMeshPhongMaterial?B.environment:null,$.fog=B.fog;let rt=M.isMeshStandardMaterial||M.isMeshLambertMaterial&&!M.envMap||M.isMeshPhongMaterial&&!M.envMap;$.envMap=A.get(M.envMap||$.environment,rt),$.envMapRotation=$.environment!==null&&M.envMap===null?B.environmentRotation:M.envMapRotation,Ve===void 0&&(M.addEventListener("dispose",ht),Ve=new Map,$.programs=Ve,$.programVariants=new Map);let gt=Ve.get(De);if(gt!==void 0){if($.currentProgram===gt&&$.lightsStateVersion===Ie)return Sa(M,Ae),gt}else Ae.uniforms=ae.getUniforms(M),z!==null&&M.isNodeMaterial&&z.build(M,Q,Ae),M.onBeforeCompile(Ae,N),gt=ae.acquireProgram(Ae,De),Ve.set(De,gt),$.uniforms=Ae.uniforms;let ze=$.uniforms;return(!M.isShaderMaterial&&!M.isRawShaderMaterial||M.clipping===!0)&&(ze.clippingPlanes=se.uniform),Sa(M,Ae),$.needsLights=Qs(M),$.lightsStateVersion=Ie,$.needsLights&&(ze.ambientLightColor.value=K.state.ambient,ze.lightProbe.value=K.state.probe,ze.sunLights.value=K.state.sun,ze.sunLightShadows.value=K.state.sunShadow,ze.directionalLights.value=K.state.directional,ze.directionalLightShadows.value=K.state.directionalShadow,ze.spotLights.value=K.state.spot,ze.spotLightShadows.value=K.state.spotShadow,ze.rectAreaLights.value=K.state.rectArea,ze.ltc_1.value=K.state.rectAreaLTC1,ze.ltc_2.value=K.state.rectAreaLTC2,ze.pointLights.value=K.state.point,ze.pointLightShadows.value=K.state.pointShadow,ze.hemisphereLights.value=K.state.hemi,ze.sunShadowMatrix.value=K.state.sunShadowMatrix,ze.sunShadowCascade.value=K.state.sunShadowCascade,ze.directionalShadowMatrix.value=K.state.directionalShadowMatrix,ze.spotLightMatrix.value=K.state.spotLightMatrix,ze.spotLightMap.value=K.state.spotLightMap,ze.pointShadowMatrix.value=K.state.pointShadowMatrix),$.numLightProbeGrids=pn(E.state.lightProbeGridArray),$.currentProgram=gt,$.uniformsList=null,gt}function fi(M,B,Q,$,K){let Ee=Ge.get(M),Ie=Ee.currentProgram.id+","+$+","+K,Ae=Ee.programVariants.get(Ie);return Ae===void 0?(Ae=as(M,B,Q),Ee.programVariants.set(Ie,Ae)):(Ee.currentProgram=Ae,Ee.uniformsList=null,Ee.outputColorSpace=$,Ee.toneMapping=K),Ae}function js(M){if(M.uniformsList===null){let B=M.currentProgram.getUniforms();M.uniformsList=sa.seqWithValue(B.seq,M.uniforms)}return M.uniformsList}function Sa(M,B){let Q=Ge.get(M);Q.outputColorSpace=B.outputColorSpace,Q.batching=B.batching,Q.batchingColor=B.batchingColor,Q.instancing=B.instancing,Q.instancingColor=B.instancingColor,Q.instancingMorph=B.instancingMorph,Q.skinning=B.skinning,Q.morphTargets=B.morphTargets,Q.morphNormals=B.morphNormals,Q.morphColors=B.morphColors,Q.morphTargetsCount=B.morphTargetsCount,Q.numClippingPlanes=B.numClippingPlanes,Q.numIntersection=B.numClipIntersection,Q.vertexAlphas=B.vertexAlphas,Q.vertexTangents=B.vertexTangents,Q.toneMapping=B.toneMapping}function ba(M,B,Q,$,K){B.isScene!==!0&&(B=wn),Ze.resetTextureUnits();let Ee=B.fog,Ie=$.isMeshStandardMaterial||$.isMeshLambertMaterial||$.isMeshPhongMaterial?B.environment:null,Ae=he===null?N.outputColorSpace:he.isXRRenderTarget===!0?he.texture.colorSpace:bt.workingColorSpace,De=$.isMeshStandardMaterial||$.isMeshLambertMaterial&&!$.envMap||$.isMeshPhongMaterial&&!$.envMap,Ve=A.get($.envMap||Ie,De),rt=$.vertexColors===!0&&!!Q.attributes.color&&Q.attributes.color.itemSize===4,gt=!!Q.attributes.tangent&&(!!$.normalMap||$.anisotropy>0),ze=!!Q.morphAttributes.position,_t=!!Q.morphAttributes.normal,sn=!!Q.morphAttributes.color,Ut=Ss;$.toneMapped&&(he===null||he.isXRRenderTarget===!0)&&(Ut=N.toneMapping);let Ft=Q.morphAttributes.position||Q.morphAttributes.normal||Q.morphAttributes.color,Tn=Ft!==void 0?Ft.length:0,Fe=Ge.get($),_n=E.state.lights;if(Xt===!0&&(mn===!0||M!==ee)){let Ot=M===ee&&$.id===j;se.setState($,M,Ot)}let vt=!1,Cs=!1;$.version===Fe.__version?Fe.needsLights&&Fe.lightsStateVersion!==_n.state.version||K.isBatchedMesh&&Fe.batching===!1||!K.isBatchedMesh&&Fe.batching===!0||K.isBatchedMesh&&Fe.batchingColor===!0&&K._colorsTexture===null||K.isBatchedMesh&&Fe.batchingColor===!1&&K._colorsTexture!==null||K.isInstancedMesh&&Fe.instancing===!1||!K.isInstancedMesh&&Fe.instancing===!0||K.isSkinnedMesh&&Fe.skinning===!1||!K.isSkinnedMesh&&Fe.skinning===!0||K.isInstancedMesh&&Fe.instancingColor===!0&&K.instanceColor===null||K.isInstancedMesh&&Fe.instancingColor===!1&&K.instanceColor!==null||K.isInstancedMesh&&Fe.instancingMorph===!0&&K.morphTexture===null||K.isInstancedMesh&&Fe.instancingMorph===!1&&K.morphTexture!==null||Fe.envMap!==Ve||$.fog===!0&&Fe.fog!==Ee||Fe.numClippingPlanes!==void 0&&(Fe.numClippingPlanes!==se.numPlanes||Fe.numIntersection!==se.numIntersection)||Fe.vertexAlphas!==rt||Fe.vertexTangents!==gt||Fe.morphTargets!==ze||Fe.morphNormals!==_t||Fe.morphColors!==sn||Fe.morphTargetsCount!==Tn||Fe.numLightProbeGrids!==pn(E.state.lightProbeGridArray)?vt=!0:(Fe.outputColorSpace!==Ae||Fe.toneMapping!==Ut)&&(Cs=!0):(vt=!0,Fe.__version=$.version);let xn=Fe.currentProgram;(vt===!0||Cs===!0)&&(xn=Cs===!0?fi($,B,K,Ae,Ut):as($,B,K),z&&$.isNodeMaterial&&z.onUpdateProgram($,xn,Fe));let lo=!1,ls=!1,Rs=!1,dt=xn.getUniforms(),an=Fe.uniforms;if(we.useProgram(xn.program)&&(lo=!0,ls=!0,Rs=!0),$.id!==j&&(j=$.id,ls=!0),lo||ee!==M){we.buffers.depth.getReversed()&&M.reversedDepth!==!0&&(M._reversedDepth=!0,M.updateProjectionMatrix()),dt.setValue(F,"projectionMatrix",M.projectionMatrix),dt.setValue(F,"viewMatrix",M.matrixWorldInverse);let yn=dt.map.cameraPosition;yn!==void 0&&yn.setValue(F,Ln.setFromMatrixPosition(M.matrixWorld)),ct.logarithmicDepthBuffer&&dt.setValue(F,"logDepthBufFC",2/(Math.log(M.far+1)/Math.LN2)),($.isMeshPhongMaterial||$.isMeshToonMaterial||$.isMeshLambertMaterial||$.isMeshBasicMaterial||$.isMeshStandardMaterial||$.isShaderMaterial)&&dt.setValue(F,"isOrthographic",M.isOrthographicCamera===!0),ee!==M&&(ee=M,ls=!0,Rs=!0)}if(Fe.needsLights&&(_n.state.sunShadowMap.length>0&&dt.setValue(F,"sunShadowMap",_n.state.sunShadowMap,Ze),_n.state.directionalShadowMap.length>0&&dt.setValue(F,"directionalShadowMap",_n.state.directionalShadowMap,Ze),_n.state.spotShadowMap.length>0&&dt.setValue(F,"spotShadowMap",_n.state.spotShadowMap,Ze),_n.state.pointShadowMap.length>0&&dt.setValue(F,"pointShadowMap",_n.state.pointShadowMap,Ze)),K.isSkinnedMesh){dt.setOptional(F,K,"bindMatrix"),dt.setOptional(F,K,"bindMatrixInverse");let Ot=K.skeleton;Ot&&(Ot.boneTexture===null&&Ot.computeBoneTexture(),dt.setValue(F,"boneTexture",Ot.boneTexture,Ze))}K.isBatchedMesh&&(dt.setOptional(F,K,"batchingTexture"),dt.setValue(F,"batchingTexture",K._matricesTexture,Ze),dt.setOptional(F,K,"batchingIdTexture"),dt.setValue(F,"batchingIdTexture",K._indirectTexture,Ze),dt.setOptional(F,K,"batchingColorTexture"),K._colorsTexture!==null&&dt.setValue(F,"batchingColorTexture",K._colorsTexture,Ze));let jn=Q.morphAttributes;if((jn.position!==void 0||jn.normal!==void 0||jn.color!==void 0)&&oe.update(K,Q,xn),(ls||Fe.receiveShadow!==K.receiveShadow)&&(Fe.receiveShadow=K.receiveShadow,dt.setValue(F,"receiveShadow",K.receiveShadow)),($.isMeshStandardMaterial||$.isMeshLambertMaterial||$.isMeshPhongMaterial)&&$.envMap===null&&B.environment!==null&&(an.envMapIntensity.value=B.environmentIntensity),an.dfgLUT!==void 0&&(an.dfgLUT.value=I1()),ls){if(dt.setValue(F,"toneMappingExposure",N.toneMappingExposure),Fe.needsLights&&oo(an,Rs),Ee&&$.fog===!0&&xe.refreshFogUniforms(an,Ee),xe.refreshMaterialUniforms(an,$,Me,Ce,E.state.transmissionRenderTarget[M.id]),Fe.needsLights&&Fe.numLightProbeGrids>0){let Ot=w,yn=0;for(let qn of E.state.lightProbeGridArray)qn.texture!==null&&(Ot.textures[yn]=qn.texture,Ot.min[yn]=qn.boundingBox.min,Ot.max[yn]=qn.boundingBox.max,Ot.resolution[yn]=qn.resolution,yn++);for(let qn in Ot)Ot[qn].length=yn;an.probesSH.value=Ot.textures,an.probesMin.value=Ot.min,an.probesMax.value=Ot.max,an.probesResolution.value=Ot.resolution}sa.upload(F,js(Fe),an,Ze)}if($.isShaderMaterial&&$.uniformsNeedUpdate===!0&&(sa.upload(F,js(Fe),an,Ze),$.uniformsNeedUpdate=!1),$.isSpriteMaterial&&dt.setValue(F,"center",K.center),dt.setValue(F,"modelViewMatrix",K.modelViewMatrix),dt.setValue(F,"normalMatrix",K.normalMatrix),dt.setValue(F,"modelMatrix",K.matrixWorld),$.uniformsGroups!==void 0){let Ot=$.uniformsGroups;for(let yn=0,qn=Ot.length;yn<qn;yn++){let Jl=Ot[yn];We.update(Jl,xn),We.bind(Jl,xn)}}return xn}function oo(M,B){M.ambientLightColor.needsUpdate=B,M.lightProbe.needsUpdate=B,M.sunLights.needsUpdate=B,M.sunLightShadows.needsUpdate=B,M.directionalLights.needsUpdate=B,M.directionalLightShadows.needsUpdate=B,M.pointLights.needsUpdate=B,M.pointLightShadows.needsUpdate=B,M.spotLights.needsUpdate=B,M.spotLightShadows.needsUpdate=B,M.rectAreaLights.needsUpdate=B,M.hemisphereLights.needsUpdate=B}function Qs(M){return M.isMeshLambertMaterial||M.isMeshToonMaterial||M.isMeshPhongMaterial||M.isMeshStandardMaterial||M.isShadowMaterial||M.isShaderMaterial&&M.lights===!0}this.getActiveCubeFace=function(){return Z},this.getActiveMipmapLevel=function(){return H},this.getRenderTarget=function(){return he},this.setRenderTargetTextures=function(M,B,Q){let $=Ge.get(M);$.__autoAllocateDepthBuffer=M.resolveDepthBuffer===!1,$.__autoAllocateDepthBuffer===!1&&($.__useRenderToTexture=!1),Ge.get(M.texture).__webglTexture=B,Ge.get(M.depthTexture).__webglTexture=$.__autoAllocateDepthBuffer?void 0:Q,$.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(M,B){let Q=Ge.get(M);Q.__webglFramebuffer=B,Q.__useDefaultFramebuffer=B===void 0},this.setRenderTarget=function(M,B=0,Q=0){he=M,Z=B,H=Q;let $=null,K=!1,Ee=!1;if(M){let Ae=Ge.get(M);if(Ae.__useDefaultFramebuffer!==void 0){we.bindFramebuffer(F.FRAMEBUFFER,Ae.__webglFramebuffer),re.copy(M.viewport),fe.copy(M.scissor),de=M.scissorTest,we.viewport(re),we.scissor(fe),we.setScissorTest(de),j=-1;return}else if(Ae.__webglFramebuffer===void 0)Ze.setupRenderTarget(M);else if(Ae.__hasExternalTextures)Ze.rebindTextures(M,Ge.get(M.texture).__webglTexture,Ge.get(M.depthTexture).__webglTexture);else if(M.depthBuffer){let rt=M.depthTexture;if(Ae.__boundDepthTexture!==rt){if(rt!==null&&Ge.has(rt)&&(M.width!==rt.image.width||M.height!==rt.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");Ze.setupDepthRenderbuffer(M)}}let De=M.texture;(De.isData3DTexture||De.isDataArrayTexture||De.isCompressedArrayTexture)&&(Ee=!0);let Ve=Ge.get(M).__webglFramebuffer;M.isWebGLCubeRenderTarget?(Array.isArray(Ve[B])?$=Ve[B][Q]:$=Ve[B],K=!0):M.samples>0&&Ze.useMultisampledRTT(M)===!1?$=Ge.get(M).__webglMultisampledFramebuffer:Array.isArray(Ve)?$=Ve[Q]:$=Ve,re.copy(M.viewport),fe.copy(M.scissor),de=M.scissorTest}else re.copy(He).multiplyScalar(Me).floor(),fe.copy(mt).multiplyScalar(Me).floor(),de=ut;if(Q!==0&&($=W),we.bindFramebuffer(F.FRAMEBUFFER,$)&&we.drawBuffers(M,$),we.viewport(re),we.scissor(fe),we.setScissorTest(de),K){let Ae=Ge.get(M.texture);F.framebufferTexture2D(F.FRAMEBUFFER,F.COLOR_ATTACHMENT0,F.TEXTURE_CUBE_MAP_POSITIVE_X+B,Ae.__webglTexture,Q)}else if(Ee){let Ae=B;for(let De=0;De<M.textures.length;De++){let Ve=Ge.get(M.textures[De]);F.framebufferTextureLayer(F.FRAMEBUFFER,F.COLOR_ATTACHMENT0+De,Ve.__webglTexture,Q,Ae)}}else if(M!==null&&Q!==0){let Ae=Ge.get(M.texture);F.framebufferTexture2D(F.FRAMEBUFFER,F.COLOR_ATTACHMENT0,F.TEXTURE_2D,Ae.__webglTexture,Q)}j=-1};function ao(M){let B=Ge.get(M);return(B.__readFormat!==M.format||B.__readType!==M.type)&&(B.__readFormat=M.format,B.__readType=M.type,B.__formatReadable=ct.textureFormatReadable(M.format),B.__typeReadable=ct.textureTypeReadable(M.type)),B}this.readRenderTargetPixels=function(M,B,Q,$,K,Ee,Ie,Ae=0){if(!(M&&M.isWebGLRenderTarget)){st("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let De=Ge.get(M).__webglFramebuffer;if(M.isWebGLCubeRenderTarget&&Ie!==void 0&&(De=De[Ie],Array.isArray(De)&&(De=De[0])),De){we.bindFramebuffer(F.FRAMEBUFFER,De);try{let Ve=M.textures[Ae],rt=Ve.format,gt=Ve.type;M.textures.length>1&&F.readBuffer(F.COLOR_ATTACHMENT0+Ae);let ze=ao(Ve);if(ze.__formatReadable===!1){st("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(ze.__typeReadable===!1){st("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}B>=0&&B<=M.width-$&&Q>=0&&Q<=M.height-K&&F.readPixels(B,Q,$,K,_e.convert(rt),_e.convert(gt),Ee)}finally{let Ve=he!==null?Ge.get(he).__webglFramebuffer:null;we.bindFramebuffer(F.FRAMEBUFFER,Ve)}}},this.readRenderTargetPixelsAsync=async function(M,B,Q,$,K,Ee,Ie,Ae=0){if(!(M&&M.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let De=Ge.get(M).__webglFramebuffer;if(M.isWebGLCubeRenderTarget&&Ie!==void 0&&(De=De[Ie],Array.isArray(De)&&(De=De[0])),De)if(B>=0&&B<=M.width-$&&Q>=0&&Q<=M.height-K){we.bindFramebuffer(F.FRAMEBUFFER,De);let Ve=M.textures[Ae],rt=Ve.format,gt=Ve.type;M.textures.length>1&&F.readBuffer(F.COLOR_ATTACHMENT0+Ae);let ze=ao(Ve);if(ze.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(ze.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let _t=F.createBuffer();F.bindBuffer(F.PIXEL_PACK_BUFFER,_t),F.bufferData(F.PIXEL_PACK_BUFFER,Ee.byteLength,F.STREAM_READ),F.readPixels(B,Q,$,K,_e.convert(rt),_e.convert(gt),0),F.bindBuffer(F.PIXEL_PACK_BUFFER,null);let sn=he!==null?Ge.get(he).__webglFramebuffer:null;we.bindFramebuffer(F.FRAMEBUFFER,sn);let Ut=F.fenceSync(F.SYNC_GPU_COMMANDS_COMPLETE,0);return F.flush(),await s_(F,Ut,4),F.bindBuffer(F.PIXEL_PACK_BUFFER,_t),F.getBufferSubData(F.PIXEL_PACK_BUFFER,0,Ee),F.bindBuffer(F.PIXEL_PACK_BUFFER,null),F.deleteBuffer(_t),F.deleteSync(Ut),Ee}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(M,B=null,Q=0){let $=Math.pow(2,-Q),K=Math.floor(M.image.width*$),Ee=Math.floor(M.image.height*$),Ie=B!==null?B.x:0,Ae=B!==null?B.y:0;Ze.setTexture2D(M,0),F.copyTexSubImage2D(F.TEXTURE_2D,Q,0,0,Ie,Ae,K,Ee),we.unbindTexture()},this.copyTextureToTexture=function(M,B,Q=null,$=null,K=0,Ee=0){let Ie,Ae,De,Ve,rt,gt,ze,_t,sn,Ut=M.isCompressedTexture?M.mipmaps[Ee]:M.image;if(Q!==null)Ie=Q.max.x-Q.min.x,Ae=Q.max.y-Q.min.y,De=Q.isBox3?Q.max.z-Q.min.z:1,Ve=Q.min.x,rt=Q.min.y,gt=Q.isBox3?Q.min.z:0;else{let dt=Math.pow(2,-K);Ie=Math.floor(Ut.width*dt),Ae=Math.floor(Ut.height*dt),M.isDataArrayTexture?De=Ut.depth:M.isData3DTexture?De=Math.floor(Ut.depth*dt):De=1,Ve=0,rt=0,gt=0}$!==null?(ze=$.x,_t=$.y,sn=$.z):(ze=0,_t=0,sn=0);let Ft=_e.convert(B.format),Tn=_e.convert(B.type),Fe;B.isData3DTexture?(Ze.setTexture3D(B,0),Fe=F.TEXTURE_3D):B.isDataArrayTexture||B.isCompressedArrayTexture?(Ze.setTexture2DArray(B,0),Fe=F.TEXTURE_2D_ARRAY):(Ze.setTexture2D(B,0),Fe=F.TEXTURE_2D),we.activeTexture(F.TEXTURE0),we.pixelStorei(F.UNPACK_FLIP_Y_WEBGL,B.flipY),we.pixelStorei(F.UNPACK_PREMULTIPLY_ALPHA_WEBGL,B.premultiplyAlpha),we.pixelStorei(F.UNPACK_ALIGNMENT,B.unpackAlignment);let _n=we.getParameter(F.UNPACK_ROW_LENGTH),vt=we.getParameter(F.UNPACK_IMAGE_HEIGHT),Cs=we.getParameter(F.UNPACK_SKIP_PIXELS),xn=we.getParameter(F.UNPACK_SKIP_ROWS),lo=we.getParameter(F.UNPACK_SKIP_IMAGES);we.pixelStorei(F.UNPACK_ROW_LENGTH,Ut.width),we.pixelStorei(F.UNPACK_IMAGE_HEIGHT,Ut.height),we.pixelStorei(F.UNPACK_SKIP_PIXELS,Ve),we.pixelStorei(F.UNPACK_SKIP_ROWS,rt),we.pixelStorei(F.UNPACK_SKIP_IMAGES,gt);let ls=M.isDataArrayTexture||M.isData3DTexture,Rs=B.isDataArrayTexture||B.isData3DTexture;if(M.isDepthTexture){let dt=Ge.get(M),an=Ge.get(B),jn=Ge.get(dt.__renderTarget),Ot=Ge.get(an.__renderTarget);we.bindFramebuffer(F.READ_FRAMEBUFFER,jn.__webglFramebuffer),we.bindFramebuffer(F.DRAW_FRAMEBUFFER,Ot.__webglFramebuffer);for(let yn=0;yn<De;yn++)ls&&(F.framebufferTextureLayer(F.READ_FRAMEBUFFER,F.COLOR_ATTACHMENT0,Ge.get(M).__webglTexture,K,gt+yn),F.framebufferTextureLayer(F.DRAW_FRAMEBUFFER,F.COLOR_ATTACHMENT0,Ge.get(B).__webglTexture,Ee,sn+yn)),F.blitFramebuffer(Ve,rt,Ve+Ie,rt+Ae,ze,_t,ze+Ie,_t+Ae,F.DEPTH_BUFFER_BIT,F.NEAREST);we.bindFramebuffer(F.READ_FRAMEBUFFER,null),we.bindFramebuffer(F.DRAW_FRAMEBUFFER,null)}else if(K!==0||M.isRenderTargetTexture||Ge.has(M)){let dt=Ge.get(M),an=Ge.get(B);we.bindFramebuffer(F.READ_FRAMEBUFFER,D),we.bindFramebuffer(F.DRAW_FRAMEBUFFER,X);for(let jn=0;jn<De;jn++)ls?F.framebufferTextureLayer(F.READ_FRAMEBUFFER,F.COLOR_ATTACHMENT0,dt.__webglTexture,K,gt+jn):F.framebufferTexture2D(F.READ_FRAMEBUFFER,F.COLOR_ATTACHMENT0,F.TEXTURE_2D,dt.__webglTexture,K),Rs?F.framebufferTextureLayer(F.DRAW_FRAMEBUFFER,F.COLOR_ATTACHMENT0,an.__webglTexture,Ee,sn+jn):F.framebufferTexture2D(F.DRAW_FRAMEBUFFER,F.COLOR_ATTACHMENT0,F.TEXTURE_2D,an.__webglTexture,Ee),K!==0?F.blitFramebuffer(Ve,rt,Ve+Ie,rt+Ae,ze,_t,ze+Ie,_t+Ae,F.COLOR_BUFFER_BIT,F.NEAREST):Rs?F.copyTexSubImage3D(Fe,Ee,ze,_t,sn+jn,Ve,rt,Ie,Ae):F.copyTexSubImage2D(Fe,Ee,ze,_t,Ve,rt,Ie,Ae);we.bindFramebuffer(F.READ_FRAMEBUFFER,null),we.bindFramebuffer(F.DRAW_FRAMEBUFFER,null)}else Rs?M.isDataTexture||M.isData3DTexture?F.texSubImage3D(Fe,Ee,ze,_t,sn,Ie,Ae,De,Ft,Tn,Ut.data):B.isCompressedArrayTexture?F.compressedTexSubImage3D(Fe,Ee,ze,_t,sn,Ie,Ae,De,Ft,Ut.data):F.texSubImage3D(Fe,Ee,ze,_t,sn,Ie,Ae,De,Ft,Tn,Ut):M.isDataTexture?F.texSubImage2D(F.TEXTURE_2D,Ee,ze,_t,Ie,Ae,Ft,Tn,Ut.data):M.isCompressedTexture?F.compressedTexSubImage2D(F.TEXTURE_2D,Ee,ze,_t,Ut.width,Ut.height,Ft,Ut.data):F.texSubImage2D(F.TEXTURE_2D,Ee,ze,_t,Ie,Ae,Ft,Tn,Ut);we.pixelStorei(F.UNPACK_ROW_LENGTH,_n),we.pixelStorei(F.UNPACK_IMAGE_HEIGHT,vt),we.pixelStorei(F.UNPACK_SKIP_PIXELS,Cs),we.pixelStorei(F.UNPACK_SKIP_ROWS,xn),we.pixelStorei(F.UNPACK_SKIP_IMAGES,lo),Ee===0&&B.generateMipmaps===!0&&B.mipmapsAutoUpdate===!0&&F.generateMipmap(Fe),we.unbindTexture()},this.initRenderTarget=function(M){Ge.get(M).__webglFramebuffer===void 0&&Ze.setupRenderTarget(M)},this.initTexture=function(M){M.isCubeTexture?Ze.setTextureCube(M,0):M.isData3DTexture?Ze.setTexture3D(M,0):M.isDataArrayTexture||M.isCompressedArrayTexture?Ze.setTexture2DArray(M,0):Ze.setTexture2D(M,0),we.unbindTexture()},this.resetState=function(){Z=0,H=0,he=null,we.reset(),be.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return Oi}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(e){this._outputColorSpace=e;let t=this.getContext();t.drawingBufferColorSpace=bt._getDrawingBufferColorSpace(e),t.unpackColorSpace=bt._getUnpackColorSpace()}};var H_=12,W_=8,oa=48;function Du({centre:n,radius:e}){return{centre:n,axes:[e,0,0,0,e,0,0,0,e]}}function Cp({centre:n,axes:e},t,i){let s=[];for(let[o,a]of D1())for(let l of[o,a])for(let c=0;c<3;c++){let h=n[c]??0;for(let u=0;u<3;u++)h+=(e[3*c+u]??0)*(l[u]??0);s.push(h)}let r=new qt;return r.setAttribute("position",new un(Float32Array.from(s),3)),new ys(r,new Zi({color:t,opacity:i,transparent:!0,depthWrite:!1}))}function X_({centre:n,axes:e},t){let[i,s]=t,r=(c,h)=>[0,1,2].reduce((u,d)=>u+(e[3*c+d]??0)*(e[3*h+d]??0),0),o=Math.sqrt(r(i,i)),a=o>0?r(i,s)/o:0,l=Math.sqrt(Math.max(0,r(s,s)-a*a));return Array.from({length:2*oa+1},(c,h)=>{let[u,d]=[Math.cos(Math.PI*h/oa),Math.sin(Math.PI*h/oa)];return[(n[i]??0)+o*u,(n[s]??0)+a*u+l*d]})}function*D1(){let n=(t,i)=>[Math.cos(t)*Math.cos(i),Math.cos(t)*Math.sin(i),Math.sin(t)],e=2*Math.PI/oa;for(let t=0;t<H_/2;t++){let i=2*Math.PI*t/H_;for(let s=0;s<oa;s++)yield[n(e*s,i),n(e*(s+1),i)]}for(let t=1;t<W_;t++){let i=-Math.PI/2+Math.PI*t/W_;for(let s=0;s<oa;s++)yield[n(i,e*s),n(i,e*(s+1))]}}var Rp={left:32,right:6,top:5,bottom:16},L1=4,N1=10,U1=`${Math.round(.92*Number.parseFloat(getComputedStyle(document.body).fontSize))}px system-ui, 'DejaVu Sans', sans-serif`,Lu=class{constructor(e,t,i,s,r,o){this.panel=e;this.plane=t;this.frames=i;this.data=s;this.maker=r;this.store=o;let[a,l]=t;this.canvas=Y("canvas",{role:"img","aria-label":`Plane ${"xyz"[a]??""}-${"xyz"[l]??""} of the force or moment space`}),e.append(this.canvas),this.encircle(),new ResizeObserver(()=>i.later(this)).observe(e)}panel;plane;frames;data;maker;store;canvas;points=document.createElement("canvas");key="";last=null;path=[];update(){this.frames.later(this)}place(e,t){let[i,s]=this.plane,{left:r,right:o,top:a,bottom:l}=Rp,[c,h]=[this.panel.clientWidth-r-o,this.panel.clientHeight-a-l],u=Math.min(c,h)/(2*e.half);return[r+c/2+((t[i]??Number.NaN)-(e.centre[i]??0))*u,a+h/2-((t[s]??Number.NaN)-(e.centre[s]??0))*u]}sampleOnScreen(e,t){let i=this.maker.of(this.store.state),s=i.clouds[e];if(!s)return null;let r=this.canvas.getBoundingClientRect(),[o,a]=this.place(i,this.data.vector(s.series,t,this.store.state.quantity));return{x:r.left+o,y:r.top+a}}draw(){let[e,t]=[this.panel.clientWidth,this.panel.clientHeight];if(e===0||t===0)return;let{state:i}=this.store,s=this.maker.of(i),r=JSON.stringify([e,t,devicePixelRatio,[...i.hidden],i.wireframes,i.selected]);(r!==this.key||s!==this.last)&&(this.key=r,this.last=s,this.drawPoints(s,q_(this.points,e,t)));let o=q_(this.canvas,e,t);if(o.drawImage(this.points,0,0,e,t),this.path.length>1){o.strokeStyle=hn,o.beginPath();for(let[a,l]of this.path)o.lineTo(a,l);o.stroke()}for(let a of this.visible(s)){let[l,c]=this.place(s,this.data.vector(a.series,i.sample,i.quantity));for(let[h,u]of[[6.5,xi],[5,a.colour],[1.8,xi]])o.fillStyle=u,o.beginPath(),o.arc(l,c,h,0,2*Math.PI),Number.isFinite(l+c)&&o.fill()}}visible(e){return e.clouds.filter(t=>!this.store.state.hidden.has(t.series.name))}drawPoints(e,t){this.drawAxes(e,t);let{left:i,right:s,top:r,bottom:o}=Rp;t.save(),t.beginPath(),t.rect(i,r,this.panel.clientWidth-i-s,this.panel.clientHeight-r-o),t.clip();let{selected:a}=this.store.state,l=Uint8Array.from(e.samples,c=>F1(a,this.data.time[c]??0)?1:0);for(let c of this.visible(e)){for(let u=0;u+2<c.points.length;u+=3){let[d,f]=this.place(e,c.points.subarray(u,u+3));t.fillStyle=a.length===0||l[u/3]?c.colour:Ni(c.colour,.12),Number.isFinite(d+f)&&t.fillRect(d-.8,f-.8,1.6,1.6)}if(!this.store.state.wireframes)continue;let h=[[c.sphere&&Du(c.sphere),rr],[c.ellipsoid,c.colour]];for(let[u,d]of h)if(u){t.strokeStyle=d,t.beginPath();for(let[f,m]of X_(u,this.plane)){let y=[0,0,0];y[this.plane[0]]=f,y[this.plane[1]]=m,t.lineTo(...this.place(e,y))}t.stroke()}}t.restore()}drawAxes(e,t){let[i,s]=this.plane,{left:r,right:o,top:a,bottom:l}=Rp,[c,h]=[this.panel.clientWidth,this.panel.clientHeight],[u,d]=[e.centre[i]??0,e.centre[s]??0],f=Math.min(c-r-o,h-a-l)/(2*e.half),m=[(c-r-o)/2/f,(h-a-l)/2/f];t.font=U1,t.fillStyle=rr,t.strokeStyle=Ir,t.textAlign="center";for(let p of Ia(u-m[0],u+m[0],c/45)){let S=this.place(e,i===0?[p,d,d]:[d,p,d])[0];Y_(t,S,a,S,h-l),S>r+8&&S<c-o-8&&t.fillText($_(p),S,h-l+11)}t.textAlign="right";for(let p of Ia(d-m[1],d+m[1],h/30)){let S=this.place(e,s===2?[u,u,p]:[u,p,u])[1];Y_(t,r,S,c-o,S),S>a+4&&t.fillText($_(p),r-4,S+4)}t.strokeStyle=Pr,t.strokeRect(r+.5,a+.5,c-r-o,h-a-l);let y=this.store.state.quantity==="force"?"f":"t",g=vi[this.store.state.quantity];t.fillStyle=hn,t.textAlign="left",t.fillText(`${y}${"xyz"[s]??""} [${g}]`,r+4,a+12),t.textAlign="right",t.fillText(`${y}${"xyz"[i]??""} [${g}]`,c-o-4,h-l-5)}encircle(){let e=null,t=i=>{let s=this.canvas.getBoundingClientRect();return[i.clientX-s.left,i.clientY-s.top]};this.canvas.addEventListener("pointerdown",i=>{i.button===0&&(e=[t(i)],this.canvas.setPointerCapture(i.pointerId))}),this.canvas.addEventListener("pointermove",i=>{e!==null&&(e.push(t(i)),this.path=e,this.frames.later(this))}),this.canvas.addEventListener("pointerup",i=>{let s=e??[];[e,this.path]=[null,[]];let[r,o]=s[0]??[0,0];s.every(([a,l])=>Math.hypot(a-r,l-o)<=L1)?this.jump(i):this.store.set({selected:this.within(s)}),this.frames.later(this)}),this.canvas.addEventListener("pointercancel",()=>{[e,this.path]=[null,[]],this.frames.later(this)})}within(e){let t=this.maker.of(this.store.state),i=this.visible(t);return zg(this.data,t,s=>i.some(({points:r})=>kg(e,...this.place(t,r.subarray(3*s,3*s+3)))))}jump(e){let t=this.maker.of(this.store.state),i=this.canvas.getBoundingClientRect(),s={sample:-1,distance:N1};for(let r of this.visible(t))t.samples.forEach((o,a)=>{let[l,c]=this.place(t,r.points.subarray(3*a,3*a+3)),h=Math.hypot(l-e.clientX+i.left,c-e.clientY+i.top);h<s.distance&&(s={sample:o,distance:h})});s.sample>=0&&this.store.set({sample:s.sample,playing:!1})}};function F1(n,e){return n.some(({start_s:t,end_s:i})=>t<=e&&e<i)}function q_(n,e,t){n.width=Math.round(e*devicePixelRatio),n.height=Math.round(t*devicePixelRatio);let i=n.getContext("2d");if(!i)throw new Error("this browser draws nothing on a canvas");return i.setTransform(devicePixelRatio,0,0,devicePixelRatio,0,0),i.fillStyle=xi,i.fillRect(0,0,e,t),i}function Y_(n,e,t,i,s){n.beginPath(),n.moveTo(e,t),n.lineTo(i,s),n.stroke()}function $_(n){return String(Number(n.toPrecision(6))).replace("-","\u2212")}var O1="uplot",B1="u-hz",k1="u-vt",z1="u-title",V1="u-wrap",G1="u-under",H1="u-over",W1="u-axis",to="u-off",X1="u-select",q1="u-cursor-x",Y1="u-cursor-y",$1="u-cursor-pt",Z1="u-legend",K1="u-live",J1="u-inline",j1="u-series",Q1="u-marker",Z_="u-label",eA="u-value",kl="width",zl="height";var K_="bottom",aa="left",Pp="right",Yp="#000",J_=Yp+"0",Ip="mousemove",j_="mousedown",Dp="mouseup",Q_="mouseenter",ex="mouseleave",tx="dblclick",tA="resize",nA="scroll",nx="change",Bu="dppxchange",$p="--",pa=typeof window<"u",Op=pa?document:null,ca=pa?window:null,iA=pa?navigator:null,It,Nu;function Bp(){let n=devicePixelRatio;It!=n&&(It=n,Nu&&zp(nx,Nu,Bp),Nu=matchMedia(`(min-resolution: ${It-.001}dppx) and (max-resolution: ${It+.001}dppx)`),no(nx,Nu,Bp),ca.dispatchEvent(new CustomEvent(Bu)))}function Ri(n,e){if(e!=null){let t=n.classList;!t.contains(e)&&t.add(e)}}function kp(n,e){let t=n.classList;t.contains(e)&&t.remove(e)}function Qt(n,e,t){n.style[e]=t+"px"}function es(n,e,t,i){let s=Op.createElement(n);return e!=null&&Ri(s,e),t?.insertBefore(s,i),s}function Bi(n,e){return es("div",n,e)}var ix=new WeakMap;function ws(n,e,t,i,s){let r="translate("+e+"px,"+t+"px)",o=ix.get(n);r!=o&&(n.style.transform=r,ix.set(n,r),e<0||t<0||e>i||t>s?Ri(n,to):kp(n,to))}var sx=new WeakMap;function rx(n,e,t){let i=e+t,s=sx.get(n);i!=s&&(sx.set(n,i),n.style.background=e,n.style.borderColor=t)}var ox=new WeakMap;function ax(n,e,t,i){let s=e+""+t,r=ox.get(n);s!=r&&(ox.set(n,s),n.style.height=t+"px",n.style.width=e+"px",n.style.marginLeft=i?-e/2+"px":0,n.style.marginTop=i?-t/2+"px":0)}var Zp={passive:!0},sA={...Zp,capture:!0};function no(n,e,t,i){e.addEventListener(n,t,i?sA:Zp)}function zp(n,e,t,i){e.removeEventListener(n,t,Zp)}pa&&Bp();function ts(n,e,t,i){let s;t=t||0,i=i||e.length-1;let r=i<=2147483647;for(;i-t>1;)s=r?t+i>>1:Pi((t+i)/2),e[s]<n?t=s:i=s;return n-e[t]<=e[i]-n?t:i}function Ux(n){return(t,i,s)=>{let r=-1,o=-1;for(let a=i;a<=s;a++)if(n(t[a])){r=a;break}for(let a=s;a>=i;a--)if(n(t[a])){o=a;break}return[r,o]}}var Fx=n=>n!=null,Ox=n=>n!=null&&n>0,Vu=Ux(Fx),rA=Ux(Ox);function oA(n,e,t,i=0,s=!1){let r=s?rA:Vu,o=s?Ox:Fx;[e,t]=r(n,e,t);let a=n[e],l=n[e];if(e>-1)if(i==1)a=n[e],l=n[t];else if(i==-1)a=n[t],l=n[e];else for(let c=e;c<=t;c++){let h=n[c];o(h)&&(h<a?a=h:h>l&&(l=h))}return[a??Ht,l??-Ht]}function Gu(n,e,t,i){let s=hx(n),r=hx(e);n==e&&(s==-1?(n*=t,e/=t):(n/=t,e*=t));let o=t==10?Zs:Bx,a=s==1?Pi:ki,l=r==1?ki:Pi,c=a(o(In(n))),h=l(o(In(e))),u=ha(t,c),d=ha(t,h);return t==10&&(c<0&&(u=Wt(u,-c)),h<0&&(d=Wt(d,-h))),i||t==2?(n=u*s,e=d*r):(n=Gx(n,u),e=Hu(e,d)),[n,e]}function Kp(n,e,t,i){let s=Gu(n,e,t,i);return n==0&&(s[0]=0),e==0&&(s[1]=0),s}var Jp=.1,lx={mode:3,pad:Jp},Gl={pad:0,soft:null,mode:0},aA={min:Gl,max:Gl};function ku(n,e,t,i){return Wu(t)?cx(n,e,t):(Gl.pad=t,Gl.soft=i?0:null,Gl.mode=i?3:0,cx(n,e,aA))}function At(n,e){return n??e}function lA(n,e,t){for(e=At(e,0),t=At(t,n.length-1);e<=t;){if(n[e]!=null)return!0;e++}return!1}function cx(n,e,t){let i=t.min,s=t.max,r=At(i.pad,0),o=At(s.pad,0),a=At(i.hard,-Ht),l=At(s.hard,Ht),c=At(i.soft,Ht),h=At(s.soft,-Ht),u=At(i.mode,0),d=At(s.mode,0),f=e-n,m=Zs(f),y=hi(In(n),In(e)),g=Zs(y),p=In(g-m);(f<1e-24||p>10)&&(f=0,(n==0||e==0)&&(f=1e-24,u==2&&c!=Ht&&(r=0),d==2&&h!=-Ht&&(o=0)));let S=f||y||1e3,C=Zs(S),w=ha(10,Pi(C)),P=S*(f==0?n==0?.1:1:r),E=Wt(Gx(n-P,w/10),24),x=n>=c&&(u==1||u==3&&E<=c||u==2&&E>=c)?c:Ht,T=hi(a,E<x&&n>=x?x:ns(x,E)),k=S*(f==0?e==0?.1:1:o),N=Wt(Hu(e+k,w/10),24),L=e<=h&&(d==1||d==3&&N>=h||d==2&&N<=h)?h:-Ht,z=ns(l,N>L&&e<=L?L:hi(L,N));return T==z&&T==0&&(z=100),[T,z]}var cA=new Intl.NumberFormat(pa?iA.language:"en-US"),jp=n=>cA.format(n),Ii=Math,Ou=Ii.PI,In=Ii.abs,Pi=Ii.floor,Pn=Ii.round,ki=Ii.ceil,ns=Ii.min,hi=Ii.max,ha=Ii.pow,hx=Ii.sign,Zs=Ii.log10,Bx=Ii.log2,hA=(n,e=1)=>Ii.sinh(n)*e,Lp=(n,e=1)=>Ii.asinh(n/e),Ht=1/0;function ux(n){return(Zs((n^n>>31)-(n>>31))|0)+1}function Vp(n,e,t){return ns(hi(n,e),t)}function kx(n){return typeof n=="function"}function Mt(n){return kx(n)?n:()=>n}var uA=()=>{},zx=n=>n,Vx=(n,e)=>e,dA=n=>null,dx=n=>!0,fx=(n,e)=>n==e,fA=/\.\d*?(?=9{6,}|0{6,})/gm,io=n=>{if(Wx(n)||Er.has(n))return n;let e=`${n}`,t=e.match(fA);if(t==null)return n;let i=t[0].length-1;if(e.indexOf("e-")!=-1){let[s,r]=e.split("e");return+`${io(s)}e${r}`}return Wt(n,i)};function Qr(n,e){return io(Wt(io(n/e))*e)}function Hu(n,e){return io(ki(io(n/e))*e)}function Gx(n,e){return io(Pi(io(n/e))*e)}function Wt(n,e=0){if(Wx(n))return n;let t=10**e,i=n*t*(1+Number.EPSILON);return Pn(i)/t}var Er=new Map;function Hx(n){return((""+n).split(".")[1]||"").length}function Wl(n,e,t,i){let s=[],r=i.map(Hx);for(let o=e;o<t;o++){let a=In(o),l=Wt(ha(n,o),a);for(let c=0;c<i.length;c++){let h=n==10?+`${i[c]}e${o}`:i[c]*l,u=(o>=0?0:a)+(o>=r[c]?0:r[c]),d=n==10?h:Wt(h,u);s.push(d),Er.set(d,u)}}return s}var Hl={},Qp=[],ua=[null,null],Tr=Array.isArray,Wx=Number.isInteger,pA=n=>n===void 0;function px(n){return typeof n=="string"}function Wu(n){let e=!1;if(n!=null){let t=n.constructor;e=t==null||t==Object}return e}function mA(n){return n!=null&&typeof n=="object"}var gA=Object.getPrototypeOf(Uint8Array),Xx="__proto__";function da(n,e=Wu){let t;if(Tr(n)){let i=n.find(s=>s!=null);if(Tr(i)||e(i)){t=Array(n.length);for(let s=0;s<n.length;s++)t[s]=da(n[s],e)}else t=n.slice()}else if(n instanceof gA)t=n.slice();else if(e(n)){t={};for(let i in n)i!=Xx&&(t[i]=da(n[i],e))}else t=n;return t}function Mn(n){let e=arguments;for(let t=1;t<e.length;t++){let i=e[t];for(let s in i)s!=Xx&&(Wu(n[s])?Mn(n[s],da(i[s])):n[s]=da(i[s]))}return n}var _A=0,xA=1,yA=2;function vA(n,e,t){for(let i=0,s,r=-1;i<e.length;i++){let o=e[i];if(o>r){for(s=o-1;s>=0&&n[s]==null;)n[s--]=null;for(s=o+1;s<t&&n[s]==null;)n[r=s++]=null}}}function SA(n,e){if(wA(n)){let o=n[0].slice();for(let a=1;a<n.length;a++)o.push(...n[a].slice(1));return TA(o[0])||(o=MA(o)),o}let t=new Set;for(let o=0;o<n.length;o++){let l=n[o][0],c=l.length;for(let h=0;h<c;h++)t.add(l[h])}let i=[Array.from(t).sort((o,a)=>o-a)],s=i[0].length,r=new Map;for(let o=0;o<s;o++)r.set(i[0][o],o);for(let o=0;o<n.length;o++){let a=n[o],l=a[0];for(let c=1;c<a.length;c++){let h=a[c],u=Array(s).fill(void 0),d=e?e[o][c]:xA,f=[];for(let m=0;m<h.length;m++){let y=h[m],g=r.get(l[m]);y===null?d!=_A&&(u[g]=y,d==yA&&f.push(g)):u[g]=y}vA(u,f,s),i.push(u)}}return i}var bA=typeof queueMicrotask>"u"?n=>Promise.resolve().then(n):queueMicrotask;function MA(n){let e=n[0],t=e.length,i=Array(t);for(let r=0;r<i.length;r++)i[r]=r;i.sort((r,o)=>e[r]-e[o]);let s=[];for(let r=0;r<n.length;r++){let o=n[r],a=Array(t);for(let l=0;l<t;l++)a[l]=o[i[l]];s.push(a)}return s}function wA(n){let e=n[0][0],t=e.length;for(let i=1;i<n.length;i++){let s=n[i][0];if(s.length!=t)return!1;if(s!=e){for(let r=0;r<t;r++)if(s[r]!=e[r])return!1}}return!0}function TA(n,e=100){let t=n.length;if(t<=1)return!0;let i=0,s=t-1;for(;i<=s&&n[i]==null;)i++;for(;s>=i&&n[s]==null;)s--;if(s<=i)return!0;let r=hi(1,Pi((s-i+1)/e));for(let o=n[i],a=i+r;a<=s;a+=r){let l=n[a];if(l!=null){if(l<=o)return!1;o=l}}return!0}var qx=["January","February","March","April","May","June","July","August","September","October","November","December"],Yx=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function $x(n){return n.slice(0,3)}var EA=Yx.map($x),AA=qx.map($x),CA={MMMM:qx,MMM:AA,WWWW:Yx,WWW:EA};function Bl(n){return(n<10?"0":"")+n}function RA(n){return(n<10?"00":n<100?"0":"")+n}var PA={YYYY:n=>n.getFullYear(),YY:n=>(n.getFullYear()+"").slice(2),MMMM:(n,e)=>e.MMMM[n.getMonth()],MMM:(n,e)=>e.MMM[n.getMonth()],MM:n=>Bl(n.getMonth()+1),M:n=>n.getMonth()+1,DD:n=>Bl(n.getDate()),D:n=>n.getDate(),WWWW:(n,e)=>e.WWWW[n.getDay()],WWW:(n,e)=>e.WWW[n.getDay()],HH:n=>Bl(n.getHours()),H:n=>n.getHours(),h:n=>{let e=n.getHours();return e==0?12:e>12?e-12:e},AA:n=>n.getHours()>=12?"PM":"AM",aa:n=>n.getHours()>=12?"pm":"am",a:n=>n.getHours()>=12?"p":"a",mm:n=>Bl(n.getMinutes()),m:n=>n.getMinutes(),ss:n=>Bl(n.getSeconds()),s:n=>n.getSeconds(),fff:n=>RA(n.getMilliseconds())};function em(n,e){e=e||CA;let t=[],i=/\{([a-z]+)\}|[^{]+/gi,s;for(;s=i.exec(n);)t.push(s[0][0]=="{"?PA[s[1]]:s[0]);return r=>{let o="";for(let a=0;a<t.length;a++)o+=typeof t[a]=="string"?t[a]:t[a](r,e);return o}}var IA=new Intl.DateTimeFormat().resolvedOptions().timeZone;function DA(n,e){let t;return e=="UTC"||e=="Etc/UTC"?t=new Date(+n+n.getTimezoneOffset()*6e4):e==IA?t=n:(t=new Date(n.toLocaleString("en-US",{timeZone:e})),t.setMilliseconds(n.getMilliseconds())),t}var Zx=n=>n%1==0,zu=[1,2,2.5,5],LA=Wl(10,-32,0,zu),Kx=Wl(10,0,32,zu),NA=Kx.filter(Zx),eo=LA.concat(Kx),tm=`
`,Jx="{YYYY}",mx=tm+Jx,jx="{M}/{D}",Vl=tm+jx,Uu=Vl+"/{YY}",Qx="{aa}",UA="{h}:{mm}",la=UA+Qx,gx=tm+la,_x=":{ss}",Nt=null;function ey(n){let e=n*1e3,t=e*60,i=t*60,s=i*24,r=s*30,o=s*365,l=(n==1?Wl(10,0,3,zu).filter(Zx):Wl(10,-3,0,zu)).concat([e,e*5,e*10,e*15,e*30,t,t*5,t*10,t*15,t*30,i,i*2,i*3,i*4,i*6,i*8,i*12,s,s*2,s*3,s*4,s*5,s*6,s*7,s*8,s*9,s*10,s*15,r,r*2,r*3,r*4,r*6,o,o*2,o*5,o*10,o*25,o*50,o*100]),c=[[o,Jx,Nt,Nt,Nt,Nt,Nt,Nt,1],[s*28,"{MMM}",mx,Nt,Nt,Nt,Nt,Nt,1],[s,jx,mx,Nt,Nt,Nt,Nt,Nt,1],[i,"{h}"+Qx,Uu,Nt,Vl,Nt,Nt,Nt,1],[t,la,Uu,Nt,Vl,Nt,Nt,Nt,1],[e,_x,Uu+" "+la,Nt,Vl+" "+la,Nt,gx,Nt,1],[n,_x+".{fff}",Uu+" "+la,Nt,Vl+" "+la,Nt,gx,Nt,1]];function h(u){return(d,f,m,y,g,p)=>{let S=[],C=g>=o,w=g>=r&&g<o,P=u(m),E=Wt(P*n,3),x=Np(P.getFullYear(),C?0:P.getMonth(),w||C?1:P.getDate()),T=Wt(x*n,3);if(w||C){let k=w?g/r:0,N=C?g/o:0,L=E==T?E:Wt(Np(x.getFullYear()+N,x.getMonth()+k,1)*n,3),z=new Date(Pn(L/n)),W=z.getFullYear(),D=z.getMonth();for(let X=0;L<=y;X++){let Z=Np(W+N*X,D+k*X,1),H=Z-u(Wt(Z*n,3));L=Wt((+Z+H)*n,3),L<=y&&S.push(L)}}else{let k=g>=s?s:g,N=Pi(m)-Pi(E),L=T+N+Hu(E-T,k);S.push(L);let z=u(L),W=z.getHours()+z.getMinutes()/t+z.getSeconds()/i,D=g/i,X=d.axes[f]._space,Z=p/X;for(;L=Wt(L+g,n==1?0:3),!(L>y);)if(D>1){let H=Pi(Wt(W+D,6))%24,ee=u(L).getHours()-H;ee>1&&(ee=-1),L-=ee*i,W=(W+D)%24;let re=S[S.length-1];Wt((L-re)/g,3)*Z>=.7&&S.push(L)}else S.push(L)}return S}}return[l,c,h]}var[FA,OA,BA]=ey(1),[kA,zA,VA]=ey(.001);Wl(2,-53,53,[1]);function xx(n,e){return n.map(t=>t.map((i,s)=>s==0||s==8||i==null?i:e(s==1||t[8]==0?i:t[1]+i)))}function yx(n,e){return(t,i,s,r,o)=>{let a=e.find(m=>o>=m[0])||e[e.length-1],l,c,h,u,d,f;return i.map(m=>{let y=n(m),g=y.getFullYear(),p=y.getMonth(),S=y.getDate(),C=y.getHours(),w=y.getMinutes(),P=y.getSeconds(),E=g!=l&&a[2]||p!=c&&a[3]||S!=h&&a[4]||C!=u&&a[5]||w!=d&&a[6]||P!=f&&a[7]||a[1];return l=g,c=p,h=S,u=C,d=w,f=P,E(y)})}}function GA(n,e){let t=em(e);return(i,s,r,o,a)=>s.map(l=>t(n(l)))}function Np(n,e,t){return new Date(n,e,t)}function vx(n,e){return e(n)}var HA="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function Sx(n,e){return(t,i,s,r)=>r==null?$p:e(n(i))}function WA(n,e){let t=n.series[e];return t.width?t.stroke(n,e):t.points.width?t.points.stroke(n,e):null}function XA(n,e){return n.series[e].fill(n,e)}var qA={show:!0,live:!0,isolate:!1,mount:uA,markers:{show:!0,width:2,stroke:WA,fill:XA,dash:"solid"},idx:null,idxs:null,values:[]};function YA(n,e){let t=n.cursor.points,i=Bi(),s=t.size(n,e);Qt(i,kl,s),Qt(i,zl,s);let r=s/-2;Qt(i,"marginLeft",r),Qt(i,"marginTop",r);let o=t.width(n,e,s);return o&&Qt(i,"borderWidth",o),i}function $A(n,e){let t=n.series[e].points;return t._fill||t._stroke}function ZA(n,e){let t=n.series[e].points;return t._stroke||t._fill}function KA(n,e){return n.series[e].points.size}var Up=[0,0];function JA(n,e,t){return Up[0]=e,Up[1]=t,Up}function Fu(n,e,t,i=!0){return s=>{s.button==0&&(!i||s.target==e)&&t(s)}}function Fp(n,e,t,i=!0){return s=>{(!i||s.target==e)&&t(s)}}var jA={show:!0,x:!0,y:!0,lock:!1,move:JA,points:{one:!1,show:YA,size:KA,width:0,stroke:ZA,fill:$A},bind:{mousedown:Fu,mouseup:Fu,click:Fu,dblclick:Fu,mousemove:Fp,mouseleave:Fp,mouseenter:Fp},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(n,e)=>{e.stopPropagation(),e.stopImmediatePropagation()},_x:!1,_y:!1},focus:{dist:(n,e,t,i,s)=>i-s,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},ty={show:!0,stroke:"rgba(0,0,0,0.07)",width:2},nm=Mn({},ty,{filter:Vx}),ny=Mn({},nm,{size:10}),iy=Mn({},ty,{show:!1}),im='12px system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',sy="bold "+im,ry=1.5,bx={show:!0,scale:"x",stroke:Yp,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:sy,side:2,grid:nm,ticks:ny,border:iy,font:im,lineGap:ry,rotate:0},QA="Value",eC="Time",Mx={show:!0,scale:"x",auto:!1,sorted:1,min:Ht,max:-Ht,idxs:[]};function tC(n,e,t,i,s){return e.map(r=>r==null?"":jp(r))}function nC(n,e,t,i,s,r,o){let a=[],l=Er.get(s)||0;t=o?t:Wt(Hu(t,s),l);for(let c=t;c<=i;c=Wt(c+s,l))a.push(Object.is(c,-0)?0:c);return a}function Gp(n,e,t,i,s,r,o){let a=[],l=n.scales[n.axes[e].scale].log,c=l==10?Zs:Bx,h=Pi(c(t));s=ha(l,h),l==10&&(s=eo[ts(s,eo)]);let u=t,d=s*l;l==10&&(d=eo[ts(d,eo)]);do a.push(u),u=u+s,l==10&&!Er.has(u)&&(u=Wt(u,Er.get(s))),u>=d&&(s=u,d=s*l,l==10&&(d=eo[ts(d,eo)]));while(u<=i);return a}function iC(n,e,t,i,s,r,o){let l=n.scales[n.axes[e].scale].asinh,c=i>l?Gp(n,e,hi(l,t),i,s):[l],h=i>=0&&t<=0?[0]:[];return(t<-l?Gp(n,e,hi(l,-i),-t,s):[l]).reverse().map(d=>-d).concat(h,c)}var oy=/./,sC=/[12357]/,rC=/[125]/,wx=/1/,Hp=(n,e,t,i)=>n.map((s,r)=>e==4&&s==0||r%i==0&&t.test(s.toExponential()[s<0?1:0])?s:null);function oC(n,e,t,i,s){let r=n.axes[t],o=r.scale,a=n.scales[o],l=n.valToPos,c=r._space,h=l(10,o),u=l(9,o)-h>=c?oy:l(7,o)-h>=c?sC:l(5,o)-h>=c?rC:wx;if(u==wx){let d=In(l(1,o)-h);if(d<c)return Hp(e.slice().reverse(),a.distr,u,ki(c/d)).reverse()}return Hp(e,a.distr,u,1)}function aC(n,e,t,i,s){let r=n.axes[t],o=r.scale,a=r._space,l=n.valToPos,c=In(l(1,o)-l(2,o));return c<a?Hp(e.slice().reverse(),3,oy,ki(a/c)).reverse():e}function lC(n,e,t,i){return i==null?$p:e==null?"":jp(e)}var Tx={show:!0,scale:"y",stroke:Yp,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:sy,side:3,grid:nm,ticks:ny,border:iy,font:im,lineGap:ry,rotate:0};function cC(n,e){let t=3+(n||1)*2;return Wt(t*e,3)}function hC(n,e){let{scale:t,idxs:i}=n.series[0],s=n._data[0],r=n.valToPos(s[i[0]],t,!0),o=n.valToPos(s[i[1]],t,!0),a=In(o-r),l=n.series[e],c=a/(l.points.space*It);return i[1]-i[0]<=c}var Ex={scale:null,auto:!0,sorted:0,min:Ht,max:-Ht},ay=(n,e,t,i,s)=>s,Ax={show:!0,auto:!0,sorted:0,gaps:ay,alpha:1,facets:[Mn({},Ex,{scale:"x"}),Mn({},Ex,{scale:"y"})]},Cx={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,gaps:ay,alpha:1,points:{show:hC,filter:null},values:null,min:Ht,max:-Ht,idxs:[],path:null,clip:null};function uC(n,e,t,i,s){return t/10}var ly={time:!0,auto:!0,distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},dC=Mn({},ly,{time:!1,ori:1}),Rx={};function cy(n,e){let t=Rx[n];return t||(t={key:n,plots:[],sub(i){t.plots.push(i)},unsub(i){t.plots=t.plots.filter(s=>s!=i)},pub(i,s,r,o,a,l,c){for(let h=0;h<t.plots.length;h++)t.plots[h]!=s&&t.plots[h].pub(i,s,r,o,a,l,c)}},n!=null&&(Rx[n]=t)),t}var fa=1,Wp=2;function so(n,e,t){let i=n.mode,s=n.series[e],r=i==2?n._data[e]:n._data,o=n.scales,a=n.bbox,l=r[0],c=i==2?r[1]:r[e],h=i==2?o[s.facets[0].scale]:o[n.series[0].scale],u=i==2?o[s.facets[1].scale]:o[s.scale],d=a.left,f=a.top,m=a.width,y=a.height,g=n.valToPosH,p=n.valToPosV;return h.ori==0?t(s,l,c,h,u,g,p,d,f,m,y,qu,ma,$u,uy,fy):t(s,l,c,h,u,p,g,f,d,y,m,Yu,ga,om,dy,py)}function sm(n,e){let t=0,i=0,s=At(n.bands,Qp);for(let r=0;r<s.length;r++){let o=s[r];o.series[0]==e?t=o.dir:o.series[1]==e&&(o.dir==1?i|=1:i|=2)}return[t,i==1?-1:i==2?1:i==3?2:0]}function fC(n,e,t,i,s){let r=n.mode,o=n.series[e],a=r==2?o.facets[1].scale:o.scale,l=n.scales[a];return s==-1?l.min:s==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function Ks(n,e,t,i,s,r){return so(n,e,(o,a,l,c,h,u,d,f,m,y,g)=>{let p=o.pxRound,S=c.dir*(c.ori==0?1:-1),C=c.ori==0?ma:ga,w,P;S==1?(w=t,P=i):(w=i,P=t);let E=p(u(a[w],c,y,f)),x=p(d(l[w],h,g,m)),T=p(u(a[P],c,y,f)),k=p(d(r==1?h.max:h.min,h,g,m)),N=new Path2D(s);return C(N,T,k),C(N,E,k),C(N,E,x),N})}function Xu(n,e,t,i,s,r){let o=null;if(n.length>0){o=new Path2D;let a=e==0?$u:om,l=t;for(let u=0;u<n.length;u++){let d=n[u];if(d[1]>d[0]){let f=d[0]-l;f>0&&a(o,l,i,f,i+r),l=d[1]}}let c=t+s-l,h=10;c>0&&a(o,l,i-h/2,c,i+r+h)}return o}function pC(n,e,t){let i=n[n.length-1];i&&i[0]==e?i[1]=t:n.push([e,t])}function rm(n,e,t,i,s,r,o){let a=[],l=n.length;for(let c=s==1?t:i;c>=t&&c<=i;c+=s)if(e[c]===null){let u=c,d=c;if(s==1)for(;++c<=i&&e[c]===null;)d=c;else for(;--c>=t&&e[c]===null;)d=c;let f=r(n[u]),m=d==u?f:r(n[d]),y=u-s;f=o<=0&&y>=0&&y<l?r(n[y]):f;let p=d+s;m=o>=0&&p>=0&&p<l?r(n[p]):m,m>=f&&a.push([f,m])}return a}function Px(n){return n==0?zx:n==1?Pn:e=>Qr(e,n)}function hy(n){let e=n==0?qu:Yu,t=n==0?(s,r,o,a,l,c)=>{s.arcTo(r,o,a,l,c)}:(s,r,o,a,l,c)=>{s.arcTo(o,r,l,a,c)},i=n==0?(s,r,o,a,l)=>{s.rect(r,o,a,l)}:(s,r,o,a,l)=>{s.rect(o,r,l,a)};return(s,r,o,a,l,c=0,h=0)=>{c==0&&h==0?i(s,r,o,a,l):(c=ns(c,a/2,l/2),h=ns(h,a/2,l/2),e(s,r+c,o),t(s,r+a,o,r+a,o+l,c),t(s,r+a,o+l,r,o+l,h),t(s,r,o+l,r,o,h),t(s,r,o,r+a,o,c),s.closePath())}}var qu=(n,e,t)=>{n.moveTo(e,t)},Yu=(n,e,t)=>{n.moveTo(t,e)},ma=(n,e,t)=>{n.lineTo(e,t)},ga=(n,e,t)=>{n.lineTo(t,e)},$u=hy(0),om=hy(1),uy=(n,e,t,i,s,r)=>{n.arc(e,t,i,s,r)},dy=(n,e,t,i,s,r)=>{n.arc(t,e,i,s,r)},fy=(n,e,t,i,s,r,o)=>{n.bezierCurveTo(e,t,i,s,r,o)},py=(n,e,t,i,s,r,o)=>{n.bezierCurveTo(t,e,s,i,o,r)};function my(n){return(e,t,i,s,r)=>so(e,t,(o,a,l,c,h,u,d,f,m,y,g)=>{let{pxRound:p,points:S}=o,C,w;c.ori==0?(C=qu,w=uy):(C=Yu,w=dy);let P=Wt(S.width*It,3),E=(S.size-S.width)/2*It,x=Wt(E*2,3),T=new Path2D,k=new Path2D,{left:N,top:L,width:z,height:W}=e.bbox;$u(k,N-x,L-x,z+x*2,W+x*2);let D=X=>{if(l[X]!=null){let Z=p(u(a[X],c,y,f)),H=p(d(l[X],h,g,m));C(T,Z+E,H),w(T,Z,H,E,0,Ou*2)}};if(r)r.forEach(D);else for(let X=i;X<=s;X++)D(X);return{stroke:P>0?T:null,fill:T,clip:k,flags:fa|Wp}})}function gy(n){return(e,t,i,s,r,o)=>{i!=s&&(r!=i&&o!=i&&n(e,t,i),r!=s&&o!=s&&n(e,t,s),n(e,t,o))}}var mC=gy(ma),gC=gy(ga);function _y(n){let e=At(n?.alignGaps,0);return(t,i,s,r)=>so(t,i,(o,a,l,c,h,u,d,f,m,y,g)=>{[s,r]=Vu(l,s,r);let p=o.pxRound,S=W=>p(u(W,c,y,f)),C=W=>p(d(W,h,g,m)),w,P;c.ori==0?(w=ma,P=mC):(w=ga,P=gC);let E=c.dir*(c.ori==0?1:-1),x={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:fa},T=x.stroke,k=!1;if(r-s>=y*4){let W=de=>t.posToVal(de,c.key,!0),D=null,X=null,Z,H,he,j=S(a[E==1?s:r]),ee=S(a[s]),re=S(a[r]),fe=W(E==1?ee+1:re-1);for(let de=E==1?s:r;de>=s&&de<=r;de+=E){let te=a[de],ye=(E==1?te<fe:te>fe)?j:S(te),Ce=l[de];ye==j?Ce!=null?(H=Ce,D==null?(w(T,ye,C(H)),Z=D=X=H):H<D?D=H:H>X&&(X=H)):Ce===null&&(k=!0):(D!=null&&P(T,j,C(D),C(X),C(Z),C(H)),Ce!=null?(H=Ce,w(T,ye,C(H)),D=X=Z=H):(D=X=null,Ce===null&&(k=!0)),j=ye,fe=W(j+E))}D!=null&&D!=X&&he!=j&&P(T,j,C(D),C(X),C(Z),C(H))}else for(let W=E==1?s:r;W>=s&&W<=r;W+=E){let D=l[W];D===null?k=!0:D!=null&&w(T,S(a[W]),C(D))}let[L,z]=sm(t,i);if(o.fill!=null||L!=0){let W=x.fill=new Path2D(T),D=o.fillTo(t,i,o.min,o.max,L),X=C(D),Z=S(a[s]),H=S(a[r]);E==-1&&([H,Z]=[Z,H]),w(W,H,X),w(W,Z,X)}if(!o.spanGaps){let W=[];k&&W.push(...rm(a,l,s,r,E,S,e)),x.gaps=W=o.gaps(t,i,s,r,W),x.clip=Xu(W,c.ori,f,m,y,g)}return z!=0&&(x.band=z==2?[Ks(t,i,s,r,T,-1),Ks(t,i,s,r,T,1)]:Ks(t,i,s,r,T,z)),x})}function _C(n){let e=At(n.align,1),t=At(n.ascDesc,!1),i=At(n.alignGaps,0),s=At(n.extend,!1);return(r,o,a,l)=>so(r,o,(c,h,u,d,f,m,y,g,p,S,C)=>{[a,l]=Vu(u,a,l);let w=c.pxRound,{left:P,width:E}=r.bbox,x=ee=>w(m(ee,d,S,g)),T=ee=>w(y(ee,f,C,p)),k=d.ori==0?ma:ga,N={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:fa},L=N.stroke,z=d.dir*(d.ori==0?1:-1),W=T(u[z==1?a:l]),D=x(h[z==1?a:l]),X=D,Z=D;s&&e==-1&&(Z=P,k(L,Z,W)),k(L,D,W);for(let ee=z==1?a:l;ee>=a&&ee<=l;ee+=z){let re=u[ee];if(re==null)continue;let fe=x(h[ee]),de=T(re);e==1?k(L,fe,W):k(L,X,de),k(L,fe,de),W=de,X=fe}let H=X;s&&e==1&&(H=P+E,k(L,H,W));let[he,j]=sm(r,o);if(c.fill!=null||he!=0){let ee=N.fill=new Path2D(L),re=c.fillTo(r,o,c.min,c.max,he),fe=T(re);k(ee,H,fe),k(ee,Z,fe)}if(!c.spanGaps){let ee=[];ee.push(...rm(h,u,a,l,z,x,i));let re=c.width*It/2,fe=t||e==1?re:-re,de=t||e==-1?-re:re;ee.forEach(te=>{te[0]+=fe,te[1]+=de}),N.gaps=ee=c.gaps(r,o,a,l,ee),N.clip=Xu(ee,d.ori,g,p,S,C)}return j!=0&&(N.band=j==2?[Ks(r,o,a,l,L,-1),Ks(r,o,a,l,L,1)]:Ks(r,o,a,l,L,j)),N})}function Ix(n,e,t,i,s,r,o=Ht){if(n.length>1){let a=null;for(let l=0,c=1/0;l<n.length;l++)if(e[l]!==void 0){if(a!=null){let h=In(n[l]-n[a]);h<c&&(c=h,o=In(t(n[l],i,s,r)-t(n[a],i,s,r)))}a=l}}return o}function xC(n){n=n||Hl;let e=At(n.size,[.6,Ht,1]),t=n.align||0,i=n.gap||0,s=n.radius;s=s==null?[0,0]:typeof s=="number"?[s,0]:s;let r=Mt(s),o=1-e[0],a=At(e[1],Ht),l=At(e[2],1),c=At(n.disp,Hl),h=At(n.each,f=>{}),{fill:u,stroke:d}=c;return(f,m,y,g)=>so(f,m,(p,S,C,w,P,E,x,T,k,N,L)=>{let z=p.pxRound,W=t,D=i*It,X=a*It,Z=l*It,H,he;w.ori==0?[H,he]=r(f,m):[he,H]=r(f,m);let j=w.dir*(w.ori==0?1:-1),ee=w.ori==0?$u:om,re=w.ori==0?h:(Pe,je,ct,we,Gt,Ge,Ze)=>{h(Pe,je,ct,Gt,we,Ze,Ge)},fe=At(f.bands,Qp).find(Pe=>Pe.series[0]==m),de=fe!=null?fe.dir:0,te=p.fillTo(f,m,p.min,p.max,de),ge=z(x(te,P,L,k)),ye,Ce,Me,Xe=N,lt=z(p.width*It),He=!1,mt=null,ut=null,ot=null,en=null;u!=null&&(lt==0||d!=null)&&(He=!0,mt=u.values(f,m,y,g),ut=new Map,new Set(mt).forEach(Pe=>{Pe!=null&&ut.set(Pe,new Path2D)}),lt>0&&(ot=d.values(f,m,y,g),en=new Map,new Set(ot).forEach(Pe=>{Pe!=null&&en.set(Pe,new Path2D)})));let{x0:Xt,size:mn}=c;if(Xt!=null&&mn!=null){W=1,S=Xt.values(f,m,y,g),Xt.unit==2&&(S=S.map(ct=>f.posToVal(T+ct*N,w.key,!0)));let Pe=mn.values(f,m,y,g);mn.unit==2?Ce=Pe[0]*N:Ce=E(Pe[0],w,N,T)-E(0,w,N,T),Xe=Ix(S,C,E,w,N,T,Xe),Me=Xe-Ce+D}else Xe=Ix(S,C,E,w,N,T,Xe),Me=Xe*o+D,Ce=Xe-Me;Me<1&&(Me=0),lt>=Ce/2&&(lt=0),Me<5&&(z=zx);let Bt=Me>0,Ln=Xe-Me-(Bt?lt:0);Ce=z(Vp(Ln,Z,X)),ye=(W==0?Ce/2:W==j?0:Ce)-W*j*((W==0?D/2:0)+(Bt?lt/2:0));let wt={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},wn=He?null:new Path2D,rn=null;if(fe!=null)rn=f.data[fe.series[1]];else{let{y0:Pe,y1:je}=c;Pe!=null&&je!=null&&(C=je.values(f,m,y,g),rn=Pe.values(f,m,y,g))}let gn=H*Ce,F=he*Ce;for(let Pe=j==1?y:g;Pe>=y&&Pe<=g;Pe+=j){let je=C[Pe];if(je==null)continue;if(rn!=null){let q=rn[Pe]??0;if(je-q==0)continue;ge=x(q,P,L,k)}let ct=w.distr!=2||c!=null?S[Pe]:Pe,we=E(ct,w,N,T),Gt=x(At(je,te),P,L,k),Ge=z(we-ye),Ze=z(hi(Gt,ge)),A=z(ns(Gt,ge)),v=Ze-A;if(je!=null){let q=je<0?F:gn,ue=je<0?gn:F;He?(lt>0&&ot[Pe]!=null&&ee(en.get(ot[Pe]),Ge,A+Pi(lt/2),Ce,hi(0,v-lt),q,ue),mt[Pe]!=null&&ee(ut.get(mt[Pe]),Ge,A+Pi(lt/2),Ce,hi(0,v-lt),q,ue)):ee(wn,Ge,A+Pi(lt/2),Ce,hi(0,v-lt),q,ue),re(f,m,Pe,Ge-lt/2,A,Ce+lt,v)}}return lt>0?wt.stroke=He?en:wn:He||(wt._fill=p.width==0?p._fill:p._stroke??p._fill,wt.width=0),wt.fill=He?ut:wn,wt})}function yC(n,e){let t=At(e?.alignGaps,0);return(i,s,r,o)=>so(i,s,(a,l,c,h,u,d,f,m,y,g,p)=>{[r,o]=Vu(c,r,o);let S=a.pxRound,C=H=>S(d(H,h,g,m)),w=H=>S(f(H,u,p,y)),P,E,x;h.ori==0?(P=qu,x=ma,E=fy):(P=Yu,x=ga,E=py);let T=h.dir*(h.ori==0?1:-1),k=C(l[T==1?r:o]),N=k,L=[],z=[];for(let H=T==1?r:o;H>=r&&H<=o;H+=T)if(c[H]!=null){let j=l[H],ee=C(j);L.push(N=ee),z.push(w(c[H]))}let W={stroke:n(L,z,P,x,E,S),fill:null,clip:null,band:null,gaps:null,flags:fa},D=W.stroke,[X,Z]=sm(i,s);if(a.fill!=null||X!=0){let H=W.fill=new Path2D(D),he=a.fillTo(i,s,a.min,a.max,X),j=w(he);x(H,N,j),x(H,k,j)}if(!a.spanGaps){let H=[];H.push(...rm(l,c,r,o,T,C,t)),W.gaps=H=a.gaps(i,s,r,o,H),W.clip=Xu(H,h.ori,m,y,g,p)}return Z!=0&&(W.band=Z==2?[Ks(i,s,r,o,D,-1),Ks(i,s,r,o,D,1)]:Ks(i,s,r,o,D,Z)),W})}function vC(n){return yC(SC,n)}function SC(n,e,t,i,s,r){let o=n.length;if(o<2)return null;let a=new Path2D;if(t(a,n[0],e[0]),o==2)i(a,n[1],e[1]);else{let l=Array(o),c=Array(o-1),h=Array(o-1),u=Array(o-1);for(let d=0;d<o-1;d++)h[d]=e[d+1]-e[d],u[d]=n[d+1]-n[d],c[d]=h[d]/u[d];l[0]=c[0];for(let d=1;d<o-1;d++)c[d]===0||c[d-1]===0||c[d-1]>0!=c[d]>0?l[d]=0:(l[d]=3*(u[d-1]+u[d])/((2*u[d]+u[d-1])/c[d-1]+(u[d]+2*u[d-1])/c[d]),isFinite(l[d])||(l[d]=0));l[o-1]=c[o-2];for(let d=0;d<o-1;d++)s(a,n[d]+u[d]/3,e[d]+l[d]*u[d]/3,n[d+1]-u[d]/3,e[d+1]-l[d+1]*u[d]/3,n[d+1],e[d+1])}return a}var Xp=new Set;function Dx(){for(let n of Xp)n.syncRect(!0)}pa&&(no(tA,ca,Dx),no(nA,ca,Dx,!0),no(Bu,ca,()=>{Xn.pxRatio=It}));var bC=_y(),MC=my();function Lx(n,e,t,i){return(i?[n[0],n[1]].concat(n.slice(2)):[n[0]].concat(n.slice(1))).map((r,o)=>qp(r,o,e,t))}function wC(n,e){return n.map((t,i)=>i==0?{}:Mn({},e,t))}function qp(n,e,t,i){return Mn({},e==0?t:i,n)}function xy(n,e,t){return e==null?ua:[e,t]}var TC=xy;function EC(n,e,t){return e==null?ua:ku(e,t,Jp,!0)}function yy(n,e,t,i){return e==null?ua:Gu(e,t,n.scales[i].log,!1)}var AC=yy;function vy(n,e,t,i){return e==null?ua:Kp(e,t,n.scales[i].log,!1)}var CC=vy;function RC(n,e,t,i,s){let r=hi(ux(n),ux(e)),o=e-n,a=ts(s/i*o,t);do{let l=t[a],c=i*l/o;if(c>=s&&r+(l<5?Er.get(l):0)<=17)return[l,c]}while(++a<t.length);return[0,0]}function Nx(n){let e,t;return n=n.replace(/(\d+)px/,(i,s)=>(e=Pn((t=+s)*It))+"px"),[n,e,t]}function PC(n){n.show&&[n.font,n.labelFont].forEach(e=>{let t=Wt(e[2]*It,1);e[0]=e[0].replace(/[0-9.]+px/,t+"px"),e[1]=t})}function Xn(n,e,t){let i={mode:At(n.mode,1)},s=i.mode;function r(_,b,R,I){let G=b.valToPct(_);return I+R*(b.dir==-1?1-G:G)}function o(_,b,R,I){let G=b.valToPct(_);return I+R*(b.dir==-1?G:1-G)}function a(_,b,R,I){return b.ori==0?r(_,b,R,I):o(_,b,R,I)}i.valToPosH=r,i.valToPosV=o;let l=!1;i.status=0;let c=i.root=Bi(O1);if(n.id!=null&&(c.id=n.id),Ri(c,n.class),n.title){let _=Bi(z1,c);_.textContent=n.title}let h=es("canvas"),u=i.ctx=h.getContext("2d"),d=Bi(V1,c);no("click",d,_=>{_.target===m&&($t!=uo||tn!=fo)&&Hn.click(i,_)},!0);let f=i.under=Bi(G1,d);d.appendChild(h);let m=i.over=Bi(H1,d);n=da(n);let y=+At(n.pxAlign,1),g=Px(y);(n.plugins||[]).forEach(_=>{_.opts&&(n=_.opts(i,n)||n)});let p=n.ms||.001,S=i.series=s==1?Lx(n.series||[],Mx,Cx,!1):wC(n.series||[null],Ax),C=i.axes=Lx(n.axes||[],bx,Tx,!0),w=i.scales={},P=i.bands=n.bands||[];P.forEach(_=>{_.fill=Mt(_.fill||null),_.dir=At(_.dir,-1)});let E=s==2?S[1].facets[0].scale:S[0].scale,x={axes:Rs,series:_t},T=(n.drawOrder||["axes","series"]).map(_=>x[_]);function k(_){let b=_.distr==3?R=>Zs(R>0?R:_.clamp(i,R,_.min,_.max,_.key)):_.distr==4?R=>Lp(R,_.asinh):_.distr==100?R=>_.fwd(R):R=>R;return R=>{let I=b(R),{_min:G,_max:J}=_,le=J-G;return(I-G)/le}}function N(_){let b=w[_];if(b==null){let R=(n.scales||Hl)[_]||Hl;if(R.from!=null){N(R.from);let I=Mn({},w[R.from],R,{key:_});I.valToPct=k(I),w[_]=I}else{b=w[_]=Mn({},_==E?ly:dC,R),b.key=_;let I=b.time,G=b.range,J=Tr(G);if((_!=E||s==2&&!I)&&(J&&(G[0]==null||G[1]==null)&&(G={min:G[0]==null?lx:{mode:1,hard:G[0],soft:G[0]},max:G[1]==null?lx:{mode:1,hard:G[1],soft:G[1]}},J=!1),!J&&Wu(G))){let le=G;G=(pe,Se,Ne)=>Se==null?ua:ku(Se,Ne,le)}b.range=Mt(G||(I?TC:_==E?b.distr==3?AC:b.distr==4?CC:xy:b.distr==3?yy:b.distr==4?vy:EC)),b.auto=Mt(J?!1:b.auto),b.clamp=Mt(b.clamp||uC),b._min=b._max=null,b.valToPct=k(b)}}}N("x"),N("y"),s==1&&S.forEach(_=>{N(_.scale)}),C.forEach(_=>{N(_.scale)});for(let _ in n.scales)N(_);let L=w[E],z=L.distr,W,D;L.ori==0?(Ri(c,B1),W=r,D=o):(Ri(c,k1),W=o,D=r);let X={};for(let _ in w){let b=w[_];(b.min!=null||b.max!=null)&&(X[_]={min:b.min,max:b.max},b.min=b.max=null)}let Z=n.tzDate||(_=>new Date(Pn(_/p))),H=n.fmtDate||em,he=p==1?BA(Z):VA(Z),j=yx(Z,xx(p==1?OA:zA,H)),ee=Sx(Z,vx(HA,H)),re=[],fe=i.legend=Mn({},qA,n.legend),de=i.cursor=Mn({},jA,{drag:{y:s==2}},n.cursor),te=fe.show,ge=de.show,ye=fe.markers;fe.idxs=re,ye.width=Mt(ye.width),ye.dash=Mt(ye.dash),ye.stroke=Mt(ye.stroke),ye.fill=Mt(ye.fill);let Ce,Me,Xe,lt=[],He=[],mt,ut=!1,ot={};if(fe.live){let _=S[1]?S[1].values:null;ut=_!=null,mt=ut?_(i,1,0):{_:0};for(let b in mt)ot[b]=$p}if(te)if(Ce=es("table",Z1,c),Xe=es("tbody",null,Ce),fe.mount(i,Ce),ut){Me=es("thead",null,Ce,Xe);let _=es("tr",null,Me);es("th",null,_);for(var en in mt)es("th",Z_,_).textContent=en}else Ri(Ce,J1),fe.live&&Ri(Ce,K1);let Xt={show:!0},mn={show:!1};function Bt(_,b){if(b==0&&(ut||!fe.live||s==2))return ua;let R=[],I=es("tr",j1,Xe,Xe.childNodes[b]);Ri(I,_.class),_.show||Ri(I,to);let G=es("th",null,I);if(ye.show){let pe=Bi(Q1,G);if(b>0){let Se=ye.width(i,b);Se&&(pe.style.border=Se+"px "+ye.dash(i,b)+" "+ye.stroke(i,b)),pe.style.background=ye.fill(i,b)}}let J=Bi(Z_,G);_.label instanceof HTMLElement?J.appendChild(_.label):J.textContent=_.label,b>0&&(ye.show||(J.style.color=_.width>0?ye.stroke(i,b):ye.fill(i,b)),wt("click",G,pe=>{if(de._lock)return;tt(pe);let Se=S.indexOf(_);if((pe.ctrlKey||pe.metaKey)!=fe.isolate){let Ne=S.some((Ue,Be)=>Be>0&&Be!=Se&&Ue.show);S.forEach((Ue,Be)=>{Be>0&&cs(Be,Ne?Be==Se?Xt:mn:Xt,!0,vn.setSeries)})}else cs(Se,{show:!_.show},!0,vn.setSeries)},!1),nt&&wt(Q_,G,pe=>{de._lock||(tt(pe),cs(S.indexOf(_),mo,!0,vn.setSeries))},!1));for(var le in mt){let pe=es("td",eA,I);pe.textContent="--",R.push(pe)}return[I,R]}let Ln=new Map;function wt(_,b,R,I=!0){let G=Ln.get(b)||{},J=de.bind[_](i,b,R,I);J&&(no(_,b,G[_]=J),Ln.set(b,G))}function wn(_,b,R){let I=Ln.get(b)||{};for(let G in I)(_==null||G==_)&&(zp(G,b,I[G]),delete I[G]);_==null&&Ln.delete(b)}let rn=0,gn=0,F=0,Pe=0,je=0,ct=0,we=je,Gt=ct,Ge=F,Ze=Pe,A=0,v=0,q=0,ue=0;i.bbox={};let ae=!1,xe=!1,ve=!1,ne=!1,se=!1,me=!1;function U(_,b,R){(R||_!=i.width||b!=i.height)&&oe(_,b),dt(!1),ve=!0,xe=!0,qn()}function oe(_,b){i.width=rn=F=_,i.height=gn=Pe=b,je=ct=0,be(),We();let R=i.bbox;A=R.left=Qr(je*It,.5),v=R.top=Qr(ct*It,.5),q=R.width=Qr(F*It,.5),ue=R.height=Qr(Pe*It,.5)}let ie=3;function Te(){let _=!1,b=0;for(;!_;){b++;let R=lo(b),I=ls(b);_=b==ie||R&&I,_||(oe(i.width,i.height),xe=!0)}}function _e({width:_,height:b}){U(_,b)}i.setSize=_e;function be(){let _=!1,b=!1,R=!1,I=!1;C.forEach((G,J)=>{if(G.show&&G._show){let{side:le,_size:pe}=G,Se=le%2,Ne=G.label!=null?G.labelSize:0,Ue=pe+Ne;Ue>0&&(Se?(F-=Ue,le==3?(je+=Ue,I=!0):R=!0):(Pe-=Ue,le==0?(ct+=Ue,_=!0):b=!0))}}),os[0]=_,os[1]=R,os[2]=b,os[3]=I,F-=zi[1]+zi[3],je+=zi[3],Pe-=zi[2]+zi[0],ct+=zi[0]}function We(){let _=je+F,b=ct+Pe,R=je,I=ct;function G(J,le){switch(J){case 1:return _+=le,_-le;case 2:return b+=le,b-le;case 3:return R-=le,R+le;case 0:return I-=le,I+le}}C.forEach((J,le)=>{if(J.show&&J._show){let pe=J.side;J._pos=G(pe,J._size),J.label!=null&&(J._lpos=G(pe,J.labelSize))}})}if(de.dataIdx==null){let _=de.hover,b=_.skip=new Set(_.skip??[]);b.add(void 0);let R=_.prox=Mt(_.prox),I=_.bias??=0;de.dataIdx=(G,J,le,pe)=>{if(J==0)return le;let Se=le,Ne=R(G,J,le,pe)??Ht,Ue=Ne>=0&&Ne<Ht,Be=L.ori==0?F:Pe,at=de.left,Ct=e[0],Et=e[J];if(b.has(Et[le])){Se=null;let yt=null,et=null,qe;if(I==0||I==-1)for(qe=le;yt==null&&qe-- >0;)b.has(Et[qe])||(yt=qe);if(I==0||I==1)for(qe=le;et==null&&qe++<Et.length;)b.has(Et[qe])||(et=qe);if(yt!=null||et!=null)if(Ue){let Kt=yt==null?-1/0:W(Ct[yt],L,Be,0),ln=et==null?1/0:W(Ct[et],L,Be,0),On=at-Kt,kt=ln-at;On<=kt?On<=Ne&&(Se=yt):kt<=Ne&&(Se=et)}else Se=et==null?yt:yt==null?et:le-yt<=et-le?yt:et}else Ue&&In(at-W(Ct[le],L,Be,0))>Ne&&(Se=null);return Se}}let tt=_=>{de.event=_};de.idxs=re,de._lock=!1;let ce=de.points;ce.show=Mt(ce.show),ce.size=Mt(ce.size),ce.stroke=Mt(ce.stroke),ce.width=Mt(ce.width),ce.fill=Mt(ce.fill);let ke=i.focus=Mn({},n.focus||{alpha:.3},de.focus),nt=ke.prox>=0,Re=nt&&ce.one,ht=[],Yt=[],Jn=[];function ya(_,b){let R=ce.show(i,b);if(R instanceof HTMLElement)return Ri(R,$1),Ri(R,_.class),ws(R,-10,-10,F,Pe),m.insertBefore(R,ht[b]),R}function ro(_,b){if(s==1||b>0){let R=s==1&&w[_.scale].time,I=_.value;_.value=R?px(I)?Sx(Z,vx(I,H)):I||ee:I||lC,_.label=_.label||(R?eC:QA)}if(Re||b>0){_.width=_.width==null?1:_.width,_.paths=_.paths||bC||dA,_.fillTo=Mt(_.fillTo||fC),_.pxAlign=+At(_.pxAlign,y),_.pxRound=Px(_.pxAlign),_.stroke=Mt(_.stroke||null),_.fill=Mt(_.fill||null),_._stroke=_._fill=_._paths=_._focus=null;let R=cC(hi(1,_.width),1),I=_.points=Mn({},{size:R,width:hi(1,R*.2),stroke:_.stroke,space:R*2,paths:MC,_stroke:null,_fill:null},_.points);I.show=Mt(I.show),I.filter=Mt(I.filter),I.fill=Mt(I.fill),I.stroke=Mt(I.stroke),I.paths=Mt(I.paths),I.pxAlign=_.pxAlign}if(te){let R=Bt(_,b);lt.splice(b,0,R[0]),He.splice(b,0,R[1]),fe.values.push(null)}if(ge){re.splice(b,0,null);let R=null;Re?b==0&&(R=ya(_,b)):b>0&&(R=ya(_,b)),ht.splice(b,0,R),Yt.splice(b,0,0),Jn.splice(b,0,0)}Fn("addSeries",b)}function pd(_,b){b=b??S.length,_=s==1?qp(_,b,Mx,Cx):qp(_,b,{},Ax),S.splice(b,0,_),ro(S[b],b)}i.addSeries=pd;function Kl(_){if(S.splice(_,1),te){fe.values.splice(_,1),He.splice(_,1);let b=lt.splice(_,1)[0];wn(null,b.firstChild),b.remove()}ge&&(re.splice(_,1),ht.splice(_,1)[0].remove(),Yt.splice(_,1),Jn.splice(_,1)),Fn("delSeries",_)}i.delSeries=Kl;let os=[!1,!1,!1,!1];function Es(_,b){if(_._show=_.show,_.show){let R=_.side%2,I=w[_.scale];I==null&&(_.scale=R?S[1].scale:E,I=w[_.scale]);let G=I.time;_.size=Mt(_.size),_.space=Mt(_.space),_.rotate=Mt(_.rotate),Tr(_.incrs)&&_.incrs.forEach(le=>{!Er.has(le)&&Er.set(le,Hx(le))}),_.incrs=Mt(_.incrs||(I.distr==2?NA:G?p==1?FA:kA:eo)),_.splits=Mt(_.splits||(G&&I.distr==1?he:I.distr==3?Gp:I.distr==4?iC:nC)),_.stroke=Mt(_.stroke),_.grid.stroke=Mt(_.grid.stroke),_.ticks.stroke=Mt(_.ticks.stroke),_.border.stroke=Mt(_.border.stroke);let J=_.values;_.values=Tr(J)&&!Tr(J[0])?Mt(J):G?Tr(J)?yx(Z,xx(J,H)):px(J)?GA(Z,J):J||j:J||tC,_.filter=Mt(_.filter||(I.distr>=3&&I.log==10?oC:I.distr==3&&I.log==2?aC:Vx)),_.font=Nx(_.font),_.labelFont=Nx(_.labelFont),_._size=_.size(i,null,b,0),_._space=_._rotate=_._incrs=_._found=_._splits=_._values=null,_._size>0&&(os[b]=!0,_._el=Bi(W1,d))}}function As(_,b,R,I){let[G,J,le,pe]=R,Se=b%2,Ne=0;return Se==0&&(pe||J)&&(Ne=b==0&&!G||b==2&&!le?Pn(bx.size/3):0),Se==1&&(G||le)&&(Ne=b==1&&!J||b==3&&!pe?Pn(Tx.size/2):0),Ne}let va=i.padding=(n.padding||[As,As,As,As]).map(_=>Mt(At(_,As))),zi=i._padding=va.map((_,b)=>_(i,b,os,0)),on,fn=null,pn=null,as=s==1?S[0].idxs:null,fi=null,js=!1;function Sa(_,b){if(e=_??[],i.data=i._data=e,s==2){on=0;for(let R=1;R<S.length;R++)on+=e[R][0].length}else{e.length==0&&(i.data=i._data=e=[[]]),fi=e[0],on=fi.length;let R=e;if(z==2){R=e.slice();let I=R[0]=Array(on);for(let G=0;G<on;G++)I[G]=G}i._data=e=R}if(dt(!0),Fn("setData"),z==2&&(ve=!0),b!==!1){let R=L;R.auto(i,js)?ba():tr(E,R.min,R.max),ne=ne||de.left>=0,me=!0,qn()}}i.setData=Sa;function ba(){js=!0;let _,b;s==1&&(on>0?(fn=as[0]=0,pn=as[1]=on-1,_=e[0][fn],b=e[0][pn],z==2?(_=fn,b=pn):_==b&&(z==3?[_,b]=Gu(_,_,L.log,!1):z==4?[_,b]=Kp(_,_,L.log,!1):L.time?b=_+Pn(86400/p):[_,b]=ku(_,b,Jp,!0))):(fn=as[0]=_=null,pn=as[1]=b=null)),tr(E,_,b)}let oo,Qs,ao,M,B,Q,$,K,Ee,Ie;function Ae(_,b,R,I,G,J){_??=J_,R??=Qp,I??="butt",G??=J_,J??="round",_!=oo&&(u.strokeStyle=oo=_),G!=Qs&&(u.fillStyle=Qs=G),b!=ao&&(u.lineWidth=ao=b),J!=B&&(u.lineJoin=B=J),I!=Q&&(u.lineCap=Q=I),R!=M&&u.setLineDash(M=R)}function De(_,b,R,I){b!=Qs&&(u.fillStyle=Qs=b),_!=$&&(u.font=$=_),R!=K&&(u.textAlign=K=R),I!=Ee&&(u.textBaseline=Ee=I)}function Ve(_,b,R,I,G=0){if(I.length>0&&_.auto(i,js)&&(b==null||b.min==null)){let J=At(fn,0),le=At(pn,I.length-1),pe=R.min==null?oA(I,J,le,G,_.distr==3):[R.min,R.max];_.min=ns(_.min,R.min=pe[0]),_.max=hi(_.max,R.max=pe[1])}}let rt={min:null,max:null};function gt(){for(let I in w){let G=w[I];X[I]==null&&(G.min==null||X[E]!=null&&G.auto(i,js))&&(X[I]=rt)}for(let I in w){let G=w[I];X[I]==null&&G.from!=null&&X[G.from]!=null&&(X[I]=rt)}X[E]!=null&&dt(!0);let _={};for(let I in X){let G=X[I];if(G!=null){let J=_[I]=da(w[I],mA);if(G.min!=null)Mn(J,G);else if(I!=E||s==2)if(on==0&&J.from==null){let le=J.range(i,null,null,I);J.min=le[0],J.max=le[1]}else J.min=Ht,J.max=-Ht}}if(on>0){S.forEach((I,G)=>{if(s==1){let J=I.scale,le=X[J];if(le==null)return;let pe=_[J];if(G==0){let Se=pe.range(i,pe.min,pe.max,J);pe.min=Se[0],pe.max=Se[1],fn=ts(pe.min,e[0]),pn=ts(pe.max,e[0]),pn-fn>1&&(e[0][fn]<pe.min&&fn++,e[0][pn]>pe.max&&pn--),I.min=fi[fn],I.max=fi[pn]}else I.show&&I.auto&&Ve(pe,le,I,e[G],I.sorted);I.idxs[0]=fn,I.idxs[1]=pn}else if(G>0&&I.show&&I.auto){let[J,le]=I.facets,pe=J.scale,Se=le.scale,[Ne,Ue]=e[G],Be=_[pe],at=_[Se];Be!=null&&Ve(Be,X[pe],J,Ne,J.sorted),at!=null&&Ve(at,X[Se],le,Ue,le.sorted),I.min=le.min,I.max=le.max}});for(let I in _){let G=_[I],J=X[I];if(G.from==null&&(J==null||J.min==null)){let le=G.range(i,G.min==Ht?null:G.min,G.max==-Ht?null:G.max,I);G.min=le[0],G.max=le[1]}}}for(let I in _){let G=_[I];if(G.from!=null){let J=_[G.from];if(J.min==null)G.min=G.max=null;else{let le=G.range(i,J.min,J.max,I);G.min=le[0],G.max=le[1]}}}let b={},R=!1;for(let I in _){let G=_[I],J=w[I];if(J.min!=G.min||J.max!=G.max){J.min=G.min,J.max=G.max;let le=J.distr;J._min=le==3?Zs(J.min):le==4?Lp(J.min,J.asinh):le==100?J.fwd(J.min):J.min,J._max=le==3?Zs(J.max):le==4?Lp(J.max,J.asinh):le==100?J.fwd(J.max):J.max,b[I]=R=!0}}if(R){S.forEach((I,G)=>{s==2?G>0&&b.y&&(I._paths=null):b[I.scale]&&(I._paths=null)});for(let I in b)ve=!0,Fn("setScale",I);ge&&de.left>=0&&(ne=me=!0)}for(let I in X)X[I]=null}function ze(_){let b=Vp(fn-1,0,on-1),R=Vp(pn+1,0,on-1);for(;_[b]==null&&b>0;)b--;for(;_[R]==null&&R<on-1;)R++;return[b,R]}function _t(){if(on>0){let _=S.some(b=>b._focus)&&Ie!=ke.alpha;_&&(u.globalAlpha=Ie=ke.alpha),S.forEach((b,R)=>{if(R>0&&b.show&&(sn(R,!1),sn(R,!0),b._paths==null)){let I=Ie;Ie!=b.alpha&&(u.globalAlpha=Ie=b.alpha);let G=s==2?[0,e[R][0].length-1]:ze(e[R]);b._paths=b.paths(i,R,G[0],G[1]),Ie!=I&&(u.globalAlpha=Ie=I)}}),S.forEach((b,R)=>{if(R>0&&b.show){let I=Ie;Ie!=b.alpha&&(u.globalAlpha=Ie=b.alpha),b._paths!=null&&Ut(R,!1);{let G=b._paths!=null?b._paths.gaps:null,J=b.points.show(i,R,fn,pn,G),le=b.points.filter(i,R,J,G);(J||le)&&(b.points._paths=b.points.paths(i,R,fn,pn,le),Ut(R,!0))}Ie!=I&&(u.globalAlpha=Ie=I),Fn("drawSeries",R)}}),_&&(u.globalAlpha=Ie=1)}}function sn(_,b){let R=b?S[_].points:S[_];R._stroke=R.stroke(i,_),R._fill=R.fill(i,_)}function Ut(_,b){let R=b?S[_].points:S[_],{stroke:I,fill:G,clip:J,flags:le,_stroke:pe=R._stroke,_fill:Se=R._fill,_width:Ne=R.width}=R._paths;Ne=Wt(Ne*It,3);let Ue=null,Be=Ne%2/2;b&&Se==null&&(Se=Ne>0?"#fff":pe);let at=R.pxAlign==1&&Be>0;if(at&&u.translate(Be,Be),!b){let Ct=A-Ne/2,Et=v-Ne/2,yt=q+Ne,et=ue+Ne;Ue=new Path2D,Ue.rect(Ct,Et,yt,et)}b?Fe(pe,Ne,R.dash,R.cap,Se,I,G,le,J):Ft(_,pe,Ne,R.dash,R.cap,Se,I,G,le,Ue,J),at&&u.translate(-Be,-Be)}function Ft(_,b,R,I,G,J,le,pe,Se,Ne,Ue){let Be=!1;Se!=0&&P.forEach((at,Ct)=>{if(at.series[0]==_){let Et=S[at.series[1]],yt=e[at.series[1]],et=(Et._paths||Hl).band;Tr(et)&&(et=at.dir==1?et[0]:et[1]);let qe,Kt=null;Et.show&&et&&lA(yt,fn,pn)?(Kt=at.fill(i,Ct)||J,qe=Et._paths.clip):et=null,Fe(b,R,I,G,Kt,le,pe,Se,Ne,Ue,qe,et),Be=!0}}),Be||Fe(b,R,I,G,J,le,pe,Se,Ne,Ue)}let Tn=fa|Wp;function Fe(_,b,R,I,G,J,le,pe,Se,Ne,Ue,Be){Ae(_,b,R,I,G),(Se||Ne||Be)&&(u.save(),Se&&u.clip(Se),Ne&&u.clip(Ne)),Be?(pe&Tn)==Tn?(u.clip(Be),Ue&&u.clip(Ue),vt(G,le),_n(_,J,b)):pe&Wp?(vt(G,le),u.clip(Be),_n(_,J,b)):pe&fa&&(u.save(),u.clip(Be),Ue&&u.clip(Ue),vt(G,le),u.restore(),_n(_,J,b)):(vt(G,le),_n(_,J,b)),(Se||Ne||Be)&&u.restore()}function _n(_,b,R){R>0&&(b instanceof Map?b.forEach((I,G)=>{u.strokeStyle=oo=G,u.stroke(I)}):b!=null&&_&&u.stroke(b))}function vt(_,b){b instanceof Map?b.forEach((R,I)=>{u.fillStyle=Qs=I,u.fill(R)}):b!=null&&_&&u.fill(b)}function Cs(_,b,R,I){let G=C[_],J;if(I<=0)J=[0,0];else{let le=G._space=G.space(i,_,b,R,I),pe=G._incrs=G.incrs(i,_,b,R,I,le);J=RC(b,R,pe,I,le)}return G._found=J}function xn(_,b,R,I,G,J,le,pe,Se,Ne){let Ue=le%2/2;y==1&&u.translate(Ue,Ue),Ae(pe,le,Se,Ne,pe),u.beginPath();let Be,at,Ct,Et,yt=G+(I==0||I==3?-J:J);R==0?(at=G,Et=yt):(Be=G,Ct=yt);for(let et=0;et<_.length;et++)b[et]!=null&&(R==0?Be=Ct=_[et]:at=Et=_[et],u.moveTo(Be,at),u.lineTo(Ct,Et));u.stroke(),y==1&&u.translate(-Ue,-Ue)}function lo(_){let b=!0;return C.forEach((R,I)=>{if(!R.show)return;let G=w[R.scale];if(G.min==null){R._show&&(b=!1,R._show=!1,dt(!1));return}else R._show||(b=!1,R._show=!0,dt(!1));let J=R.side,le=J%2,{min:pe,max:Se}=G,[Ne,Ue]=Cs(I,pe,Se,le==0?F:Pe);if(Ue==0)return;let Be=G.distr==2,at=R._splits=R.splits(i,I,pe,Se,Ne,Ue,Be),Ct=G.distr==2?at.map(qe=>fi[qe]):at,Et=G.distr==2?fi[at[1]]-fi[at[0]]:Ne,yt=R._values=R.values(i,R.filter(i,Ct,I,Ue,Et),I,Ue,Et);R._rotate=J==2?R.rotate(i,yt,I,Ue):0;let et=R._size;R._size=ki(R.size(i,yt,I,_)),et!=null&&R._size!=et&&(b=!1)}),b}function ls(_){let b=!0;return va.forEach((R,I)=>{let G=R(i,I,os,_);G!=zi[I]&&(b=!1),zi[I]=G}),b}function Rs(){for(let _=0;_<C.length;_++){let b=C[_];if(!b.show||!b._show)continue;let R=b.side,I=R%2,G,J,le=b.stroke(i,_),pe=R==0||R==3?-1:1,[Se,Ne]=b._found;if(b.label!=null){let ei=b.labelGap*pe,gi=Pn((b._lpos+ei)*It);De(b.labelFont[0],le,"center",R==2?"top":K_),u.save(),I==1?(G=J=0,u.translate(gi,Pn(v+ue/2)),u.rotate((R==3?-Ou:Ou)/2)):(G=Pn(A+q/2),J=gi);let Rr=kx(b.label)?b.label(i,_,Se,Ne):b.label;u.fillText(Rr,G,J),u.restore()}if(Ne==0)continue;let Ue=w[b.scale],Be=I==0?q:ue,at=I==0?A:v,Ct=b._splits,Et=Ue.distr==2?Ct.map(ei=>fi[ei]):Ct,yt=Ue.distr==2?fi[Ct[1]]-fi[Ct[0]]:Se,et=b.ticks,qe=b.border,Kt=et.show?et.size:0,ln=Pn(Kt*It),On=Pn((b.alignTo==2?b._size-Kt-b.gap:b.gap)*It),kt=b._rotate*-Ou/180,cn=g(b._pos*It),pi=(ln+On)*pe,Qn=cn+pi;J=I==0?Qn:0,G=I==1?Qn:0;let Di=b.font[0],Vi=b.align==1?aa:b.align==2?Pp:kt>0?aa:kt<0?Pp:I==0?"center":R==3?Pp:aa,us=kt||I==1?"middle":R==2?"top":K_;De(Di,le,Vi,us);let mi=b.font[1]*b.lineGap,Li=Ct.map(ei=>g(a(ei,Ue,Be,at))),Gi=b._values;for(let ei=0;ei<Gi.length;ei++){let gi=Gi[ei];if(gi!=null){I==0?G=Li[ei]:J=Li[ei],gi=""+gi;let Rr=gi.indexOf(`
`)==-1?[gi]:gi.split(/\n/gm);for(let ti=0;ti<Rr.length;ti++){let Im=Rr[ti];kt?(u.save(),u.translate(G,J+ti*mi),u.rotate(kt),u.fillText(Im,0,0),u.restore()):u.fillText(Im,G,J+ti*mi)}}}et.show&&xn(Li,et.filter(i,Et,_,Ne,yt),I,R,cn,ln,Wt(et.width*It,3),et.stroke(i,_),et.dash,et.cap);let ds=b.grid;ds.show&&xn(Li,ds.filter(i,Et,_,Ne,yt),I,I==0?2:1,I==0?v:A,I==0?ue:q,Wt(ds.width*It,3),ds.stroke(i,_),ds.dash,ds.cap),qe.show&&xn([cn],[1],I==0?1:0,I==0?1:2,I==1?v:A,I==1?ue:q,Wt(qe.width*It,3),qe.stroke(i,_),qe.dash,qe.cap)}Fn("drawAxes")}function dt(_){S.forEach((b,R)=>{R>0&&(b._paths=null,_&&(s==1?(b.min=null,b.max=null):b.facets.forEach(I=>{I.min=null,I.max=null})))})}let an=!1,jn=!1,Ot=[];function yn(){jn=!1;for(let _=0;_<Ot.length;_++)Fn(...Ot[_]);Ot.length=0}function qn(){an||(bA(fm),an=!0)}function Jl(_,b=!1){an=!0,jn=b,_(i),fm(),b&&Ot.length>0&&queueMicrotask(yn)}i.batch=Jl;function fm(){if(ae&&(gt(),ae=!1),ve&&(Te(),ve=!1),xe){if(Qt(f,aa,je),Qt(f,"top",ct),Qt(f,kl,F),Qt(f,zl,Pe),Qt(m,aa,je),Qt(m,"top",ct),Qt(m,kl,F),Qt(m,zl,Pe),Qt(d,kl,rn),Qt(d,zl,gn),h.width=Pn(rn*It),h.height=Pn(gn*It),C.forEach(({_el:_,_show:b,_size:R,_pos:I,side:G})=>{if(_!=null)if(b){let J=G===3||G===0?R:0,le=G%2==1;Qt(_,le?"left":"top",I-J),Qt(_,le?"width":"height",R),Qt(_,le?"top":"left",le?ct:je),Qt(_,le?"height":"width",le?Pe:F),kp(_,to)}else Ri(_,to)}),oo=Qs=ao=B=Q=$=K=Ee=M=null,Ie=1,Ta(!0),je!=we||ct!=Gt||F!=Ge||Pe!=Ze){dt(!1);let _=F/Ge,b=Pe/Ze;if(ge&&!ne&&de.left>=0){de.left*=_,de.top*=b,co&&ws(co,Pn(de.left),0,F,Pe),ho&&ws(ho,0,Pn(de.top),F,Pe);for(let R=0;R<ht.length;R++){let I=ht[R];I!=null&&(Yt[R]*=_,Jn[R]*=b,ws(I,ki(Yt[R]),ki(Jn[R]),F,Pe))}}if(Zt.show&&!se&&Zt.left>=0&&Zt.width>0){Zt.left*=_,Zt.width*=_,Zt.top*=b,Zt.height*=b;for(let R in vd)Qt(po,R,Zt[R])}we=je,Gt=ct,Ge=F,Ze=Pe}Fn("setSize"),xe=!1}rn>0&&gn>0&&(u.clearRect(0,0,h.width,h.height),Fn("drawClear"),T.forEach(_=>_()),Fn("draw")),Zt.show&&se&&(jl(Zt),se=!1),ge&&ne&&(Cr(null,!0,!1),ne=!1),fe.show&&fe.live&&me&&(xd(),me=!1),l||(l=!0,i.status=1,Fn("ready")),js=!1,an=!1}i.redraw=(_,b)=>{ve=b||!1,_!==!1?tr(E,L.min,L.max):qn()};function md(_,b){let R=w[_];if(R.from==null){if(on==0){let I=R.range(i,b.min,b.max,_);b.min=I[0],b.max=I[1]}if(b.min>b.max){let I=b.min;b.min=b.max,b.max=I}if(on>1&&b.min!=null&&b.max!=null&&b.max-b.min<1e-16)return;_==E&&R.distr==2&&on>0&&(b.min=ts(b.min,e[0]),b.max=ts(b.max,e[0]),b.min==b.max&&b.max++),X[_]=b,ae=!0,qn()}}i.setScale=md;let gd,_d,co,ho,pm,mm,uo,fo,gm,_m,$t,tn,er=!1,Hn=de.drag,Nn=Hn.x,Un=Hn.y;ge&&(de.x&&(gd=Bi(q1,m)),de.y&&(_d=Bi(Y1,m)),L.ori==0?(co=gd,ho=_d):(co=_d,ho=gd),$t=de.left,tn=de.top);let Zt=i.select=Mn({show:!0,over:!0,left:0,width:0,top:0,height:0},n.select),po=Zt.show?Bi(X1,Zt.over?m:f):null;function jl(_,b){if(Zt.show){for(let R in _)Zt[R]=_[R],R in vd&&Qt(po,R,_[R]);b!==!1&&Fn("setSelect")}}i.setSelect=jl;function By(_){if(S[_].show)te&&kp(lt[_],to);else if(te&&Ri(lt[_],to),ge){let R=Re?ht[0]:ht[_];R!=null&&ws(R,-10,-10,F,Pe)}}function tr(_,b,R){md(_,{min:b,max:R})}function cs(_,b,R,I){b.focus!=null&&Hy(_),b.show!=null&&S.forEach((G,J)=>{J>0&&(_==J||_==null)&&(G.show=b.show,By(J),s==2?(tr(G.facets[0].scale,null,null),tr(G.facets[1].scale,null,null)):tr(G.scale,null,null),qn())}),R!==!1&&Fn("setSeries",_,b),I&&Ea("setSeries",i,_,b)}i.setSeries=cs;function ky(_,b){Mn(P[_],b)}function zy(_,b){_.fill=Mt(_.fill||null),_.dir=At(_.dir,-1),b=b??P.length,P.splice(b,0,_)}function Vy(_){_==null?P.length=0:P.splice(_,1)}i.addBand=zy,i.setBand=ky,i.delBand=Vy;function Gy(_,b){S[_].alpha=b,ge&&ht[_]!=null&&(ht[_].style.opacity=b),te&&lt[_]&&(lt[_].style.opacity=b)}let Ps,nr,Ar,mo={focus:!0};function Hy(_){if(_!=Ar){let b=_==null,R=ke.alpha!=1;S.forEach((I,G)=>{if(s==1||G>0){let J=b||G==0||G==_;I._focus=b?null:J,R&&Gy(G,J?1:ke.alpha)}}),Ar=_,R&&qn()}}te&&nt&&wt(ex,Ce,_=>{de._lock||(tt(_),Ar!=null&&cs(null,mo,!0,vn.setSeries))});function hs(_,b,R){let I=w[b];R&&(_=_/It-(I.ori==1?ct:je));let G=F;I.ori==1&&(G=Pe,_=G-_),I.dir==-1&&(_=G-_);let J=I._min,le=I._max,pe=_/G,Se=J+(le-J)*pe,Ne=I.distr;return Ne==3?ha(10,Se):Ne==4?hA(Se,I.asinh):Ne==100?I.bwd(Se):Se}function Wy(_,b){let R=hs(_,E,b);return ts(R,e[0],fn,pn)}i.valToIdx=_=>ts(_,e[0]),i.posToIdx=Wy,i.posToVal=hs,i.valToPos=(_,b,R)=>w[b].ori==0?r(_,w[b],R?q:F,R?A:0):o(_,w[b],R?ue:Pe,R?v:0),i.setCursor=(_,b,R)=>{$t=_.left,tn=_.top,Cr(null,b,R)};function xm(_,b){Qt(po,aa,Zt.left=_),Qt(po,kl,Zt.width=b)}function ym(_,b){Qt(po,"top",Zt.top=_),Qt(po,zl,Zt.height=b)}let Ma=L.ori==0?xm:ym,wa=L.ori==1?xm:ym;function Xy(){if(te&&fe.live)for(let _=s==2?1:0;_<S.length;_++){if(_==0&&ut)continue;let b=fe.values[_],R=0;for(let I in b)He[_][R++].firstChild.nodeValue=b[I]}}function xd(_,b){if(_!=null&&(_.idxs?_.idxs.forEach((R,I)=>{re[I]=R}):pA(_.idx)||re.fill(_.idx),fe.idx=re[0]),te&&fe.live){for(let R=0;R<S.length;R++)(R>0||s==1&&!ut)&&qy(R,re[R]);Xy()}me=!1,b!==!1&&Fn("setLegend")}i.setLegend=xd;function qy(_,b){let R=S[_],I=_==0&&z==2?fi:e[_],G;ut?G=R.values(i,_,b)??ot:(G=R.value(i,b==null?null:I[b],_,b),G=G==null?ot:{_:G}),fe.values[_]=G}function Cr(_,b,R){gm=$t,_m=tn,[$t,tn]=de.move(i,$t,tn),de.left=$t,de.top=tn,ge&&(co&&ws(co,Pn($t),0,F,Pe),ho&&ws(ho,0,Pn(tn),F,Pe));let I,G=fn>pn;Ps=Ht,nr=null;let J=L.ori==0?F:Pe,le=L.ori==1?F:Pe;if($t<0||on==0||G){I=de.idx=null;for(let pe=0;pe<S.length;pe++){let Se=ht[pe];Se!=null&&ws(Se,-10,-10,F,Pe)}nt&&cs(null,mo,!0,_==null&&vn.setSeries),fe.live&&(re.fill(I),me=!0)}else{let pe,Se,Ne;s==1&&(pe=L.ori==0?$t:tn,Se=hs(pe,E),I=de.idx=ts(Se,e[0],fn,pn),Ne=W(e[0][I],L,J,0));let Ue=-10,Be=-10,at=0,Ct=0,Et=!0,yt="",et="";for(let qe=s==2?1:0;qe<S.length;qe++){let Kt=S[qe],ln=re[qe],On=ln==null?null:s==1?e[qe][ln]:e[qe][1][ln],kt=de.dataIdx(i,qe,I,Se),cn=kt==null?null:s==1?e[qe][kt]:e[qe][1][kt];if(me=me||cn!=On||kt!=ln,re[qe]=kt,qe>0&&Kt.show){let pi=kt==null?-10:kt==I?Ne:W(s==1?e[0][kt]:e[qe][0][kt],L,J,0),Qn=cn==null?-10:D(cn,s==1?w[Kt.scale]:w[Kt.facets[1].scale],le,0);if(nt&&cn!=null){let Di=L.ori==1?$t:tn,Vi=In(ke.dist(i,qe,kt,Qn,Di));if(Vi<Ps){let us=ke.bias;if(us!=0){let mi=hs(Di,Kt.scale),Li=cn>=0?1:-1,Gi=mi>=0?1:-1;Gi==Li&&(Gi==1?us==1?cn>=mi:cn<=mi:us==1?cn<=mi:cn>=mi)&&(Ps=Vi,nr=qe)}else Ps=Vi,nr=qe}}if(me||Re){let Di,Vi;L.ori==0?(Di=pi,Vi=Qn):(Di=Qn,Vi=pi);let us,mi,Li,Gi,ds,ei,gi=!0,Rr=ce.bbox;if(Rr!=null){gi=!1;let ti=Rr(i,qe);Li=ti.left,Gi=ti.top,us=ti.width,mi=ti.height}else Li=Di,Gi=Vi,us=mi=ce.size(i,qe);if(ei=ce.fill(i,qe),ds=ce.stroke(i,qe),Re)qe==nr&&Ps<=ke.prox&&(Ue=Li,Be=Gi,at=us,Ct=mi,Et=gi,yt=ei,et=ds);else{let ti=ht[qe];ti!=null&&(Yt[qe]=Li,Jn[qe]=Gi,ax(ti,us,mi,gi),rx(ti,ei,ds),ws(ti,ki(Li),ki(Gi),F,Pe))}}}}if(Re){let qe=ke.prox,Kt=Ar==null?Ps<=qe:Ps>qe||nr!=Ar;if(me||Kt){let ln=ht[0];ln!=null&&(Yt[0]=Ue,Jn[0]=Be,ax(ln,at,Ct,Et),rx(ln,yt,et),ws(ln,ki(Ue),ki(Be),F,Pe))}}}if(Zt.show&&er)if(_!=null){let[pe,Se]=vn.scales,[Ne,Ue]=vn.match,[Be,at]=_.cursor.sync.scales,Ct=_.cursor.drag;if(Nn=Ct._x,Un=Ct._y,Nn||Un){let{left:Et,top:yt,width:et,height:qe}=_.select,Kt=_.scales[Be].ori,ln=_.posToVal,On,kt,cn,pi,Qn,Di=pe!=null&&Ne(pe,Be),Vi=Se!=null&&Ue(Se,at);Di&&Nn?(Kt==0?(On=Et,kt=et):(On=yt,kt=qe),cn=w[pe],pi=W(ln(On,Be),cn,J,0),Qn=W(ln(On+kt,Be),cn,J,0),Ma(ns(pi,Qn),In(Qn-pi))):Ma(0,J),Vi&&Un?(Kt==1?(On=Et,kt=et):(On=yt,kt=qe),cn=w[Se],pi=D(ln(On,at),cn,le,0),Qn=D(ln(On+kt,at),cn,le,0),wa(ns(pi,Qn),In(Qn-pi))):wa(0,le)}else Sd()}else{let pe=In(gm-pm),Se=In(_m-mm);if(L.ori==1){let at=pe;pe=Se,Se=at}Nn=Hn.x&&pe>=Hn.dist,Un=Hn.y&&Se>=Hn.dist;let Ne=Hn.uni;Ne!=null?Nn&&Un&&(Nn=pe>=Ne,Un=Se>=Ne,!Nn&&!Un&&(Se>pe?Un=!0:Nn=!0)):Hn.x&&Hn.y&&(Nn||Un)&&(Nn=Un=!0);let Ue,Be;Nn&&(L.ori==0?(Ue=uo,Be=$t):(Ue=fo,Be=tn),Ma(ns(Ue,Be),In(Be-Ue)),Un||wa(0,le)),Un&&(L.ori==1?(Ue=uo,Be=$t):(Ue=fo,Be=tn),wa(ns(Ue,Be),In(Be-Ue)),Nn||Ma(0,J)),!Nn&&!Un&&(Ma(0,0),wa(0,0))}if(Hn._x=Nn,Hn._y=Un,_==null){if(R){if(Pm!=null){let[pe,Se]=vn.scales;vn.values[0]=pe!=null?hs(L.ori==0?$t:tn,pe):null,vn.values[1]=Se!=null?hs(L.ori==1?$t:tn,Se):null}Ea(Ip,i,$t,tn,F,Pe,I)}if(nt){let pe=R&&vn.setSeries,Se=ke.prox;Ar==null?Ps<=Se&&cs(nr,mo,!0,pe):Ps>Se?cs(null,mo,!0,pe):nr!=Ar&&cs(nr,mo,!0,pe)}}me&&(fe.idx=I,xd()),b!==!1&&Fn("setCursor")}let ir=null;Object.defineProperty(i,"rect",{get(){return ir==null&&Ta(!1),ir}});function Ta(_=!1){_?ir=null:(ir=m.getBoundingClientRect(),Fn("syncRect",ir))}function vm(_,b,R,I,G,J,le){de._lock||er&&_!=null&&_.movementX==0&&_.movementY==0||(yd(_,b,R,I,G,J,le,!1,_!=null),_!=null?Cr(null,!0,!0):Cr(b,!0,!1))}function yd(_,b,R,I,G,J,le,pe,Se){if(ir==null&&Ta(!1),tt(_),_!=null)R=_.clientX-ir.left,I=_.clientY-ir.top;else{if(R<0||I<0){$t=-10,tn=-10;return}let[Ne,Ue]=vn.scales,Be=b.cursor.sync,[at,Ct]=Be.values,[Et,yt]=Be.scales,[et,qe]=vn.match,Kt=b.axes[0].side%2==1,ln=L.ori==0?F:Pe,On=L.ori==1?F:Pe,kt=Kt?J:G,cn=Kt?G:J,pi=Kt?I:R,Qn=Kt?R:I;if(Et!=null?R=et(Ne,Et)?a(at,w[Ne],ln,0):-10:R=ln*(pi/kt),yt!=null?I=qe(Ue,yt)?a(Ct,w[Ue],On,0):-10:I=On*(Qn/cn),L.ori==1){let Di=R;R=I,I=Di}}Se&&(b==null||b.cursor.event.type==Ip)&&((R<=1||R>=F-1)&&(R=Qr(R,F)),(I<=1||I>=Pe-1)&&(I=Qr(I,Pe))),pe?(pm=R,mm=I,[uo,fo]=de.move(i,R,I)):($t=R,tn=I)}let vd={width:0,height:0,left:0,top:0};function Sd(){jl(vd,!1)}let Sm,bm,Mm,wm;function Tm(_,b,R,I,G,J,le){er=!0,Nn=Un=Hn._x=Hn._y=!1,yd(_,b,R,I,G,J,le,!0,!1),_!=null&&(wt(Dp,Op,Em,!1),Ea(j_,i,uo,fo,F,Pe,null));let{left:pe,top:Se,width:Ne,height:Ue}=Zt;Sm=pe,bm=Se,Mm=Ne,wm=Ue}function Em(_,b,R,I,G,J,le){er=Hn._x=Hn._y=!1,yd(_,b,R,I,G,J,le,!1,!0);let{left:pe,top:Se,width:Ne,height:Ue}=Zt,Be=Ne>0||Ue>0,at=Sm!=pe||bm!=Se||Mm!=Ne||wm!=Ue;if(Be&&at&&jl(Zt),Hn.setScale&&Be&&at){let Ct=pe,Et=Ne,yt=Se,et=Ue;if(L.ori==1&&(Ct=Se,Et=Ue,yt=pe,et=Ne),Nn&&tr(E,hs(Ct,E),hs(Ct+Et,E)),Un)for(let qe in w){let Kt=w[qe];qe!=E&&Kt.from==null&&Kt.min!=Ht&&tr(qe,hs(yt+et,qe),hs(yt,qe))}Sd()}else de.lock&&(de._lock=!de._lock,Cr(b,!0,_!=null));_!=null&&(wn(Dp,Op),Ea(Dp,i,$t,tn,F,Pe,null))}function Yy(_,b,R,I,G,J,le){if(de._lock)return;tt(_);let pe=er;if(er){let Se=!0,Ne=!0,Ue=10,Be,at;L.ori==0?(Be=Nn,at=Un):(Be=Un,at=Nn),Be&&at&&(Se=$t<=Ue||$t>=F-Ue,Ne=tn<=Ue||tn>=Pe-Ue),Be&&Se&&($t=$t<uo?0:F),at&&Ne&&(tn=tn<fo?0:Pe),Cr(null,!0,!0),er=!1}$t=-10,tn=-10,re.fill(null),Cr(null,!0,!0),pe&&(er=pe)}function Am(_,b,R,I,G,J,le){de._lock||(tt(_),ba(),Sd(),_!=null&&Ea(tx,i,$t,tn,F,Pe,null))}function Cm(){C.forEach(PC),U(i.width,i.height,!0)}no(Bu,ca,Cm);let go={};go.mousedown=Tm,go.mousemove=vm,go.mouseup=Em,go.dblclick=Am,go.setSeries=(_,b,R,I)=>{let G=vn.match[2];R=G(i,b,R),R!=-1&&cs(R,I,!0,!1)},ge&&(wt(j_,m,Tm),wt(Ip,m,vm),wt(Q_,m,_=>{tt(_),Ta(!1)}),wt(ex,m,Yy),wt(tx,m,Am),Xp.add(i),i.syncRect=Ta);let Ql=i.hooks=n.hooks||{};function Fn(_,b,R){jn?Ot.push([_,b,R]):_ in Ql&&Ql[_].forEach(I=>{I.call(null,i,b,R)})}(n.plugins||[]).forEach(_=>{for(let b in _.hooks)Ql[b]=(Ql[b]||[]).concat(_.hooks[b])});let Rm=(_,b,R)=>R,vn=Mn({key:null,setSeries:!1,filters:{pub:dx,sub:dx},scales:[E,S[1]?S[1].scale:null],match:[fx,fx,Rm],values:[null,null]},de.sync);vn.match.length==2&&vn.match.push(Rm),de.sync=vn;let Pm=vn.key,bd=cy(Pm);function Ea(_,b,R,I,G,J,le){vn.filters.pub(_,b,R,I,G,J,le)&&bd.pub(_,b,R,I,G,J,le)}bd.sub(i);function $y(_,b,R,I,G,J,le){vn.filters.sub(_,b,R,I,G,J,le)&&go[_](null,b,R,I,G,J,le)}i.pub=$y;function Zy(){bd.unsub(i),Xp.delete(i),Ln.clear(),zp(Bu,ca,Cm),c.remove(),Ce?.remove(),Fn("destroy")}i.destroy=Zy;function Md(){Fn("init",n,e),Sa(e||n.data,!1),X[E]?md(E,X[E]):ba(),se=Zt.show&&(Zt.width>0||Zt.height>0),ne=me=!0,U(n.width,n.height)}return S.forEach(ro),C.forEach(Es),t?t instanceof HTMLElement?(t.appendChild(c),Md()):t(i,Md):Md(),i}Xn.assign=Mn;Xn.fmtNum=jp;Xn.rangeNum=ku;Xn.rangeLog=Gu;Xn.rangeAsinh=Kp;Xn.orient=so;Xn.pxRatio=It;Xn.join=SA;Xn.fmtDate=em,Xn.tzDate=DA;Xn.sync=cy;{Xn.addGap=pC,Xn.clipGaps=Xu;let n=Xn.paths={points:my};n.linear=_y,n.stepped=_C,n.bars=xC,n.spline=vC}var Kn=58,Ts=10,IC=13,DC=4,LC=.0015,Zu=`${Math.round(.92*Number.parseFloat(getComputedStyle(document.body).fontSize))}px system-ui, 'DejaVu Sans', sans-serif`,Ku=class{constructor(e,t,i,s,r){this.panel=e;this.shown=t;this.data=s;this.store=r;e.append(this.readout),new ResizeObserver(()=>i.later(this)).observe(e);let o=["sensor","quantity","hidden","window","marks","selected","large","scaleByCalibrations"];r.on(o,()=>i.later(this)),r.on(["sample","hover"],()=>this.moveCursor())}panel;shown;data;store;plot=null;cursor=Y("div",{class:"plot-cursor"});pointer=Y("div",{class:"plot-pointer"});readout=Y("div",{class:"readout"});bounds=[-1,1];form="";content="";draw(){let{state:e}=this.store,[t,i]=[this.panel.clientWidth,this.panel.clientHeight];if(t<=Kn||i===0||this.data.samples===0)return;let s=[...yi(this.data,e.marks),...e.selected].map(c=>[c.start_s,c.end_s]),r=JSON.stringify([t,i,devicePixelRatio,e.sensor,[...e.hidden]]),o=JSON.stringify([r,e.window,s,e.scaleByCalibrations]);if(o===this.content)return;this.content=o;let a=this.drawn(),l=this.lines(a,t);r===this.form&&this.plot?this.plot.setData(l):(this.form=r,this.plot?.destroy(),this.plot=new Xn(this.options(t,i,a),l,this.panel),this.plot.over.append(this.pointer,this.cursor),this.followPointer(this.plot))}range(){if(!this.plot||this.panel.clientHeight===0)return null;let{kind:e,quantity:t,component:i}=this.shown;return{kind:e,quantity:t,component:i,x:[...this.store.state.window],y:[...this.bounds]}}moveCursor(){let{sample:e,hover:t,window:i}=this.store.state;for(let[r,o]of[[this.cursor,e],[this.pointer,t]]){let a=o===null?Number.NaN:this.data.time[o]??0;r.hidden=!this.plot||!(a>=i[0]&&a<=i[1]),this.plot&&!r.hidden&&(r.style.transform=`translateX(${Math.round(this.plot.valToPos(a,"x"))}px)`)}if(!this.plot)return;let s=this.sensor();this.readout.replaceChildren(...this.drawn().map(({series:r,column:o})=>{let a=o.at(t??e),l=this.shown.quantity==="force"?2:3,c=Y("span",{class:"chip"});return s&&(c.style.background=ni(s,r)),Y("span",{},c,Number.isFinite(a)?a.toFixed(l):"\u2013")}))}sensor(){return this.data.sensor(this.store.state.sensor)}drawn(){let{kind:e,quantity:t,component:i}=this.shown,{columns:s}=this.data,r=this.sensor();return(r?.wrenches.filter(a=>!this.store.state.hidden.has(a.name))??[]).flatMap(a=>{let l=e==="measured"?s.measured(a,t,i):r&&s.error(r,a,t,i);return l?[{series:a,column:l,band:e==="error"||i!==3?s.band(a,t,i):null}]:[]})}lines(e,t){let{window:i,scaleByCalibrations:s}=this.store.state,r=this.data.sampleAt(i[0]),o=Math.min(this.data.samples,this.data.sampleAt(i[1])+2),a=e.flatMap(({column:f,band:m})=>m?NC(f,m,this.shown):[]),l=[...e.map(({column:f})=>f),...a],c=Vm(this.data.time,l,r,o,t-Kn-Ts),h=e.map(({series:f},m)=>f.calibrated?m:-1).filter(f=>f>=0),d=this.shown.kind==="error"&&s&&h.length>0?[...h,...a.map((f,m)=>e.length+m)]:l.map((f,m)=>m);return this.bounds=UC(d.map(f=>c.y[f]??[]),this.shown),[c.x,...c.y]}options(e,t,i){let{quantity:s,component:r,last:o}=this.shown,a=this.sensor(),l=s==="force"?"f":"t",c=u=>a?ni(a,u):hn,h=i.filter(({band:u})=>u!==null);return{width:e,height:t,padding:[5,Ts,o?0:4,0],legend:{show:!1},cursor:{show:!1},scales:{x:{time:!1,range:()=>[...this.store.state.window]},y:{range:()=>this.bounds}},axes:[{show:!0,size:o?20:0,font:Zu,stroke:hn,grid:{stroke:Ir},ticks:{size:o?4:0},label:o?"time [s]":"",labelSize:o?IC:0,labelGap:0,gap:2,labelFont:Zu,values:o?(u,d)=>d.map(String):()=>[]},{size:Kn-14,font:Zu,stroke:hn,grid:{stroke:Ir},ticks:{size:4},gap:2,space:15,label:`${r===3?`|${l}|`:`${l}${"xyz"[r]}`} [${vi[s]}]`,labelSize:14,labelGap:0,labelFont:Zu}],series:[{},...i.map(({series:u})=>({label:u.name,stroke:c(u),width:u.role==="expected"?2:1,dash:a?Om(a,u).map(d=>d*devicePixelRatio):[],points:{show:!1}})),...h.flatMap(()=>[0,1].map(()=>({width:0,points:{show:!1}})))],bands:h.map(({series:u},d)=>({series:[i.length+2*d+2,i.length+2*d+1],fill:Ni(c(u),.2)})),hooks:{drawClear:[u=>this.drawBackground(u)],draw:[()=>this.moveCursor()]}}}drawBackground(e){let{left:t,top:i,width:s,height:r}=e.bbox,o=(h,u,d)=>{let f=Math.max(t,e.valToPos(h,"x",!0)),m=Math.min(t+s,e.valToPos(u,"x",!0));e.ctx.fillStyle=d,m>f&&e.ctx.fillRect(f,i,m-f,r)},{marks:a,selected:l}=this.store.state;for(let{start_s:h,end_s:u,use:d}of[...this.data.scene.intervals,...yi(this.data,a)])o(h,u,Ni(Dr[d],d==="ignore"?.3:.12));for(let{start_s:h,end_s:u}of l)o(h,u,Ni(rr,.35));if(this.shown.kind==="measured")return;let c=Math.round(e.valToPos(0,"y",!0));e.ctx.fillStyle=rr,c>=i&&c<=i+r&&e.ctx.fillRect(t,c,s,1)}followPointer(e){let{over:t}=e,i=o=>o.clientX-t.getBoundingClientRect().left,s=o=>e.posToVal(o,"x"),r=null;t.addEventListener("pointerdown",o=>{o.button===0&&(r={x:i(o),window:this.store.state.window,spans:o.shiftKey,moved:!1},t.setPointerCapture(o.pointerId))}),t.addEventListener("pointermove",o=>{let a=i(o);if(r===null){this.store.set({hover:this.data.nearestSample(s(a))});return}if(r.moved||=Math.abs(a-r.x)>DC,!!r.moved)if(r.spans){let[l,c]=[Math.min(r.x,a),Math.max(r.x,a)];e.setSelect({left:l,width:c-l,top:0,height:t.clientHeight},!1)}else{let l=(r.x-a)/t.clientWidth*(r.window[1]-r.window[0]);this.store.set({window:wo(r.window,l,this.data.span)})}}),t.addEventListener("pointerup",o=>{let a=r;if(r=null,a!==null){if(!a.moved)this.store.set({sample:this.data.nearestSample(s(i(o))),playing:!1});else if(a.spans){let[l=0,c=0]=[s(a.x),s(i(o))].sort((d,f)=>d-f);e.setSelect({left:0,width:0,top:0,height:0},!1);let{span:h,samples:u}=this.data;this.store.set({window:zr([l,c],1,(l+c)/2,h,u)})}}}),t.addEventListener("pointercancel",()=>{r=null}),t.addEventListener("pointerleave",()=>this.store.set({hover:null})),t.addEventListener("dblclick",()=>this.store.set({window:this.data.span})),t.addEventListener("wheel",o=>{o.preventDefault();let{window:a}=this.store.state,{span:l,samples:c}=this.data,h=(o.shiftKey?o.deltaY:o.deltaX)/t.clientWidth*(a[1]-a[0]),u=o.shiftKey||Math.abs(o.deltaX)>Math.abs(o.deltaY)?wo(a,h,l):zr(a,Math.exp(LC*o.deltaY),s(i(o)),l,c);this.store.set({window:u})},{passive:!1})}};function NC(n,e,{kind:t,component:i}){let s=r=>t==="measured"?o=>n.at(o)+r*e.at(o):i===3&&r<0?o=>0*e.at(o):o=>r*e.at(o);return[-1,1].map(r=>n.beside(r<0?"lower":"upper",s(r)))}function UC(n,{kind:e,component:t}){let i=e==="error"?0:1/0,s=e==="error"?0:-1/0;for(let o of n)for(let a of o)a!==null&&(a<i&&(i=a),a>s&&(s=a));if(!(i<=s))return[-1,1];let r=s>i?.06*(s-i):Math.max(1,.1*Math.abs(s));return[e==="error"&&t===3?i:i-r,s+r]}var Xl=64;function Js(n,e,t,i=!1){let s=document.createElement("canvas"),r=`600 ${.75*Xl}px system-ui, "DejaVu Sans", sans-serif`,o=s.getContext("2d");if(!o)throw new Error("this browser draws no text on a canvas");o.font=r,s.width=Math.ceil(o.measureText(n).width)+12,s.height=Xl,o=s.getContext("2d"),o&&(o.font=r,o.textAlign="center",o.textBaseline="middle",o.lineWidth=6,o.lineJoin="round",o.strokeStyle=Ni(xi,.85),o.strokeText(n,s.width/2,Xl/2),o.fillStyle=e,o.fillText(n,s.width/2,Xl/2));let a=new dl(s);a.colorSpace="srgb";let l=new Xr(new Zo({map:a,depthTest:!i,depthWrite:!1}));return l.scale.set(t*s.width/Xl,t,1),l.renderOrder=i?30:5,l}var FC=new O(0,1,0),OC=new gr(1,1,1,10).translate(0,.5,0),BC=new ml(1,1,14).translate(0,-.5,0);function ss(n){return new Pt().fromArray(n).transpose()}var is=class extends Vt{constructor(t,i,s){super();this.width=i;let r=new Ws({color:t,depthTest:!1,depthWrite:!1,transparent:!0});this.shaft=new Gn(OC,r),this.heads=Array.from({length:s==="force"?1:2},()=>new Gn(BC,r)),this.add(this.shaft,...this.heads);for(let o of this.children)o.renderOrder=20;this.visible=!1}width;shaft;heads;point(t,i){let s=i.length();if(this.visible=Number.isFinite(s)&&s>1e-9,!this.visible)return;this.position.copy(t),this.quaternion.copy(new oi().setFromUnitVectors(FC,i.clone().divideScalar(s)));let r=Math.min(4.5*this.width,.5*s);this.shaft.scale.set(this.width,Math.max(s-r,1e-9),this.width),this.heads.forEach((o,a)=>{o.scale.set(.45*r,r,.45*r),o.position.y=s-.7*a*r})}};function Sy(n,e,t){let i=new Vt;return[new O(1,0,0),new O(0,1,0),new O(0,0,1)].forEach((r,o)=>{let a=nc[o]??hn,l=new is(a,e,"force");if(l.point(new O,r.clone().multiplyScalar(n)),i.add(l),t){let c=Js("xyz"[o]??"",a,.45*n,!0);c.position.copy(r).multiplyScalar(1.25*n),i.add(c)}}),i.matrixAutoUpdate=!1,i}var kC=.25,zC=.85,VC=.1,Ju=class extends Vt{constructor(t,i,s){super();this.data=t;this.model=i;this.size=s;let r=.0075*s;this.arrows={force:new is(Aa,r,"force"),moment:new is(Aa,.7*r,"moment")},this.add(this.arrows.force,this.arrows.moment)}data;model;size;metresPer=null;arrows;fullColour=null;key="";update(t,i){let s=this.data.sensor(t.sensor);this.fit(t);let r=s&&t.errorOnRobot&&this.metresPer!==null?this.vector(t,s):null;for(let l of Object.values(this.arrows))l.visible=!1;if(this.model.tint(new Set,0),!s||!r||this.metresPer===null||this.fullColour===null)return;let o=ss(_o(i.get(s.link)??Da,s.link_H_sensor)),a=r.length();r.applyMatrix3(new Qe().setFromMatrix4(o)).multiplyScalar(this.metresPer),this.arrows[t.quantity].point(new O().setFromMatrixPosition(o),r),Number.isFinite(a)&&this.model.tint(GC(this.data,s),zC*Math.min(1,a/this.fullColour))}vector(t,i){let s=Ra(i,t.hidden);if(!s)return null;let r=o=>this.data.columns.error(i,s,t.quantity,o)?.at(t.sample)??Number.NaN;return new O(r(0),r(1),r(2))}fit(t){let i=JSON.stringify([t.sensor,t.quantity,[...t.hidden]]);if(i===this.key)return;this.key=i;let s=this.data.sensor(t.sensor),r=Ra(s,t.hidden),o=Mo(this.data,{...t,window:this.data.span}),a=s&&r&&this.data.columns.error(s,r,t.quantity,3),l=a&&o!==null?a.at(o):0,c=Pd(s),h=c?this.data.columns.measured(c,t.quantity,3).summary(0,this.data.samples).high:0;this.metresPer=l>0?kC*this.size/l:null,this.fullColour=h>0?VC*h:null}};function GC({scene:n},e){let t=({acting:o,acted_on:a})=>n.robot.joints.find(({parent:l,child:c})=>l===o&&c===a||l===a&&c===o)?.child,i=t(e),s=new Set(n.sensors.filter(o=>o!==e).map(t)),r=new Set(i===void 0?[]:[i]);for(let{parent:o,child:a}of n.robot.joints)r.has(o)&&!s.has(a)&&r.add(a);return r}var HC=new Je(Aa),ju=class extends Vt{constructor(t){super();this.data=t;let{shapes:i}=t.scene.robot;for(let s of t.scene.robot.links){let r=new Vt;r.matrixAutoUpdate=!1,this.links.set(s,r),this.add(r)}for(let s of i)this.links.get(s.link)?.add(this.solid(s));this.bones=i.length===0?new ys(new qt,new Zi({color:hn})):null,this.bones&&(this.bones.frustumCulled=!1,this.add(this.bones))}data;links=new Map;bones;surfaces=[];place(t){for(let[i,s]of this.links){let r=t.get(i);s.visible=r!==void 0,r&&s.matrix.copy(ss(r))}this.bones?.geometry.setFromPoints(this.data.scene.robot.joints.flatMap(i=>[Qu(t,i.parent),Qu(t,i.child)]))}tint(t,i){for(let{link:s,material:r,own:o}of this.surfaces)r.color.copy(o).lerp(HC,t.has(s)?i:0)}solid(t){let[i=.7,s=.7,r=.7,o=1]=t.colour,a=new _l({color:new Je().setRGB(i,s,r,"srgb"),opacity:o,transparent:o<1,flatShading:!0,side:ci});this.surfaces.push({link:t.link,material:a,own:a.color.clone()});let l=new Gn(this.surface(t),a);if(l.matrixAutoUpdate=!1,l.matrix.copy(ss(t.link_H_shape)),t.kind==="mesh"){let[c=1,h=1,u=1]=t.size;l.matrix.scale(new O(c,h,u))}return l}surface(t){let[i=0,s=0,r=0]=t.size;if(t.kind==="box")return new mr(i,s,r);if(t.kind==="sphere")return new Yr(i,24,16);if(t.kind==="cylinder")return new gr(i,i,s,32).rotateX(Math.PI/2);let o=this.data.scene.robot.meshes[t.mesh??-1],a=new qt;return o&&(a.setAttribute("position",new un(this.data.floats(o.vertices),3)),a.setIndex(new un(this.data.integers(o.faces),1))),a}};function Qu(n,e){let t=n.get(e);return new O(t?.[3]??0,t?.[7]??0,t?.[11]??0)}function ql(n,e,t){let i=n.doubles(e.time_s),s=0,r=i.length;for(;s<r;){let a=s+r>>1;(i[a]??0)<=t?s=a+1:r=a}let o=i[s-1];return o!==void 0&&t<o+e.hold_s?s-1:null}function ed(n,e,t){if(t===null)return[];let i=n.integers(e.first),[s,r]=[n.floats(e.place),n.floats(e.force)],o=e.spread?n.floats(e.spread):null,a=n.integers(e.identity),[l,c]=[i[t]??0,i[t+1]??0];return Array.from({length:c-l},(h,u)=>{let d=l+u,f=o?[...o.subarray(9*d,9*d+9)]:null;return{place:[...s.subarray(3*d,3*d+3)],force:[...r.subarray(3*d,3*d+3)],spread:f?.every(Number.isFinite)?f:null,identity:a[d]??0}})}function by({force:n,spread:e}){let t=Math.hypot(...n);if(!e||t===0)return Number.NaN;let i=[0,1,2].map(s=>n.reduce((r,o,a)=>r+o/t*(e[3*a+s]??0),0));return Math.hypot(...i)}function My(n,e){let t=n.floats(e.force),i=0;for(let s=0;s+2<t.length;s+=3){let r=Math.hypot(t[s]??0,t[s+1]??0,t[s+2]??0);r>i&&(i=r)}return i}var WC=.2,td=ec.map(n=>new Je(n)),XC=new Yr(1,20,14),nd=class extends Vt{constructor(t,i,s){super();this.colour=t;this.size=i;this.matrixAutoUpdate=!1,this.words=s===null?null:new Vt,this.words&&s!==null&&(this.words.add(Js(s,t,.03*i,!0)),this.add(this.words))}colour;size;arrows=[];balls=[];words;tips=[];point(t,i){for(;this.arrows.length<t.length;)this.addOne();this.tips=[],this.arrows.forEach((r,o)=>{let a=this.balls[o],l=t[o];if(a&&(a.visible=!1),r.visible=!1,!l)return;let c=new O().fromArray([...l.place]),h=new O().fromArray([...l.force]).multiplyScalar(i);r.point(c,h),this.tips.push(c.clone().add(h).toArray()),a&&l.spread&&this.stretch(a,c.add(h),l.spread,i)});let[s]=t;this.words&&(this.words.visible=s!==void 0,s&&this.words.position.fromArray([...s.place]))}inWorld(){return this.visible?this.tips.map(t=>new O().fromArray(t).applyMatrix4(this.matrix).toArray()):[]}get ellipsoids(){return this.visible?this.balls.filter(t=>t.visible).length:0}stretch(t,i,s,r){let[o=0,a=0,l=0,c=0,h=0,u=0,d=0,f=0,m=0]=s.map(y=>y*r);t.matrix.set(o,a,l,i.x,c,h,u,i.y,d,f,m,i.z,0,0,0,1),t.visible=!0}addOne(){let t=new is(this.colour,.0038*this.size,"force"),i=new Gn(XC,new Ws({color:this.colour,opacity:.35,transparent:!0,depthTest:!1,depthWrite:!1,side:ci}));i.matrixAutoUpdate=!1,i.visible=!1,i.renderOrder=21,this.arrows.push(t),this.balls.push(i),this.add(t,i)}},am=class extends Gn{constructor(t,i){let s=new Ws({vertexColors:!0,side:ci,polygonOffset:!0});[s.polygonOffsetFactor,s.polygonOffsetUnits]=[-4,-4];super(new qt,s);this.data=t;this.patch=i;let r=i.vertices.shape[0]??0;this.colours=new un(new Float32Array(3*r),3),this.geometry.setAttribute("position",new un(t.floats(i.vertices),3)),this.geometry.setAttribute("color",this.colours),this.geometry.setIndex(new un(t.integers(i.faces),1)),this.matrixAutoUpdate=!1}data;patch;pressed=0;colours;colour(t){let i=this.colours.count,s=t===null?null:this.data.floats(this.patch.pressure).subarray(t*i);this.pressed=0;for(let r=0;r<i;r++){let o=s?.[r]??0;o>0&&this.pressed++;let{r:a,g:l,b:c}=qC(o/(this.patch.largest_Pa||1));this.colours.setXYZ(r,a,l,c)}this.colours.needsUpdate=!0}},id=class extends Vt{constructor(t,i){super();this.data=t;let{skin:s,skin_events:r}=t.scene;this.metresPer=wy(t,s.map(a=>a.contacts),i);let o=wy(t,r.map(a=>a.contacts),i);this.patches=s.map(a=>({patch:a,surface:new am(t,a),arrows:new nd(sc,i,null)})),this.events=r.map(a=>({series:a,arrows:new nd(rc,i,"heuristic"),metresPer:o}));for(let{surface:a,arrows:l}of this.patches)this.add(a,l);for(let{arrows:a}of this.events)this.add(a)}data;metresPer;patches;events;update(t,i){let s=this.data.time[t.sample]??Number.NaN;for(let{patch:r,surface:o,arrows:a}of this.patches){let l=i.get(r.link);if(o.visible=a.visible=t.skin&&l!==void 0,!o.visible||!l)continue;let c=ql(this.data,r.contacts,s);o.matrix.copy(ss(l)),o.colour(c),this.turn(a,r.contacts,c,l,this.metresPer)}for(let{series:r,arrows:o,metresPer:a}of this.events){let l=i.get(r.link);o.visible=t.skinEvents&&l!==void 0,l&&this.turn(o,r.contacts,ql(this.data,r.contacts,s),l,a)}}shown(){let t=[...this.patches.map(({patch:i,arrows:s})=>[i.name,s]),...this.events.map(({series:i,arrows:s})=>[i.name,s])];return{pressed:Object.fromEntries(this.patches.map(({patch:i,surface:s})=>[i.name,s.visible?s.pressed:0])),contacts:Object.fromEntries(t.map(([i,s])=>[i,s.inWorld()])),ellipsoids:t.reduce((i,[,s])=>i+s.ellipsoids,0)}}turn(t,i,s,r,o){t.matrix.copy(ss(r)),t.point(ed(this.data,i,s),o)}};function qC(n){let e=Math.min(1,Math.max(0,n))*(td.length-1),t=Math.min(Math.floor(e),td.length-2);return new Je().lerpColors(td[t]??new Je,td[t+1]??new Je,e-t)}function wy(n,e,t){let i=Math.max(0,...e.map(s=>My(n,s)));return i>0?WC*t/i:1}var Ty={type:"change"},cm={type:"start"},Ay={type:"end"},sd=new fr,Ey=new Ei,YC=Math.cos(70*fp.DEG2RAD),Dn=new O,di=2*Math.PI,Dt={NONE:-1,ROTATE:0,DOLLY:1,PAN:2,TOUCH_ROTATE:3,TOUCH_PAN:4,TOUCH_DOLLY_PAN:5,TOUCH_DOLLY_ROTATE:6},lm=1e-6,rd=class extends Tl{constructor(e,t=null){super(e,t),this.state=Dt.NONE,this.target=new O,this.cursor=new O,this.minDistance=0,this.maxDistance=1/0,this.minZoom=0,this.maxZoom=1/0,this.minTargetRadius=0,this.maxTargetRadius=1/0,this.minPolarAngle=0,this.maxPolarAngle=Math.PI,this.minAzimuthAngle=-1/0,this.maxAzimuthAngle=1/0,this.enableDamping=!1,this.dampingFactor=.05,this.enableZoom=!0,this.zoomSpeed=1,this.enableRotate=!0,this.rotateSpeed=1,this.keyRotateSpeed=1,this.enablePan=!0,this.panSpeed=1,this.screenSpacePanning=!0,this.keyPanSpeed=7,this.zoomToCursor=!1,this.autoRotate=!1,this.autoRotateSpeed=2,this.keys={LEFT:"ArrowLeft",UP:"ArrowUp",RIGHT:"ArrowRight",BOTTOM:"ArrowDown"},this.mouseButtons={LEFT:vr.ROTATE,MIDDLE:vr.DOLLY,RIGHT:vr.PAN},this.touches={ONE:Sr.ROTATE,TWO:Sr.DOLLY_PAN},this.target0=this.target.clone(),this.position0=this.object.position.clone(),this.zoom0=this.object.zoom,this._cursorStyle="auto",this._domElementKeyEvents=null,this._lastPosition=new O,this._lastQuaternion=new oi,this._lastTargetPosition=new O,this._quat=new oi().setFromUnitVectors(e.up,new O(0,1,0)),this._quatInverse=this._quat.clone().invert(),this._spherical=new Qo,this._sphericalDelta=new Qo,this._scale=1,this._panOffset=new O,this._rotateStart=new $e,this._rotateEnd=new $e,this._rotateDelta=new $e,this._panStart=new $e,this._panEnd=new $e,this._panDelta=new $e,this._dollyStart=new $e,this._dollyEnd=new $e,this._dollyDelta=new $e,this._dollyDirection=new O,this._mouse=new $e,this._performCursorZoom=!1,this._pointers=[],this._pointerPositions={},this._controlActive=!1,this._onPointerMove=ZC.bind(this),this._onPointerDown=$C.bind(this),this._onPointerUp=KC.bind(this),this._onContextMenu=iR.bind(this),this._onMouseWheel=QC.bind(this),this._onKeyDown=eR.bind(this),this._onTouchStart=tR.bind(this),this._onTouchMove=nR.bind(this),this._onMouseDown=JC.bind(this),this._onMouseMove=jC.bind(this),this._interceptControlDown=sR.bind(this),this._interceptControlUp=rR.bind(this),this.domElement!==null&&this.connect(this.domElement),this.update()}set cursorStyle(e){this._cursorStyle=e,e==="grab"?this.domElement.style.cursor="grab":this.domElement.style.cursor="auto"}get cursorStyle(){return this._cursorStyle}connect(e){super.connect(e),this.domElement.addEventListener("pointerdown",this._onPointerDown),this.domElement.addEventListener("pointercancel",this._onPointerUp),this.domElement.addEventListener("contextmenu",this._onContextMenu),this.domElement.addEventListener("wheel",this._onMouseWheel,{passive:!1}),this.domElement.ownerDocument.addEventListener("keydown",this._interceptControlDown,{passive:!0,capture:!0}),this.domElement.style.touchAction="none"}disconnect(){this.state=Dt.NONE,this.domElement.removeEventListener("pointerdown",this._onPointerDown),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.domElement.removeEventListener("pointercancel",this._onPointerUp),this.domElement.removeEventListener("wheel",this._onMouseWheel),this.domElement.removeEventListener("contextmenu",this._onContextMenu),this.stopListenToKeyEvents(),this.domElement.ownerDocument.removeEventListener("keydown",this._interceptControlDown,{capture:!0}),this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{capture:!0}),this._controlActive=!1,this._pointers.length=0,this._pointerPositions={},this.domElement.style.touchAction="",this.domElement.style.cursor="auto"}dispose(){this.disconnect()}getPolarAngle(){return this._spherical.phi}getAzimuthalAngle(){return this._spherical.theta}getDistance(){return this.object.position.distanceTo(this.target)}listenToKeyEvents(e){e.addEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=e}stopListenToKeyEvents(){this._domElementKeyEvents!==null&&(this._domElementKeyEvents.removeEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=null)}saveState(){this.target0.copy(this.target),this.position0.copy(this.object.position),this.zoom0=this.object.zoom}reset(){this.target.copy(this.target0),this.object.position.copy(this.position0),this.object.zoom=this.zoom0,this.object.updateProjectionMatrix(),this.dispatchEvent(Ty),this.update(),this.state=Dt.NONE}pan(e,t){this._pan(e,t),this.update()}dollyIn(e){this._dollyIn(e),this.update()}dollyOut(e){this._dollyOut(e),this.update()}rotateLeft(e){this._rotateLeft(e),this.update()}rotateUp(e){this._rotateUp(e),this.update()}update(e=null){let t=this.object.position;Dn.copy(t).sub(this.target),Dn.applyQuaternion(this._quat),this._spherical.setFromVector3(Dn),this.autoRotate&&this.state===Dt.NONE&&this._rotateLeft(this._getAutoRotationAngle(e)),this.enableDamping?(this._spherical.theta+=this._sphericalDelta.theta*this.dampingFactor,this._spherical.phi+=this._sphericalDelta.phi*this.dampingFactor):(this._spherical.theta+=this._sphericalDelta.theta,this._spherical.phi+=this._sphericalDelta.phi);let i=this.minAzimuthAngle,s=this.maxAzimuthAngle;isFinite(i)&&isFinite(s)&&(i<-Math.PI?i+=di:i>Math.PI&&(i-=di),s<-Math.PI?s+=di:s>Math.PI&&(s-=di),i<=s?this._spherical.theta=Math.max(i,Math.min(s,this._spherical.theta)):this._spherical.theta=this._spherical.theta>(i+s)/2?Math.max(i,this._spherical.theta):Math.min(s,this._spherical.theta)),this._spherical.phi=Math.max(this.minPolarAngle,Math.min(this.maxPolarAngle,this._spherical.phi)),this._spherical.makeSafe(),this.enableDamping===!0?this.target.addScaledVector(this._panOffset,this.dampingFactor):this.target.add(this._panOffset),this.target.sub(this.cursor),this.target.clampLength(this.minTargetRadius,this.maxTargetRadius),this.target.add(this.cursor);let r=!1;if(this.zoomToCursor&&this._performCursorZoom||this.object.isOrthographicCamera)this._spherical.radius=this._clampDistance(this._spherical.radius);else{let o=this._spherical.radius;this._spherical.radius=this._clampDistance(this._spherical.radius*this._scale),r=o!=this._spherical.radius}if(Dn.setFromSpherical(this._spherical),Dn.applyQuaternion(this._quatInverse),t.copy(this.target).add(Dn),this.object.lookAt(this.target),this.enableDamping===!0?(this._sphericalDelta.theta*=1-this.dampingFactor,this._sphericalDelta.phi*=1-this.dampingFactor,this._panOffset.multiplyScalar(1-this.dampingFactor)):(this._sphericalDelta.set(0,0,0),this._panOffset.set(0,0,0)),this.zoomToCursor&&this._performCursorZoom){let o=null;if(this.object.isPerspectiveCamera){let a=Dn.length();o=this._clampDistance(a*this._scale);let l=a-o;this.object.position.addScaledVector(this._dollyDirection,l),this.object.updateMatrixWorld(),r=!!l}else if(this.object.isOrthographicCamera){let a=new O(this._mouse.x,this._mouse.y,0);a.unproject(this.object);let l=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),this.object.updateProjectionMatrix(),r=l!==this.object.zoom;let c=new O(this._mouse.x,this._mouse.y,0);c.unproject(this.object),this.object.position.sub(c).add(a),this.object.updateMatrixWorld(),o=Dn.length()}else console.warn("WARNING: OrbitControls.js encountered an unknown camera type - zoom to cursor disabled."),this.zoomToCursor=!1;o!==null&&(this.screenSpacePanning?this.target.set(0,0,-1).transformDirection(this.object.matrix).multiplyScalar(o).add(this.object.position):(sd.origin.copy(this.object.position),sd.direction.set(0,0,-1).transformDirection(this.object.matrix),Math.abs(this.object.up.dot(sd.direction))<YC?this.object.lookAt(this.target):(Ey.setFromNormalAndCoplanarPoint(this.object.up,this.target),sd.intersectPlane(Ey,this.target))))}else if(this.object.isOrthographicCamera){let o=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),o!==this.object.zoom&&(this.object.updateProjectionMatrix(),r=!0)}return this._scale=1,this._performCursorZoom=!1,r||this._lastPosition.distanceToSquared(this.object.position)>lm||8*(1-this._lastQuaternion.dot(this.object.quaternion))>lm||this._lastTargetPosition.distanceToSquared(this.target)>lm?(this.dispatchEvent(Ty),this._lastPosition.copy(this.object.position),this._lastQuaternion.copy(this.object.quaternion),this._lastTargetPosition.copy(this.target),!0):!1}_getAutoRotationAngle(e){return e!==null?di/60*this.autoRotateSpeed*e:di/60/60*this.autoRotateSpeed}_getZoomScale(e){let t=Math.abs(e*.01);return Math.pow(.95,this.zoomSpeed*t)}_rotateLeft(e){this._sphericalDelta.theta-=e}_rotateUp(e){this._sphericalDelta.phi-=e}_panLeft(e,t){Dn.setFromMatrixColumn(t,0),Dn.multiplyScalar(-e),this._panOffset.add(Dn)}_panUp(e,t){this.screenSpacePanning===!0?Dn.setFromMatrixColumn(t,1):(Dn.setFromMatrixColumn(t,0),Dn.crossVectors(this.object.up,Dn)),Dn.multiplyScalar(e),this._panOffset.add(Dn)}_pan(e,t){let i=this.domElement;if(this.object.isPerspectiveCamera){let s=this.object.position;Dn.copy(s).sub(this.target);let r=Dn.length();r*=Math.tan(this.object.fov/2*Math.PI/180),this._panLeft(2*e*r/i.clientHeight,this.object.matrix),this._panUp(2*t*r/i.clientHeight,this.object.matrix)}else this.object.isOrthographicCamera?(this._panLeft(e*(this.object.right-this.object.left)/this.object.zoom/i.clientWidth,this.object.matrix),this._panUp(t*(this.object.top-this.object.bottom)/this.object.zoom/i.clientHeight,this.object.matrix)):(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - pan disabled."),this.enablePan=!1)}_dollyOut(e){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale/=e:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_dollyIn(e){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale*=e:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_updateZoomParameters(e,t){if(!this.zoomToCursor)return;this._performCursorZoom=!0;let i=this.domElement.getBoundingClientRect(),s=e-i.left,r=t-i.top,o=i.width,a=i.height;this._mouse.x=s/o*2-1,this._mouse.y=-(r/a)*2+1,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()}_clampDistance(e){return Math.max(this.minDistance,Math.min(this.maxDistance,e))}_handleMouseDownRotate(e){this._rotateStart.set(e.clientX,e.clientY)}_handleMouseDownDolly(e){this._updateZoomParameters(e.clientX,e.clientY),this._dollyStart.set(e.clientX,e.clientY)}_handleMouseDownPan(e){this._panStart.set(e.clientX,e.clientY)}_handleMouseMoveRotate(e){this._rotateEnd.set(e.clientX,e.clientY),this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let t=this.domElement;this._rotateLeft(di*this._rotateDelta.x/t.clientHeight),this._rotateUp(di*this._rotateDelta.y/t.clientHeight),this._rotateStart.copy(this._rotateEnd),this.update()}_handleMouseMoveDolly(e){this._dollyEnd.set(e.clientX,e.clientY),this._dollyDelta.subVectors(this._dollyEnd,this._dollyStart),this._dollyDelta.y>0?this._dollyOut(this._getZoomScale(this._dollyDelta.y)):this._dollyDelta.y<0&&this._dollyIn(this._getZoomScale(this._dollyDelta.y)),this._dollyStart.copy(this._dollyEnd),this.zoomToCursor&&(this._performCursorZoom=!0,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()),this.update()}_handleMouseMovePan(e){this._panEnd.set(e.clientX,e.clientY),this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd),this.update()}_handleMouseWheel(e){this._updateZoomParameters(e.clientX,e.clientY),e.deltaY<0?this._dollyIn(this._getZoomScale(e.deltaY)):e.deltaY>0&&this._dollyOut(this._getZoomScale(e.deltaY)),this.update()}_handleKeyDown(e){let t=!1;switch(e.code){case this.keys.UP:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateUp(di*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,this.keyPanSpeed),t=!0;break;case this.keys.BOTTOM:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateUp(-di*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,-this.keyPanSpeed),t=!0;break;case this.keys.LEFT:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateLeft(di*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(this.keyPanSpeed,0),t=!0;break;case this.keys.RIGHT:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateLeft(-di*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(-this.keyPanSpeed,0),t=!0;break}t&&(e.preventDefault(),this.update())}_handleTouchStartRotate(e){if(this._pointers.length===1)this._rotateStart.set(e.pageX,e.pageY);else{let t=this._getSecondPointerPosition(e),i=.5*(e.pageX+t.x),s=.5*(e.pageY+t.y);this._rotateStart.set(i,s)}}_handleTouchStartPan(e){if(this._pointers.length===1)this._panStart.set(e.pageX,e.pageY);else{let t=this._getSecondPointerPosition(e),i=.5*(e.pageX+t.x),s=.5*(e.pageY+t.y);this._panStart.set(i,s)}}_handleTouchStartDolly(e){let t=this._getSecondPointerPosition(e),i=e.pageX-t.x,s=e.pageY-t.y,r=Math.sqrt(i*i+s*s);this._dollyStart.set(0,r)}_handleTouchStartDollyPan(e){this.enableZoom&&this._handleTouchStartDolly(e),this.enablePan&&this._handleTouchStartPan(e)}_handleTouchStartDollyRotate(e){this.enableZoom&&this._handleTouchStartDolly(e),this.enableRotate&&this._handleTouchStartRotate(e)}_handleTouchMoveRotate(e){if(this._pointers.length==1)this._rotateEnd.set(e.pageX,e.pageY);else{let i=this._getSecondPointerPosition(e),s=.5*(e.pageX+i.x),r=.5*(e.pageY+i.y);this._rotateEnd.set(s,r)}this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let t=this.domElement;this._rotateLeft(di*this._rotateDelta.x/t.clientHeight),this._rotateUp(di*this._rotateDelta.y/t.clientHeight),this._rotateStart.copy(this._rotateEnd)}_handleTouchMovePan(e){if(this._pointers.length===1)this._panEnd.set(e.pageX,e.pageY);else{let t=this._getSecondPointerPosition(e),i=.5*(e.pageX+t.x),s=.5*(e.pageY+t.y);this._panEnd.set(i,s)}this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd)}_handleTouchMoveDolly(e){let t=this._getSecondPointerPosition(e),i=e.pageX-t.x,s=e.pageY-t.y,r=Math.sqrt(i*i+s*s);this._dollyEnd.set(0,r),this._dollyDelta.set(0,Math.pow(this._dollyEnd.y/this._dollyStart.y,this.zoomSpeed)),this._dollyOut(this._dollyDelta.y),this._dollyStart.copy(this._dollyEnd);let o=(e.pageX+t.x)*.5,a=(e.pageY+t.y)*.5;this._updateZoomParameters(o,a)}_handleTouchMoveDollyPan(e){this.enableZoom&&this._handleTouchMoveDolly(e),this.enablePan&&this._handleTouchMovePan(e)}_handleTouchMoveDollyRotate(e){this.enableZoom&&this._handleTouchMoveDolly(e),this.enableRotate&&this._handleTouchMoveRotate(e)}_addPointer(e){this._pointers.push(e.pointerId)}_removePointer(e){delete this._pointerPositions[e.pointerId];for(let t=0;t<this._pointers.length;t++)if(this._pointers[t]==e.pointerId){this._pointers.splice(t,1);return}}_isTrackingPointer(e){for(let t=0;t<this._pointers.length;t++)if(this._pointers[t]==e.pointerId)return!0;return!1}_trackPointer(e){let t=this._pointerPositions[e.pointerId];t===void 0&&(t=new $e,this._pointerPositions[e.pointerId]=t),t.set(e.pageX,e.pageY)}_getSecondPointerPosition(e){let t=e.pointerId===this._pointers[0]?this._pointers[1]:this._pointers[0];return this._pointerPositions[t]}_customWheelEvent(e){let t=e.deltaMode,i={clientX:e.clientX,clientY:e.clientY,deltaY:e.deltaY};switch(t){case 1:i.deltaY*=16;break;case 2:i.deltaY*=100;break}return e.ctrlKey&&!this._controlActive&&(i.deltaY*=10),i}};function $C(n){this.enabled!==!1&&(this._pointers.length===0&&(this.domElement.setPointerCapture(n.pointerId),this.domElement.ownerDocument.addEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.addEventListener("pointerup",this._onPointerUp)),!this._isTrackingPointer(n)&&(this._addPointer(n),n.pointerType==="touch"?this._onTouchStart(n):this._onMouseDown(n),this._cursorStyle==="grab"&&(this.domElement.style.cursor="grabbing")))}function ZC(n){this.enabled!==!1&&(n.pointerType==="touch"?this._onTouchMove(n):this._onMouseMove(n))}function KC(n){switch(this._removePointer(n),this._pointers.length){case 0:this.domElement.releasePointerCapture(n.pointerId),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.dispatchEvent(Ay),this.state=Dt.NONE,this._cursorStyle==="grab"&&(this.domElement.style.cursor="grab");break;case 1:let e=this._pointers[0],t=this._pointerPositions[e];this._onTouchStart({pointerId:e,pageX:t.x,pageY:t.y});break}}function JC(n){let e;switch(n.button){case 0:e=this.mouseButtons.LEFT;break;case 1:e=this.mouseButtons.MIDDLE;break;case 2:e=this.mouseButtons.RIGHT;break;default:e=-1}switch(e){case vr.DOLLY:if(this.enableZoom===!1)return;this._handleMouseDownDolly(n),this.state=Dt.DOLLY;break;case vr.ROTATE:if(n.ctrlKey||n.metaKey||n.shiftKey){if(this.enablePan===!1)return;this._handleMouseDownPan(n),this.state=Dt.PAN}else{if(this.enableRotate===!1)return;this._handleMouseDownRotate(n),this.state=Dt.ROTATE}break;case vr.PAN:if(n.ctrlKey||n.metaKey||n.shiftKey){if(this.enableRotate===!1)return;this._handleMouseDownRotate(n),this.state=Dt.ROTATE}else{if(this.enablePan===!1)return;this._handleMouseDownPan(n),this.state=Dt.PAN}break;default:this.state=Dt.NONE}this.state!==Dt.NONE&&this.dispatchEvent(cm)}function jC(n){switch(this.state){case Dt.ROTATE:if(this.enableRotate===!1)return;this._handleMouseMoveRotate(n);break;case Dt.DOLLY:if(this.enableZoom===!1)return;this._handleMouseMoveDolly(n);break;case Dt.PAN:if(this.enablePan===!1)return;this._handleMouseMovePan(n);break}}function QC(n){this.enabled===!1||this.enableZoom===!1||this.state!==Dt.NONE||(n.preventDefault(),this.dispatchEvent(cm),this._handleMouseWheel(this._customWheelEvent(n)),this.dispatchEvent(Ay))}function eR(n){this.enabled!==!1&&this._handleKeyDown(n)}function tR(n){switch(this._trackPointer(n),this._pointers.length){case 1:switch(this.touches.ONE){case Sr.ROTATE:if(this.enableRotate===!1){this.state=Dt.NONE;break}this._handleTouchStartRotate(n),this.state=Dt.TOUCH_ROTATE;break;case Sr.PAN:if(this.enablePan===!1){this.state=Dt.NONE;break}this._handleTouchStartPan(n),this.state=Dt.TOUCH_PAN;break;default:this.state=Dt.NONE}break;case 2:switch(this.touches.TWO){case Sr.DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchStartDollyPan(n),this.state=Dt.TOUCH_DOLLY_PAN;break;case Sr.DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchStartDollyRotate(n),this.state=Dt.TOUCH_DOLLY_ROTATE;break;default:this.state=Dt.NONE}break;default:this.state=Dt.NONE}this.state!==Dt.NONE&&this.dispatchEvent(cm)}function nR(n){switch(this._trackPointer(n),this.state){case Dt.TOUCH_ROTATE:if(this.enableRotate===!1)return;this._handleTouchMoveRotate(n),this.update();break;case Dt.TOUCH_PAN:if(this.enablePan===!1)return;this._handleTouchMovePan(n),this.update();break;case Dt.TOUCH_DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchMoveDollyPan(n),this.update();break;case Dt.TOUCH_DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchMoveDollyRotate(n),this.update();break;default:this.state=Dt.NONE}}function iR(n){this.enabled!==!1&&n.preventDefault()}function sR(n){n.key==="Control"&&(this._controlActive=!0,this.domElement.ownerDocument.addEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}function rR(n){n.key==="Control"&&(this._controlActive=!1,this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}var od=Math.PI/24,Cy=1.15,oR=2,_a=class{constructor(e,t,i){this.panel=e;this.frames=i;this.renderer=aR(),this.canvas=this.renderer?.domElement??document.createElement("canvas"),this.canvas.tabIndex=0,this.canvas.setAttribute("role","img"),this.canvas.setAttribute("aria-label",t),e.append(this.canvas),this.renderer||e.append(Y("p",{class:"overlay absent"},"This browser draws nothing in 3-D: it has no WebGL 2.")),this.scene.background=new Je(xi),this.camera.up.set(0,0,1),this.controls=new rd(this.camera,this.canvas),this.controls.addEventListener("change",()=>i.later(this)),this.canvas.addEventListener("keydown",s=>this.turnByKey(s)),this.fit(),new ResizeObserver(()=>this.fit()).observe(e)}panel;frames;canvas;scene=new al;camera=new si(35,1,.01,100);renderer;controls;home={from:new O(3,-3,2),at:new O};fixed=!1;size="";lookFrom(e,t){this.home={from:e.clone(),at:t.clone()};let i=e.distanceTo(t);this.camera.near=i/100,this.camera.far=i*20,this.reset()}reset(){this.camera.position.copy(this.home.from),this.controls.target.copy(this.home.at),this.camera.updateProjectionMatrix(),this.controls.update(),this.frames.later(this)}draw(){this.renderer?.render(this.scene,this.camera)}hold(e,t){this.fixed=!0,this.resize(e,t,1,!1)}release(){this.fixed=!1,this.size="",this.fit()}onCanvas(e){let t=e.clone().project(this.camera);return t.z>1?null:{x:(.5+.5*t.x)*this.canvas.clientWidth,y:(.5-.5*t.y)*this.canvas.clientHeight}}fit(){let{clientWidth:e,clientHeight:t}=this.panel,i=Math.min(devicePixelRatio,oR),s=`${e} ${t} ${i}`;this.fixed||e===0||t===0||s===this.size||(this.size=s,this.resize(e,t,i,!0),this.frames.later(this))}resize(e,t,i,s){this.renderer?.setPixelRatio(i),this.renderer?.setSize(e,t,s),this.camera.aspect=e/t,this.camera.updateProjectionMatrix(),this.camera.updateMatrixWorld()}turnByKey(e){let t=this.camera.position.clone().sub(this.controls.target),i=new O().crossVectors(this.camera.up,t).normalize(),s={ArrowLeft:()=>t.applyAxisAngle(this.camera.up,-od),ArrowRight:()=>t.applyAxisAngle(this.camera.up,od),ArrowUp:()=>t.applyAxisAngle(i,-od),ArrowDown:()=>t.applyAxisAngle(i,od)},r={"+":()=>t.divideScalar(Cy),"-":()=>t.multiplyScalar(Cy),0:()=>t.copy(this.home.from).sub(this.controls.target)},o=e.altKey?s[e.key]:r[e.key];o&&(e.preventDefault(),e.stopPropagation(),o(),this.camera.position.copy(this.controls.target).add(t),this.controls.update(),this.frames.later(this))}};function aR(){try{return new Ru({antialias:!0,preserveDrawingBuffer:!0})}catch{return null}}var lR=["force","moment"],cR=.3,ad=class extends Vt{constructor(t,i){super();this.data=t;this.size=i;this.metresPer={force:this.unit("force"),moment:this.unit("moment")};let{sensors:s,contacts:r}=t.scene;this.places=[...s.map((o,a)=>this.place(a,o.name,o.link,o.link_H_sensor,o.wrenches)),...r.map(o=>this.place(null,o.name,o.link,o.link_H_contact,[o]))]}data;size;metresPer;places;update(t,i){for(let s of this.places){let r=_o(i.get(s.link)??Da,s.link_H_frame),o=s.sensor===null?t.contacts:t.allSensors||s.sensor===t.sensor;s.frame.matrix.copy(ss(r)),s.frame.visible=o;for(let{series:a,arrows:l}of s.drawn){let c=o&&!("role"in a&&t.hidden.has(a.name));for(let h of lR){let u=c&&(h==="force"?t.forceArrows:t.momentArrows);this.turn(l[h],a,h,u?r:null,t.sample)}}}}turn(t,i,s,r,o){if(r===null){t.visible=!1;return}let a=ss(r),l=new O(...this.data.vector(i,o,s));l.applyMatrix3(new Qe().setFromMatrix4(a)).multiplyScalar(this.metresPer[s]),t.point(new O().setFromMatrixPosition(a),l)}place(t,i,s,r,o){let a=new Vt;a.matrixAutoUpdate=!1,a.matrix=new Pt,a.add(Sy(.07*this.size,.002*this.size,t!==null));let l=Js(i,t===null?ic:hn,.032*this.size,!0);l.position.set(0,0,-.035*this.size),a.add(l),this.add(a);let c=o.map(h=>{let u="role"in h?this.colour(t,h):ic,d=("role"in h&&h.role==="expected"?.0065:.0042)*this.size,f={force:new is(u,d,"force"),moment:new is(u,.7*d,"moment")};return this.add(f.force,f.moment),{series:h,arrows:f}});return{sensor:t,link:s,link_H_frame:r,frame:a,drawn:c}}colour(t,i){let s=t===null?void 0:this.data.sensor(t);return s?ni(s,i):ic}unit(t){let i=this.data.scene.sensors.flatMap(({wrenches:r})=>{let a=r.filter(({role:l})=>l==="expected").map(l=>this.largest(l,t)).filter(l=>l>-1/0);return a.length>0?a:r.map(l=>this.largest(l,t))}),s=Math.max(0,...i);return s>0?cR*this.size/s:1}largest(t,i){return this.data.columns.measured(t,i,3).summary(0,this.data.samples).high}};var hR=24,ld=class extends _a{constructor(t,i,s){super(t,"Robot in its posture at the current sample",i);this.data=s;let r=new Ml(Ad,1.9);r.position.set(2,-3,5),this.scene.add(new vl(Ad,Lm,2.2),r),this.model=new ju(s),this.scene.add(this.model);let o=this.reach(),a=Math.max(o.getSize(new O).length(),.001);this.wrenches=new ad(s,a),this.scene.add(this.wrenches),this.skin=new id(s,a),this.error=new Ju(s,this.model,a),this.scene.add(this.skin,this.error),this.floor(o,a);let l=o.getCenter(new O);this.lookFrom(l.clone().add(new O(.82,-.95,.45).multiplyScalar(a)),l)}data;wrenches;skin;error;model;update(t){let i=La(this.data,t.sample);this.model.place(i),this.wrenches.update(t,i),this.skin.update(t,i),this.error.update(t,i),this.frames.later(this)}reach(){let t=Math.min(hR,Math.max(1,this.data.samples)),i=Array.from({length:t},(o,a)=>Math.floor(a*this.data.samples/t)),s=new Yi,r=new Map;for(let o of i){r=La(this.data,o);for(let a of r.keys())s.expandByPoint(Qu(r,a))}return this.model.place(r),this.model.updateMatrixWorld(!0),s.union(new Yi().setFromObject(this.model))}floor(t,i){let s=new wl(2*i,20,Pr,Ir);s.rotateX(Math.PI/2);let r=t.getCenter(new O);s.position.set(r.x,r.y,t.min.z),this.scene.add(s)}};var uR=[["errorOnRobot","Error as an arrow and as the colour of the limb"],["scaleByCalibrations","Scale of errors by calibrations alone"],["forceArrows","Force arrows"],["momentArrows","Moment arrows (two heads)"],["allSensors","Arrows of all sensors"],["contacts","Contact wrenches (world on robot)"],["skin","Pressure and contacts on skin"],["skinEvents","Contacts of the skinManager (heuristic, not newtons)"],["wireframes","Ellipsoids and reference sphere"],["hideIgnored","Hide ignored intervals in the clouds"]];function Ry(n,e){let t=Y("div",{role:"group","aria-label":"Series"});return e.on(["sensor","hidden"],()=>{let i=n.sensor(e.state.sensor),s=t.contains(document.activeElement)?document.activeElement?.getAttribute("aria-label"):null;t.replaceChildren();for(let r of i?.wrenches??[]){let o=Y("span",{class:"chip"});o.style.background=i?ni(i,r):"";let{row:a,box:l}=Id([o,r.name],!e.state.hidden.has(r.name),c=>{let h=new Set(e.state.hidden);c?h.delete(r.name):h.add(r.name),e.set({hidden:h})},r.name);t.append(a),r.name===s&&l.focus()}i?.wrenches.length||t.append(Y("p",{class:"absent"},"No wrenches of this sensor."))}),t}function Py(n,e){let t=Y("div",{role:"group","aria-label":"Shown"});for(let[i,s]of uR){if(dR(n,i))continue;let{row:r,box:o}=Id([s],e.state[i],a=>e.set({[i]:a}));e.on([i],()=>{o.checked=e.state[i]}),t.append(r)}return t}function dR({scene:n},e){let t={contacts:n.contacts,skin:n.skin,skinEvents:n.skin_events};return e in t&&t[e].length===0}function Dy(n,e,t,i){let{skin:s,skin_events:r}=n.scene;if(s.length+r.length===0)return[];let o=s.map(({name:h,largest_Pa:u})=>{let d=Y("span",{class:"pressures",role:"img","aria-label":`Colours from 0 to ${Iy(u)} kPa`});return d.style.background=`linear-gradient(to right, ${ec.join(", ")})`,Y("p",{class:"pressure-legend"},`${h}: 0 `,d,` ${Iy(u)} kPa`)}),a=Number((.1/i).toPrecision(2)),l=s.length?[Y("p",{},`0.1 m of arrow on skin: ${a} N, ellipsoid: one standard deviation`)]:[],c=new hm(n,e,t);return[Y("section",{"aria-label":"Skin"},Y("h2",{},"Skin"),...o,...l,c.root)]}var hm=class{constructor(e,t,i){this.data=e;this.store=t;t.on(["sample"],()=>i.later(this))}data;store;root=Y("div",{class:"values"});draw(){let{skin:e,skin_events:t}=this.data.scene,i=[...e.flatMap(({name:r,contacts:o})=>this.rows(r,o,sc,"N")),...t.flatMap(({name:r,contacts:o})=>this.rows(r,o,rc,"heuristic"))],s=Y("p",{class:"absent"},"No contact on skin at this sample.");this.root.replaceChildren(i.length?Y("table",{},Y("tbody",{},...i)):s)}rows(e,t,i,s){let r=this.data.time[this.store.state.sample]??Number.NaN;return ed(this.data,t,ql(this.data,t,r)).map(a=>{let l=Y("span",{class:"chip"});l.style.background=i;let c=by(a),h=Math.hypot(...a.force).toFixed(2)+(Number.isFinite(c)?` \xB1 ${c.toFixed(2)}`:"");return Y("tr",{},Y("th",{scope:"row"},l,`${e}: contact ${a.identity}`),Y("td",{},`${h} ${s}`))})}};function Iy(n){return(.001*n).toFixed(1)}function um(n){n.traverse(e=>{if(e===n)return;if(e instanceof Xr){e.material.map?.dispose(),e.material.dispose();return}let{geometry:t,material:i}=e;t?.dispose(),i?.dispose()}),n.clear()}var rs=32,Yl=null;function dm(){if(Yl)return Yl;let n=new Uint8Array(4*rs*rs).fill(255);for(let e=0;e<rs*rs;e++){let[t,i]=[e%rs-rs/2+.5,Math.floor(e/rs)-rs/2+.5];n[4*e+3]=Math.hypot(t,i)<rs/2?255:0}return Yl=new Ko(n,rs,rs),Yl.needsUpdate=!0,Yl}var fR={force:"f",moment:"t"},Ly=.17;function Uy(n,e){let t=new Vt,i=r=>new O(r&1?1:-1,r&2?1:-1,r&4?1:-1),s=[0,1,2,3,4,5,6,7].flatMap(r=>[1,2,4].filter(o=>!(r&o)).flatMap(o=>[i(r),i(r|o)]));t.add(Fy(s,Pr));for(let r of[0,1,2])t.add(...pR(n,e,r));return t}function $l(n,e){let[t,i,s]=[0,1,2].map(r=>((e[r]??Number.NaN)-(n.centre[r]??0))/n.half);return new O(t,i,s)}function pR(n,e,t){let i=nc[t]??Pr,s=n.centre[t]??0,r=(u,d)=>{let f=t===2?new O(-1,1,0):new O(-1,-1,-1);f.setComponent(t,(u-s)/n.half);let m=t===0?new O(0,-1,0):new O(-1,0,0);return f.addScaledVector(m,d)},o=Ia(s-n.half,s+n.half,4),a=o.flatMap(u=>[r(u,0),r(u,.04)]),l=[r(s-n.half,0),r(s+n.half,0)],c=o.map(u=>Ny(Js(String(u),rr,Ly),r(u,.2))),h=Js(`${fR[e]}${"xyz"[t]??""} [${vi[e]}]`,i,1.15*Ly);return[Fy([...a,...l],i),...c,Ny(h,r(s+1.2*n.half,0))]}function Ny(n,e){return n.position.copy(e),n}function Fy(n,e){return new ys(new qt().setFromPoints(n),new Zi({color:e}))}var mR=12,gR=4,cd=class extends _a{constructor(t,i,s,r,o){super(t,"Force or moment space with the current sample",i);this.data=s;this.maker=r;this.store=o;this.scene.add(this.fixedParts,this.markers),this.lookFrom(new O(2.75,-4.6,2.2),new O(0,-.1,-.05)),this.jumpOnClick()}data;maker;store;fixedParts=new Vt;markers=new Vt;clouds=null;drawn="";update(t){let i=this.maker.of(t),s=JSON.stringify([[...t.hidden],t.wireframes]);(i!==this.clouds||s!==this.drawn)&&this.rebuild(i,t),this.clouds=i,this.drawn=s,this.mark(i,t),this.frames.later(this)}sampleOnCanvas(t,i){let s=this.clouds?.clouds[t];return!this.clouds||!s?null:this.onCanvas($l(this.clouds,this.data.vector(s.series,i,this.store.state.quantity)))}samples(){return this.clouds?.samples??new Uint32Array}rebuild(t,i){um(this.fixedParts),this.fixedParts.add(Uy(t,i.quantity));for(let s of this.visible(t,i)){if(this.fixedParts.add(_R(t,s)),!i.wireframes)continue;let r=new Vt;s.sphere&&r.add(Cp(Du(s.sphere),Um,.22)),s.ellipsoid&&r.add(Cp(s.ellipsoid,s.colour,.45)),r.scale.setScalar(1/t.half),r.position.copy($l(t,[0,0,0])),this.fixedParts.add(r)}}mark(t,i){um(this.markers);for(let s of this.visible(t,i)){let r=$l(t,this.data.vector(s.series,i.sample,i.quantity));if(!Number.isFinite(r.x+r.y+r.z))continue;let o=new qt().setFromPoints([r]);for(let[a,l]of[[17,xi],[14,s.colour],[5,xi]]){let c=new Jo(o,new qr({color:l,size:a,sizeAttenuation:!1,map:dm(),transparent:!0,depthTest:!1,alphaTest:.5}));c.renderOrder=20,this.markers.add(c)}}}visible(t,i){return t.clouds.filter(s=>!i.hidden.has(s.series.name))}jumpOnClick(){let t=[0,0];this.canvas.addEventListener("pointerdown",i=>{t=[i.clientX,i.clientY]}),this.canvas.addEventListener("click",i=>{if(Math.hypot(i.clientX-t[0],i.clientY-t[1])>gR)return;let s=this.canvas.getBoundingClientRect(),r=this.closest(i.clientX-s.left,i.clientY-s.top);r!==null&&this.store.set({sample:r,playing:!1})})}closest(t,i){if(!this.clouds)return null;let s=null;for(let r of this.visible(this.clouds,this.store.state))this.clouds.samples.forEach((o,a)=>{let l=this.clouds&&this.onCanvas($l(this.clouds,r.points.subarray(3*a,3*a+3)));if(!l||Number.isNaN(l.x))return;let c=Math.hypot(l.x-t,l.y-i);c<(s?.distance??mR)&&(s={sample:o,distance:c})});return s?.sample??null}};function _R(n,e){let t=new Float32Array(e.points.length),i=new O(...n.centre),s=0,r=new O;for(let a=0;a+2<e.points.length;a+=3)r.fromArray(e.points,a).sub(i).divideScalar(n.half),Number.isFinite(r.x+r.y+r.z)&&r.toArray(t,s++*3);let o=new qt;return o.setAttribute("position",new un(t.subarray(0,3*s),3)),new Jo(o,new qr({color:e.colour,size:3,sizeAttenuation:!1,map:dm(),alphaTest:.5}))}var hd=class{constructor(e,t,i){this.data=e;this.store=t;t.on(["window","sensor","quantity","hidden"],()=>i.later(this))}data;store;root=Y("div",{class:"values"});draw(){let{sensor:e,hidden:t}=this.store.state,i=this.data.sensor(e),s=(i?.wrenches??[]).filter(o=>o.role==="measured"&&!t.has(o.name)).flatMap(o=>i?this.table(i,o):[]),r=Y("p",{class:"absent"},"No wrench is expected in this window.");this.root.replaceChildren(...s.length>0?s:[r])}table(e,t){let{quantity:i,window:s}=this.store.state,[r,o]=[this.data.firstAt(s[0]),this.data.sampleAt(s[1])+1],a=lc.flatMap(f=>this.data.columns.error(e,t,i,f)??[]),l=a[0]?.summary(r,o).count??0;if(l===0)return[];let c=i==="force"?"f":"t",h=Y("span",{class:"chip"});h.style.background=ni(e,t);let u=a.map((f,m)=>{let y=m===3?`|${c}|`:`${c}${"xyz"[m]??""}`;return Y("tr",{},Y("th",{scope:"row"},y),...this.cells(f,r,o))}),d=["","rms","mean","largest"].map(f=>Y("th",{scope:"col"},f));return[Y("table",{class:"statistics"},Y("caption",{},h,` ${t.name} [${vi[i]}], n = ${l}`),Y("thead",{},Y("tr",{},...d)),Y("tbody",{},...u))]}cells(e,t,i){let{sum:s,squares:r,count:o}=e.summary(t,i),a=e.farthest(t,i)??t,l=zt(this.shown(e.at(a)),()=>this.store.set({sample:a,playing:!1}),{class:"link",title:`at ${(this.data.time[a]??0).toFixed(3)} s`});return[...[Math.sqrt(r/o),s/o].map(h=>Y("td",{},this.shown(h))),Y("td",{},l)]}shown(e){return e.toFixed(this.store.state.quantity==="force"?2:3)}};var xa={top:1,height:14},Zl={top:17,height:9},ud=class{constructor(e,t,i,s){this.panel=e;this.frames=t;this.data=i;this.store=s;this.canvas=Y("canvas",{role:"img"}),e.append(this.canvas),new ResizeObserver(()=>t.later(this)).observe(e),this.canvas.addEventListener("click",r=>{let o=this.instant(r.clientX-this.canvas.getBoundingClientRect().left);s.set({sample:i.nearestSample(o),playing:!1})}),this.canvas.addEventListener("mousemove",r=>{this.canvas.title=this.describe(this.instant(r.clientX-this.canvas.getBoundingClientRect().left))})}panel;frames;data;store;canvas;update(){this.frames.later(this)}draw(){let[e,t]=[this.panel.clientWidth,this.panel.clientHeight],i=this.canvas.getContext("2d");if(!i||e<=Kn+Ts)return;this.canvas.width=Math.round(e*devicePixelRatio),this.canvas.height=Math.round(t*devicePixelRatio),i.setTransform(devicePixelRatio,0,0,devicePixelRatio,0,0),i.font="10px system-ui, 'DejaVu Sans', sans-serif";let s=[...this.data.scene.intervals,...yi(this.data,this.store.state.marks)],r=this.data.scene.findings;this.canvas.setAttribute("aria-label",`Time axis with ${s.length} intervals and ${r.length} findings; both are listed beside the plots`);for(let{label:o,start_s:a,end_s:l,use:c}of s)this.bar(i,a,l,c,o);for(let{start_s:o,end_s:a}of r)this.finding(i,o,a);for(let{start_s:o,end_s:a}of this.store.state.selected){let[l,c]=[Math.max(Kn,this.pixel(o)),Math.min(e-Ts,this.pixel(a))];i.fillStyle=Ni(hn,.45),c>=l&&i.fillRect(l,0,Math.max(1,c-l),t)}for(let o of this.store.state.marks)this.flag(i,o.time_s,o.mark);i.fillStyle=hn,i.fillText("intervals",4,xa.top+11),i.fillStyle=tc,i.fillText("findings",4,Zl.top+8)}bar(e,t,i,s,r){let o=Math.max(Kn,this.pixel(t)),a=Math.min(this.panel.clientWidth-Ts,this.pixel(i));if(a<=o)return;e.fillStyle=Ni(Dr[s],.4),e.fillRect(o,xa.top,a-o,xa.height),e.strokeStyle=Dr[s],e.strokeRect(o+.5,xa.top+.5,Math.max(0,a-o-1),xa.height-1),e.fillStyle=hn;let l=s==="ignore"?`${r} (ignored)`:r;e.measureText(l).width<a-o-6&&e.fillText(l,o+4,xa.top+11)}finding(e,t,i){if(t===null)return;let s=this.panel.clientWidth-Ts,[r,o]=[this.pixel(t),this.pixel(i??t)];if(!(o<Kn||r>s)){e.fillStyle=Ni(tc,.25),e.fillRect(Math.max(Kn,r),Zl.top,Math.min(s,o)-Math.max(Kn,r),Zl.height),e.fillStyle=tc;for(let a of[r,o])a>=Kn&&a<=s&&e.fillRect(a-.75,Zl.top,1.5,Zl.height)}}flag(e,t,i){let s=this.pixel(t);if(s<Kn||s>this.panel.clientWidth-Ts)return;let r=i==="begin"?6:i==="end"?-6:0;if(e.fillStyle=Nm,e.fillRect(s-.75,0,1.5,this.panel.clientHeight),e.beginPath(),r===0)e.arc(s,4,3.5,0,2*Math.PI);else for(let[o,a]of[[s,0],[s+r,4],[s,8]])e.lineTo(o,a);e.fill()}pixel(e){let[t,i]=this.store.state.window;return Kn+(e-t)/(i-t||1)*(this.panel.clientWidth-Kn-Ts)}instant(e){let[t,i]=this.store.state.window;return t+(e-Kn)/(this.panel.clientWidth-Kn-Ts)*(i-t)}describe(e){let t=3*Math.abs(this.instant(1)-this.instant(0)),{intervals:i,findings:s}=this.data.scene;return[...i.filter(r=>r.start_s<=e&&e<r.end_s).map(r=>`${r.label} (${r.use})`),...s.filter(r=>r.start_s!==null&&r.start_s-t<=e&&e<=(r.end_s??r.start_s)+t).map(r=>`${r.stream}: ${r.kind}: ${r.message}`)].slice(0,12).join(`
`)}};var xR=180/Math.PI,dd=class{constructor(e,t,i){this.data=e;this.store=t;t.on(["sample","sensor","quantity","hidden"],()=>i.later(this))}data;store;root=Y("div",{class:"values"});draw(){let{sample:e,sensor:t,quantity:i,hidden:s}=this.store.state,r=this.data.sensor(t),o=i==="force"?"f":"t",a=["",`${o}x`,`${o}y`,`${o}z`,`|${o}|`],l=(r?.wrenches??[]).filter(c=>!s.has(c.name)).map(c=>{let h=this.data.vector(c,e,i),u=[...h,Math.hypot(...h)].map(f=>Y("td",{},vR(f,i))),d=Y("span",{class:"chip"});return d.style.background=r?ni(r,c):"",Y("tr",{},Y("th",{scope:"row",title:c.name,"aria-label":c.name},d),...u)});this.root.replaceChildren(Y("table",{},Y("caption",{},`${i==="force"?"Force":"Torque"} [${vi[i]}]${yR(r)}`),Y("thead",{},Y("tr",{},...a.map(c=>Y("th",{scope:"col"},c)))),Y("tbody",{},...l)))}},fd=class{constructor(e,t,i){this.data=e;this.store=t;let s=Y("table",{},this.body);this.root=Y("details",{},Y("summary",{},`Joint configuration (${e.scene.coordinates.length})`),s),this.root.addEventListener("toggle",()=>i.later(this)),t.on(["sample"],()=>i.later(this))}data;store;root;body=Y("tbody");draw(){if(!this.root.open)return;let{sample:e}=this.store.state;this.body.replaceChildren(...this.data.scene.coordinates.map((t,i)=>{let s=this.data.position(e,i),r=this.data.isLength(i),o=Number.isNaN(s)?"absent":r?`${s.toFixed(4)} m`:`${(s*xR).toFixed(2)}\xB0`;return Y("tr",{},Y("th",{scope:"row"},t),Y("td",{},o))}))}};function yR(n){return n?n.acting===null?` unexplained on ${n.acted_on}`:` of ${n.acting} on ${n.acted_on}`:""}function vR(n,e){return Number.isFinite(n)?n.toFixed(e==="force"?2:3):"\u2013"}function Oy(n,e){let t=(u,d,f,m)=>Y("input",{type:"number","aria-label":u,value:d,min:f,step:m}),[i,s]=[t("Video start in seconds",0,0,.1),t("Video end in seconds",0,0,.1)],[r,o]=[t("Video frames per second",20,1,1),t("Video speed",1,.1,.1)],a=or("Video codec",[["h264","H.264: plays everywhere"],["vp9","VP9: same file every time"]],"h264",()=>{}),l=Y("progress",{max:1,value:0,"aria-label":"Video progress"});l.hidden=!0,n.store.on(["window"],()=>{i.value=n.store.state.window[0].toFixed(3),s.value=n.store.state.window[1].toFixed(3)});let c=zt("Record video",()=>{h()},{});async function h(){c.disabled=!0,l.hidden=!1;try{let[u,d,f,m]=[i,s,r,o].map(C=>C.valueAsNumber),[y,g]=[u??0,d??0].map(C=>n.data.nearestSample(C)),p={start:y??0,end:g??0,fps:f??20,speed:m??1,codec:a.value},S=await Ec(n,p,C=>{l.value=C});uc(dc(n.data.scene.title,".mp4"),S,"video/mp4"),e("The video is made.")}catch(u){e(String(u))}finally{c.disabled=!1,l.hidden=!0}}return Y("details",{},Y("summary",{},"Video"),Y("div",{class:"row video"},Y("label",{},"from",i),Y("label",{},"to",s),Y("label",{},"frames/s",r),Y("label",{},"speed",o)),Y("div",{class:"row"},a,c,l))}window.ft={ready:SR()};async function SR(){document.readyState==="loading"&&await new Promise(t=>document.addEventListener("DOMContentLoaded",t,{once:!0}));let n=Y("progress",{"aria-label":"Loading the data"}),e=Y("div",{class:"waiting",role:"status"},"Loading the data ",n);document.body.append(e);try{let t=Ig();document.title||=t.title;let i=await Dg((s,r)=>{r>0&&([n.max,n.value]=[r,s])});return bR(new cc(t,i)),e.remove(),document.documentElement.dataset.ready="true",!0}catch(t){throw e.replaceChildren(`This page cannot be shown. ${t instanceof Error?t.message:String(t)}`),e.setAttribute("role","alert"),t}}function bR(n){let e={sensor:0,quantity:"force",hidden:new Set,window:n.span},t=new Rc({...e,sample:Mo(n,e)??0,forceArrows:!0,momentArrows:!0,allSensors:!0,contacts:!0,skin:!0,skinEvents:!0,wireframes:!0,hideIgnored:!1,marks:[],markKind:"point",hover:null,selected:[],errorOnRobot:!0,scaleByCalibrations:!1,large:null,playing:!1,speed:1,...of(n,location.hash)}),i=new fc,s=f=>{r.status.textContent=f},r=Cg(n,t,()=>xg(n,t,s));(document.getElementById("viewer")??document.body).append(r.app);let o=new hc(n),a=new ld(r.robot,i,n),l=new cd(r.space,i,n,o,t);r.robotTitle.prepend(zt("\u27F2",()=>a.reset(),{"aria-label":"Reset the robot's view",title:"Reset the view"})),r.spaceTitle.prepend(zt("\u27F2",()=>l.reset(),{"aria-label":"Reset the space's view",title:"Reset the view"}));let c=["forceArrows","momentArrows","allSensors","contacts","errorOnRobot"];t.on(["sample","sensor","quantity","hidden",...c,"skin","skinEvents"],()=>a.update(t.state)),t.on(["sample","sensor","quantity","hidden","wireframes","hideIgnored","marks","window"],()=>l.update(t.state));let h=r.plots.map(({panel:f,shown:m})=>new Ku(f,m,i,n,t)),u=MR(r,i,n,o,t),d={data:n,store:t,robot:a,space:l,flush:()=>i.flush()};wR(r,i,d,s),TR(r,d,a),yg(n,t),Tg(n,t,s),Wg(n,t),Eg(),Object.assign(window.ft,mg(d,l,u,h)),i.flush()}function MR(n,e,t,i,s){for(let r of n.strips){let o=new ud(r,e,t,s);s.on(["window","marks","selected"],()=>o.update())}return n.planes.map((r,o)=>{let a=new Lu(r,[[0,1],[1,2],[0,2]][o]??[0,1],e,t,i,s),l=["sensor","quantity","hidden","wireframes","hideIgnored","marks","window","selected"];return s.on(["sample",...l],()=>a.update()),a})}function wR(n,e,t,i){let{data:s,store:r}=t,o=(u,...d)=>Y("section",{"aria-label":u},Y("h2",{},u),...d),a=new dd(s,r,e),l=new hd(s,r,e),c=new fd(s,r,e),h=Y("details",{},Y("summary",{},"Origin of the data"),Y("ul",{class:"entries"},...s.scene.provenance.map(u=>Y("li",{},u))));n.side.append(...Wm(s),o("Series",Ry(s,r),a.root),o("Error in view",l.root),o("Shown",Py(s,r)),...Dy(s,r,e,t.robot.skin.metresPer),o("Saved samples",Gg(s,r,i),n.status),c.root,qm(s,r),Xm(s,r),Oy(t,i),h)}function TR(n,{data:e,store:t,space:i},s){let{force:r,moment:o}=s.wrenches.metresPer,a=l=>String(Number((.1/l).toPrecision(2)));t.on(["sensor","quantity","hidden","errorOnRobot"],()=>{let{quantity:l,errorOnRobot:c}=t.state,{metresPer:h,fullColour:u}=s.error,d=c&&h!==null&&u!==null,f=d?Number(u.toPrecision(2)):0,m=d?`; of error: ${a(h)} ${vi[l]}; limb red at ${f} ${vi[l]}`:"";n.scale.textContent=`0.1 m of arrow: ${a(r)} N, ${a(o)} N m${m}`}),t.on(["sample","sensor","quantity"],()=>{let{sample:l,sensor:c,quantity:h}=t.state,u=`sample ${l}, ${(e.time[l]??0).toFixed(3)} s`;s.canvas.setAttribute("aria-label",`Robot ${e.scene.robot.name} in its posture at ${u}`);let d=e.sensor(c)?.name??"no sensor";i.canvas.setAttribute("aria-label",`${h==="force"?"Force":"Torque"} space of ${d} at ${u}`)})}})();
