"use strict";(()=>{var Zf={expected:{word:"expected",colours:["#000000","#ffffff"],dash:[]},prior:{word:"prior",colours:["#747b85","#9aa3af"],dash:[4,2]},"calibration-1":{word:"calibration",colours:["#0072B2","#56b4e9"],dash:[]},"calibration-2":{word:"second calibration",colours:["#D55E00","#f08a3c"],dash:[6,2]},"calibration-3":{word:"third calibration",colours:["#009E73","#2fc79b"],dash:[6,2,1,2]},"calibration-4":{word:"fourth calibration",colours:["#CC79A7","#e3a0c6"],dash:[2,1.5]},"calibration-5":{word:"fifth calibration",colours:["#665200","#ffc04d"],dash:[6,2,1,2,1,2]},"calibration-6":{word:"sixth calibration",colours:["#5b2a86","#b7a3e3"],dash:[1,1]},contact:{word:"contact",colours:["#7a4a00","#d9a25f"],dash:[]},limit:{word:"limit",colours:["#c1121f","#ff6b6b"],dash:[4,3]},finding:{word:"finding",colours:["#b04a00","#ff9d5c"],dash:[]},skin:{word:"contact on skin",colours:["#882255","#e08bb4"],dash:[]},heuristic:{word:"heuristic contact",colours:["#5b6472","#a9b2c0"],dash:[1,2]},"axis-x":{word:"x",colours:["#d0312d","#ff7b72"],dash:[]},"axis-y":{word:"y",colours:["#2a8a3c","#5fd075"],dash:[]},"axis-z":{word:"z",colours:["#2b5fd0","#82aaff"],dash:[]},"use-calibration":{word:"calibration",colours:["#3a8fc4","#3d8fc0"],dash:[]},"use-validation":{word:"validation",colours:["#009e73","#1f9c78"],dash:[]},"use-ignore":{word:"ignored",colours:["#8a8f98","#7d838d"],dash:[]},"tone-good":{word:"use",colours:["#00654a","#4ed1a5"],dash:[]},"tone-caution":{word:"caution",colours:["#8a5a00","#f0b64a"],dash:[]},"tone-bad":{word:"refuse",colours:["#a33c00","#ff8f5c"],dash:[]},"tone-unknown":{word:"unknown",colours:["#4b5560","#aab3be"],dash:[]}},ag={ink:["#1f2430","#e8ebf0"],muted:["#59606c","#a4acb9"],line:["#d8dce3","#3a4150"],border:["#7b8390","#7d8694"],guide:["#c9ced6","#4a5263"],grid:["#e9ecf1","#2a303c"],ground:["#f4f6f8","#12151b"],panel:["#ffffff","#1b1f27"],hover:["#eef3f7","#2a313d"],chosen:["#dcecf6","#1d3a52"],accent:["#0069a6","#5cb8f0"],"on-accent":["#ffffff","#0c1218"],link:["#005c91","#7cc7f5"],note:["#fff7e0","#3a3115"],"note-border":["#b87f00","#a8842a"],shadow:["#00000033","#000000aa"],sky:["#ffffff","#ffffff"],earth:["#b9bec8","#9aa1ad"]},Mo=["#f3efe6","#f2c14e","#d1495b","#3b0f70"];var Ba=matchMedia("(prefers-color-scheme: dark)").matches;document.documentElement.dataset.ground=Ba?"dark":"light";var xi=n=>Zf[n].colours[Ba?1:0],fr=n=>ag[n][Ba?1:0],Yt=fr("ink"),vs=fr("muted"),kr=fr("guide"),Br=fr("grid"),Xn=fr("panel"),[Jf,lg]=[fr("sky"),fr("earth")],cg=fr("accent"),_c=xi("finding"),za=xi("limit"),hg=xi("expected"),xc=[xi("axis-x"),xi("axis-y"),xi("axis-z")],Sc=xi("contact"),bc=xi("skin"),wo=xi("heuristic"),zr={calibration:xi("use-calibration"),validation:xi("use-validation"),ignore:xi("use-ignore")},Kf=["calibration-1","calibration-2","calibration-3","calibration-4","calibration-5","calibration-6"];function ug(n,e){if(e.role==="expected")return"expected";if(!e.calibrated)return"prior";let t=n.wrenches.filter(i=>i.calibrated).indexOf(e);return Kf[t%Kf.length]??Kf[0]}function ii(n,e){return xi(ug(n,e))}function fg(n,e){return Zf[ug(n,e)].dash}function si(n,e){return n+Math.round(e*255).toString(16).padStart(2,"0")}function Fs(n){let e={begin:0,point:1,end:2};return[...n].sort((t,i)=>t.sample-i.sample||e[t.mark]-e[i.mark])}function Si(n,e){let t=[],i=new Set(n.scene.intervals.map(r=>r.label)),s=null;for(let r of Fs(e))if(r.mark==="begin")s=r;else if(r.mark==="end"&&s!==null){let o=oS(s.label||"marked",i),a={start_s:s.time_s,end_s:aS(n,r.sample),use:s.use},l={supportLines:lS(n,a),overlaps:cS(n,a)};t.push({begin:s,label:o,...a,...l}),s=null}return t}function dg(n){let e=[],t=null;for(let i of Fs(n))i.mark!=="point"&&(i.mark==="end"&&t===null&&e.push(i),i.mark==="begin"&&t!==null&&e.push(t),t=i.mark==="begin"?i:null);return t===null?e:[...e,t]}function pg(n,e){return[...n.scene.intervals,...Si(n,e)].filter(t=>t.use==="ignore")}function oS(n,e){let t=n;for(let i=2;e.has(t);i++)t=`${n} ${i}`;return e.add(t),t}function aS(n,e){let t=n.samples-1,[i,s]=n.span,r=t>0?(s-i)/t:1;return Math.min(e<t?n.time[e+1]??0:s+r,n.scene.end_s)}function lS(n,{start_s:e,end_s:t,use:i}){let{intervals:s}=n.scene;if(!s.every(o=>o.states_support))return[];let r=s.find(o=>o.support!==null&&o.start_s<=e&&t<=o.end_s+1e-9);return r?[`support = ${Va(r.support??"")}`]:i==="ignore"?[]:['# support = "..."  # state the link that stands still']}function cS(n,{start_s:e,end_s:t,use:i}){return n.scene.intervals.filter(s=>i!=="ignore"&&s.use!=="ignore").filter(s=>s.start_s<t-1e-9&&e<s.end_s-1e-9).map(s=>s.label)}function Va(n){return JSON.stringify(n).replaceAll("\x7F","\\u007f")}var Tc=[0,1,2,3],mg=1.96,Mc=64,dr={low:1/0,high:-1/0,sum:0,squares:0,count:0},jf=class n{constructor(e,t){this.samples=e;this.source=t;this.block=t.overview?.samples??Mc}samples;source;block;blocks=null;others=new Map;get isSummedUp(){return this.source.overview!==null}at(e){return this.source.need(e,e+1),this.source.value(e)}beside(e,t,i,s){let{need:r,value:o,overview:a}=this.source,l=s?.source,c=a&&(!l||l.overview)?a:null,h=this.others.get(e)??new n(this.samples,{need:(u,f)=>{r(u,f),l?.need(u,f)},value:u=>t(o(u),u,l?l.value(u):Number.NaN),overview:c&&{samples:c.samples,of:u=>{let f=c.of(u),d=l?l.overview?.of(u)??null:f;return!f||!d?null:f.count>0&&d.count>0?i(u,f,d):dr}}});return this.others.set(e,h),h}summary(e,t){let{block:i}=this,[s,r]=[Math.ceil(e/i),Math.floor(t/i)];if(r<=s)return this.scan(e,t,dr);let o=this.scan(e,s*i,dr);for(let a=s;a<r;a++)o=hS(o,this.ofBlock(a));return this.scan(r*i,t,o)}farthest(e,t){let i=null,s=-1,{block:r,source:o}=this,a=[];for(let l=e,c=e;l<t;l=c){c=Math.min(t,(Math.floor(l/r)+1)*r);let{low:h,high:u,count:f}=this.summary(l,c);f>0&&a.push({start:l,stop:c,reach:Math.max(-h,u)})}a.sort((l,c)=>c.reach-l.reach||l.start-c.start);for(let{start:l,stop:c,reach:h}of a){if(h<s)break;o.need(l,c);for(let u=l;u<c;u++){let f=Math.abs(o.value(u));(f>s||f===s&&i!==null&&u<i)&&([i,s]=[u,f])}}return i}ofBlock(e){let{overview:t}=this.source;return t?t.of(e)??this.scan(e*this.block,(e+1)*this.block,dr):(this.blocks??=Array.from({length:Math.floor(this.samples/Mc)},(i,s)=>this.scan(s*Mc,(s+1)*Mc,dr)),this.blocks[e]??dr)}scan(e,t,i){if(t<=e)return i;let{source:s}=this;s.need(e,t);let{low:r,high:o,sum:a,squares:l,count:c}=i;for(let h=e;h<t;h++){let u=s.value(h);Number.isNaN(u)||(u<r&&(r=u),u>o&&(o=u),a+=u,l+=u*u,c++)}return{low:r,high:o,sum:a,squares:l,count:c}}};function hS(n,e){return{low:Math.min(n.low,e.low),high:Math.max(n.high,e.high),sum:n.sum+e.sum,squares:n.squares+e.squares,count:n.count+e.count}}var wc=class{constructor(e){this.data=e}data;known=new Map;masks=new Map;forget(){this.known.clear(),this.masks.clear()}measured(e,t,i){return this.remembered(`measured ${e.values.offset} ${t} ${i}`,()=>({...this.components([e.values],t,i),overview:this.overview(e,e.overview?.wrench,t,i)}))}error(e,t,i,s){let r=Oi(e);return!r||t===r?null:this.remembered(`error ${t.values.offset} ${i} ${s}`,()=>{let{need:o,value:a}=this.components([t.values,r.values],i,s),l=this.inUse("ignore");return{need:o,value:c=>l[c]?NaN:a(c),overview:this.overview(t,t.overview?.error,i,s)}})}band(e,t,i){let{deviation:s,overview:r}=e;return s?this.remembered(`band ${s.offset} ${t} ${i}`,()=>{let{need:o,value:a}=this.components([s],t,i);return{need:o,value:l=>mg*a(l),overview:this.overview(e,r?.deviation,t,i,mg)}}):null}partOf(e,t){let i=this.inUse(t),{block:s}=e,r=new Uint32Array(Math.ceil(i.length/s));for(let o=0;o<i.length;o++)i[o]&&r[Math.floor(o/s)]++;return e.beside(t,(o,a)=>i[a]?o:NaN,(o,a)=>r[o]===s?a:r[o]===0?dr:null)}components(e,t,i){let{data:s}=this,[r,o]=e.map(a=>s.over(a,0,0));return{need:(a,l)=>{for(let c of e)s.over(c,a,l)},value:uS(r??new Float32Array,o??null,Ga[t],i)}}overview({overview:e},t,i,s,r=1){if(!e||!t)return null;let o=this.data.floats(t),a=t.shape[1]??0,l=(i==="force"?0:4)+s;return{samples:e.samples,of(c){let h=a*c+l,[u,f]=[r*(o[h]??NaN),r*(o[h+8]??NaN)];if(Number.isNaN(u))return dr;let[d,g,_]=a>16?[o[h+16],o[h+24],o[h+32]]:[];return{low:u,high:f,sum:d??NaN,squares:g??NaN,count:_??e.samples}}}}inUse(e){let t=this.masks.get(e);if(t)return t;let{data:i}=this,s=new Uint8Array(i.samples);for(let{use:r,start_s:o,end_s:a}of i.scene.intervals)r===e&&s.fill(1,i.firstAt(o),i.firstAt(a));return this.masks.set(e,s),s}remembered(e,t){let i=this.known.get(e);if(i)return i;let s=new jf(this.data.samples,t());return this.known.set(e,s),s}};function Oi(n){return n?.wrenches.find(e=>e.role==="expected")}function Ha(n,e){let t=n?.wrenches.filter(i=>i.role==="measured"&&!e.has(i.name))??[];return t.find(i=>i.calibrated)??t[0]}function uS(n,e,t,i){let s=r=>(n[r]??NaN)-(e===null?0:e[r]??NaN);return i!==3?r=>s(6*r+t+i):r=>{let o=6*r+t;return Math.hypot(s(o),s(o+1),s(o+2))}}var ki=Uint8Array,To=Uint16Array,fS=Int32Array,gg=new ki([0,0,0,0,0,0,0,0,1,1,1,1,2,2,2,2,3,3,3,3,4,4,4,4,5,5,5,5,0,0,0,0]),vg=new ki([0,0,0,0,1,1,2,2,3,3,4,4,5,5,6,6,7,7,8,8,9,9,10,10,11,11,12,12,13,13,0,0]),dS=new ki([16,17,18,0,8,7,9,6,10,5,11,4,12,3,13,2,14,1,15]),yg=function(n,e){for(var t=new To(31),i=0;i<31;++i)t[i]=e+=1<<n[i-1];for(var s=new fS(t[30]),i=1;i<30;++i)for(var r=t[i];r<t[i+1];++r)s[r]=r-t[i]<<5|i;return{b:t,r:s}},_g=yg(gg,2),xg=_g.b,pS=_g.r;xg[28]=258,pS[258]=28;var Sg=yg(vg,0),mS=Sg.b,A2=Sg.r,td=new To(32768);for(Rt=0;Rt<32768;++Rt)Os=(Rt&43690)>>1|(Rt&21845)<<1,Os=(Os&52428)>>2|(Os&13107)<<2,Os=(Os&61680)>>4|(Os&3855)<<4,td[Rt]=((Os&65280)>>8|(Os&255)<<8)>>1;var Os,Rt,Wa=(function(n,e,t){for(var i=n.length,s=0,r=new To(e);s<i;++s)n[s]&&++r[n[s]-1];var o=new To(e);for(s=1;s<e;++s)o[s]=o[s-1]+r[s-1]<<1;var a;if(t){a=new To(1<<e);var l=15-e;for(s=0;s<i;++s)if(n[s])for(var c=s<<4|n[s],h=e-n[s],u=o[n[s]-1]++<<h,f=u|(1<<h)-1;u<=f;++u)a[td[u]>>l]=c}else for(a=new To(i),s=0;s<i;++s)n[s]&&(a[s]=td[o[n[s]-1]++]>>15-n[s]);return a}),Xa=new ki(288);for(Rt=0;Rt<144;++Rt)Xa[Rt]=8;var Rt;for(Rt=144;Rt<256;++Rt)Xa[Rt]=9;var Rt;for(Rt=256;Rt<280;++Rt)Xa[Rt]=7;var Rt;for(Rt=280;Rt<288;++Rt)Xa[Rt]=8;var Rt,bg=new ki(32);for(Rt=0;Rt<32;++Rt)bg[Rt]=5;var Rt;var gS=Wa(Xa,9,1);var vS=Wa(bg,5,1),Qf=function(n){for(var e=n[0],t=1;t<n.length;++t)n[t]>e&&(e=n[t]);return e},$i=function(n,e,t){var i=e/8|0;return(n[i]|n[i+1]<<8)>>(e&7)&t},ed=function(n,e){var t=e/8|0;return(n[t]|n[t+1]<<8|n[t+2]<<16)>>(e&7)},yS=function(n){return(n+7)/8|0},_S=function(n,e,t){return(e==null||e<0)&&(e=0),(t==null||t>n.length)&&(t=n.length),new ki(n.subarray(e,t))};var xS=["unexpected EOF","invalid block type","invalid length/literal","invalid distance","stream finished","no stream handler",,"no callback","invalid UTF-8 data","extra field too long","date not in range 1980-2099","filename too long","stream finishing","invalid zip data"],ks=function(n,e,t){var i=new Error(e||xS[n]);if(i.code=n,Error.captureStackTrace&&Error.captureStackTrace(i,ks),!t)throw i;return i},SS=function(n,e,t,i){var s=n.length,r=i?i.length:0;if(!s||e.f&&!e.l)return t||new ki(0);var o=!t,a=o||e.i!=2,l=e.i;o&&(t=new ki(s*3));var c=function(He){var ut=t.length;if(He>ut){var ht=new ki(Math.max(ut*2,He));ht.set(t),t=ht}},h=e.f||0,u=e.p||0,f=e.b||0,d=e.l,g=e.d,_=e.m,m=e.n,p=s*8;do{if(!d){h=$i(n,u,1);var x=$i(n,u+1,3);if(u+=3,x)if(x==1)d=gS,g=vS,_=9,m=5;else if(x==2){var E=$i(n,u,31)+257,y=$i(n,u+10,15)+4,T=E+$i(n,u+5,31)+1;u+=14;for(var k=new ki(T),N=new ki(19),I=0;I<y;++I)N[dS[I]]=$i(n,u+I*3,7);u+=y*3;for(var z=Qf(N),W=(1<<z)-1,L=Wa(N,z,1),I=0;I<T;){var X=L[$i(n,u,W)];u+=X&15;var A=X>>4;if(A<16)k[I++]=A;else{var $=0,V=0;for(A==16?(V=3+$i(n,u,3),u+=2,$=k[I-1]):A==17?(V=3+$i(n,u,7),u+=3):A==18&&(V=11+$i(n,u,127),u+=7);V--;)k[I++]=$}}var ce=k.subarray(0,E),K=k.subarray(E);_=Qf(ce),m=Qf(K),d=Wa(ce,_,1),g=Wa(K,m,1)}else ks(1);else{var A=yS(u)+4,w=n[A-4]|n[A-3]<<8,P=A+w;if(P>s){l&&ks(0);break}a&&c(f+w),t.set(n.subarray(A,P),f),e.b=f+=w,e.p=u=P*8,e.f=h;continue}if(u>p){l&&ks(0);break}}a&&c(f+131072);for(var ee=(1<<_)-1,se=(1<<m)-1,de=u;;de=u){var $=d[ed(n,u)&ee],he=$>>4;if(u+=$&15,u>p){l&&ks(0);break}if($||ks(2),he<256)t[f++]=he;else if(he==256){de=u,d=null;break}else{var te=he-254;if(he>264){var I=he-257,me=gg[I];te=$i(n,u,(1<<me)-1)+xg[I],u+=me}var ve=g[ed(n,u)&se],Me=ve>>4;ve||ks(3),u+=ve&15;var K=mS[Me];if(Me>3){var me=vg[Me];K+=ed(n,u)&(1<<me)-1,u+=me}if(u>p){l&&ks(0);break}a&&c(f+131072);var xe=f+te;if(f<K){var We=r-K,ot=Math.min(K,xe);for(We+f<0&&ks(3);f<ot;++f)t[f]=i[We+f]}for(;f<xe;++f)t[f]=t[f-K]}}e.l=d,e.p=de,e.b=f,e.f=h,d&&(h=1,e.m=_,e.d=g,e.n=m)}while(!h);return f!=t.length&&o?_S(t,0,f):t.subarray(0,f)};var bS=new ki(0);function Mg(n,e){return SS(n,{i:2},e&&e.out,e&&e.dictionary)}var MS=typeof TextDecoder<"u"&&new TextDecoder,wS=0;try{MS.decode(bS,{stream:!0}),wS=1}catch{}var wg=65535,Tg=8,Eg=128,Ec=class{constructor(e,t,i,s){this.block=e;this.rows=i;this.columns=s;let[r=1,o=0]=new Uint32Array(e.read(t,t+8).buffer);this.rowsOfBlock=r,this.starts=new Uint32Array(e.read(t+8,t+8+4*(o+1)).buffer),this.isUnpacked=new Uint8Array(o);let a=t+TS(8+4*(o+1));this.first=a+8*s,this.steps=new Float64Array(e.read(a,this.first).buffer)}block;rows;columns;rowsOfBlock;isUnpacked;starts;steps;first;firstRow(e){return Float32Array.from(this.head(e),({begin:t,slope:i,step:s,twice:r,absent:o})=>o?Number.NaN:(r?t+i:t)*s)}unpack(e){let{columns:t}=this,i=this.head(e),s=Math.min(this.rowsOfBlock,this.rows-e*this.rowsOfBlock),r=this.block.read(this.first+(this.starts[e]??0)+10*t,this.first+(this.starts[e+1]??0)),o=Mg(r,{out:new Uint8Array(2*t*s)}),a=new Float32Array(t*s);return i.forEach(({begin:l,slope:c,step:h,twice:u},f)=>{let d=l,g=c,_=2*f*s;for(let m=0;m<s;m++){let p=(o[_+m]??0)+256*(o[_+s+m]??0),x=p===wg?0:p>>1^-(p&1);u?d+=g+=x:d+=x,a[m*t+f]=p===wg?Number.NaN:d*h}}),a}head(e){let{columns:t}=this,i=this.first+(this.starts[e]??0),s=this.block.read(i,i+10*t),r=new Int32Array(s.buffer,0,2*t);return Array.from({length:t},(o,a)=>{let l=s[9*t+a]??1;return{begin:r[a]??0,slope:r[t+a]??0,step:(this.steps[a]??0)*2**(s[8*t+a]??0),twice:l%Eg===2,absent:l>=Eg}})}};function TS(n){return Math.ceil(n/Tg)*Tg}var bi={force:"N",moment:"N m"},Ga={force:0,moment:3},Eo=class{constructor(e,t,i=new Map){this.scene=e;this.block=t;this.known=i;this.time=this.doubles(e.time_s)}scene;block;known;time;packed=new Map;columns=new wc(this);isOver=!1;get samples(){return this.scene.samples}floats(e){return this.over(e,0,e.shape[0]??0)}over(e,t,i){if(e.packed_bytes===null)return this.remembered(e,()=>new Float32Array(this.bytes(e,"float32",4)));let[s=0,r=1]=e.shape,o=this.remembered(e,()=>new Float32Array(s*r));if(!(i>t))return o;let a=this.packedArray(e),{rowsOfBlock:l}=a;for(let c=Math.floor(t/l);c*l<i;c++){if(a.isUnpacked[c])continue;a.isUnpacked[c]=1;let h=a.unpack(c),u=c*l,f=Math.min(s,u+l);e.base&&ES(h,e,this.over(e.base,u,f).subarray(u*r,f*r)),o.set(h,u*r)}return o}row(e,t){let i=e.shape[1]??1;if(e.packed_bytes!==null&&!e.base){let s=this.packedArray(e),r=t/s.rowsOfBlock;if(Number.isInteger(r)&&!s.isUnpacked[r])return s.firstRow(r)}return this.over(e,t,t+1).subarray(t*i,(t+1)*i)}keySample(e,t){let{positions:i}=this.scene;if(i.packed_bytes===null)return e;let s=this.packedArray(i).rowsOfBlock;return this.samples<t*s?e:e-e%s}packedArray(e){let t=this.packed.get(e.offset);if(t)return t;this.within(e.offset+(e.packed_bytes??0));let i=new Ec(this.block,e.offset,e.shape[0]??0,e.shape[1]??0);return this.packed.set(e.offset,i),i}doubles(e){return this.remembered(e,()=>new Float64Array(this.bytes(e,"float64",8)))}integers(e){return this.remembered(e,()=>new Uint32Array(this.bytes(e,"uint32",4)))}vector(e,t,i){let s=this.row(e.values,t),r=Ga[i];return[s[r]??Number.NaN,s[r+1]??Number.NaN,s[r+2]??Number.NaN]}peak(e,t){return"peak"in e?e.peak[t==="force"?0:1]??0:0}position(e,t){return this.row(this.scene.positions,e)[t]??Number.NaN}isLength(e){let t=this.scene.coordinates[e];return this.scene.robot.joints.some(i=>i.name===t&&i.type==="prismatic")}sensor(e){return this.scene.sensors[e]}sampleAt(e){let t=0,i=this.samples;for(;t<i;){let s=t+i>>1;(this.time[s]??0)<=e?t=s+1:i=s}return Math.max(0,t-1)}firstAt(e){let t=this.sampleAt(e);return(this.time[t]??e)<e?t+1:t}nearestSample(e){let t=this.sampleAt(e),i=Math.min(t+1,this.samples-1),s=Math.abs((this.time[i]??0)-e)<Math.abs((this.time[t]??0)-e);return Math.max(0,s?i:t)}get span(){return[this.time[0]??0,this.time[this.samples-1]??0]}remembered(e,t){if(e.shape.includes(0))return t();let i=this.known.get(e.offset)??t();return this.known.set(e.offset,i),i}bytes(e,t,i){if(e.dtype!==t)throw new Error(`expected an array of ${t}, got ${e.dtype}`);let s=e.offset+i*e.shape.reduce((r,o)=>r*o,1);return this.within(s),this.block.read(e.offset,s).buffer}within(e){let{byteLength:t}=this.block;if(e>t)throw new Error(`an array ends at byte ${e}, the data are ${t} bytes long`)}};function ES(n,e,t){let i=e.shape[1]??1,s=e.matrix??[];for(let r=0;r<n.length;r+=i)for(let o=0;o<i;o++){let a=n[r+o]??0;for(let l=0;l<i;l++)a+=(s[i*o+l]??0)*(t[r+l]??0);n[r+o]=a}}function Ag(n,e,t){let i=0;for(let a=0;a<n;a++)t(a)&&i++;let s=Math.max(1,Math.ceil(i/e)),r=new Uint32Array(Math.ceil(i/s)),o=0;for(let a=0;a<n;a++)t(a)&&(o%s===0&&(r[o/s]=a),o++);return r}var AS=4;function Cg(n,e,t,i,s){let r=i-t;if(r<=2*s){let f=Array.from({length:r},(d,g)=>t+g);return{x:f.map(d=>n[d]??0),y:e.map(d=>f.map(g=>CS(d.at(g))))}}let o=[],a=e.map(()=>[]),l=e.reduce((f,d)=>Math.max(f,d.isSummedUp?d.block:1),1),c=l>1&&r>=l*s/AS?l:1,h=Math.min(s,Math.floor(r/c)),u=f=>f===h?i:Math.max(t,c*Math.round((t+r*f/h)/c));for(let f=0;f<h;f++){let[d,g]=[f===0?t:u(f),u(f+1)];o.push(n[d]??0,n[d+g>>1]??0),e.forEach((_,m)=>{let{low:p,high:x,count:A}=_.summary(d,g);a[m]?.push(A?p:null,A?x:null)})}return{x:o,y:a}}function CS(n){return Number.isNaN(n)?null:n}function qa(n,e,t){if(!(e>n))return[n];let i=(e-n)/t,s=10**Math.floor(Math.log10(i)),r=[1,2,5,10].map(a=>a*s).find(a=>a>=i)??i,o=[];for(let a=Math.ceil(n/r-1e-9);a*r<=e+1e-9*r;a++)o.push(Number((a*r).toPrecision(12)));return o}var RS=2e4,PS=4,IS=3,Rg={samples:new Uint32Array,clouds:[],centre:[0,0,0],half:1},Ac=class{constructor(e){this.data=e}data;last={whole:{key:"",clouds:Rg},window:{key:"",clouds:Rg}};of(e){let{sensor:t,quantity:i,window:s}=e,r=e.hideIgnored?pg(this.data,e.marks):[],o=this.data.span,a=this.data.scene.live!==null&&e.playing,l=JSON.stringify([t,i,a?Math.floor(o[1]):o,r.map(h=>[h.start_s,h.end_s])]),c=this.remembered("whole",l,()=>{let h=Pg(this.data,t,i,r,o);return{...h,...LS(h.clouds)}});return a||s[0]<=o[0]&&s[1]>=o[1]?c:this.remembered("window",`${l} ${s.join(" ")}`,()=>({...Pg(this.data,t,i,r,s),centre:c.centre,half:c.half}))}remembered(e,t,i){return this.last[e].key!==t&&(this.last[e]={key:t,clouds:i()}),this.last[e].clouds}};function Pg(n,e,t,i,s){let r=new Uint8Array(n.samples).fill(1);r.fill(0,n.firstAt(s[0]),n.sampleAt(s[1])+1);for(let{start_s:_,end_s:m}of i)r.fill(1,n.firstAt(_),n.firstAt(m));let o=n.sensor(e),a=o?.wrenches??[],l=Math.floor(RS/Math.max(1,a.length)),c=r.reduce((_,m)=>_+1-m,0),h=a[0]?.overview?.every??1/0,f=PS*c>=h*Math.min(l,c)?h:1,d=Ag(Math.ceil(n.samples/f),l,_=>r[f*_]===0).map(_=>f*_),g=a.map(_=>({series:_,colour:o?ii(o,_):Yt,points:DS(n,_,d,f,Ga[t]),ellipsoid:t==="force"?_.ellipsoid_force:_.ellipsoid_moment,sphere:t==="force"?_.reference_force:_.reference_moment}));return{samples:d,clouds:g}}function DS(n,{values:e,overview:t},i,s,r){let o=new Float32Array(3*i.length),a=s>1&&t?n.floats(t.points):null;return i.forEach((l,c)=>{let h=a??n.over(e,l,l+1),u=6*(a?l/s:l)+r;o.set(h.subarray(u,u+3),3*c)}),o}function LS(n){let e=[0,1,2].map(o=>{let a=n.flatMap(({points:u})=>Array.from(u.filter((f,d)=>d%3===o&&!Number.isNaN(f)))),l=a.length>0?[NS(Float64Array.from(a).sort())]:[],c=n.flatMap(({sphere:u})=>u?[[u.centre[o]??0,u.radius]]:[]),h=[...l,...c.map(([u,f])=>[u-f,u+f])];return h.length>0?[Math.min(...h.map(([u])=>u)),Math.max(...h.map(([,u])=>u))]:[0,0]}),[t,i,s]=e.map(([o,a])=>(o+a)/2),r=Math.max(...e.map(([o,a])=>a-o));return{centre:[t??0,i??0,s??0],half:r>0?.55*r:1}}function NS(n){let e=o=>n[Math.round(o*(n.length-1))]??0,[t,i,s]=[e(.01),e(.5),e(.99)],r=IS*Math.max(s-i,i-t);return[Math.max(e(0),i-r),Math.min(e(1),i+r)]}function q(n,e={},...t){let i=document.createElement(n);for(let[s,r]of Object.entries(e))r!==!1&&r!==null&&i.setAttribute(s,r===!0?"":String(r));return i.append(...t),i}function Cc(n,e){n.textContent!==e&&(n.textContent=e)}function Ya(n){return q("span",{class:"spoken"},n)}function Pt(n,e,t={}){let i=q("button",{type:"button",...t},n);return i.addEventListener("click",e),i}function nd(n,e,t,i){let s=q("input",{type:"checkbox","aria-label":i??null});return s.checked=e,s.addEventListener("change",()=>t(s.checked)),{row:q("label",{class:"check"},s,...n),box:s}}function pr(n,e,t,i){let s=q("select",{"aria-label":n});for(let[r,o]of e)s.append(q("option",{value:r},o));return s.value=t,s.addEventListener("change",()=>i(s.value)),s}function Rc(n,e,t){let i=URL.createObjectURL(new Blob([e],{type:t})),s=q("a",{href:i,download:n});document.body.append(s),s.click(),s.remove(),setTimeout(()=>URL.revokeObjectURL(i),6e4)}function Pc(n,e){return`${n.replace(/[^\w.-]+/gu,"_").slice(0,80)||"experiment"}${e}`}var id=200;function sd(n){let e=[...n.scene.notes];if(n.samples===0&&!n.scene.live&&e.push("The scene has no samples."),e.length===0)return[];let t=q("ul",{tabindex:"0"},...e.map(s=>q("li",{},s))),i=e.length===1?"1 note":`${e.length} notes`;return[q("section",{class:"notes","aria-label":"Notes"},q("details",{open:!0},q("summary",{},i),t))]}function Ig(n,e){let t=n.scene.intervals.map(i=>{let s=q("span",{class:"chip"});s.style.background=zr[i.use];let r=Pt(i.label,()=>Lg(n,e,i.start_s),{class:"link"}),o=`${i.start_s.toFixed(1)}\u2013${i.end_s.toFixed(1)} s, ${i.use}`,a=i.support===null?"":`, on ${i.support}`;return q("li",{},s,r,q("span",{class:"muted"},o+a))});return Ng(`Intervals (${t.length})`,t,t.length>0?"":"The experiment names none.")}function Dg(n,e){let{findings:t}=n.scene,i=t.slice(0,id).map(s=>{let{start_s:r}=s,o=`${s.kind}${r===null?"":` at ${r.toFixed(2)} s`}`,a=r===null?q("b",{},o):Pt(o,()=>Lg(n,e,r),{class:"link"});return q("li",{},a,q("span",{class:"muted"},`${s.stream}: ${s.message}`))});return t.length>id&&i.push(q("li",{},`and ${t.length-id} more`)),Ng(`Findings (${t.length})`,i,t.length>0?"":"None.")}function Lg(n,e,t){e.set({sample:n.nearestSample(t),playing:!1})}function Ng(n,e,t){return q("details",{},q("summary",{},n),q("ul",{class:"entries",tabindex:"0"},...e),q("p",{class:"absent"},t))}var Ic=class{waiting=new Set;request=0;later(e){this.waiting.add(e),this.request===0&&(this.request=requestAnimationFrame(()=>this.flush()))}flush(){cancelAnimationFrame(this.request),this.request=0;let e=[...this.waiting];this.waiting.clear();for(let t of e)t.draw()}};var $a=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1];function Ao(n,e){let t=Array.from({length:16},()=>0);for(let i=0;i<4;i++)for(let s=0;s<4;s++){let r=0;for(let o=0;o<4;o++)r+=(n[4*i+o]??0)*(e[4*o+s]??0);t[4*i+s]=r}return t}function US(n,e){let t=n.row(n.scene.root,e),[i=0,s=0,r=0,o=1,a=0,l=0,c=0]=t;if(t.length<7||t.some(Number.isNaN))return $a;let h=2/(o*o+a*a+l*l+c*c);return[1-h*(l*l+c*c),h*(a*l-c*o),h*(a*c+l*o),i,h*(a*l+c*o),1-h*(a*a+c*c),h*(l*c-a*o),s,h*(a*c-l*o),h*(l*c+a*o),1-h*(a*a+l*l),r,0,0,0,1]}function FS(n,e,t){if(e.column===null)return e.offset;let i=n.position(t,e.column);return e.multiplier*(Number.isNaN(i)?0:i)+e.offset}function Za(n,e){let{robot:t}=n.scene,i=new Map([[t.root_link,US(n,e)]]);for(let s of t.joints){let r=i.get(s.parent);if(!r)throw new Error(`joint ${s.name}: link ${s.parent} comes after it`);let o=Ao(r,s.parent_H_child);i.set(s.child,s.type==="fixed"?o:Ao(o,OS(s,n,e)))}return i}function OS(n,e,t){let[i=0,s=0,r=1]=n.axis,o=FS(e,n,t);if(n.type==="prismatic")return[1,0,0,i*o,0,1,0,s*o,0,0,1,r*o,0,0,0,1];let a=Math.sin(o),l=2*Math.sin(o/2)**2;return[1-l*(s*s+r*r),l*i*s-a*r,l*i*r+a*s,0,l*i*s+a*r,1-l*(i*i+r*r),l*s*r-a*i,0,l*i*r-a*s,l*s*r+a*i,1-l*(i*i+s*s),0,0,0,0,1]}var md=(n,e,t)=>{if(!e.has(n))throw TypeError("Cannot "+t)},H=(n,e,t)=>(md(n,e,"read from private field"),t?t.call(n):e.get(n)),pt=(n,e,t)=>{if(e.has(n))throw TypeError("Cannot add the same private member more than once");e instanceof WeakSet?e.add(n):e.set(n,t)},zn=(n,e,t,i)=>(md(n,e,"write to private field"),i?i.call(n,t):e.set(n,t),t),kS=(n,e,t,i)=>({set _(s){zn(n,e,s,t)},get _(){return H(n,e,i)}}),St=(n,e,t)=>(md(n,e,"access private method"),t),Tt=new Uint8Array(8),Ss=new DataView(Tt.buffer),An=n=>[(n%256+256)%256],It=n=>(Ss.setUint16(0,n,!1),[Tt[0],Tt[1]]),BS=n=>(Ss.setInt16(0,n,!1),[Tt[0],Tt[1]]),Fg=n=>(Ss.setUint32(0,n,!1),[Tt[1],Tt[2],Tt[3]]),Oe=n=>(Ss.setUint32(0,n,!1),[Tt[0],Tt[1],Tt[2],Tt[3]]),zS=n=>(Ss.setInt32(0,n,!1),[Tt[0],Tt[1],Tt[2],Tt[3]]),qr=n=>(Ss.setUint32(0,Math.floor(n/2**32),!1),Ss.setUint32(4,n,!1),[Tt[0],Tt[1],Tt[2],Tt[3],Tt[4],Tt[5],Tt[6],Tt[7]]),gd=n=>(Ss.setInt16(0,2**8*n,!1),[Tt[0],Tt[1]]),_s=n=>(Ss.setInt32(0,2**16*n,!1),[Tt[0],Tt[1],Tt[2],Tt[3]]),rd=n=>(Ss.setInt32(0,2**30*n,!1),[Tt[0],Tt[1],Tt[2],Tt[3]]),Bi=(n,e=!1)=>{let t=Array(n.length).fill(null).map((i,s)=>n.charCodeAt(s));return e&&t.push(0),t},Oc=n=>n&&n[n.length-1],vd=n=>{let e;for(let t of n)(!e||t.presentationTimestamp>e.presentationTimestamp)&&(e=t);return e},xs=(n,e,t=!0)=>{let i=n*e;return t?Math.round(i):i},Og=n=>{let e=n*(Math.PI/180),t=Math.cos(e),i=Math.sin(e);return[t,i,0,-i,t,0,0,0,1]},kg=Og(0),Bg=n=>[_s(n[0]),_s(n[1]),rd(n[2]),_s(n[3]),_s(n[4]),rd(n[5]),_s(n[6]),_s(n[7]),rd(n[8])],ja=n=>!n||typeof n!="object"?n:Array.isArray(n)?n.map(ja):Object.fromEntries(Object.entries(n).map(([e,t])=>[e,ja(t)])),Io=n=>n>=0&&n<2**32,bn=(n,e,t)=>({type:n,contents:e&&new Uint8Array(e.flat(10)),children:t}),Qt=(n,e,t,i,s)=>bn(n,[An(e),Fg(t),i??[]],s),VS=n=>{let e=512;return n.fragmented?bn("ftyp",[Bi("iso5"),Oe(e),Bi("iso5"),Bi("iso6"),Bi("mp41")]):bn("ftyp",[Bi("isom"),Oe(e),Bi("isom"),n.holdsAvc?Bi("avc1"):[],Bi("mp41")])},od=n=>({type:"mdat",largeSize:n}),HS=n=>({type:"free",size:n}),Dc=(n,e,t=!1)=>bn("moov",null,[GS(e,n),...n.map(i=>WS(i,e)),t?Sb(n):null]),GS=(n,e)=>{let t=xs(Math.max(0,...e.filter(o=>o.samples.length>0).map(o=>{let a=vd(o.samples);return a.presentationTimestamp+a.duration})),cd),i=Math.max(...e.map(o=>o.id))+1,s=!Io(n)||!Io(t),r=s?qr:Oe;return Qt("mvhd",+s,0,[r(n),r(n),Oe(cd),r(t),_s(1),gd(1),Array(10).fill(0),Bg(kg),Array(24).fill(0),Oe(i)])},WS=(n,e)=>bn("trak",null,[XS(n,e),qS(n,e)]),XS=(n,e)=>{let t=vd(n.samples),i=xs(t?t.presentationTimestamp+t.duration:0,cd),s=!Io(e)||!Io(i),r=s?qr:Oe,o;return n.info.type==="video"?o=typeof n.info.rotation=="number"?Og(n.info.rotation):n.info.rotation:o=kg,Qt("tkhd",+s,3,[r(e),r(e),Oe(n.id),Oe(0),r(i),Array(8).fill(0),It(0),It(0),gd(n.info.type==="audio"?1:0),It(0),Bg(o),_s(n.info.type==="video"?n.info.width:0),_s(n.info.type==="video"?n.info.height:0)])},qS=(n,e)=>bn("mdia",null,[YS(n,e),$S(n.info.type==="video"?"vide":"soun"),ZS(n)]),YS=(n,e)=>{let t=vd(n.samples),i=xs(t?t.presentationTimestamp+t.duration:0,n.timescale),s=!Io(e)||!Io(i),r=s?qr:Oe;return Qt("mdhd",+s,0,[r(e),r(e),Oe(n.timescale),r(i),It(21956),It(0)])},$S=n=>Qt("hdlr",0,0,[Bi("mhlr"),Bi(n),Oe(0),Oe(0),Oe(0),Bi("mp4-muxer-hdlr",!0)]),ZS=n=>bn("minf",null,[n.info.type==="video"?KS():JS(),jS(),tb(n)]),KS=()=>Qt("vmhd",0,1,[It(0),It(0),It(0),It(0)]),JS=()=>Qt("smhd",0,0,[It(0),It(0)]),jS=()=>bn("dinf",null,[QS()]),QS=()=>Qt("dref",0,0,[Oe(1)],[eb()]),eb=()=>Qt("url ",0,1),tb=n=>{let e=n.compositionTimeOffsetTable.length>1||n.compositionTimeOffsetTable.some(t=>t.sampleCompositionTimeOffset!==0);return bn("stbl",null,[nb(n),mb(n),gb(n),vb(n),yb(n),_b(n),e?xb(n):null])},nb=n=>Qt("stsd",0,0,[Oe(1)],[n.info.type==="video"?ib(Ib[n.info.codec],n):fb(Lb[n.info.codec],n)]),ib=(n,e)=>bn(n,[Array(6).fill(0),It(1),It(0),It(0),Array(12).fill(0),It(e.info.width),It(e.info.height),Oe(4718592),Oe(4718592),Oe(0),It(1),Array(32).fill(0),It(24),BS(65535)],[Db[e.info.codec](e),e.info.decoderConfig.colorSpace?ab(e):null]),sb={bt709:1,bt470bg:5,smpte170m:6},rb={bt709:1,smpte170m:6,"iec61966-2-1":13},ob={rgb:0,bt709:1,bt470bg:5,smpte170m:6},ab=n=>bn("colr",[Bi("nclx"),It(sb[n.info.decoderConfig.colorSpace.primaries]),It(rb[n.info.decoderConfig.colorSpace.transfer]),It(ob[n.info.decoderConfig.colorSpace.matrix]),An((n.info.decoderConfig.colorSpace.fullRange?1:0)<<7)]),lb=n=>n.info.decoderConfig&&bn("avcC",[...new Uint8Array(n.info.decoderConfig.description)]),cb=n=>n.info.decoderConfig&&bn("hvcC",[...new Uint8Array(n.info.decoderConfig.description)]),hb=n=>{if(!n.info.decoderConfig)return null;let e=n.info.decoderConfig;if(!e.colorSpace)throw new Error("'colorSpace' is required in the decoder config for VP9.");let t=e.codec.split("."),i=Number(t[1]),s=Number(t[2]),a=(Number(t[3])<<4)+(0<<1)+Number(e.colorSpace.fullRange);return Qt("vpcC",1,0,[An(i),An(s),An(a),An(2),An(2),An(2),It(0)])},ub=()=>{let t=(1<<7)+1;return bn("av1C",[t,0,0,0])},fb=(n,e)=>bn(n,[Array(6).fill(0),It(1),It(0),It(0),Oe(0),It(e.info.numberOfChannels),It(16),It(0),It(0),_s(e.info.sampleRate)],[Nb[e.info.codec](e)]),db=n=>{let e=new Uint8Array(n.info.decoderConfig.description);return Qt("esds",0,0,[Oe(58753152),An(32+e.byteLength),It(1),An(0),Oe(75530368),An(18+e.byteLength),An(64),An(21),Fg(0),Oe(130071),Oe(130071),Oe(92307584),An(e.byteLength),...e,Oe(109084800),An(1),An(2)])},pb=n=>{let e=3840,t=0,i=n.info.decoderConfig?.description;if(i){if(i.byteLength<18)throw new TypeError("Invalid decoder description provided for Opus; must be at least 18 bytes long.");let s=ArrayBuffer.isView(i)?new DataView(i.buffer,i.byteOffset,i.byteLength):new DataView(i);e=s.getUint16(10,!0),t=s.getInt16(14,!0)}return bn("dOps",[An(0),An(n.info.numberOfChannels),It(e),Oe(n.info.sampleRate),gd(t),An(0)])},mb=n=>Qt("stts",0,0,[Oe(n.timeToSampleTable.length),n.timeToSampleTable.map(e=>[Oe(e.sampleCount),Oe(e.sampleDelta)])]),gb=n=>{if(n.samples.every(t=>t.type==="key"))return null;let e=[...n.samples.entries()].filter(([,t])=>t.type==="key");return Qt("stss",0,0,[Oe(e.length),e.map(([t])=>Oe(t+1))])},vb=n=>Qt("stsc",0,0,[Oe(n.compactlyCodedChunkTable.length),n.compactlyCodedChunkTable.map(e=>[Oe(e.firstChunk),Oe(e.samplesPerChunk),Oe(1)])]),yb=n=>Qt("stsz",0,0,[Oe(0),Oe(n.samples.length),n.samples.map(e=>Oe(e.size))]),_b=n=>n.finalizedChunks.length>0&&Oc(n.finalizedChunks).offset>=2**32?Qt("co64",0,0,[Oe(n.finalizedChunks.length),n.finalizedChunks.map(e=>qr(e.offset))]):Qt("stco",0,0,[Oe(n.finalizedChunks.length),n.finalizedChunks.map(e=>Oe(e.offset))]),xb=n=>Qt("ctts",0,0,[Oe(n.compositionTimeOffsetTable.length),n.compositionTimeOffsetTable.map(e=>[Oe(e.sampleCount),Oe(e.sampleCompositionTimeOffset)])]),Sb=n=>bn("mvex",null,n.map(bb)),bb=n=>Qt("trex",0,0,[Oe(n.id),Oe(1),Oe(0),Oe(0),Oe(0)]),Ug=(n,e)=>bn("moof",null,[Mb(n),...e.map(wb)]),Mb=n=>Qt("mfhd",0,0,[Oe(n)]),zg=n=>{let e=0,t=0,i=0,s=0,r=n.type==="delta";return t|=+r,r?e|=1:e|=2,e<<24|t<<16|i<<8|s},wb=n=>bn("traf",null,[Tb(n),Eb(n),Ab(n)]),Tb=n=>{let e=0;e|=8,e|=16,e|=32,e|=131072;let t=n.currentChunk.samples[1]??n.currentChunk.samples[0],i={duration:t.timescaleUnitsToNextSample,size:t.size,flags:zg(t)};return Qt("tfhd",0,e,[Oe(n.id),Oe(i.duration),Oe(i.size),Oe(i.flags)])},Eb=n=>Qt("tfdt",1,0,[qr(xs(n.currentChunk.startTimestamp,n.timescale))]),Ab=n=>{let e=n.currentChunk.samples.map(_=>_.timescaleUnitsToNextSample),t=n.currentChunk.samples.map(_=>_.size),i=n.currentChunk.samples.map(zg),s=n.currentChunk.samples.map(_=>xs(_.presentationTimestamp-_.decodeTimestamp,n.timescale)),r=new Set(e),o=new Set(t),a=new Set(i),l=new Set(s),c=a.size===2&&i[0]!==i[1],h=r.size>1,u=o.size>1,f=!c&&a.size>1,d=l.size>1||[...l].some(_=>_!==0),g=0;return g|=1,g|=4*+c,g|=256*+h,g|=512*+u,g|=1024*+f,g|=2048*+d,Qt("trun",1,g,[Oe(n.currentChunk.samples.length),Oe(n.currentChunk.offset-n.currentChunk.moofOffset||0),c?Oe(i[0]):[],n.currentChunk.samples.map((_,m)=>[h?Oe(e[m]):[],u?Oe(t[m]):[],f?Oe(i[m]):[],d?zS(s[m]):[]])])},Cb=n=>bn("mfra",null,[...n.map(Rb),Pb()]),Rb=(n,e)=>Qt("tfra",1,0,[Oe(n.id),Oe(63),Oe(n.finalizedChunks.length),n.finalizedChunks.map(i=>[qr(xs(i.startTimestamp,n.timescale)),qr(i.moofOffset),Oe(e+1),Oe(1),Oe(1)])]),Pb=()=>Qt("mfro",0,0,[Oe(0)]),Ib={avc:"avc1",hevc:"hvc1",vp9:"vp09",av1:"av01"},Db={avc:lb,hevc:cb,vp9:hb,av1:ub},Lb={aac:"mp4a",opus:"Opus"},Nb={aac:db,opus:pb};var Gc=class{},yd=class extends Gc{constructor(){super(...arguments),this.buffer=null}},Vg=class extends Gc{constructor(n){if(super(),this.options=n,typeof n!="object")throw new TypeError("StreamTarget requires an options object to be passed to its constructor.");if(n.onData){if(typeof n.onData!="function")throw new TypeError("options.onData, when provided, must be a function.");if(n.onData.length<2)throw new TypeError("options.onData, when provided, must be a function that takes in at least two arguments (data and position). Ignoring the position argument, which specifies the byte offset at which the data is to be written, can lead to broken outputs.")}if(n.chunked!==void 0&&typeof n.chunked!="boolean")throw new TypeError("options.chunked, when provided, must be a boolean.");if(n.chunkSize!==void 0&&(!Number.isInteger(n.chunkSize)||n.chunkSize<1024))throw new TypeError("options.chunkSize, when provided, must be an integer and not smaller than 1024.")}},Ub=class extends Gc{constructor(n,e){if(super(),this.stream=n,this.options=e,!(n instanceof FileSystemWritableFileStream))throw new TypeError("FileSystemWritableFileStreamTarget requires a FileSystemWritableFileStream instance.");if(e!==void 0&&typeof e!="object")throw new TypeError("FileSystemWritableFileStreamTarget's options, when provided, must be an object.");if(e&&e.chunkSize!==void 0&&(!Number.isInteger(e.chunkSize)||e.chunkSize<=0))throw new TypeError("options.chunkSize, when provided, must be a positive integer")}},Vr,Co,Hg=class{constructor(){this.pos=0,pt(this,Vr,new Uint8Array(8)),pt(this,Co,new DataView(H(this,Vr).buffer)),this.offsets=new WeakMap}seek(n){this.pos=n}writeU32(n){H(this,Co).setUint32(0,n,!1),this.write(H(this,Vr).subarray(0,4))}writeU64(n){H(this,Co).setUint32(0,Math.floor(n/2**32),!1),H(this,Co).setUint32(4,n,!1),this.write(H(this,Vr).subarray(0,8))}writeAscii(n){for(let e=0;e<n.length;e++)H(this,Co).setUint8(e%8,n.charCodeAt(e)),e%8===7&&this.write(H(this,Vr));n.length%8!==0&&this.write(H(this,Vr).subarray(0,n.length%8))}writeBox(n){if(this.offsets.set(n,this.pos),n.contents&&!n.children)this.writeBoxHeader(n,n.size??n.contents.byteLength+8),this.write(n.contents);else{let e=this.pos;if(this.writeBoxHeader(n,0),n.contents&&this.write(n.contents),n.children)for(let s of n.children)s&&this.writeBox(s);let t=this.pos,i=n.size??t-e;this.seek(e),this.writeBoxHeader(n,i),this.seek(t)}}writeBoxHeader(n,e){this.writeU32(n.largeSize?1:e),this.writeAscii(n.type),n.largeSize&&this.writeU64(e)}measureBoxHeader(n){return 8+(n.largeSize?8:0)}patchBox(n){let e=this.pos;this.seek(this.offsets.get(n)),this.writeBox(n),this.seek(e)}measureBox(n){if(n.contents&&!n.children)return this.measureBoxHeader(n)+n.contents.byteLength;{let e=this.measureBoxHeader(n);if(n.contents&&(e+=n.contents.byteLength),n.children)for(let t of n.children)t&&(e+=this.measureBox(t));return e}}};Vr=new WeakMap;Co=new WeakMap;var Lc,Xr,il,Ka,Nc,ad,Fb=class extends Hg{constructor(n){super(),pt(this,Nc),pt(this,Lc,void 0),pt(this,Xr,new ArrayBuffer(2**16)),pt(this,il,new Uint8Array(H(this,Xr))),pt(this,Ka,0),zn(this,Lc,n)}write(n){St(this,Nc,ad).call(this,this.pos+n.byteLength),H(this,il).set(n,this.pos),this.pos+=n.byteLength,zn(this,Ka,Math.max(H(this,Ka),this.pos))}finalize(){St(this,Nc,ad).call(this,this.pos),H(this,Lc).buffer=H(this,Xr).slice(0,Math.max(H(this,Ka),this.pos))}};Lc=new WeakMap;Xr=new WeakMap;il=new WeakMap;Ka=new WeakMap;Nc=new WeakSet;ad=function(n){let e=H(this,Xr).byteLength;for(;e<n;)e*=2;if(e===H(this,Xr).byteLength)return;let t=new ArrayBuffer(e),i=new Uint8Array(t);i.set(H(this,il),0),zn(this,Xr,t),zn(this,il,i)};var Ob=2**24,kb=2,Qa,Hr,Ja,zs,wi,kc,ld,_d,Gg,xd,Wg,el,Bc,Sd=class extends Hg{constructor(n){super(),pt(this,kc),pt(this,_d),pt(this,xd),pt(this,el),pt(this,Qa,void 0),pt(this,Hr,[]),pt(this,Ja,void 0),pt(this,zs,void 0),pt(this,wi,[]),zn(this,Qa,n),zn(this,Ja,n.options?.chunked??!1),zn(this,zs,n.options?.chunkSize??Ob)}write(n){H(this,Hr).push({data:n.slice(),start:this.pos}),this.pos+=n.byteLength}flush(){if(H(this,Hr).length===0)return;let n=[],e=[...H(this,Hr)].sort((t,i)=>t.start-i.start);n.push({start:e[0].start,size:e[0].data.byteLength});for(let t=1;t<e.length;t++){let i=n[n.length-1],s=e[t];s.start<=i.start+i.size?i.size=Math.max(i.size,s.start+s.data.byteLength-i.start):n.push({start:s.start,size:s.data.byteLength})}for(let t of n){t.data=new Uint8Array(t.size);for(let i of H(this,Hr))t.start<=i.start&&i.start<t.start+t.size&&t.data.set(i.data,i.start-t.start);H(this,Ja)?(St(this,kc,ld).call(this,t.data,t.start),St(this,el,Bc).call(this)):H(this,Qa).options.onData?.(t.data,t.start)}H(this,Hr).length=0}finalize(){H(this,Ja)&&St(this,el,Bc).call(this,!0)}};Qa=new WeakMap;Hr=new WeakMap;Ja=new WeakMap;zs=new WeakMap;wi=new WeakMap;kc=new WeakSet;ld=function(n,e){let t=H(this,wi).findIndex(a=>a.start<=e&&e<a.start+H(this,zs));t===-1&&(t=St(this,xd,Wg).call(this,e));let i=H(this,wi)[t],s=e-i.start,r=n.subarray(0,Math.min(H(this,zs)-s,n.byteLength));i.data.set(r,s);let o={start:s,end:s+r.byteLength};if(St(this,_d,Gg).call(this,i,o),i.written[0].start===0&&i.written[0].end===H(this,zs)&&(i.shouldFlush=!0),H(this,wi).length>kb){for(let a=0;a<H(this,wi).length-1;a++)H(this,wi)[a].shouldFlush=!0;St(this,el,Bc).call(this)}r.byteLength<n.byteLength&&St(this,kc,ld).call(this,n.subarray(r.byteLength),e+r.byteLength)};_d=new WeakSet;Gg=function(n,e){let t=0,i=n.written.length-1,s=-1;for(;t<=i;){let r=Math.floor(t+(i-t+1)/2);n.written[r].start<=e.start?(t=r+1,s=r):i=r-1}for(n.written.splice(s+1,0,e),(s===-1||n.written[s].end<e.start)&&s++;s<n.written.length-1&&n.written[s].end>=n.written[s+1].start;)n.written[s].end=Math.max(n.written[s].end,n.written[s+1].end),n.written.splice(s+1,1)};xd=new WeakSet;Wg=function(n){let t={start:Math.floor(n/H(this,zs))*H(this,zs),data:new Uint8Array(H(this,zs)),written:[],shouldFlush:!1};return H(this,wi).push(t),H(this,wi).sort((i,s)=>i.start-s.start),H(this,wi).indexOf(t)};el=new WeakSet;Bc=function(n=!1){for(let e=0;e<H(this,wi).length;e++){let t=H(this,wi)[e];if(!(!t.shouldFlush&&!n)){for(let i of t.written)H(this,Qa).options.onData?.(t.data.subarray(i.start,i.end),t.start+i.start);H(this,wi).splice(e--,1)}}};var Bb=class extends Sd{constructor(n){super(new Vg({onData:(e,t)=>n.stream.write({type:"write",data:e,position:t}),chunked:!0,chunkSize:n.options?.chunkSize}))}},cd=1e3,zb=["avc","hevc","vp9","av1"],Vb=["aac","opus"],Hb=2082844800,Gb=["strict","offset","cross-track-offset"],Ye,it,zc,Mi,qn,Bn,Ro,Po,bd,Gr,Wr,tl,hd,Xg,ud,qg,Md,Yg,fd,$g,wd,Zg,Uc,dd,ys,Bs,Td,Kg,nl,Vc,Hc,Ed,Do,sl,Fc,pd,Jg=class{constructor(n){if(pt(this,hd),pt(this,ud),pt(this,Md),pt(this,fd),pt(this,wd),pt(this,Uc),pt(this,ys),pt(this,Td),pt(this,nl),pt(this,Hc),pt(this,Do),pt(this,Fc),pt(this,Ye,void 0),pt(this,it,void 0),pt(this,zc,void 0),pt(this,Mi,void 0),pt(this,qn,null),pt(this,Bn,null),pt(this,Ro,Math.floor(Date.now()/1e3)+Hb),pt(this,Po,[]),pt(this,bd,1),pt(this,Gr,[]),pt(this,Wr,[]),pt(this,tl,!1),St(this,hd,Xg).call(this,n),n.video=ja(n.video),n.audio=ja(n.audio),n.fastStart=ja(n.fastStart),this.target=n.target,zn(this,Ye,{firstTimestampBehavior:"strict",...n}),n.target instanceof yd)zn(this,it,new Fb(n.target));else if(n.target instanceof Vg)zn(this,it,new Sd(n.target));else if(n.target instanceof Ub)zn(this,it,new Bb(n.target));else throw new Error(`Invalid target: ${n.target}`);St(this,fd,$g).call(this),St(this,ud,qg).call(this)}addVideoChunk(n,e,t,i){if(!(n instanceof EncodedVideoChunk))throw new TypeError("addVideoChunk's first argument (sample) must be of type EncodedVideoChunk.");if(e&&typeof e!="object")throw new TypeError("addVideoChunk's second argument (meta), when provided, must be an object.");if(t!==void 0&&(!Number.isFinite(t)||t<0))throw new TypeError("addVideoChunk's third argument (timestamp), when provided, must be a non-negative real number.");if(i!==void 0&&!Number.isFinite(i))throw new TypeError("addVideoChunk's fourth argument (compositionTimeOffset), when provided, must be a real number.");let s=new Uint8Array(n.byteLength);n.copyTo(s),this.addVideoChunkRaw(s,n.type,t??n.timestamp,n.duration,e,i)}addVideoChunkRaw(n,e,t,i,s,r){if(!(n instanceof Uint8Array))throw new TypeError("addVideoChunkRaw's first argument (data) must be an instance of Uint8Array.");if(e!=="key"&&e!=="delta")throw new TypeError("addVideoChunkRaw's second argument (type) must be either 'key' or 'delta'.");if(!Number.isFinite(t)||t<0)throw new TypeError("addVideoChunkRaw's third argument (timestamp) must be a non-negative real number.");if(!Number.isFinite(i)||i<0)throw new TypeError("addVideoChunkRaw's fourth argument (duration) must be a non-negative real number.");if(s&&typeof s!="object")throw new TypeError("addVideoChunkRaw's fifth argument (meta), when provided, must be an object.");if(r!==void 0&&!Number.isFinite(r))throw new TypeError("addVideoChunkRaw's sixth argument (compositionTimeOffset), when provided, must be a real number.");if(St(this,Fc,pd).call(this),!H(this,Ye).video)throw new Error("No video track declared.");if(typeof H(this,Ye).fastStart=="object"&&H(this,qn).samples.length===H(this,Ye).fastStart.expectedVideoChunks)throw new Error(`Cannot add more video chunks than specified in 'fastStart' (${H(this,Ye).fastStart.expectedVideoChunks}).`);let o=St(this,Uc,dd).call(this,H(this,qn),n,e,t,i,s,r);if(H(this,Ye).fastStart==="fragmented"&&H(this,Bn)){for(;H(this,Wr).length>0&&H(this,Wr)[0].decodeTimestamp<=o.decodeTimestamp;){let a=H(this,Wr).shift();St(this,ys,Bs).call(this,H(this,Bn),a)}o.decodeTimestamp<=H(this,Bn).lastDecodeTimestamp?St(this,ys,Bs).call(this,H(this,qn),o):H(this,Gr).push(o)}else St(this,ys,Bs).call(this,H(this,qn),o)}addAudioChunk(n,e,t){if(!(n instanceof EncodedAudioChunk))throw new TypeError("addAudioChunk's first argument (sample) must be of type EncodedAudioChunk.");if(e&&typeof e!="object")throw new TypeError("addAudioChunk's second argument (meta), when provided, must be an object.");if(t!==void 0&&(!Number.isFinite(t)||t<0))throw new TypeError("addAudioChunk's third argument (timestamp), when provided, must be a non-negative real number.");let i=new Uint8Array(n.byteLength);n.copyTo(i),this.addAudioChunkRaw(i,n.type,t??n.timestamp,n.duration,e)}addAudioChunkRaw(n,e,t,i,s){if(!(n instanceof Uint8Array))throw new TypeError("addAudioChunkRaw's first argument (data) must be an instance of Uint8Array.");if(e!=="key"&&e!=="delta")throw new TypeError("addAudioChunkRaw's second argument (type) must be either 'key' or 'delta'.");if(!Number.isFinite(t)||t<0)throw new TypeError("addAudioChunkRaw's third argument (timestamp) must be a non-negative real number.");if(!Number.isFinite(i)||i<0)throw new TypeError("addAudioChunkRaw's fourth argument (duration) must be a non-negative real number.");if(s&&typeof s!="object")throw new TypeError("addAudioChunkRaw's fifth argument (meta), when provided, must be an object.");if(St(this,Fc,pd).call(this),!H(this,Ye).audio)throw new Error("No audio track declared.");if(typeof H(this,Ye).fastStart=="object"&&H(this,Bn).samples.length===H(this,Ye).fastStart.expectedAudioChunks)throw new Error(`Cannot add more audio chunks than specified in 'fastStart' (${H(this,Ye).fastStart.expectedAudioChunks}).`);let r=St(this,Uc,dd).call(this,H(this,Bn),n,e,t,i,s);if(H(this,Ye).fastStart==="fragmented"&&H(this,qn)){for(;H(this,Gr).length>0&&H(this,Gr)[0].decodeTimestamp<=r.decodeTimestamp;){let o=H(this,Gr).shift();St(this,ys,Bs).call(this,H(this,qn),o)}r.decodeTimestamp<=H(this,qn).lastDecodeTimestamp?St(this,ys,Bs).call(this,H(this,Bn),r):H(this,Wr).push(r)}else St(this,ys,Bs).call(this,H(this,Bn),r)}finalize(){if(H(this,tl))throw new Error("Cannot finalize a muxer more than once.");if(H(this,Ye).fastStart==="fragmented"){for(let e of H(this,Gr))St(this,ys,Bs).call(this,H(this,qn),e);for(let e of H(this,Wr))St(this,ys,Bs).call(this,H(this,Bn),e);St(this,Hc,Ed).call(this,!1)}else H(this,qn)&&St(this,nl,Vc).call(this,H(this,qn)),H(this,Bn)&&St(this,nl,Vc).call(this,H(this,Bn));let n=[H(this,qn),H(this,Bn)].filter(Boolean);if(H(this,Ye).fastStart==="in-memory"){let e;for(let i=0;i<2;i++){let s=Dc(n,H(this,Ro)),r=H(this,it).measureBox(s);e=H(this,it).measureBox(H(this,Mi));let o=H(this,it).pos+r+e;for(let a of H(this,Po)){a.offset=o;for(let{data:l}of a.samples)o+=l.byteLength,e+=l.byteLength}if(o<2**32)break;e>=2**32&&(H(this,Mi).largeSize=!0)}let t=Dc(n,H(this,Ro));H(this,it).writeBox(t),H(this,Mi).size=e,H(this,it).writeBox(H(this,Mi));for(let i of H(this,Po))for(let s of i.samples)H(this,it).write(s.data),s.data=null}else if(H(this,Ye).fastStart==="fragmented"){let e=H(this,it).pos,t=Cb(n);H(this,it).writeBox(t);let i=H(this,it).pos-e;H(this,it).seek(H(this,it).pos-4),H(this,it).writeU32(i)}else{let e=H(this,it).offsets.get(H(this,Mi)),t=H(this,it).pos-e;H(this,Mi).size=t,H(this,Mi).largeSize=t>=2**32,H(this,it).patchBox(H(this,Mi));let i=Dc(n,H(this,Ro));if(typeof H(this,Ye).fastStart=="object"){H(this,it).seek(H(this,zc)),H(this,it).writeBox(i);let s=e-H(this,it).pos;H(this,it).writeBox(HS(s))}else H(this,it).writeBox(i)}St(this,Do,sl).call(this),H(this,it).finalize(),zn(this,tl,!0)}};Ye=new WeakMap;it=new WeakMap;zc=new WeakMap;Mi=new WeakMap;qn=new WeakMap;Bn=new WeakMap;Ro=new WeakMap;Po=new WeakMap;bd=new WeakMap;Gr=new WeakMap;Wr=new WeakMap;tl=new WeakMap;hd=new WeakSet;Xg=function(n){if(typeof n!="object")throw new TypeError("The muxer requires an options object to be passed to its constructor.");if(!(n.target instanceof Gc))throw new TypeError("The target must be provided and an instance of Target.");if(n.video){if(!zb.includes(n.video.codec))throw new TypeError(`Unsupported video codec: ${n.video.codec}`);if(!Number.isInteger(n.video.width)||n.video.width<=0)throw new TypeError(`Invalid video width: ${n.video.width}. Must be a positive integer.`);if(!Number.isInteger(n.video.height)||n.video.height<=0)throw new TypeError(`Invalid video height: ${n.video.height}. Must be a positive integer.`);let e=n.video.rotation;if(typeof e=="number"&&![0,90,180,270].includes(e))throw new TypeError(`Invalid video rotation: ${e}. Has to be 0, 90, 180 or 270.`);if(Array.isArray(e)&&(e.length!==9||e.some(t=>typeof t!="number")))throw new TypeError(`Invalid video transformation matrix: ${e.join()}`);if(n.video.frameRate!==void 0&&(!Number.isInteger(n.video.frameRate)||n.video.frameRate<=0))throw new TypeError(`Invalid video frame rate: ${n.video.frameRate}. Must be a positive integer.`)}if(n.audio){if(!Vb.includes(n.audio.codec))throw new TypeError(`Unsupported audio codec: ${n.audio.codec}`);if(!Number.isInteger(n.audio.numberOfChannels)||n.audio.numberOfChannels<=0)throw new TypeError(`Invalid number of audio channels: ${n.audio.numberOfChannels}. Must be a positive integer.`);if(!Number.isInteger(n.audio.sampleRate)||n.audio.sampleRate<=0)throw new TypeError(`Invalid audio sample rate: ${n.audio.sampleRate}. Must be a positive integer.`)}if(n.firstTimestampBehavior&&!Gb.includes(n.firstTimestampBehavior))throw new TypeError(`Invalid first timestamp behavior: ${n.firstTimestampBehavior}`);if(typeof n.fastStart=="object"){if(n.video){if(n.fastStart.expectedVideoChunks===void 0)throw new TypeError("'fastStart' is an object but is missing property 'expectedVideoChunks'.");if(!Number.isInteger(n.fastStart.expectedVideoChunks)||n.fastStart.expectedVideoChunks<0)throw new TypeError("'expectedVideoChunks' must be a non-negative integer.")}if(n.audio){if(n.fastStart.expectedAudioChunks===void 0)throw new TypeError("'fastStart' is an object but is missing property 'expectedAudioChunks'.");if(!Number.isInteger(n.fastStart.expectedAudioChunks)||n.fastStart.expectedAudioChunks<0)throw new TypeError("'expectedAudioChunks' must be a non-negative integer.")}}else if(![!1,"in-memory","fragmented"].includes(n.fastStart))throw new TypeError("'fastStart' option must be false, 'in-memory', 'fragmented' or an object.");if(n.minFragmentDuration!==void 0&&(!Number.isFinite(n.minFragmentDuration)||n.minFragmentDuration<0))throw new TypeError("'minFragmentDuration' must be a non-negative number.")};ud=new WeakSet;qg=function(){if(H(this,it).writeBox(VS({holdsAvc:H(this,Ye).video?.codec==="avc",fragmented:H(this,Ye).fastStart==="fragmented"})),zn(this,zc,H(this,it).pos),H(this,Ye).fastStart==="in-memory")zn(this,Mi,od(!1));else if(H(this,Ye).fastStart!=="fragmented"){if(typeof H(this,Ye).fastStart=="object"){let n=St(this,Md,Yg).call(this);H(this,it).seek(H(this,it).pos+n)}zn(this,Mi,od(!0)),H(this,it).writeBox(H(this,Mi))}St(this,Do,sl).call(this)};Md=new WeakSet;Yg=function(){if(typeof H(this,Ye).fastStart!="object")return;let n=0,e=[H(this,Ye).fastStart.expectedVideoChunks,H(this,Ye).fastStart.expectedAudioChunks];for(let t of e)t&&(n+=8*Math.ceil(2/3*t),n+=4*t,n+=12*Math.ceil(2/3*t),n+=4*t,n+=8*t);return n+=4096,n};fd=new WeakSet;$g=function(){if(H(this,Ye).video&&zn(this,qn,{id:1,info:{type:"video",codec:H(this,Ye).video.codec,width:H(this,Ye).video.width,height:H(this,Ye).video.height,rotation:H(this,Ye).video.rotation??0,decoderConfig:null},timescale:H(this,Ye).video.frameRate??57600,samples:[],finalizedChunks:[],currentChunk:null,firstDecodeTimestamp:void 0,lastDecodeTimestamp:-1,timeToSampleTable:[],compositionTimeOffsetTable:[],lastTimescaleUnits:null,lastSample:null,compactlyCodedChunkTable:[]}),H(this,Ye).audio&&(zn(this,Bn,{id:H(this,Ye).video?2:1,info:{type:"audio",codec:H(this,Ye).audio.codec,numberOfChannels:H(this,Ye).audio.numberOfChannels,sampleRate:H(this,Ye).audio.sampleRate,decoderConfig:null},timescale:H(this,Ye).audio.sampleRate,samples:[],finalizedChunks:[],currentChunk:null,firstDecodeTimestamp:void 0,lastDecodeTimestamp:-1,timeToSampleTable:[],compositionTimeOffsetTable:[],lastTimescaleUnits:null,lastSample:null,compactlyCodedChunkTable:[]}),H(this,Ye).audio.codec==="aac")){let n=St(this,wd,Zg).call(this,2,H(this,Ye).audio.sampleRate,H(this,Ye).audio.numberOfChannels);H(this,Bn).info.decoderConfig={codec:H(this,Ye).audio.codec,description:n,numberOfChannels:H(this,Ye).audio.numberOfChannels,sampleRate:H(this,Ye).audio.sampleRate}}};wd=new WeakSet;Zg=function(n,e,t){let s=[96e3,88200,64e3,48e3,44100,32e3,24e3,22050,16e3,12e3,11025,8e3,7350].indexOf(e),r=t,o="";o+=n.toString(2).padStart(5,"0"),o+=s.toString(2).padStart(4,"0"),s===15&&(o+=e.toString(2).padStart(24,"0")),o+=r.toString(2).padStart(4,"0");let a=Math.ceil(o.length/8)*8;o=o.padEnd(a,"0");let l=new Uint8Array(o.length/8);for(let c=0;c<o.length;c+=8)l[c/8]=parseInt(o.slice(c,c+8),2);return l};Uc=new WeakSet;dd=function(n,e,t,i,s,r,o){let a=i/1e6,l=(i-(o??0))/1e6,c=s/1e6,h=St(this,Td,Kg).call(this,a,l,n);return a=h.presentationTimestamp,l=h.decodeTimestamp,r?.decoderConfig&&(n.info.decoderConfig===null?n.info.decoderConfig=r.decoderConfig:Object.assign(n.info.decoderConfig,r.decoderConfig)),{presentationTimestamp:a,decodeTimestamp:l,duration:c,data:e,size:e.byteLength,type:t,timescaleUnitsToNextSample:xs(c,n.timescale)}};ys=new WeakSet;Bs=function(n,e){H(this,Ye).fastStart!=="fragmented"&&n.samples.push(e);let t=xs(e.presentationTimestamp-e.decodeTimestamp,n.timescale);if(n.lastTimescaleUnits!==null){let s=xs(e.decodeTimestamp,n.timescale,!1),r=Math.round(s-n.lastTimescaleUnits);if(n.lastTimescaleUnits+=r,n.lastSample.timescaleUnitsToNextSample=r,H(this,Ye).fastStart!=="fragmented"){let o=Oc(n.timeToSampleTable);o.sampleCount===1?(o.sampleDelta=r,o.sampleCount++):o.sampleDelta===r?o.sampleCount++:(o.sampleCount--,n.timeToSampleTable.push({sampleCount:2,sampleDelta:r}));let a=Oc(n.compositionTimeOffsetTable);a.sampleCompositionTimeOffset===t?a.sampleCount++:n.compositionTimeOffsetTable.push({sampleCount:1,sampleCompositionTimeOffset:t})}}else n.lastTimescaleUnits=0,H(this,Ye).fastStart!=="fragmented"&&(n.timeToSampleTable.push({sampleCount:1,sampleDelta:xs(e.duration,n.timescale)}),n.compositionTimeOffsetTable.push({sampleCount:1,sampleCompositionTimeOffset:t}));n.lastSample=e;let i=!1;if(!n.currentChunk)i=!0;else{let s=e.presentationTimestamp-n.currentChunk.startTimestamp;if(H(this,Ye).fastStart==="fragmented"){let r=H(this,qn)??H(this,Bn),o=H(this,Ye).minFragmentDuration??1;n===r&&e.type==="key"&&s>=o&&(i=!0,St(this,Hc,Ed).call(this))}else i=s>=.5}i&&(n.currentChunk&&St(this,nl,Vc).call(this,n),n.currentChunk={startTimestamp:e.presentationTimestamp,samples:[]}),n.currentChunk.samples.push(e)};Td=new WeakSet;Kg=function(n,e,t){let i=H(this,Ye).firstTimestampBehavior==="strict",s=t.lastDecodeTimestamp===-1;if(i&&s&&e!==0)throw new Error(`The first chunk for your media track must have a timestamp of 0 (received DTS=${e}).Non-zero first timestamps are often caused by directly piping frames or audio data from a MediaStreamTrack into the encoder. Their timestamps are typically relative to the age of thedocument, which is probably what you want.

If you want to offset all timestamps of a track such that the first one is zero, set firstTimestampBehavior: 'offset' in the options.
`);if(H(this,Ye).firstTimestampBehavior==="offset"||H(this,Ye).firstTimestampBehavior==="cross-track-offset"){t.firstDecodeTimestamp===void 0&&(t.firstDecodeTimestamp=e);let o;H(this,Ye).firstTimestampBehavior==="offset"?o=t.firstDecodeTimestamp:o=Math.min(H(this,qn)?.firstDecodeTimestamp??1/0,H(this,Bn)?.firstDecodeTimestamp??1/0),e-=o,n-=o}if(e<t.lastDecodeTimestamp)throw new Error(`Timestamps must be monotonically increasing (DTS went from ${t.lastDecodeTimestamp*1e6} to ${e*1e6}).`);return t.lastDecodeTimestamp=e,{presentationTimestamp:n,decodeTimestamp:e}};nl=new WeakSet;Vc=function(n){if(H(this,Ye).fastStart==="fragmented")throw new Error("Can't finalize individual chunks if 'fastStart' is set to 'fragmented'.");if(n.currentChunk){if(n.finalizedChunks.push(n.currentChunk),H(this,Po).push(n.currentChunk),(n.compactlyCodedChunkTable.length===0||Oc(n.compactlyCodedChunkTable).samplesPerChunk!==n.currentChunk.samples.length)&&n.compactlyCodedChunkTable.push({firstChunk:n.finalizedChunks.length,samplesPerChunk:n.currentChunk.samples.length}),H(this,Ye).fastStart==="in-memory"){n.currentChunk.offset=0;return}n.currentChunk.offset=H(this,it).pos;for(let e of n.currentChunk.samples)H(this,it).write(e.data),e.data=null;St(this,Do,sl).call(this)}};Hc=new WeakSet;Ed=function(n=!0){if(H(this,Ye).fastStart!=="fragmented")throw new Error("Can't finalize a fragment unless 'fastStart' is set to 'fragmented'.");let e=[H(this,qn),H(this,Bn)].filter(a=>a&&a.currentChunk);if(e.length===0)return;let t=kS(this,bd)._++;if(t===1){let a=Dc(e,H(this,Ro),!0);H(this,it).writeBox(a)}let i=H(this,it).pos,s=Ug(t,e);H(this,it).writeBox(s);{let a=od(!1),l=0;for(let h of e)for(let u of h.currentChunk.samples)l+=u.size;let c=H(this,it).measureBox(a)+l;c>=2**32&&(a.largeSize=!0,c=H(this,it).measureBox(a)+l),a.size=c,H(this,it).writeBox(a)}for(let a of e){a.currentChunk.offset=H(this,it).pos,a.currentChunk.moofOffset=i;for(let l of a.currentChunk.samples)H(this,it).write(l.data),l.data=null}let r=H(this,it).pos;H(this,it).seek(H(this,it).offsets.get(s));let o=Ug(t,e);H(this,it).writeBox(o),H(this,it).seek(r);for(let a of e)a.finalizedChunks.push(a.currentChunk),H(this,Po).push(a.currentChunk),a.currentChunk=null;n&&St(this,Do,sl).call(this)};Do=new WeakSet;sl=function(){H(this,it)instanceof Sd&&H(this,it).flush()};Fc=new WeakSet;pd=function(){if(H(this,tl))throw new Error("Cannot add new video or audio chunks after the file has been finalized.")};var Wb=new Set(["moov","trak","mdia"]),Xb=new Set(["mvhd","tkhd","mdhd"]);function jg(n){return Qg(n,0,n.length),n}function Qg(n,e,t){let i=new DataView(n.buffer,n.byteOffset,n.byteLength);for(let s=e;s+8<=t;){let r=i.getUint32(s),o=String.fromCharCode(...n.subarray(s+4,s+8));if(Wb.has(o)&&Qg(n,s+8,s+r),Xb.has(o)&&n.fill(0,s+12,s+12+(n[s+8]===1?16:8)),r<8)return;s+=r}}var qb=44,Yb=2,$b=4,Zb={h264:["avc1.640028","avc1.42002a"],vp9:["vp09.00.40.08"]},e0=1e-9,Kb=24;function Jb(n,e){let{fps:t=20,speed:i=1,start:s=0,end:r=n.samples-1}=e,[o,a]=[n.time[s],n.time[r]];if(!(t>0&&i>0)||o===void 0||a===void 0||a<o){let c=`fps ${t}, speed ${i}, samples ${s} to ${r} of ${n.samples}`;throw new Error(`video: expected fps and speed above 0, and a last sample after the first one, got ${c}`)}let l=Math.floor((a-o)*t/i+e0)+1;return Array.from({length:l},(c,h)=>o+h*i/t+e0)}async function Wc(n,e,t){let{fps:i=20,width:s=960,height:r=480}=e;if(s%2!==0||r%2!==0||s<64||r<64)throw new Error(`video: expected an even width and height of at least 64 x 64, got ${s} x ${r}`);let o=Jb(n.data,e),{config:a,codec:l}=await jb(e.codec?[e.codec]:["h264","vp9"],s,r,i),c=new yd,h=new Jg({target:c,video:{codec:l==="h264"?"avc":"vp9",width:s,height:r,frameRate:i},fastStart:"in-memory"}),u=null,f=new VideoEncoder({output:(_,m)=>h.addVideoChunk(_,m),error:_=>{u=_}});f.configure(a);let d=new OffscreenCanvas(s,r),g=n.store.state;n.store.set({playing:!1});for(let _ of[n.robot,n.space])_.hold(s/2,r-qb);try{for(let[_,m]of o.entries()){Qb(n,d,n.data.sampleAt(m));let p=new VideoFrame(d,{timestamp:Math.round(_*1e6/i),duration:Math.round(1e6/i)}),x={keyFrame:_%Math.max(1,Math.round(Yb*i))===0,vp9:{quantizer:Kb}};f.encode(p,x),p.close(),t((_+1)/o.length);do await new Promise(A=>setTimeout(A,0));while(f.encodeQueueSize>$b&&u===null);if(u!==null)throw u}await f.flush()}finally{f.state!=="closed"&&f.close();for(let _ of[n.robot,n.space])_.release();n.store.set({sample:g.sample})}return h.finalize(),jg(new Uint8Array(c.buffer))}async function jb(n,e,t,i){if(typeof VideoEncoder>"u")throw new Error("video: this browser has no WebCodecs; Chromium has");for(let s of n){let r=s==="h264"?{bitrate:4e6,avc:{format:"avc"}}:{bitrateMode:"quantizer"};for(let o of Zb[s]){let a={codec:o,width:e,height:t,framerate:i,latencyMode:"quality",hardwareAcceleration:"prefer-software",...r};if((await VideoEncoder.isConfigSupported(a).catch(()=>null))?.supported)return{config:a,codec:s}}}throw new Error(`video: this browser does not encode ${n.join(" or ")} at ${e} x ${t}`)}function Qb(n,e,t){let{data:i,store:s,robot:r,space:o}=n;s.set({sample:t}),n.flush(),r.draw(),o.draw();let a=e.getContext("2d");if(!a)throw new Error("video: this browser draws nothing on a canvas");let{width:l,height:c}=e;a.fillStyle=Xn,a.fillRect(0,0,l,c),a.drawImage(r.canvas,0,0),a.drawImage(o.canvas,l/2,0),a.fillStyle=Yt,a.font="14px system-ui, 'DejaVu Sans', sans-serif";let h=i.sensor(s.state.sensor),u=s.state.quantity==="force"?"force":"torque";a.fillText(`${i.scene.title} \xB7 ${h?.name??""} \xB7 ${u}`,12,c-26,l/2),a.fillText(`sample ${t} \xB7 ${(i.time[t]??0).toFixed(3)} s`,12,c-8);let f=l/2+12;for(let d of h?.wrenches??[])s.state.hidden.has(d.name)||(a.fillStyle=h?ii(h,d):Yt,a.fillRect(f,c-22,10,10),a.fillText(d.name,f+14,c-12),f+=30+a.measureText(d.name).width)}function t0(n,e,t,i){let s=n.store.state;return{reset(){n.store.set(s);for(let r of[n.robot,n.space])r.reset();n.flush()},show(r){let o=Math.max(0,n.data.samples-1);n.store.set({sample:Math.min(o,Math.max(0,r)),playing:!1}),n.flush()},sample:()=>n.store.state.sample,linkPoses:r=>Object.fromEntries([...Za(n.data,r)].map(([o,a])=>[o,[...a]])),spacePoint(r,o){let a=e.sampleOnCanvas(r,o),l=e.canvas.getBoundingClientRect();return a&&{x:l.left+a.x,y:l.top+a.y}},planePoint:(r,o,a)=>t[r]?.sampleOnScreen(o,a)??null,plots:()=>i.flatMap(r=>r.range()??[]),cloudSamples:()=>[...e.samples()],labels:()=>n.robot.labels(),spaceLabels:()=>e.labels(),skin:()=>n.robot.skin.shown(),video:async(r={})=>eM(await Wc(n,r,()=>{}))}}function eM(n){let e="";for(let t=0;t<n.length;t+=32768)e+=String.fromCharCode(...n.subarray(t,t+32768));return btoa(e)}function rl(n,e,t){let i=n.doubles(e.time_s),s=0,r=i.length;for(;s<r;){let a=s+r>>1;(i[a]??0)<=t?s=a+1:r=a}let o=i[s-1];return o!==void 0&&t<o+e.hold_s?s-1:null}function Xc(n,e,t){if(t===null)return[];let i=n.integers(e.first),[s,r]=[n.floats(e.place),n.floats(e.force)],o=e.spread?n.floats(e.spread):null,a=n.integers(e.identity),[l,c]=[i[t]??0,i[t+1]??0];return Array.from({length:c-l},(h,u)=>{let f=l+u,d=o?[...o.subarray(9*f,9*f+9)]:null;return{place:[...s.subarray(3*f,3*f+3)],force:[...r.subarray(3*f,3*f+3)],spread:d?.every(Number.isFinite)?d:null,identity:a[f]??0}})}function n0({force:n,spread:e}){let t=Math.hypot(...n);if(!e||t===0)return Number.NaN;let i=[0,1,2].map(s=>n.reduce((r,o,a)=>r+o/t*(e[3*a+s]??0),0));return Math.hypot(...i)}function qc(n,e){return o0(n,e)[1]}function i0(n,e){let[t,i]=[n.integers(e.first),n.floats(e.force)],s=new Float32Array(Math.max(0,t.length-1));return s.forEach((r,o)=>{for(let a=t[o]??0;a<(t[o+1]??0);a++){let l=Math.hypot(i[3*a]??0,i[3*a+1]??0,i[3*a+2]??0);s[o]=Math.max(s[o]??0,l)}}),s}function s0(n){return[...n.scene.skin,...n.scene.skin_events].flatMap(({contacts:e})=>{let[t,i,s]=[n.doubles(e.time_s),n.integers(e.first),n.integers(e.identity)],r=new Set;return[...t].filter((o,a)=>{let l=t[a-1];l!==void 0&&o>l+e.hold_s&&(r=new Set);let c=new Set(s.subarray(i[a]??0,i[a+1]??0)),h=[...c].some(u=>!r.has(u));return r=c,h})})}function r0(n){for(let e of[n.scene.skin,n.scene.skin_events]){let t=e.map(({contacts:o})=>({contacts:o,most:o0(n,o)})),{contacts:i,most:s}=t.sort((o,a)=>a.most[1]-o.most[1])[0]??{};if(!i||!s||s[1]===0)continue;let r=n.integers(i.first).findIndex(o=>o>s[0])-1;return Math.min(n.firstAt(n.doubles(i.time_s)[r]??0),n.samples-1)}return null}function o0(n,e){let t=n.floats(e.force),i=[0,0];for(let s=0;s+2<t.length;s+=3){let r=Math.hypot(t[s]??0,t[s+1]??0,t[s+2]??0);r>i[1]&&(i=[s/3,r])}return i}var tM=1e-6;function Lo(n,e){let t=n.sensor(e.sensor),i=Ha(t,e.hidden),s=t&&i?n.columns.error(t,i,e.quantity,3):null;if(!s)return null;let[r,o]=e.window;for(let a of["validation","calibration"]){let l=null;for(let{start_s:c,end_s:h}of n.scene.intervals.filter(u=>u.use===a)){let u=Math.min(n.firstAt(h),n.sampleAt(o)+1),f=s.farthest(n.firstAt(Math.max(r,c)),u);f!==null&&(l===null||s.at(f)>s.at(l))&&(l=f)}if(l!==null)return l}return null}function a0(n,e,t){let i=[...[...n.scene.intervals,...Si(n,e.marks),...e.selected].map(s=>s.start_s),...n.scene.findings.flatMap(({start_s:s})=>s===null?[]:[s]),...e.marks.map(({time_s:s})=>s)];return c0(n,e,i,t)}function l0(n,e,t){let i=s0(n).map(s=>n.time[n.firstAt(s)]??s);return c0(n,e,i,t)}function c0(n,e,t,i){let s=n.time[e.sample]??0,o=t.map(a=>n.time[n.nearestSample(a)]??a).filter(a=>i*(a-s)>tM);return o.length===0?null:n.nearestSample(i>0?Math.min(...o):Math.max(...o))}function Yr(n,e,t,i,s){let r=4*(i[1]-i[0])/Math.max(1,s-1),o=Math.min(i[1]-i[0],Math.max(r,e*(n[1]-n[0]))),a=(t-n[0])/(n[1]-n[0]||1);return h0(t-a*o,o,i)}function No(n,e,t){return h0(n[0]+e,n[1]-n[0],t)}function h0(n,e,[t,i]){let s=Math.max(t,Math.min(i-e,n));return[s,Math.min(i,s+e)]}var nM=["0.1","0.25","0.5","1","2","5","10","50"],iM=["point","begin","end"];function u0(n,e,t){let i=Math.max(0,n.samples-1),s=q("input",{type:"range",min:0,max:i,step:1,"aria-label":"Sample slider",class:"slider"});s.addEventListener("input",()=>e.set({sample:Number(s.value),playing:!1}));let r=q("input",{type:"number",min:0,max:i,step:1,"aria-label":"Sample number"});r.addEventListener("change",()=>{let h=Math.round(r.valueAsNumber);Number.isFinite(h)&&e.set({sample:Math.min(i,Math.max(0,h)),playing:!1}),r.value=String(e.state.sample)});let o=q("time"),a=Pt("\u25B6 Play",()=>ol(n,e),{class:"play"}),l=nM.map(h=>[h,`${h}\xD7`]),c=pr("Speed",l,"1",h=>e.set({speed:Number(h)}));return e.on(["sample"],()=>{let{sample:h}=e.state;s.value=String(h),r.value=String(h);let u=(n.time[h]??0).toFixed(3);s.setAttribute("aria-valuetext",`sample ${h}, ${u} s`),o.textContent=`${u} s`}),e.on(["playing"],()=>{let{playing:h}=e.state;a.textContent=h?"\u275A\u275A Pause":"\u25B6 Play",a.setAttribute("aria-label",h?"Pause":"Play"),a.setAttribute("aria-pressed",String(h))}),q("footer",{class:"transport"},a,c,Pt("\u22121",()=>Yc(n,e,-1),{"aria-label":"\u22121: one sample back"}),s,Pt("+1",()=>Yc(n,e,1),{"aria-label":"+1: one sample on"}),r,o,sM(n,e,t))}function sM(n,e,t){let i=q("span",{class:"segments",role:"radiogroup","aria-label":"Saved sample is"});for(let s of iM){let r=q("input",{type:"radio",name:"mark-kind",value:s});r.addEventListener("change",()=>e.set({markKind:s})),e.on(["markKind"],()=>{r.checked=e.state.markKind===s}),i.append(q("label",{},r,q("span",{},s)))}return q("span",{class:"saving"},i,Pt("Save sample",()=>Ad(n,e,t),{class:"primary"}))}function Ad(n,e,t){let{sample:i,markKind:s,marks:r}=e.state;if(n.samples===0)return;let o=n.time[i]??0,a={sample:i,time_s:o,mark:s,label:"",use:"ignore"},l={begin:"end",end:"begin",point:"point"};e.set({marks:[...r,a],markKind:l[s]}),t(`Saved sample ${i} at ${o.toFixed(3)} s as ${s}.`)}function Yc(n,e,t){let i=Math.min(Math.max(0,n.samples-1),Math.max(0,e.state.sample+t));e.set({sample:i,playing:!1})}function $c(n,e){return n.scene.live!==null&&e.state.playing}function ol(n,e){if(n.isOver)return;let{playing:t,sample:i}=e.state;!t&&i>=n.samples-1&&e.set({sample:0}),e.set({playing:!t&&(n.scene.live!==null||n.samples>1)})}function f0(n,e){let t=0,i=-1,s=0,r=o=>{let{playing:a,sample:l,speed:c}=e.state;a&&(l!==i&&(t=n.time[l]??0),t+=Math.min(.5,(o-s)/1e3)*c,s=o,i=n.sampleAt(t),e.set({sample:i,playing:i<n.samples-1}),requestAnimationFrame(r))};e.on(["playing"],()=>{e.state.playing&&(i=-1,s=performance.now(),requestAnimationFrame(r))})}var d0=1.5,p0=.25,rM=[["\u2190 \u2192","one sample back, on; with Shift ten"],["Home End","first, last sample"],["Space","play, pause"],["w","worst sample of the validation data in view"],["n, Shift+n","next, previous event: interval, finding, saved sample"],["c, Shift+c","next, previous contact on skin"],["+ \u2212 0","stretch, shrink the time in view, all of it; wheel likewise"],["[ ]","move the time in view; drag likewise, Shift+drag chooses it"],["Esc","forget what was encircled in a plane"],["f t","force, torque"],["p b e","the saved sample is a point, begin, end"],["s","save the sample"],["Alt + arrows, + \u2212, 0","turn, zoom, reset the focused 3-D view"]];function v0(n,e){let{live:t,sensors:i,skin:s,skin_events:r}=n.scene;return e==="w"?!t&&i.some(Oi):e==="c"?!t&&s.length+r.length>0:["n","p","b","e","s"].includes(e)?!t:i.length>0||!["f","t","Esc"].includes(e)}function y0(n){return rM.filter(([e])=>v0(n,e.split(/[ ,]/)[0]??""))}function _0(n,e,t){let i={Home:()=>e.set({sample:0,playing:!1}),End:()=>e.set({sample:Math.max(0,n.samples-1),playing:!1})," ":()=>ol(n,e),w:()=>Cd(n,e),n:()=>Zc(n,e,1),N:()=>Zc(n,e,-1),c:()=>Kc(n,e,1),C:()=>Kc(n,e,-1),"+":()=>m0(n,e,1/d0),"-":()=>m0(n,e,d0),0:()=>e.set({window:n.span}),"[":()=>g0(n,e,-p0),"]":()=>g0(n,e,p0),Escape:()=>e.set({selected:[]}),f:()=>e.set({quantity:"force"}),t:()=>e.set({quantity:"moment"}),p:()=>e.set({markKind:"point"}),b:()=>e.set({markKind:"begin"}),e:()=>e.set({markKind:"end"}),s:()=>Ad(n,e,t)};document.addEventListener("keydown",s=>{if(s.ctrlKey||s.metaKey||s.altKey||oM(s.target,s.key))return;let r=s.key==="ArrowRight"?1:s.key==="ArrowLeft"?-1:0,o=r!==0?()=>Yc(n,e,s.shiftKey?10*r:r):i[s.key];!o||!v0(n,s.key.toLowerCase())||(s.preventDefault(),o())})}function Cd(n,e){let t=Lo(n,e.state);t!==null&&e.set({sample:t,playing:!1})}function Zc(n,e,t){x0(n,e,a0(n,e.state,t))}function Kc(n,e,t){x0(n,e,l0(n,e.state,t))}function x0(n,e,t){if(t===null)return;let{window:i}=e.state,s=n.time[t]??0,o=i[0]<=s&&s<=i[1]?i:No(i,s-(i[0]+i[1])/2,n.span);e.set({sample:t,playing:!1,window:o})}function m0(n,e,t){let{window:i,sample:s}=e.state,r=n.time[s]??0,o=i[0]<=r&&r<=i[1]?r:(i[0]+i[1])/2;e.set({window:Yr(i,t,o,n.span,n.samples)})}function g0(n,e,t){let{window:i}=e.state;e.set({window:No(i,t*(i[1]-i[0]),n.span)})}function S0(){document.addEventListener("change",({target:n})=>{(n instanceof HTMLSelectElement||n instanceof HTMLInputElement&&n.type==="radio")&&!n.matches(":focus-visible")&&n.blur()})}function oM(n,e){return n instanceof HTMLInputElement?n.type==="range"?!1:n.type==="checkbox"?e===" ":n.type==="radio"?e===" "||e.startsWith("Arrow"):!0:n instanceof HTMLSelectElement||n instanceof HTMLTextAreaElement?!0:n instanceof HTMLElement&&n.closest("button, summary, a")!==null&&e===" "}var Rd=["error","measured"];function M0(n,e,t){let i=q("p",{role:"status",class:"status"}),s=q("div",{class:"view"}),r=q("div",{class:"view"}),o=q("p",{class:"overlay"}),a=[0,1,2].map(()=>q("div",{class:"view"})),l=lM(n,e),c=q("aside",{class:"side","aria-label":"Details"}),h=q("div",{class:"tools"}),u=q("div",{class:"tools"}),f=q("div",{class:"views"},Pd(e,"Robot","robot",h,s,o),Pd(e,"Force space","space",u,r),Pd(e,"Planes","planes",q("div",{class:"tools"}),q("div",{class:"three"},...a)));f.classList.toggle("robot-alone",n.scene.sensors.length===0),e.on(["large"],()=>{f.dataset.large=e.state.large??""});let d=q("div",{class:"app"},aM(n,e),q("main",{},f,l.root),c,t(p=>{i.textContent=p}));e.on(["quantity"],()=>{let p=d.querySelector(".space h2");p&&(p.textContent=e.state.quantity==="force"?"Force space":"Torque space")});let{strips:g,rasters:_,plots:m}=l;return{robot:s,space:r,planes:a,strips:g,rasters:_,plots:m,side:c,scale:o,robotTitle:h,spaceTitle:u,status:i,app:d}}function aM(n,e){if(n.scene.sensors.length===0)return q("header",{},q("h1",{title:n.scene.title},n.scene.title),b0(n));let t=n.scene.sensors.map((r,o)=>[String(o),r.serial?`${r.name} (${r.serial})`:r.name]),i=pr("Sensor",t,"0",r=>e.set({sensor:Number(r)}));e.on(["sensor"],()=>{i.value=String(e.state.sensor)});let s=q("span",{class:"segments",role:"radiogroup","aria-label":"Quantity"});for(let[r,o]of[["force","Force"],["moment","Torque"]]){let a=q("input",{type:"radio",name:"quantity",value:r});a.addEventListener("change",()=>e.set({quantity:r})),e.on(["quantity"],()=>{a.checked=e.state.quantity===r}),s.append(q("label",{},a,q("span",{},o)))}return q("header",{},q("h1",{title:n.scene.title},n.scene.title),i,s,b0(n))}function b0(n){return q("details",{class:"keys"},q("summary",{},"Keys"),q("dl",{},...y0(n).flatMap(([e,t])=>[q("dt",{},e),q("dd",{},t)])))}function lM(n,e){let{live:t,sensors:i}=n.scene,r=(i.length>0?Rd:Rd.slice(0,1)).map(x=>q("div",{class:"strip","aria-hidden":x==="error"?null:"true"})),o=w0(n)?r.map((x,A)=>q("div",{class:"raster","aria-hidden":A===0?null:"true"})):[],a=[],l=["force","moment"],c=l.map(x=>({name:`rows ${x}`,columns:Rd.map(A=>({kind:A,quantity:x}))})),h={name:"rows",columns:l.map(x=>({kind:"measured",quantity:x}))},u=t||!i.some(Oi),f=(i.length===0&&!t?[]:u?[h]:c).map(({name:x,columns:A})=>{let w=Tc.flatMap(P=>A.map(E=>{let y=P===3,T=q("div",{class:y?"plot last":"plot","data-kind":E.kind});return a.push({panel:T,shown:{...E,component:P,last:y}}),T}));return q("div",{class:x},...w)}),d=q("span",{class:"muted"});e.on(["sample","hover"],()=>{let{sample:x,hover:A}=e.state;d.textContent=`at ${(n.time[A??x]??0).toFixed(3)} s`});let g=f.length===0?["Time"]:u?["Force","Torque"]:["Error: measured \u2212 expected","Measured and expected"],_=q("div",{class:"heading columns"},...g.map((x,A)=>q("h2",{},x,...A===0?[" ",d]:[])),cM(n,e)),m=t?[_]:[_,q("div",{class:"strips"},...r,...o)],p=q("section",{class:t?"times live":u?"times bare":"times","aria-label":"Time plots"},...m,...f);return e.on(["quantity"],()=>{p.dataset.quantity=e.state.quantity}),{root:p,strips:t?[]:r,rasters:o,plots:a}}function w0({scene:n}){return!n.live&&n.skin.length+n.skin_events.length>0}function cM(n,e){let t=Pt("Whole recording",()=>e.set({window:n.span}));e.on(["window"],()=>{let[s,r]=n.span;t.hidden=e.state.window[0]===s&&e.state.window[1]===r});let i=q("div",{class:"tools"},t);return n.scene.sensors.length>0&&!n.scene.live&&(n.scene.sensors.some(Oi)&&i.append(Pt("Worst sample",()=>Cd(n,e),{title:"Largest error of the validation data in view (w)"})),i.append(Pt("Next event",()=>Zc(n,e,1),{title:"Next interval, finding or saved sample (n)"}))),w0(n)&&i.append(Pt("Next contact",()=>Kc(n,e,1),{title:"Next contact on skin (c)"})),n.scene.sensors.length>0&&i.append(T0(e,"time plots","times")),i}function T0(n,e,t){let i=Pt("\u2922",()=>n.set({large:n.state.large===t?null:t}),{"aria-label":`Enlarge ${e}`,title:"Enlarge"});return n.on(["large"],()=>i.setAttribute("aria-pressed",String(n.state.large===t))),i}function Pd(n,e,t,i,...s){i.append(T0(n,e.toLowerCase(),t));let r=q("div",{class:"heading"},q("h2",{},e),i);return q("section",{class:`panel ${t}`,"aria-label":e},r,...s)}var hM=[1,2,5,10],Vs=class extends Eo{feed;isFull=!1;count=0;kept;constructor(e,t){let i=uM(e),s=e.time_s.shape[0]??0,r=i.map(a=>new Float32Array(s*(a.shape[1]??1))),o=new Map(i.map((a,l)=>[a.offset,r[l]??new Float32Array]));if(super(e,t,o.set(e.time_s.offset,new Float64Array(s))),!e.live)throw new Error("expected a scene of a stream");this.feed=e.live,this.kept=r.map((a,l)=>({values:a,columns:i[l]?.shape[1]??1}));for(let{values:a}of this.kept)a.fill(Number.NaN)}get samples(){return this.count}peak(e,t){if(!("calibrated"in e&&e.calibrated))return 0;let{high:i}=this.columns.measured(e,t,3).summary(0,this.count);if(!(i>0))return 0;let s=10**Math.floor(Math.log10(i));return s*(hM.find(r=>r*s>=i)??10)}add({rows:e},t){let i=e*(8+4*this.kept.reduce((o,{columns:a})=>o+a,0));if(t.length!==i)throw new Error(`expected ${i} bytes of ${e} rows, got ${t.length}`);if(e===0)return;let s=new Float64Array(t.slice(0,8*e).buffer);this.makeRoom(e,(s[e-1]??0)-this.feed.window_s),this.time.set(s,this.count);let r=8*e;for(let{values:o,columns:a}of this.kept){let l=r+4*e*a;o.set(new Float32Array(t.slice(r,l).buffer),this.count*a),r=l}this.count+=e,this.columns.forget()}makeRoom(e,t){let i=this.count===0?0:this.firstAt(t),s=this.count+e-this.time.length;this.isFull=s>i;let r=Math.min(this.count,Math.max(i,s));this.time.copyWithin(0,r,this.count);for(let{values:o,columns:a}of this.kept)o.copyWithin(0,r*a,this.count*a);this.count-=r}};function uM({positions:n,root:e,sensors:t}){let i=t.flatMap(({wrenches:s})=>s);return[n,e,...i.flatMap(({values:s,deviation:r})=>r?[s,r]:[s])]}var fM=100,dM=-1,pM=1,mM=10;function E0(n,e,t){let i={skipped:0,update:null,ended:null},s=0,r=async()=>{let o=performance.now(),{playing:a}=e.state;try{let h=await fetch(`${n.feed.url}?after=${a?s:dM}`,{cache:"no-store"});if(!h.ok)throw new Error(`the server answered ${h.status}`);let u=new Uint8Array(await h.arrayBuffer()),f=u.indexOf(mM),d=JSON.parse(new TextDecoder().decode(u.subarray(0,f)));i.update=d,a&&(s>0&&(i.skipped+=d.first-s),s=d.first+d.rows,n.add(d,u.subarray(f+1)),d.rows>0&&e.state.playing&&(e.renew({sample:n.samples-1,window:n.span}),await new Promise(requestAnimationFrame))),d.ended_by!==null&&(!a||s>=d.total)&&(i.ended=d.ended_by)}catch(h){i.ended=`the server of the run does not answer (${h instanceof Error?h.message:String(h)})`}if(t(i),i.ended!==null){n.isOver=!0,e.set({playing:!1});return}let l=a&&s<(i.update?.total??0),c=performance.now()-o;setTimeout(()=>{r()},l?0:Math.max(c,fM-c))};return r(),i}function A0(n,e){let t=Pt("",()=>ol(n,e),{class:"play"}),i=q("time"),s=q("span",{class:"grow"}),r=q("span",{class:"status"});e.on(["playing"],()=>{t.textContent=e.state.playing?"\u275A\u275A Hold":"\u25B6 Follow",t.setAttribute("aria-pressed",String(e.state.playing))}),e.on(["sample"],()=>{i.textContent=`${(n.time[e.state.sample]??0).toFixed(3)} s`});let o=({update:a,skipped:l,ended:c})=>{if(a){let{received:f,lost:d,late:g,repeated:_}=a,m=l>0?`; ${l} samples not shown: the page was too slow, or held`:"",[p,x]=n.span,A=n.isFull?`; shown are ${(x-p).toFixed(0)} s, not ${n.feed.window_s} s: ${n.time.length} samples at most`:"",w=`Packets: ${f} received, ${d??"not countable"} lost, ${g} late, ${_} repeated${m}${A}`;Cc(s,w)}t.disabled=c!==null;let h=a?.silent_s??0,u=h>pM?`No packet for ${h.toFixed(0)} s`:"";Cc(r,c!==null?`The run ended: ${c}. What came last stays here.`:u)};return{bar:q("footer",{class:"transport"},t,i,s,r),show:o}}function C0(n){let e=q("tbody"),t=["status","drift [N]","faults"].map(r=>q("th",{scope:"col"},r));return{panel:q("table",{},q("caption",{},"Drift of the bias since the tare, largest component; faults of all samples"),q("thead",{},q("tr",{},q("th",{scope:"col"},"sensor"),...t)),e),show:({update:r})=>{(r?.sensors??[]).forEach((o,a)=>{let l=[o.status,vM(o),`${o.faulty} of ${o.samples}`],c=e.rows[a]??e.appendChild(gM(n.sensor(a)?.name??"",l.length));l.forEach((h,u)=>Cc(c.cells[u+1],h))})}}}function gM(n,e){return q("tr",{},q("th",{scope:"row"},n),...Array.from({length:e},()=>q("td")))}function vM({drift:n}){return n?Math.max(...n.slice(0,3).map(Math.abs)).toFixed(2):"\u2013"}function P0(n){let e=n.endsWith("==")?2:n.endsWith("=")?1:0;return{byteLength:n.length/4*3-e,read(t,i){let s=t%3,r=(t-s)/3*4;return yM(n.slice(r,Math.ceil(i/3)*4)).slice(s,s+i-t)}}}var R0=Uint8Array.fromBase64;function yM(n){if(R0)return R0.call(Uint8Array,n);let e=atob(n),t=new Uint8Array(e.length);for(let i=0;i<e.length;i++)t[i]=e.charCodeAt(i);return t}var al=class n{constructor(e,t){this.url=e;this.byteLength=t;this.bytes=new Uint8Array(t),this.has=new Uint8Array(Math.ceil(t/262144))}url;byteLength;bytes;has;static async at(e){let t=await I0(e,"bytes=0-262143"),i=new Uint8Array(await t.arrayBuffer()),s=t.status===200?i.length:Number(/\/(\d+)$/.exec(t.headers.get("Content-Range")??"")?.[1]);if(!Number.isFinite(s))throw new Error(`${e}: the server sent a piece without the length of the whole`);let r=new n(e,s);return r.keep(0,Math.ceil(i.length/262144),i),r}read(e,t){for(let[i,s]of this.missing([[e,t]])){let r=new XMLHttpRequest;r.open("GET",this.url,!1),r.setRequestHeader("Range",this.header(i,s)),r.overrideMimeType("text/plain; charset=x-user-defined");try{r.send()}catch{throw D0(this.url)}if(r.status!==206)throw L0(this.url,r.status);let o=r.responseText,a=new Uint8Array(o.length);for(let l=0;l<o.length;l++)a[l]=o.charCodeAt(l);this.keep(i,s,a)}return this.bytes.slice(e,t)}async fetch(e,t=()=>{}){let i=r=>r.reduce((o,[a,l])=>o+l-a,0),s=i(this.missing(e));for(let r=this.missing(e);r[0];r=this.missing(e)){let[o,a]=r[0],l=await I0(this.url,this.header(o,a));this.keep(o,a,new Uint8Array(await l.arrayBuffer())),t(s-i(this.missing(e)),s)}}missing(e){let t=new Set;for(let[s,r]of e)for(let o=Math.floor(s/262144);o*262144<Math.min(r,this.byteLength);o++)this.has[o]||t.add(o);let i=[];for(let s of[...t].sort((r,o)=>r-o)){let r=i.at(-1);r?.[1]===s&&s-r[0]<16?r[1]=s+1:i.push([s,s+1])}return i}header(e,t){return`bytes=${e*262144}-${Math.min(t*262144,this.byteLength)-1}`}keep(e,t,i){let s=Math.min(t*262144,this.byteLength)-e*262144;if(i.length!==s)throw new Error(`${this.url}: expected ${s} bytes, got ${i.length}`);this.bytes.set(i,e*262144),this.has.fill(1,e,t)}};async function I0(n,e){let t=await fetch(n,{headers:{Range:e}}).catch(()=>{throw D0(n)});if(!t.ok)throw L0(n,t.status);return t}function D0(n){return new Error(`${n}: the server does not answer; start the command again`)}function L0(n,e){return new Error(`${n}: the server answered ${e}; start the command again`)}function N0(){let n=document.getElementById("scene")?.textContent;if(!n)throw new Error('the page holds no scene: expected a script element with id "scene"');let e=JSON.parse(n);if(e.schema!=="forcetorque/scene/1")throw new Error(`expected a scene of schema "forcetorque/scene/1", got ${JSON.stringify(e.schema)}`);return e}async function U0(n,e){let t=document.getElementById("data");if(!t)throw new Error('the page holds no data: expected a script element with id "data"');let i=t.dataset.url;if(i){let r=await al.at(i);return await r.fetch(_M(n).map(SM),e),r}let s=P0(t.textContent??"");return t.textContent="",s}async function F0(n){n instanceof al&&await n.fetch([[0,n.byteLength]]).catch(()=>{})}function _M({time_s:n,sensors:[e]}){let t=e?.wrenches??[];return[n,...t.flatMap(({values:i,deviation:s,overview:r})=>r?[r.wrench,r.error,r.deviation,r.points]:[i,i.base,s])].filter(i=>i!=null)}var xM={float32:4,float64:8,uint32:4};function SM({offset:n,packed_bytes:e,dtype:t,shape:i}){return[n,n+(e??xM[t]*i.reduce((s,r)=>s*r,1))]}var bM=180/Math.PI;function k0(n,e){let t=n.scene.coordinates.map((s,r)=>`${s}${n.isLength(r)?"_m":"_deg"}`),i=Fs(e).map(s=>[String(s.sample),V0(s.time_s),s.mark,s.label,...n.scene.coordinates.map((r,o)=>MM(n,s.sample,o))]);return[["sample","time_s","mark","label",...t],...i].map(s=>`${s.map(wM).join(",")}
`).join("")}function B0(n,e){return[`# intervals marked in the viewer; copy them into the experiment file
`,...Si(n,e).map(i=>{let s=["[[interval]]",`label = ${Va(i.label)}`,`start_s = ${O0(i.start_s)}`,`end_s = ${O0(i.end_s)}`,`use = ${Va(i.use)}`,...i.supportLines],r=i.overlaps.map(Va).join(", ");return r&&s.push(`# overlaps ${r}: shorten those, as a sample is fitted or judged once`),`${s.join(`
`)}
`})].join(`
`)}function z0(n,e){return{samples:Fs(e),intervals:Si(n,e).map(({label:t,start_s:i,end_s:s,use:r})=>({label:t,start_s:i,end_s:s,use:r}))}}function MM(n,e,t){let i=n.position(e,t);return Number.isNaN(i)?"":n.isLength(t)?i.toFixed(6):(i*bM).toFixed(4)}function V0(n){return n.toFixed(9).replace(/0+$/,"").replace(/\.$/,"")}function O0(n){let e=V0(n);return e.includes(".")?e:`${e}.0`}function wM(n){return/[",\r\n]/.test(n)?`"${n.replaceAll('"','""')}"`:n}var H0=.25;function G0(n,e,t){let i=!1;return n.forEach(([s,r],o)=>{let[a,l]=n[(o+1)%n.length]??[s,r];r>t!=l>t&&e<s+(a-s)*(t-r)/(l-r)&&(i=!i)}),i}function W0(n,e,t){let i=[];return e.samples.forEach((s,r)=>{if(!t(r))return;let o=n.time[s]??0,a=n.time[e.samples[r+1]??s]??o,l=i.at(-1),c=Math.min(a,o+H0);l&&o-l.end_s<H0?l.end_s=c:i.push({start_s:o,end_s:c})}),i.filter(({start_s:s,end_s:r})=>r>s)}function X0(n,e,t){let i=e.flatMap(({start_s:s,end_s:r})=>["begin","end"].map(o=>{let a=n.firstAt(s),l=o==="begin"?a:Math.max(a,n.firstAt(r)-1);return{sample:l,time_s:n.time[l]??0,mark:o,label:"",use:"ignore"}}));return Fs([...t,...i])}var TM=[["ignore","ignore"],["calibration","calibration"],["validation","validation"]],EM=180;function q0(n,e,t){let i=q("ul",{class:"marks","aria-label":"Saved samples"}),s=q("ul",{class:"marks","aria-label":"Marked intervals"});e.on(["marks"],()=>{let{marks:a}=e.state;(!i.contains(document.activeElement)||i.children.length!==a.length)&&i.replaceChildren(...Fs(a).map(l=>CM(l,e))),a.length===0&&i.replaceChildren(q("li",{class:"absent"},"None yet: \u201CSave sample\u201D keeps the one shown.")),s.replaceChildren(...RM(n,e))});let r=new Set;addEventListener("beforeunload",a=>{let{marks:l}=e.state;l.length>0&&!r.has(l)&&a.preventDefault()});let o=a=>{r.add(a)};return q("div",{},i,s,AM(n,e,t),PM(n,e,t,o))}function AM(n,e,t){let i=q("div",{class:"row"});return e.on(["selected"],()=>{let{selected:s}=e.state;i.hidden=s.length===0;let r=s.reduce((o,{start_s:a,end_s:l})=>o+l-a,0);i.replaceChildren(q("span",{class:"muted"},`Selected: ${r.toFixed(2)} s in ${s.length} interval(s)`),Pt("Save as intervals",()=>{e.set({marks:X0(n,s,e.state.marks),selected:[]}),t(`Saved ${s.length} interval(s).`)}),Pt("Forget",()=>e.set({selected:[]})))}),i}function CM(n,e){let t=n,i=`sample ${n.sample}`,s=q("input",{type:"text",maxlength:EM,value:n.label,placeholder:"label","aria-label":`Label of ${i}`});s.addEventListener("change",()=>{let o={...t,label:s.value.trim()},a=e.state.marks.map(l=>l===t?o:l);t=o,e.set({marks:a})});let r=()=>e.set({marks:e.state.marks.filter(o=>o!==t)});return q("li",{},Pt(`${n.sample}`,()=>e.set({sample:n.sample,playing:!1}),{class:"link","aria-label":`Go to ${i}`}),q("span",{class:"muted"},`${n.time_s.toFixed(2)} s ${n.mark}`),s,Pt("\u2715",r,{"aria-label":`Delete ${i}`}))}function RM(n,e){let t=Si(n,e.state.marks).map(s=>{let r=pr(`Use of ${s.label}`,TM,s.use,c=>{let h=e.state.marks.map(u=>u===s.begin?{...u,use:c}:u);e.set({marks:h})}),o=`${s.label}: ${s.start_s.toFixed(2)}\u2013${s.end_s.toFixed(2)} s`,a=s.overlaps.join(", "),l=a?[q("span",{class:"muted clash"},`overlaps ${a}: shorten it there`)]:[];return q("li",{},q("span",{class:"grow"},o),r,...l)}),i=dg(e.state.marks).map(({mark:s,sample:r})=>q("li",{class:"absent"},s==="begin"?`begin at ${r} has no end`:`end at ${r} has no begin`));return[...t,...i]}function PM(n,e,t,i){let{title:s,annotations_url:r}=n.scene,o=(l,c,h)=>{Rc(Pc(s,l),c,h),i(e.state.marks)},a=q("div",{class:"row"},Pt("Samples as CSV",()=>o("_samples.csv",k0(n,e.state.marks),"text/csv")),Pt("Intervals as TOML",()=>o("_intervals.toml",B0(n,e.state.marks),"application/toml")));return r!==null&&a.append(Pt("Write beside the experiment",()=>{let{marks:l}=e.state;IM(r,n,l,t).then(c=>{c&&i(l)})},{class:"primary"})),a}async function IM(n,e,t,i){try{let s=JSON.stringify(z0(e,t)),r=await fetch(n,{method:"POST",headers:{"Content-Type":"application/json"},body:s}),o=await r.text();if(!r.ok)throw new Error(`${r.status} ${r.statusText}: ${o.slice(0,300)}`);let{files:a}=JSON.parse(o);return i(`Written beside the experiment: ${a.join(", ")}`),!0}catch(s){return i(`Not written. ${s instanceof Error?s.message:String(s)}`),!1}}var Y0=["robot","space","planes","times"],Jc=class{constructor(e){this.current=e}current;listeners=[];get state(){return this.current}set(e){let t=Object.keys(e).filter(i=>e[i]!==this.current[i]);t.length>0&&this.change(e,t)}renew(e){this.change(e,Object.keys(e))}change(e,t){this.current={...this.current,...e};for(let{keys:i,call:s}of this.listeners)t.some(r=>i.has(r))&&s()}on(e,t){this.listeners.push({keys:new Set(e),call:t}),t()}};var DM=250,LM=4;function NM(n,e){let{sensor:t,quantity:i,window:s,hidden:r,large:o}=e,a=new URLSearchParams({sample:String(e.sample)}),l=n.sensor(t)?.name;l!==void 0&&a.set("sensor",l),a.set("quantity",i);let[c,h]=n.span;(s[0]>c||s[1]<h)&&a.set("window",s.map(u=>u.toFixed(LM)).join(","));for(let u of r)a.append("hide",u);return o&&a.set("large",o),a.toString()}function Id(n,e){let t=new URLSearchParams(e.replace(/^#/,"")),i={},s=t.get("sample");s!==null&&/^\d+$/.test(s)&&(i.sample=Math.min(Number(s),Math.max(0,n.samples-1)));let r=n.scene.sensors.findIndex(({name:h})=>h===t.get("sensor"));r>=0&&(i.sensor=r);let o=t.get("quantity");(o==="force"||o==="moment")&&(i.quantity=o);let[a=NaN,l=NaN]=(t.get("window")??"").split(",").map(Number);l>a&&(i.window=Yr([a,l],1,a,n.span,n.samples)),t.has("hide")&&(i.hidden=new Set(t.getAll("hide")));let c=Y0.find(h=>h===t.get("large"));return c&&(i.large=c),i}function $0(n,e){let t=0,i=location.hash,s=!0;e.on(["sample","sensor","quantity","window","hidden","large"],()=>{if(s){s=!1;return}clearTimeout(t),t=setTimeout(()=>{location.hash===i&&(i=`#${NM(n,e.state)}`,location.protocol!=="about:"&&(history.replaceState(null,"",i),i=location.hash))},DM)}),addEventListener("hashchange",()=>{location.hash!==i&&(i=location.hash,e.set({window:n.span,hidden:new Set,large:null,...Id(n,i),playing:!1}))})}var Cr={LEFT:0,MIDDLE:1,RIGHT:2,ROTATE:0,DOLLY:1,PAN:2},Rr={ROTATE:0,PAN:1,DOLLY_PAN:2,DOLLY_ROTATE:3},Cv=0,lp=1,Rv=2;var Xl=1,Pv=2,ha=3,Pr=0,hi=1,ui=2,eo=0,ua=1,cp=2,hp=3,up=4,Iv=5;var to=100,Dv=101,Lv=102,Nv=103,Uv=104,Fv=200,Ov=201,kv=202,Bv=203,fp=204,dp=205,zv=206,Vv=207,Hv=208,Gv=209,Wv=210,Xv=211,qv=212,Yv=213,$v=214,Ah=0,Ch=1,Rh=2,Qo=3,Ph=4,Ih=5,Dh=6,Lh=7,ou=0,Zv=1,Kv=2,Es=0,pp=1,mp=2,gp=3,vp=4,yp=5,_p=6,xp=7;var Sp=300,no=301,fa=302,au=303,lu=304,Nh=1e3,Ms=1001,Uh=1002,Hn=1003,Jv=1004;var ql=1005;var ai=1006,cu=1007;var er=1008;var di=1009,bp=1010,Mp=1011,da=1012,hu=1013,ts=1014,ns=1015,is=1016,uu=1017,fu=1018,io=1020,wp=35902,Tp=35899,Ep=1021,Ap=1022,ss=1023,Zs=1026,tr=1027,Cp=1028,du=1029,Ir=1030,pu=1031;var mu=1033,Yl=33776,$l=33777,Zl=33778,Kl=33779,gu=35840,vu=35841,yu=35842,_u=35843,xu=36196,Su=37492,bu=37496,Mu=37488,wu=37489,Jl=37490,Tu=37491,Eu=37808,Au=37809,Cu=37810,Ru=37811,Pu=37812,Iu=37813,Du=37814,Lu=37815,Nu=37816,Uu=37817,Fu=37818,Ou=37819,ku=37820,Bu=37821,zu=36492,Vu=36494,Hu=36495,Gu=36283,Wu=36284,jl=36285,Xu=36286;var _l=2300,Fh=2301,Th=2302,ep=2303,tp=2400,np=2401,ip=2402;var jv=3200;var qu=0,Qv=1,nr="",Ai="srgb",xl="srgb-linear",Sl="linear",Ft="srgb";var Eh=7680;var ey=519,ty=512,ny=513,iy=514,Rp=515,sy=516,ry=517,Pp=518,Ip=519,Dp=35044;var Lp="300 es",Vi=2e3,ea=2001;function UM(n){for(let e=n.length-1;e>=0;--e)if(n[e]>=65535)return!0;return!1}function FM(n){return ArrayBuffer.isView(n)&&!(n instanceof DataView)}function bl(n){return document.createElementNS("http://www.w3.org/1999/xhtml",n)}function oy(){let n=bl("canvas");return n.style.display="block",n}var Z0={},ta=null;function Ml(...n){let e="THREE."+n.shift();ta?ta("log",e,...n):console.log(e,...n)}function ay(n){let e=n[0];if(typeof e=="string"&&e.startsWith("TSL:")){let t=n[1];t&&t.isStackTrace?n[0]+=" "+t.getLocation():n[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return n}function Je(...n){n=ay(n);let e="THREE."+n.shift();if(ta)ta("warn",e,...n);else{let t=n[0];t&&t.isStackTrace?console.warn(t.getError(e)):console.warn(e,...n)}}function st(...n){n=ay(n);let e="THREE."+n.shift();if(ta)ta("error",e,...n);else{let t=n[0];t&&t.isStackTrace?console.error(t.getError(e)):console.error(e,...n)}}function gl(...n){let e=n.join(" ");e in Z0||(Z0[e]=!0,Je(...n))}function ly(n,e,t){return new Promise(function(i,s){function r(){switch(n.clientWaitSync(e,n.SYNC_FLUSH_COMMANDS_BIT,0)){case n.WAIT_FAILED:s();break;case n.TIMEOUT_EXPIRED:setTimeout(r,t);break;default:i()}}setTimeout(r,t)})}var cy={[Ah]:Ah,[Rh]:Dh,[Ph]:Ph,[Qo]:Ih,[Ch]:Ch,[Dh]:Rh,[Lh]:Lh,[Ih]:Qo},ji=class{addEventListener(e,t){this._listeners===void 0&&(this._listeners={});let i=this._listeners;i[e]===void 0&&(i[e]=[]),i[e].indexOf(t)===-1&&i[e].push(t)}hasEventListener(e,t){let i=this._listeners;return i===void 0?!1:i[e]!==void 0&&i[e].indexOf(t)!==-1}removeEventListener(e,t){let i=this._listeners;if(i===void 0)return;let s=i[e];if(s!==void 0){let r=s.indexOf(t);r!==-1&&s.splice(r,1)}}dispatchEvent(e){let t=this._listeners;if(t===void 0)return;let i=t[e.type];if(i!==void 0){e.target=this;let s=i.slice(0);for(let r=0,o=s.length;r<o;r++)s[r].call(this,e);e.target=null}}},Zn=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"],K0=1234567,vl=Math.PI/180,na=180/Math.PI;function Dr(){let n=Math.random()*4294967295|0,e=Math.random()*4294967295|0,t=Math.random()*4294967295|0,i=Math.random()*4294967295|0;return(Zn[n&255]+Zn[n>>8&255]+Zn[n>>16&255]+Zn[n>>24&255]+"-"+Zn[e&255]+Zn[e>>8&255]+"-"+Zn[e>>16&15|64]+Zn[e>>24&255]+"-"+Zn[t&63|128]+Zn[t>>8&255]+"-"+Zn[t>>16&255]+Zn[t>>24&255]+Zn[i&255]+Zn[i>>8&255]+Zn[i>>16&255]+Zn[i>>24&255]).toLowerCase()}function yt(n,e,t){return Math.max(e,Math.min(t,n))}function Np(n,e){return(n%e+e)%e}function OM(n,e,t,i,s){return i+(n-e)*(s-i)/(t-e)}function kM(n,e,t){return n!==e?(t-n)/(e-n):0}function yl(n,e,t){return(1-t)*n+t*e}function BM(n,e,t,i){return yl(n,e,1-Math.exp(-t*i))}function zM(n,e=1){return e-Math.abs(Np(n,e*2)-e)}function VM(n,e,t){return n<=e?0:n>=t?1:(n=(n-e)/(t-e),n*n*(3-2*n))}function HM(n,e,t){return n<=e?0:n>=t?1:(n=(n-e)/(t-e),n*n*n*(n*(n*6-15)+10))}function GM(n,e){return n+Math.floor(Math.random()*(e-n+1))}function WM(n,e){return n+Math.random()*(e-n)}function XM(n){return n*(.5-Math.random())}function qM(n){n!==void 0&&(K0=n);let e=K0+=1831565813;return e=Math.imul(e^e>>>15,e|1),e^=e+Math.imul(e^e>>>7,e|61),((e^e>>>14)>>>0)/4294967296}function YM(n){return n*vl}function $M(n){return n*na}function ZM(n){return n>0&&Number.isInteger(n)&&2**Math.round(Math.log2(n))===n}function KM(n){return Math.pow(2,Math.ceil(Math.log(n)/Math.LN2))}function Up(n){return Math.pow(2,Math.floor(Math.log(n)/Math.LN2))}function JM(n,e,t,i,s){let r=Math.cos,o=Math.sin,a=r(t/2),l=o(t/2),c=r((e+i)/2),h=o((e+i)/2),u=r((e-i)/2),f=o((e-i)/2),d=r((i-e)/2),g=o((i-e)/2);switch(s){case"XYX":n.set(a*h,l*u,l*f,a*c);break;case"YZY":n.set(l*f,a*h,l*u,a*c);break;case"ZXZ":n.set(l*u,l*f,a*h,a*c);break;case"XZX":n.set(a*h,l*g,l*d,a*c);break;case"YXY":n.set(l*d,a*h,l*g,a*c);break;case"ZYZ":n.set(l*g,l*d,a*h,a*c);break;default:Je("MathUtils: .setQuaternionFromProperEuler() encountered an unknown order: "+s)}}function Yu(n){switch(n.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function Fp(n,e){if(e.constructor===Float32Array)return n;let t=Yu(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(n/t,-1)}function Op(n,e){if(e.constructor===Float32Array)return n;let t=Yu(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(n*t)}var kp={DEG2RAD:vl,RAD2DEG:na,generateUUID:Dr,clamp:yt,euclideanModulo:Np,mapLinear:OM,inverseLerp:kM,lerp:yl,damp:BM,pingpong:zM,smoothstep:VM,smootherstep:HM,randInt:GM,randFloat:WM,randFloatSpread:XM,seededRandom:qM,degToRad:YM,radToDeg:$M,isPowerOfTwo:ZM,ceilPowerOfTwo:KM,floorPowerOfTwo:Up,setQuaternionFromProperEuler:JM,normalize:Op,denormalize:Fp},$e=class{static{this.prototype.isVector2=!0}constructor(e=0,t=0){this.x=e,this.y=t}get width(){return this.x}set width(e){this.x=e}get height(){return this.y}set height(e){this.y=e}set(e,t){return this.x=e,this.y=t,this}setScalar(e){return this.x=e,this.y=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;default:throw new Error("THREE.Vector2: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y)}copy(e){return this.x=e.x,this.y=e.y,this}add(e){return this.x+=e.x,this.y+=e.y,this}addScalar(e){return this.x+=e,this.y+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this}subScalar(e){return this.x-=e,this.y-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this}multiply(e){return this.x*=e.x,this.y*=e.y,this}multiplyScalar(e){return this.x*=e,this.y*=e,this}divide(e){return this.x/=e.x,this.y/=e.y,this}divideScalar(e){return this.multiplyScalar(1/e)}applyMatrix3(e){let t=this.x,i=this.y,s=e.elements;return this.x=s[0]*t+s[3]*i+s[6],this.y=s[1]*t+s[4]*i+s[7],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this}clamp(e,t){return this.x=yt(this.x,e.x,t.x),this.y=yt(this.y,e.y,t.y),this}clampScalar(e,t){return this.x=yt(this.x,e,t),this.y=yt(this.y,e,t),this}clampLength(e,t){let i=this.length();return this.divideScalar(i||1).multiplyScalar(yt(i,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(e){return this.x*e.x+this.y*e.y}cross(e){return this.x*e.y-this.y*e.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let i=this.dot(e)/t;return Math.acos(yt(i,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,i=this.y-e.y;return t*t+i*i}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this}lerpVectors(e,t,i){return this.x=e.x+(t.x-e.x)*i,this.y=e.y+(t.y-e.y)*i,this}equals(e){return e.x===this.x&&e.y===this.y}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this}rotateAround(e,t){let i=Math.cos(t),s=Math.sin(t),r=this.x-e.x,o=this.y-e.y;return this.x=r*i-o*s+e.x,this.y=r*s+o*i+e.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}},li=class{constructor(e=0,t=0,i=0,s=1){this.isQuaternion=!0,this._x=e,this._y=t,this._z=i,this._w=s}static slerpFlat(e,t,i,s,r,o,a){let l=i[s+0],c=i[s+1],h=i[s+2],u=i[s+3],f=r[o+0],d=r[o+1],g=r[o+2],_=r[o+3];if(u!==_||l!==f||c!==d||h!==g){let m=l*f+c*d+h*g+u*_;m<0&&(f=-f,d=-d,g=-g,_=-_,m=-m);let p=1-a;if(m<.9995){let x=Math.acos(m),A=Math.sin(x);p=Math.sin(p*x)/A,a=Math.sin(a*x)/A,l=l*p+f*a,c=c*p+d*a,h=h*p+g*a,u=u*p+_*a}else{l=l*p+f*a,c=c*p+d*a,h=h*p+g*a,u=u*p+_*a;let x=1/Math.sqrt(l*l+c*c+h*h+u*u);l*=x,c*=x,h*=x,u*=x}}e[t]=l,e[t+1]=c,e[t+2]=h,e[t+3]=u}static multiplyQuaternionsFlat(e,t,i,s,r,o){let a=i[s],l=i[s+1],c=i[s+2],h=i[s+3],u=r[o],f=r[o+1],d=r[o+2],g=r[o+3];return e[t]=a*g+h*u+l*d-c*f,e[t+1]=l*g+h*f+c*u-a*d,e[t+2]=c*g+h*d+a*f-l*u,e[t+3]=h*g-a*u-l*f-c*d,e}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get w(){return this._w}set w(e){this._w=e,this._onChangeCallback()}set(e,t,i,s){return this._x=e,this._y=t,this._z=i,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(e){return this._x=e.x,this._y=e.y,this._z=e.z,this._w=e.w,this._onChangeCallback(),this}setFromEuler(e,t=!0){let i=e._x,s=e._y,r=e._z,o=e._order,a=Math.cos,l=Math.sin,c=a(i/2),h=a(s/2),u=a(r/2),f=l(i/2),d=l(s/2),g=l(r/2);switch(o){case"XYZ":this._x=f*h*u+c*d*g,this._y=c*d*u-f*h*g,this._z=c*h*g+f*d*u,this._w=c*h*u-f*d*g;break;case"YXZ":this._x=f*h*u+c*d*g,this._y=c*d*u-f*h*g,this._z=c*h*g-f*d*u,this._w=c*h*u+f*d*g;break;case"ZXY":this._x=f*h*u-c*d*g,this._y=c*d*u+f*h*g,this._z=c*h*g+f*d*u,this._w=c*h*u-f*d*g;break;case"ZYX":this._x=f*h*u-c*d*g,this._y=c*d*u+f*h*g,this._z=c*h*g-f*d*u,this._w=c*h*u+f*d*g;break;case"YZX":this._x=f*h*u+c*d*g,this._y=c*d*u+f*h*g,this._z=c*h*g-f*d*u,this._w=c*h*u-f*d*g;break;case"XZY":this._x=f*h*u-c*d*g,this._y=c*d*u-f*h*g,this._z=c*h*g+f*d*u,this._w=c*h*u+f*d*g;break;default:Je("Quaternion: .setFromEuler() encountered an unknown order: "+o)}return t===!0&&this._onChangeCallback(),this}setFromAxisAngle(e,t){let i=t/2,s=Math.sin(i);return this._x=e.x*s,this._y=e.y*s,this._z=e.z*s,this._w=Math.cos(i),this._onChangeCallback(),this}setFromRotationMatrix(e){let t=e.elements,i=t[0],s=t[4],r=t[8],o=t[1],a=t[5],l=t[9],c=t[2],h=t[6],u=t[10],f=i+a+u;if(f>0){let d=.5/Math.sqrt(f+1);this._w=.25/d,this._x=(h-l)*d,this._y=(r-c)*d,this._z=(o-s)*d}else if(i>a&&i>u){let d=2*Math.sqrt(1+i-a-u);this._w=(h-l)/d,this._x=.25*d,this._y=(s+o)/d,this._z=(r+c)/d}else if(a>u){let d=2*Math.sqrt(1+a-i-u);this._w=(r-c)/d,this._x=(s+o)/d,this._y=.25*d,this._z=(l+h)/d}else{let d=2*Math.sqrt(1+u-i-a);this._w=(o-s)/d,this._x=(r+c)/d,this._y=(l+h)/d,this._z=.25*d}return this._onChangeCallback(),this}setFromUnitVectors(e,t){let i=e.dot(t)+1;return i<1e-8?(i=0,Math.abs(e.x)>Math.abs(e.z)?(this._x=-e.y,this._y=e.x,this._z=0,this._w=i):(this._x=0,this._y=-e.z,this._z=e.y,this._w=i)):(this._x=e.y*t.z-e.z*t.y,this._y=e.z*t.x-e.x*t.z,this._z=e.x*t.y-e.y*t.x,this._w=i),this.normalize()}angleTo(e){return 2*Math.acos(Math.abs(yt(this.dot(e),-1,1)))}rotateTowards(e,t){let i=this.angleTo(e);if(i===0)return this;let s=Math.min(1,t/i);return this.slerp(e,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(e){return this._x*e._x+this._y*e._y+this._z*e._z+this._w*e._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let e=this.length();return e===0?(this._x=0,this._y=0,this._z=0,this._w=1):(e=1/e,this._x=this._x*e,this._y=this._y*e,this._z=this._z*e,this._w=this._w*e),this._onChangeCallback(),this}multiply(e){return this.multiplyQuaternions(this,e)}premultiply(e){return this.multiplyQuaternions(e,this)}multiplyQuaternions(e,t){let i=e._x,s=e._y,r=e._z,o=e._w,a=t._x,l=t._y,c=t._z,h=t._w;return this._x=i*h+o*a+s*c-r*l,this._y=s*h+o*l+r*a-i*c,this._z=r*h+o*c+i*l-s*a,this._w=o*h-i*a-s*l-r*c,this._onChangeCallback(),this}slerp(e,t){let i=e._x,s=e._y,r=e._z,o=e._w,a=this.dot(e);a<0&&(i=-i,s=-s,r=-r,o=-o,a=-a);let l=1-t;if(a<.9995){let c=Math.acos(a),h=Math.sin(c);l=Math.sin(l*c)/h,t=Math.sin(t*c)/h,this._x=this._x*l+i*t,this._y=this._y*l+s*t,this._z=this._z*l+r*t,this._w=this._w*l+o*t,this._onChangeCallback()}else this._x=this._x*l+i*t,this._y=this._y*l+s*t,this._z=this._z*l+r*t,this._w=this._w*l+o*t,this.normalize();return this}slerpQuaternions(e,t,i){return this.copy(e).slerp(t,i)}random(){let e=2*Math.PI*Math.random(),t=2*Math.PI*Math.random(),i=Math.random(),s=Math.sqrt(1-i),r=Math.sqrt(i);return this.set(s*Math.sin(e),s*Math.cos(e),r*Math.sin(t),r*Math.cos(t))}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._w===this._w}fromArray(e,t=0){return this._x=e[t],this._y=e[t+1],this._z=e[t+2],this._w=e[t+3],this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._w,e}fromBufferAttribute(e,t){return this._x=e.getX(t),this._y=e.getY(t),this._z=e.getZ(t),this._w=e.getW(t),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},O=class{static{this.prototype.isVector3=!0}constructor(e=0,t=0,i=0){this.x=e,this.y=t,this.z=i}set(e,t,i){return i===void 0&&(i=this.z),this.x=e,this.y=t,this.z=i,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;default:throw new Error("THREE.Vector3: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this}multiplyVectors(e,t){return this.x=e.x*t.x,this.y=e.y*t.y,this.z=e.z*t.z,this}applyEuler(e){return this.applyQuaternion(J0.setFromEuler(e))}applyAxisAngle(e,t){return this.applyQuaternion(J0.setFromAxisAngle(e,t))}applyMatrix3(e){let t=this.x,i=this.y,s=this.z,r=e.elements;return this.x=r[0]*t+r[3]*i+r[6]*s,this.y=r[1]*t+r[4]*i+r[7]*s,this.z=r[2]*t+r[5]*i+r[8]*s,this}applyNormalMatrix(e){return this.applyMatrix3(e).normalize()}applyMatrix4(e){let t=this.x,i=this.y,s=this.z,r=e.elements,o=1/(r[3]*t+r[7]*i+r[11]*s+r[15]);return this.x=(r[0]*t+r[4]*i+r[8]*s+r[12])*o,this.y=(r[1]*t+r[5]*i+r[9]*s+r[13])*o,this.z=(r[2]*t+r[6]*i+r[10]*s+r[14])*o,this}applyQuaternion(e){let t=this.x,i=this.y,s=this.z,r=e.x,o=e.y,a=e.z,l=e.w,c=2*(o*s-a*i),h=2*(a*t-r*s),u=2*(r*i-o*t);return this.x=t+l*c+o*u-a*h,this.y=i+l*h+a*c-r*u,this.z=s+l*u+r*h-o*c,this}project(e){return this.applyMatrix4(e.matrixWorldInverse).applyMatrix4(e.projectionMatrix)}unproject(e){return this.applyMatrix4(e.projectionMatrixInverse).applyMatrix4(e.matrixWorld)}transformDirection(e){let t=this.x,i=this.y,s=this.z,r=e.elements;return this.x=r[0]*t+r[4]*i+r[8]*s,this.y=r[1]*t+r[5]*i+r[9]*s,this.z=r[2]*t+r[6]*i+r[10]*s,this.normalize()}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this}divideScalar(e){return this.multiplyScalar(1/e)}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this}clamp(e,t){return this.x=yt(this.x,e.x,t.x),this.y=yt(this.y,e.y,t.y),this.z=yt(this.z,e.z,t.z),this}clampScalar(e,t){return this.x=yt(this.x,e,t),this.y=yt(this.y,e,t),this.z=yt(this.z,e,t),this}clampLength(e,t){let i=this.length();return this.divideScalar(i||1).multiplyScalar(yt(i,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this}lerpVectors(e,t,i){return this.x=e.x+(t.x-e.x)*i,this.y=e.y+(t.y-e.y)*i,this.z=e.z+(t.z-e.z)*i,this}cross(e){return this.crossVectors(this,e)}crossVectors(e,t){let i=e.x,s=e.y,r=e.z,o=t.x,a=t.y,l=t.z;return this.x=s*l-r*a,this.y=r*o-i*l,this.z=i*a-s*o,this}projectOnVector(e){let t=e.lengthSq();if(t===0)return this.set(0,0,0);let i=e.dot(this)/t;return this.copy(e).multiplyScalar(i)}projectOnPlane(e){return Dd.copy(this).projectOnVector(e),this.sub(Dd)}reflect(e){return this.sub(Dd.copy(e).multiplyScalar(2*this.dot(e)))}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let i=this.dot(e)/t;return Math.acos(yt(i,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,i=this.y-e.y,s=this.z-e.z;return t*t+i*i+s*s}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)+Math.abs(this.z-e.z)}setFromSpherical(e){return this.setFromSphericalCoords(e.radius,e.phi,e.theta)}setFromSphericalCoords(e,t,i){let s=Math.sin(t)*e;return this.x=s*Math.sin(i),this.y=Math.cos(t)*e,this.z=s*Math.cos(i),this}setFromCylindrical(e){return this.setFromCylindricalCoords(e.radius,e.theta,e.y)}setFromCylindricalCoords(e,t,i){return this.x=e*Math.sin(t),this.y=i,this.z=e*Math.cos(t),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this}setFromMatrixScale(e){let t=this.setFromMatrixColumn(e,0).length(),i=this.setFromMatrixColumn(e,1).length(),s=this.setFromMatrixColumn(e,2).length();return this.x=t,this.y=i,this.z=s,this}setFromMatrixColumn(e,t){return this.fromArray(e.elements,t*4)}setFromMatrix3Column(e,t){return this.fromArray(e.elements,t*3)}setFromEuler(e){return this.x=e._x,this.y=e._y,this.z=e._z,this}setFromColor(e){return this.x=e.r,this.y=e.g,this.z=e.b,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let e=Math.random()*Math.PI*2,t=Math.random()*2-1,i=Math.sqrt(1-t*t);return this.x=i*Math.cos(e),this.y=t,this.z=i*Math.sin(e),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}},Dd=new O,J0=new li,Qe=class{static{this.prototype.isMatrix3=!0}constructor(e,t,i,s,r,o,a,l,c){this.elements=[1,0,0,0,1,0,0,0,1],e!==void 0&&this.set(e,t,i,s,r,o,a,l,c)}set(e,t,i,s,r,o,a,l,c){let h=this.elements;return h[0]=e,h[1]=s,h[2]=a,h[3]=t,h[4]=r,h[5]=l,h[6]=i,h[7]=o,h[8]=c,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(e){let t=this.elements,i=e.elements;return t[0]=i[0],t[1]=i[1],t[2]=i[2],t[3]=i[3],t[4]=i[4],t[5]=i[5],t[6]=i[6],t[7]=i[7],t[8]=i[8],this}extractBasis(e,t,i){return e.setFromMatrix3Column(this,0),t.setFromMatrix3Column(this,1),i.setFromMatrix3Column(this,2),this}setFromMatrix4(e){let t=e.elements;return this.set(t[0],t[4],t[8],t[1],t[5],t[9],t[2],t[6],t[10]),this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let i=e.elements,s=t.elements,r=this.elements,o=i[0],a=i[3],l=i[6],c=i[1],h=i[4],u=i[7],f=i[2],d=i[5],g=i[8],_=s[0],m=s[3],p=s[6],x=s[1],A=s[4],w=s[7],P=s[2],E=s[5],y=s[8];return r[0]=o*_+a*x+l*P,r[3]=o*m+a*A+l*E,r[6]=o*p+a*w+l*y,r[1]=c*_+h*x+u*P,r[4]=c*m+h*A+u*E,r[7]=c*p+h*w+u*y,r[2]=f*_+d*x+g*P,r[5]=f*m+d*A+g*E,r[8]=f*p+d*w+g*y,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[3]*=e,t[6]*=e,t[1]*=e,t[4]*=e,t[7]*=e,t[2]*=e,t[5]*=e,t[8]*=e,this}determinant(){let e=this.elements,t=e[0],i=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8];return t*o*h-t*a*c-i*r*h+i*a*l+s*r*c-s*o*l}invert(){let e=this.elements,t=e[0],i=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8],u=h*o-a*c,f=a*l-h*r,d=c*r-o*l,g=t*u+i*f+s*d;if(g===0)return this.set(0,0,0,0,0,0,0,0,0);let _=1/g;return e[0]=u*_,e[1]=(s*c-h*i)*_,e[2]=(a*i-s*o)*_,e[3]=f*_,e[4]=(h*t-s*l)*_,e[5]=(s*r-a*t)*_,e[6]=d*_,e[7]=(i*l-c*t)*_,e[8]=(o*t-i*r)*_,this}transpose(){let e,t=this.elements;return e=t[1],t[1]=t[3],t[3]=e,e=t[2],t[2]=t[6],t[6]=e,e=t[5],t[5]=t[7],t[7]=e,this}getNormalMatrix(e){return this.setFromMatrix4(e).invert().transpose()}transposeIntoArray(e){let t=this.elements;return e[0]=t[0],e[1]=t[3],e[2]=t[6],e[3]=t[1],e[4]=t[4],e[5]=t[7],e[6]=t[2],e[7]=t[5],e[8]=t[8],this}setUvTransform(e,t,i,s,r,o,a){let l=Math.cos(r),c=Math.sin(r);return this.set(i*l,i*c,-i*(l*o+c*a)+o+e,-s*c,s*l,-s*(-c*o+l*a)+a+t,0,0,1),this}scale(e,t){return gl("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(Ld.makeScale(e,t)),this}rotate(e){return gl("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(Ld.makeRotation(-e)),this}translate(e,t){return gl("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(Ld.makeTranslation(e,t)),this}makeTranslation(e,t){return e.isVector2?this.set(1,0,e.x,0,1,e.y,0,0,1):this.set(1,0,e,0,1,t,0,0,1),this}makeRotation(e){let t=Math.cos(e),i=Math.sin(e);return this.set(t,-i,0,i,t,0,0,0,1),this}makeScale(e,t){return this.set(e,0,0,0,t,0,0,0,1),this}equals(e){let t=this.elements,i=e.elements;for(let s=0;s<9;s++)if(t[s]!==i[s])return!1;return!0}fromArray(e,t=0){for(let i=0;i<9;i++)this.elements[i]=e[i+t];return this}toArray(e=[],t=0){let i=this.elements;return e[t]=i[0],e[t+1]=i[1],e[t+2]=i[2],e[t+3]=i[3],e[t+4]=i[4],e[t+5]=i[5],e[t+6]=i[6],e[t+7]=i[7],e[t+8]=i[8],e}clone(){return new this.constructor().fromArray(this.elements)}},Ld=new Qe,j0=new Qe().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),Q0=new Qe().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function jM(){let n={enabled:!0,workingColorSpace:xl,spaces:{},convert:function(s,r,o){return this.enabled===!1||r===o||!r||!o||(this.spaces[r].transfer===Ft&&(s.r=$s(s.r),s.g=$s(s.g),s.b=$s(s.b)),this.spaces[r].primaries!==this.spaces[o].primaries&&(s.applyMatrix3(this.spaces[r].toXYZ),s.applyMatrix3(this.spaces[o].fromXYZ)),this.spaces[o].transfer===Ft&&(s.r=jo(s.r),s.g=jo(s.g),s.b=jo(s.b))),s},workingToColorSpace:function(s,r){return this.convert(s,this.workingColorSpace,r)},colorSpaceToWorking:function(s,r){return this.convert(s,r,this.workingColorSpace)},getPrimaries:function(s){return this.spaces[s].primaries},getTransfer:function(s){return s===nr?Sl:this.spaces[s].transfer},getToneMappingMode:function(s){return this.spaces[s].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(s,r=this.workingColorSpace){return s.fromArray(this.spaces[r].luminanceCoefficients)},define:function(s){Object.assign(this.spaces,s)},_getMatrix:function(s,r,o){return s.copy(this.spaces[o].fromXYZ).multiply(this.spaces[r].toXYZ)},_getDrawingBufferColorSpace:function(s){return this.spaces[s].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(s=this.workingColorSpace){return this.spaces[s].workingColorSpaceConfig.unpackColorSpace}},e=[.64,.33,.3,.6,.15,.06],t=[.2126,.7152,.0722],i=[.3127,.329];return n.define({[xl]:{primaries:e,whitePoint:i,transfer:Sl,toXYZ:j0,fromXYZ:Q0,luminanceCoefficients:t,workingColorSpaceConfig:{unpackColorSpace:Ai},outputColorSpaceConfig:{drawingBufferColorSpace:Ai}},[Ai]:{primaries:e,whitePoint:i,transfer:Ft,toXYZ:j0,fromXYZ:Q0,luminanceCoefficients:t,outputColorSpaceConfig:{drawingBufferColorSpace:Ai}}}),n}var bt=jM();function $s(n){return n<.04045?n*.0773993808:Math.pow(n*.9478672986+.0521327014,2.4)}function jo(n){return n<.0031308?n*12.92:1.055*Math.pow(n,.41666)-.055}var Uo,Oh=class{static getDataURL(e,t="image/png"){if(/^data:/i.test(e.src)||typeof HTMLCanvasElement>"u")return e.src;let i;if(e instanceof HTMLCanvasElement)i=e;else{Uo===void 0&&(Uo=bl("canvas")),Uo.width=e.width,Uo.height=e.height;let s=Uo.getContext("2d");e instanceof ImageData?s.putImageData(e,0,0):s.drawImage(e,0,0,e.width,e.height),i=Uo}return i.toDataURL(t)}static sRGBToLinear(e){if(typeof HTMLImageElement<"u"&&e instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&e instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&e instanceof ImageBitmap){let t=bl("canvas");t.width=e.width,t.height=e.height;let i=t.getContext("2d");i.drawImage(e,0,0,e.width,e.height);let s=i.getImageData(0,0,e.width,e.height),r=s.data;for(let o=0;o<r.length;o++)r[o]=$s(r[o]/255)*255;return i.putImageData(s,0,0),t}else if(e.data){let t=e.data.slice(0);for(let i=0;i<t.length;i++)t instanceof Uint8Array||t instanceof Uint8ClampedArray?t[i]=Math.floor($s(t[i]/255)*255):t[i]=$s(t[i]);return{data:t,width:e.width,height:e.height}}else return Je("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),e}},QM=0,ia=class{constructor(e=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:QM++}),this.uuid=Dr(),this.data=e,this.dataReady=!0,this.version=0}getSize(e){let t=this.data;return typeof HTMLVideoElement<"u"&&t instanceof HTMLVideoElement?e.set(t.videoWidth,t.videoHeight,0):typeof VideoFrame<"u"&&t instanceof VideoFrame?e.set(t.displayWidth,t.displayHeight,0):t!==null?e.set(t.width||0,t.height||0,t.depth||0):e.set(0,0,0),e}set needsUpdate(e){e===!0&&this.version++}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.images[this.uuid]!==void 0)return e.images[this.uuid];let i={uuid:this.uuid,url:""},s=this.data;if(s!==null){let r;if(Array.isArray(s)){r=[];for(let o=0,a=s.length;o<a;o++)s[o].isDataTexture?r.push(Nd(s[o].image)):r.push(Nd(s[o]))}else r=Nd(s);i.url=r}return t||(e.images[this.uuid]=i),i}};function Nd(n){return typeof HTMLImageElement<"u"&&n instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&n instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&n instanceof ImageBitmap?Oh.getDataURL(n):n.data?{data:Array.from(n.data),width:n.width,height:n.height,type:n.data.constructor.name}:(Je("Texture: Unable to serialize Texture."),{})}var ew=0,Ud=new O,ci=class n extends ji{constructor(e=n.DEFAULT_IMAGE,t=n.DEFAULT_MAPPING,i=Ms,s=Ms,r=ai,o=er,a=ss,l=di,c=n.DEFAULT_ANISOTROPY,h=nr){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:ew++}),this.uuid=Dr(),this.name="",this.source=new ia(e),this.mipmaps=[],this.mapping=t,this.channel=0,this.wrapS=i,this.wrapT=s,this.magFilter=r,this.minFilter=o,this.anisotropy=c,this.format=a,this.internalFormat=null,this.type=l,this.offset=new $e(0,0),this.repeat=new $e(1,1),this.center=new $e(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new Qe,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=h,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(e&&e.depth&&e.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(Ud).x}get height(){return this.source.getSize(Ud).y}get depth(){return this.source.getSize(Ud).z}get image(){return this.source.data}set image(e){this.source.data=e}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(e){return this.name=e.name,this.source=e.source,this.mipmaps=e.mipmaps.slice(0),this.mapping=e.mapping,this.channel=e.channel,this.wrapS=e.wrapS,this.wrapT=e.wrapT,this.magFilter=e.magFilter,this.minFilter=e.minFilter,this.anisotropy=e.anisotropy,this.format=e.format,this.internalFormat=e.internalFormat,this.type=e.type,this.normalized=e.normalized,this.offset.copy(e.offset),this.repeat.copy(e.repeat),this.center.copy(e.center),this.rotation=e.rotation,this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrix.copy(e.matrix),this.generateMipmaps=e.generateMipmaps,this.mipmapsAutoUpdate=e.mipmapsAutoUpdate,this.premultiplyAlpha=e.premultiplyAlpha,this.flipY=e.flipY,this.unpackAlignment=e.unpackAlignment,this.colorSpace=e.colorSpace,this.renderTarget=e.renderTarget,this.isRenderTargetTexture=e.isRenderTargetTexture,this.isPMREMTexture=e.isPMREMTexture,this.isArrayTexture=e.isArrayTexture,this.userData=JSON.parse(JSON.stringify(e.userData)),this.needsUpdate=!0,this}setValues(e){for(let t in e){let i=e[t];if(i===void 0){Je(`Texture.setValues(): parameter '${t}' has value of undefined.`);continue}let s=this[t];if(s===void 0){Je(`Texture.setValues(): property '${t}' does not exist.`);continue}s&&i&&s.isVector2&&i.isVector2||s&&i&&s.isVector3&&i.isVector3||s&&i&&s.isMatrix3&&i.isMatrix3?s.copy(i):this[t]=i}}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.textures[this.uuid]!==void 0)return e.textures[this.uuid];let i={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(e).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(i.userData=this.userData),t||(e.textures[this.uuid]=i),i}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(e){if(this.mapping!==Sp)return e;if(e.applyMatrix3(this.matrix),e.x<0||e.x>1)switch(this.wrapS){case Nh:e.x=e.x-Math.floor(e.x);break;case Ms:e.x=e.x<0?0:1;break;case Uh:Math.abs(Math.floor(e.x)%2)===1?e.x=Math.ceil(e.x)-e.x:e.x=e.x-Math.floor(e.x);break}if(e.y<0||e.y>1)switch(this.wrapT){case Nh:e.y=e.y-Math.floor(e.y);break;case Ms:e.y=e.y<0?0:1;break;case Uh:Math.abs(Math.floor(e.y)%2)===1?e.y=Math.ceil(e.y)-e.y:e.y=e.y-Math.floor(e.y);break}return this.flipY&&(e.y=1-e.y),e}set needsUpdate(e){e===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(e){e===!0&&this.pmremVersion++}};ci.DEFAULT_IMAGE=null;ci.DEFAULT_MAPPING=Sp;ci.DEFAULT_ANISOTROPY=1;var rn=class{static{this.prototype.isVector4=!0}constructor(e=0,t=0,i=0,s=1){this.x=e,this.y=t,this.z=i,this.w=s}get width(){return this.z}set width(e){this.z=e}get height(){return this.w}set height(e){this.w=e}set(e,t,i,s){return this.x=e,this.y=t,this.z=i,this.w=s,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this.w=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setW(e){return this.w=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;case 3:this.w=t;break;default:throw new Error("THREE.Vector4: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this.w=e.w!==void 0?e.w:1,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this.w+=e.w,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this.w+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this.w=e.w+t.w,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this.w+=e.w*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this.w-=e.w,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this.w-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this.w=e.w-t.w,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this.w*=e.w,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this.w*=e,this}applyMatrix4(e){let t=this.x,i=this.y,s=this.z,r=this.w,o=e.elements;return this.x=o[0]*t+o[4]*i+o[8]*s+o[12]*r,this.y=o[1]*t+o[5]*i+o[9]*s+o[13]*r,this.z=o[2]*t+o[6]*i+o[10]*s+o[14]*r,this.w=o[3]*t+o[7]*i+o[11]*s+o[15]*r,this}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this.w/=e.w,this}divideScalar(e){return this.multiplyScalar(1/e)}setAxisAngleFromQuaternion(e){this.w=2*Math.acos(e.w);let t=Math.sqrt(1-e.w*e.w);return t<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=e.x/t,this.y=e.y/t,this.z=e.z/t),this}setAxisAngleFromRotationMatrix(e){let t,i,s,r,l=e.elements,c=l[0],h=l[4],u=l[8],f=l[1],d=l[5],g=l[9],_=l[2],m=l[6],p=l[10];if(Math.abs(h-f)<.01&&Math.abs(u-_)<.01&&Math.abs(g-m)<.01){if(Math.abs(h+f)<.1&&Math.abs(u+_)<.1&&Math.abs(g+m)<.1&&Math.abs(c+d+p-3)<.1)return this.set(1,0,0,0),this;t=Math.PI;let A=(c+1)/2,w=(d+1)/2,P=(p+1)/2,E=(h+f)/4,y=(u+_)/4,T=(g+m)/4;return A>w&&A>P?A<.01?(i=0,s=.707106781,r=.707106781):(i=Math.sqrt(A),s=E/i,r=y/i):w>P?w<.01?(i=.707106781,s=0,r=.707106781):(s=Math.sqrt(w),i=E/s,r=T/s):P<.01?(i=.707106781,s=.707106781,r=0):(r=Math.sqrt(P),i=y/r,s=T/r),this.set(i,s,r,t),this}let x=Math.sqrt((m-g)*(m-g)+(u-_)*(u-_)+(f-h)*(f-h));return Math.abs(x)<.001&&(x=1),this.x=(m-g)/x,this.y=(u-_)/x,this.z=(f-h)/x,this.w=Math.acos((c+d+p-1)/2),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this.w=t[15],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this.w=Math.min(this.w,e.w),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this.w=Math.max(this.w,e.w),this}clamp(e,t){return this.x=yt(this.x,e.x,t.x),this.y=yt(this.y,e.y,t.y),this.z=yt(this.z,e.z,t.z),this.w=yt(this.w,e.w,t.w),this}clampScalar(e,t){return this.x=yt(this.x,e,t),this.y=yt(this.y,e,t),this.z=yt(this.z,e,t),this.w=yt(this.w,e,t),this}clampLength(e,t){let i=this.length();return this.divideScalar(i||1).multiplyScalar(yt(i,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z+this.w*e.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this.w+=(e.w-this.w)*t,this}lerpVectors(e,t,i){return this.x=e.x+(t.x-e.x)*i,this.y=e.y+(t.y-e.y)*i,this.z=e.z+(t.z-e.z)*i,this.w=e.w+(t.w-e.w)*i,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z&&e.w===this.w}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this.w=e[t+3],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e[t+3]=this.w,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this.w=e.getW(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}},kh=class extends ji{constructor(e=1,t=1,i={}){super(),i=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:ai,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},i),this.isRenderTarget=!0,this.width=e,this.height=t,this.depth=i.depth,this.scissor=new rn(0,0,e,t),this.scissorTest=!1,this.viewport=new rn(0,0,e,t),this.textures=[];let s=i.count;for(let r=0;r<s;r++)this.textures[r]=new ci({width:e,height:t,depth:i.depth}),this.textures[r].isRenderTargetTexture=!0,this.textures[r].renderTarget=this;this._setTextureOptions(i),this.depthBuffer=i.depthBuffer,this.stencilBuffer=i.stencilBuffer,this.resolveColorBuffer=i.resolveColorBuffer,this.resolveDepthBuffer=i.resolveDepthBuffer,this.resolveStencilBuffer=i.resolveStencilBuffer,this.storeMultisampledColorBuffer=i.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=i.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=i.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=i.depthTexture,this.samples=i.samples,this.multiview=i.multiview,this.useArrayDepthTexture=i.useArrayDepthTexture}_setTextureOptions(e={}){let t={minFilter:ai,generateMipmaps:!1,flipY:!1,internalFormat:null};e.mapping!==void 0&&(t.mapping=e.mapping),e.wrapS!==void 0&&(t.wrapS=e.wrapS),e.wrapT!==void 0&&(t.wrapT=e.wrapT),e.wrapR!==void 0&&(t.wrapR=e.wrapR),e.magFilter!==void 0&&(t.magFilter=e.magFilter),e.minFilter!==void 0&&(t.minFilter=e.minFilter),e.format!==void 0&&(t.format=e.format),e.type!==void 0&&(t.type=e.type),e.anisotropy!==void 0&&(t.anisotropy=e.anisotropy),e.colorSpace!==void 0&&(t.colorSpace=e.colorSpace),e.flipY!==void 0&&(t.flipY=e.flipY),e.generateMipmaps!==void 0&&(t.generateMipmaps=e.generateMipmaps),e.mipmapsAutoUpdate!==void 0&&(t.mipmapsAutoUpdate=e.mipmapsAutoUpdate),e.internalFormat!==void 0&&(t.internalFormat=e.internalFormat);for(let i=0;i<this.textures.length;i++)this.textures[i].setValues(t)}get texture(){return this.textures[0]}set texture(e){this.textures[0]=e}set depthTexture(e){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),e!==null&&e.renderTarget===null&&(e.renderTarget=this),this._depthTexture=e}get depthTexture(){return this._depthTexture}setSize(e,t,i=1){if(this.width!==e||this.height!==t||this.depth!==i){this.width=e,this.height=t,this.depth=i;for(let s=0,r=this.textures.length;s<r;s++)this.textures[s].image.width=e,this.textures[s].image.height=t,this.textures[s].image.depth=i,this.textures[s].isData3DTexture!==!0&&(this.textures[s].isArrayTexture=this.textures[s].image.depth>1);this.dispose()}this.viewport.set(0,0,e,t),this.scissor.set(0,0,e,t)}clone(){return new this.constructor().copy(this)}copy(e){this.width=e.width,this.height=e.height,this.depth=e.depth,this.scissor.copy(e.scissor),this.scissorTest=e.scissorTest,this.viewport.copy(e.viewport),this.textures.length=0;for(let t=0,i=e.textures.length;t<i;t++){this.textures[t]=e.textures[t].clone(),this.textures[t].isRenderTargetTexture=!0,this.textures[t].renderTarget=this;let s=Object.assign({},e.textures[t].image);this.textures[t].source=new ia(s)}if(this.depthBuffer=e.depthBuffer,this.stencilBuffer=e.stencilBuffer,this.resolveColorBuffer=e.resolveColorBuffer,this.resolveDepthBuffer=e.resolveDepthBuffer,this.resolveStencilBuffer=e.resolveStencilBuffer,this.storeMultisampledColorBuffer=e.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=e.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=e.storeMultisampledStencilBuffer,e.depthTexture!==null)if(e.depthTexture.renderTarget===e){let t=e.depthTexture.clone();t.renderTarget=null,this.depthTexture=t}else this.depthTexture=e.depthTexture;else this.depthTexture=null;return this.samples=e.samples,this.multiview=e.multiview,this.useArrayDepthTexture=e.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},Ri=class extends kh{constructor(e=1,t=1,i={}){super(e,t,i),this.isWebGLRenderTarget=!0}},wl=class extends ci{constructor(e=null,t=1,i=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:e,width:t,height:i,depth:s},this.magFilter=Hn,this.minFilter=Hn,this.wrapR=Ms,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}addLayerUpdate(e){this.layerUpdates.add(e)}clearLayerUpdates(){this.layerUpdates.clear()}};var Bh=class extends ci{constructor(e=null,t=1,i=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:e,width:t,height:i,depth:s},this.magFilter=Hn,this.minFilter=Hn,this.wrapR=Ms,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}};var Dt=class n{static{this.prototype.isMatrix4=!0}constructor(e,t,i,s,r,o,a,l,c,h,u,f,d,g,_,m){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],e!==void 0&&this.set(e,t,i,s,r,o,a,l,c,h,u,f,d,g,_,m)}set(e,t,i,s,r,o,a,l,c,h,u,f,d,g,_,m){let p=this.elements;return p[0]=e,p[4]=t,p[8]=i,p[12]=s,p[1]=r,p[5]=o,p[9]=a,p[13]=l,p[2]=c,p[6]=h,p[10]=u,p[14]=f,p[3]=d,p[7]=g,p[11]=_,p[15]=m,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new n().fromArray(this.elements)}copy(e){let t=this.elements,i=e.elements;return t[0]=i[0],t[1]=i[1],t[2]=i[2],t[3]=i[3],t[4]=i[4],t[5]=i[5],t[6]=i[6],t[7]=i[7],t[8]=i[8],t[9]=i[9],t[10]=i[10],t[11]=i[11],t[12]=i[12],t[13]=i[13],t[14]=i[14],t[15]=i[15],this}copyPosition(e){let t=this.elements,i=e.elements;return t[12]=i[12],t[13]=i[13],t[14]=i[14],this}setFromMatrix3(e){let t=e.elements;return this.set(t[0],t[3],t[6],0,t[1],t[4],t[7],0,t[2],t[5],t[8],0,0,0,0,1),this}extractBasis(e,t,i){return this.determinantAffine()===0?(e.set(1,0,0),t.set(0,1,0),i.set(0,0,1),this):(e.setFromMatrixColumn(this,0),t.setFromMatrixColumn(this,1),i.setFromMatrixColumn(this,2),this)}makeBasis(e,t,i){return this.set(e.x,t.x,i.x,0,e.y,t.y,i.y,0,e.z,t.z,i.z,0,0,0,0,1),this}extractRotation(e){if(e.determinantAffine()===0)return this.identity();let t=this.elements,i=e.elements,s=1/Fo.setFromMatrixColumn(e,0).length(),r=1/Fo.setFromMatrixColumn(e,1).length(),o=1/Fo.setFromMatrixColumn(e,2).length();return t[0]=i[0]*s,t[1]=i[1]*s,t[2]=i[2]*s,t[3]=0,t[4]=i[4]*r,t[5]=i[5]*r,t[6]=i[6]*r,t[7]=0,t[8]=i[8]*o,t[9]=i[9]*o,t[10]=i[10]*o,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromEuler(e){let t=this.elements,i=e.x,s=e.y,r=e.z,o=Math.cos(i),a=Math.sin(i),l=Math.cos(s),c=Math.sin(s),h=Math.cos(r),u=Math.sin(r);if(e.order==="XYZ"){let f=o*h,d=o*u,g=a*h,_=a*u;t[0]=l*h,t[4]=-l*u,t[8]=c,t[1]=d+g*c,t[5]=f-_*c,t[9]=-a*l,t[2]=_-f*c,t[6]=g+d*c,t[10]=o*l}else if(e.order==="YXZ"){let f=l*h,d=l*u,g=c*h,_=c*u;t[0]=f+_*a,t[4]=g*a-d,t[8]=o*c,t[1]=o*u,t[5]=o*h,t[9]=-a,t[2]=d*a-g,t[6]=_+f*a,t[10]=o*l}else if(e.order==="ZXY"){let f=l*h,d=l*u,g=c*h,_=c*u;t[0]=f-_*a,t[4]=-o*u,t[8]=g+d*a,t[1]=d+g*a,t[5]=o*h,t[9]=_-f*a,t[2]=-o*c,t[6]=a,t[10]=o*l}else if(e.order==="ZYX"){let f=o*h,d=o*u,g=a*h,_=a*u;t[0]=l*h,t[4]=g*c-d,t[8]=f*c+_,t[1]=l*u,t[5]=_*c+f,t[9]=d*c-g,t[2]=-c,t[6]=a*l,t[10]=o*l}else if(e.order==="YZX"){let f=o*l,d=o*c,g=a*l,_=a*c;t[0]=l*h,t[4]=_-f*u,t[8]=g*u+d,t[1]=u,t[5]=o*h,t[9]=-a*h,t[2]=-c*h,t[6]=d*u+g,t[10]=f-_*u}else if(e.order==="XZY"){let f=o*l,d=o*c,g=a*l,_=a*c;t[0]=l*h,t[4]=-u,t[8]=c*h,t[1]=f*u+_,t[5]=o*h,t[9]=d*u-g,t[2]=g*u-d,t[6]=a*h,t[10]=_*u+f}return t[3]=0,t[7]=0,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromQuaternion(e){return this.compose(tw,e,nw)}lookAt(e,t,i){let s=this.elements;return Ti.subVectors(e,t),Ti.lengthSq()===0&&(Ti.z=1),Ti.normalize(),mr.crossVectors(i,Ti),mr.lengthSq()===0&&(Math.abs(i.z)===1?Ti.x+=1e-4:Ti.z+=1e-4,Ti.normalize(),mr.crossVectors(i,Ti)),mr.normalize(),jc.crossVectors(Ti,mr),s[0]=mr.x,s[4]=jc.x,s[8]=Ti.x,s[1]=mr.y,s[5]=jc.y,s[9]=Ti.y,s[2]=mr.z,s[6]=jc.z,s[10]=Ti.z,this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let i=e.elements,s=t.elements,r=this.elements,o=i[0],a=i[4],l=i[8],c=i[12],h=i[1],u=i[5],f=i[9],d=i[13],g=i[2],_=i[6],m=i[10],p=i[14],x=i[3],A=i[7],w=i[11],P=i[15],E=s[0],y=s[4],T=s[8],k=s[12],N=s[1],I=s[5],z=s[9],W=s[13],L=s[2],X=s[6],$=s[10],V=s[14],ce=s[3],K=s[7],ee=s[11],se=s[15];return r[0]=o*E+a*N+l*L+c*ce,r[4]=o*y+a*I+l*X+c*K,r[8]=o*T+a*z+l*$+c*ee,r[12]=o*k+a*W+l*V+c*se,r[1]=h*E+u*N+f*L+d*ce,r[5]=h*y+u*I+f*X+d*K,r[9]=h*T+u*z+f*$+d*ee,r[13]=h*k+u*W+f*V+d*se,r[2]=g*E+_*N+m*L+p*ce,r[6]=g*y+_*I+m*X+p*K,r[10]=g*T+_*z+m*$+p*ee,r[14]=g*k+_*W+m*V+p*se,r[3]=x*E+A*N+w*L+P*ce,r[7]=x*y+A*I+w*X+P*K,r[11]=x*T+A*z+w*$+P*ee,r[15]=x*k+A*W+w*V+P*se,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[4]*=e,t[8]*=e,t[12]*=e,t[1]*=e,t[5]*=e,t[9]*=e,t[13]*=e,t[2]*=e,t[6]*=e,t[10]*=e,t[14]*=e,t[3]*=e,t[7]*=e,t[11]*=e,t[15]*=e,this}determinant(){let e=this.elements,t=e[0],i=e[4],s=e[8],r=e[12],o=e[1],a=e[5],l=e[9],c=e[13],h=e[2],u=e[6],f=e[10],d=e[14],g=e[3],_=e[7],m=e[11],p=e[15],x=l*d-c*f,A=a*d-c*u,w=a*f-l*u,P=o*d-c*h,E=o*f-l*h,y=o*u-a*h;return t*(_*x-m*A+p*w)-i*(g*x-m*P+p*E)+s*(g*A-_*P+p*y)-r*(g*w-_*E+m*y)}determinantAffine(){let e=this.elements,t=e[0],i=e[4],s=e[8],r=e[1],o=e[5],a=e[9],l=e[2],c=e[6],h=e[10];return t*(o*h-a*c)-i*(r*h-a*l)+s*(r*c-o*l)}transpose(){let e=this.elements,t;return t=e[1],e[1]=e[4],e[4]=t,t=e[2],e[2]=e[8],e[8]=t,t=e[6],e[6]=e[9],e[9]=t,t=e[3],e[3]=e[12],e[12]=t,t=e[7],e[7]=e[13],e[13]=t,t=e[11],e[11]=e[14],e[14]=t,this}setPosition(e,t,i){let s=this.elements;return e.isVector3?(s[12]=e.x,s[13]=e.y,s[14]=e.z):(s[12]=e,s[13]=t,s[14]=i),this}invert(){let e=this.elements,t=e[0],i=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8],u=e[9],f=e[10],d=e[11],g=e[12],_=e[13],m=e[14],p=e[15],x=t*a-i*o,A=t*l-s*o,w=t*c-r*o,P=i*l-s*a,E=i*c-r*a,y=s*c-r*l,T=h*_-u*g,k=h*m-f*g,N=h*p-d*g,I=u*m-f*_,z=u*p-d*_,W=f*p-d*m,L=x*W-A*z+w*I+P*N-E*k+y*T;if(L===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let X=1/L;return e[0]=(a*W-l*z+c*I)*X,e[1]=(s*z-i*W-r*I)*X,e[2]=(_*y-m*E+p*P)*X,e[3]=(f*E-u*y-d*P)*X,e[4]=(l*N-o*W-c*k)*X,e[5]=(t*W-s*N+r*k)*X,e[6]=(m*w-g*y-p*A)*X,e[7]=(h*y-f*w+d*A)*X,e[8]=(o*z-a*N+c*T)*X,e[9]=(i*N-t*z-r*T)*X,e[10]=(g*E-_*w+p*x)*X,e[11]=(u*w-h*E-d*x)*X,e[12]=(a*k-o*I-l*T)*X,e[13]=(t*I-i*k+s*T)*X,e[14]=(_*A-g*P-m*x)*X,e[15]=(h*P-u*A+f*x)*X,this}scale(e){let t=this.elements,i=e.x,s=e.y,r=e.z;return t[0]*=i,t[4]*=s,t[8]*=r,t[1]*=i,t[5]*=s,t[9]*=r,t[2]*=i,t[6]*=s,t[10]*=r,t[3]*=i,t[7]*=s,t[11]*=r,this}getMaxScaleOnAxis(){let e=this.elements,t=e[0]*e[0]+e[1]*e[1]+e[2]*e[2],i=e[4]*e[4]+e[5]*e[5]+e[6]*e[6],s=e[8]*e[8]+e[9]*e[9]+e[10]*e[10];return Math.sqrt(Math.max(t,i,s))}makeTranslation(e,t,i){return e.isVector3?this.set(1,0,0,e.x,0,1,0,e.y,0,0,1,e.z,0,0,0,1):this.set(1,0,0,e,0,1,0,t,0,0,1,i,0,0,0,1),this}makeRotationX(e){let t=Math.cos(e),i=Math.sin(e);return this.set(1,0,0,0,0,t,-i,0,0,i,t,0,0,0,0,1),this}makeRotationY(e){let t=Math.cos(e),i=Math.sin(e);return this.set(t,0,i,0,0,1,0,0,-i,0,t,0,0,0,0,1),this}makeRotationZ(e){let t=Math.cos(e),i=Math.sin(e);return this.set(t,-i,0,0,i,t,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(e,t){let i=Math.cos(t),s=Math.sin(t),r=1-i,o=e.x,a=e.y,l=e.z,c=r*o,h=r*a;return this.set(c*o+i,c*a-s*l,c*l+s*a,0,c*a+s*l,h*a+i,h*l-s*o,0,c*l-s*a,h*l+s*o,r*l*l+i,0,0,0,0,1),this}makeScale(e,t,i){return this.set(e,0,0,0,0,t,0,0,0,0,i,0,0,0,0,1),this}makeShear(e,t,i,s,r,o){return this.set(1,i,r,0,e,1,o,0,t,s,1,0,0,0,0,1),this}compose(e,t,i){let s=this.elements,r=t._x,o=t._y,a=t._z,l=t._w,c=r+r,h=o+o,u=a+a,f=r*c,d=r*h,g=r*u,_=o*h,m=o*u,p=a*u,x=l*c,A=l*h,w=l*u,P=i.x,E=i.y,y=i.z;return s[0]=(1-(_+p))*P,s[1]=(d+w)*P,s[2]=(g-A)*P,s[3]=0,s[4]=(d-w)*E,s[5]=(1-(f+p))*E,s[6]=(m+x)*E,s[7]=0,s[8]=(g+A)*y,s[9]=(m-x)*y,s[10]=(1-(f+_))*y,s[11]=0,s[12]=e.x,s[13]=e.y,s[14]=e.z,s[15]=1,this}decompose(e,t,i){let s=this.elements;e.x=s[12],e.y=s[13],e.z=s[14];let r=this.determinantAffine();if(r===0)return i.set(1,1,1),t.identity(),this;let o=Fo.set(s[0],s[1],s[2]).length(),a=Fo.set(s[4],s[5],s[6]).length(),l=Fo.set(s[8],s[9],s[10]).length();r<0&&(o=-o),Zi.copy(this);let c=1/o,h=1/a,u=1/l;return Zi.elements[0]*=c,Zi.elements[1]*=c,Zi.elements[2]*=c,Zi.elements[4]*=h,Zi.elements[5]*=h,Zi.elements[6]*=h,Zi.elements[8]*=u,Zi.elements[9]*=u,Zi.elements[10]*=u,t.setFromRotationMatrix(Zi),i.x=o,i.y=a,i.z=l,this}makePerspective(e,t,i,s,r,o,a=Vi,l=!1){let c=this.elements,h=2*r/(t-e),u=2*r/(i-s),f=(t+e)/(t-e),d=(i+s)/(i-s),g,_;if(l)g=r/(o-r),_=o*r/(o-r);else if(a===Vi)g=-(o+r)/(o-r),_=-2*o*r/(o-r);else if(a===ea)g=-o/(o-r),_=-o*r/(o-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=f,c[12]=0,c[1]=0,c[5]=u,c[9]=d,c[13]=0,c[2]=0,c[6]=0,c[10]=g,c[14]=_,c[3]=0,c[7]=0,c[11]=-1,c[15]=0,this}makeOrthographic(e,t,i,s,r,o,a=Vi,l=!1){let c=this.elements,h=2/(t-e),u=2/(i-s),f=-(t+e)/(t-e),d=-(i+s)/(i-s),g,_;if(l)g=1/(o-r),_=o/(o-r);else if(a===Vi)g=-2/(o-r),_=-(o+r)/(o-r);else if(a===ea)g=-1/(o-r),_=-r/(o-r);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=0,c[12]=f,c[1]=0,c[5]=u,c[9]=0,c[13]=d,c[2]=0,c[6]=0,c[10]=g,c[14]=_,c[3]=0,c[7]=0,c[11]=0,c[15]=1,this}equals(e){let t=this.elements,i=e.elements;for(let s=0;s<16;s++)if(t[s]!==i[s])return!1;return!0}fromArray(e,t=0){for(let i=0;i<16;i++)this.elements[i]=e[i+t];return this}toArray(e=[],t=0){let i=this.elements;return e[t]=i[0],e[t+1]=i[1],e[t+2]=i[2],e[t+3]=i[3],e[t+4]=i[4],e[t+5]=i[5],e[t+6]=i[6],e[t+7]=i[7],e[t+8]=i[8],e[t+9]=i[9],e[t+10]=i[10],e[t+11]=i[11],e[t+12]=i[12],e[t+13]=i[13],e[t+14]=i[14],e[t+15]=i[15],e}},Fo=new O,Zi=new Dt,tw=new O(0,0,0),nw=new O(1,1,1),mr=new O,jc=new O,Ti=new O,ev=new Dt,tv=new li,Ks=class n{constructor(e=0,t=0,i=0,s=n.DEFAULT_ORDER){this.isEuler=!0,this._x=e,this._y=t,this._z=i,this._order=s}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get order(){return this._order}set order(e){this._order=e,this._onChangeCallback()}set(e,t,i,s=this._order){return this._x=e,this._y=t,this._z=i,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(e){return this._x=e._x,this._y=e._y,this._z=e._z,this._order=e._order,this._onChangeCallback(),this}setFromRotationMatrix(e,t=this._order,i=!0){let s=e.elements,r=s[0],o=s[4],a=s[8],l=s[1],c=s[5],h=s[9],u=s[2],f=s[6],d=s[10];switch(t){case"XYZ":this._y=Math.asin(yt(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(-h,d),this._z=Math.atan2(-o,r)):(this._x=Math.atan2(f,c),this._z=0);break;case"YXZ":this._x=Math.asin(-yt(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(a,d),this._z=Math.atan2(l,c)):(this._y=Math.atan2(-u,r),this._z=0);break;case"ZXY":this._x=Math.asin(yt(f,-1,1)),Math.abs(f)<.9999999?(this._y=Math.atan2(-u,d),this._z=Math.atan2(-o,c)):(this._y=0,this._z=Math.atan2(l,r));break;case"ZYX":this._y=Math.asin(-yt(u,-1,1)),Math.abs(u)<.9999999?(this._x=Math.atan2(f,d),this._z=Math.atan2(l,r)):(this._x=0,this._z=Math.atan2(-o,c));break;case"YZX":this._z=Math.asin(yt(l,-1,1)),Math.abs(l)<.9999999?(this._x=Math.atan2(-h,c),this._y=Math.atan2(-u,r)):(this._x=0,this._y=Math.atan2(a,d));break;case"XZY":this._z=Math.asin(-yt(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(f,c),this._y=Math.atan2(a,r)):(this._x=Math.atan2(-h,d),this._y=0);break;default:Je("Euler: .setFromRotationMatrix() encountered an unknown order: "+t)}return this._order=t,i===!0&&this._onChangeCallback(),this}setFromQuaternion(e,t,i){return ev.makeRotationFromQuaternion(e),this.setFromRotationMatrix(ev,t,i)}setFromVector3(e,t=this._order){return this.set(e.x,e.y,e.z,t)}reorder(e){return tv.setFromEuler(this),this.setFromQuaternion(tv,e)}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._order===this._order}fromArray(e){return this._x=e[0],this._y=e[1],this._z=e[2],e[3]!==void 0&&(this._order=e[3]),this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._order,e}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};Ks.DEFAULT_ORDER="XYZ";var Tl=class{constructor(){this.mask=1}set(e){this.mask=(1<<e|0)>>>0}enable(e){this.mask|=1<<e|0}enableAll(){this.mask=-1}toggle(e){this.mask^=1<<e|0}disable(e){this.mask&=~(1<<e|0)}disableAll(){this.mask=0}test(e){return(this.mask&e.mask)!==0}isEnabled(e){return(this.mask&(1<<e|0))!==0}},iw=0,nv=new O,Oo=new li,Hs=new Dt,Qc=new O,ll=new O,sw=new O,rw=new li,iv=new O(1,0,0),sv=new O(0,1,0),rv=new O(0,0,1),ov={type:"added"},ow={type:"removed"},ko={type:"childadded",child:null},Fd={type:"childremoved",child:null},Cn=class n extends ji{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:iw++}),this.uuid=Dr(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=n.DEFAULT_UP.clone();let e=new O,t=new Ks,i=new li,s=new O(1,1,1);function r(){i.setFromEuler(t,!1)}function o(){t.setFromQuaternion(i,void 0,!1)}t._onChange(r),i._onChange(o),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:e},rotation:{configurable:!0,enumerable:!0,value:t},quaternion:{configurable:!0,enumerable:!0,value:i},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new Dt},normalMatrix:{value:new Qe}}),this.matrix=new Dt,this.matrixWorld=new Dt,this.matrixAutoUpdate=n.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=n.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new Tl,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(e){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(e),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(e){return this.quaternion.premultiply(e),this}setRotationFromAxisAngle(e,t){this.quaternion.setFromAxisAngle(e,t)}setRotationFromEuler(e){this.quaternion.setFromEuler(e,!0)}setRotationFromMatrix(e){this.quaternion.setFromRotationMatrix(e)}setRotationFromQuaternion(e){this.quaternion.copy(e)}rotateOnAxis(e,t){return Oo.setFromAxisAngle(e,t),this.quaternion.multiply(Oo),this}rotateOnWorldAxis(e,t){return Oo.setFromAxisAngle(e,t),this.quaternion.premultiply(Oo),this}rotateX(e){return this.rotateOnAxis(iv,e)}rotateY(e){return this.rotateOnAxis(sv,e)}rotateZ(e){return this.rotateOnAxis(rv,e)}translateOnAxis(e,t){return nv.copy(e).applyQuaternion(this.quaternion),this.position.add(nv.multiplyScalar(t)),this}translateX(e){return this.translateOnAxis(iv,e)}translateY(e){return this.translateOnAxis(sv,e)}translateZ(e){return this.translateOnAxis(rv,e)}localToWorld(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(this.matrixWorld)}worldToLocal(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(Hs.copy(this.matrixWorld).invert())}lookAt(e,t,i){e.isVector3?Qc.copy(e):Qc.set(e,t,i);let s=this.parent;this.updateWorldMatrix(!0,!1),ll.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?Hs.lookAt(ll,Qc,this.up):Hs.lookAt(Qc,ll,this.up),this.quaternion.setFromRotationMatrix(Hs),s&&(Hs.extractRotation(s.matrixWorld),Oo.setFromRotationMatrix(Hs),this.quaternion.premultiply(Oo.invert()))}add(e){if(arguments.length>1){for(let t=0;t<arguments.length;t++)this.add(arguments[t]);return this}return e===this?(st("Object3D.add: object can't be added as a child of itself.",e),this):(e&&e.isObject3D?(e.removeFromParent(),e.parent=this,this.children.push(e),e.dispatchEvent(ov),ko.child=e,this.dispatchEvent(ko),ko.child=null):st("Object3D.add: object not an instance of THREE.Object3D.",e),this)}remove(e){if(arguments.length>1){for(let i=0;i<arguments.length;i++)this.remove(arguments[i]);return this}let t=this.children.indexOf(e);return t!==-1&&(e.parent=null,this.children.splice(t,1),e.dispatchEvent(ow),Fd.child=e,this.dispatchEvent(Fd),Fd.child=null),this}removeFromParent(){let e=this.parent;return e!==null&&e.remove(this),this}clear(){return this.remove(...this.children)}attach(e){return this.updateWorldMatrix(!0,!1),Hs.copy(this.matrixWorld).invert(),e.parent!==null&&(e.parent.updateWorldMatrix(!0,!1),Hs.multiply(e.parent.matrixWorld)),e.applyMatrix4(Hs),e.removeFromParent(),e.parent=this,this.children.push(e),e.updateWorldMatrix(!1,!0),e.dispatchEvent(ov),ko.child=e,this.dispatchEvent(ko),ko.child=null,this}getObjectById(e){return this.getObjectByProperty("id",e)}getObjectByName(e){return this.getObjectByProperty("name",e)}getObjectByProperty(e,t){if(this[e]===t)return this;for(let i=0,s=this.children.length;i<s;i++){let o=this.children[i].getObjectByProperty(e,t);if(o!==void 0)return o}}getObjectsByProperty(e,t,i=[]){this[e]===t&&i.push(this);let s=this.children;for(let r=0,o=s.length;r<o;r++)s[r].getObjectsByProperty(e,t,i);return i}getWorldPosition(e){return this.updateWorldMatrix(!0,!1),e.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(ll,e,sw),e}getWorldScale(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(ll,rw,e),e}getWorldDirection(e){this.updateWorldMatrix(!0,!1);let t=this.matrixWorld.elements;return e.set(t[8],t[9],t[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(e){e(this);let t=this.children;for(let i=0,s=t.length;i<s;i++)t[i].traverse(e)}traverseVisible(e){if(this.visible===!1)return;e(this);let t=this.children;for(let i=0,s=t.length;i<s;i++)t[i].traverseVisible(e)}traverseAncestors(e){let t=this.parent;t!==null&&(e(t),t.traverseAncestors(e))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let e=this.pivot;if(e!==null){let t=e.x,i=e.y,s=e.z,r=this.matrix.elements;r[12]+=t-r[0]*t-r[4]*i-r[8]*s,r[13]+=i-r[1]*t-r[5]*i-r[9]*s,r[14]+=s-r[2]*t-r[6]*i-r[10]*s}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(e){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||e)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,e=!0);let t=this.children;for(let i=0,s=t.length;i<s;i++)t[i].updateMatrixWorld(e)}updateWorldMatrix(e,t,i=!1){let s=this.parent;if(e===!0&&s!==null&&s.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||i)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,i=!0),t===!0){let r=this.children;for(let o=0,a=r.length;o<a;o++)r[o].updateWorldMatrix(!1,!0,i)}}toJSON(e){let t=e===void 0||typeof e=="string",i={};t&&(e={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},i.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let s={};s.uuid=this.uuid,s.type=this.type,s.name=this.name,s.castShadow=this.castShadow,s.receiveShadow=this.receiveShadow,s.visible=this.visible,s.frustumCulled=this.frustumCulled,s.renderOrder=this.renderOrder,s.static=this.static,s.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.pivot!==null&&(s.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(s.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(s.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.geometryInfo=this._geometryInfo.map(a=>({...a,boundingBox:a.boundingBox?a.boundingBox.toJSON():void 0,boundingSphere:a.boundingSphere?a.boundingSphere.toJSON():void 0})),s.instanceInfo=this._instanceInfo.map(a=>({...a})),s.availableInstanceIds=this._availableInstanceIds.slice(),s.availableGeometryIds=this._availableGeometryIds.slice(),s.nextIndexStart=this._nextIndexStart,s.nextVertexStart=this._nextVertexStart,s.geometryCount=this._geometryCount,s.maxInstanceCount=this._maxInstanceCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.matricesTexture=this._matricesTexture.toJSON(e),s.indirectTexture=this._indirectTexture.toJSON(e),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(e)),this.boundingSphere!==null&&(s.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(s.boundingBox=this.boundingBox.toJSON()));function r(a,l){return a[l.uuid]===void 0&&(a[l.uuid]=l.toJSON(e)),l.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(e).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(e).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=r(e.geometries,this.geometry);let a=this.geometry.parameters;if(a!==void 0&&a.shapes!==void 0){let l=a.shapes;if(Array.isArray(l))for(let c=0,h=l.length;c<h;c++){let u=l[c];r(e.shapes,u)}else r(e.shapes,l)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(e.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let a=[];for(let l=0,c=this.material.length;l<c;l++)a.push(r(e.materials,this.material[l]));s.material=a}else s.material=r(e.materials,this.material);if(this.children.length>0){s.children=[];for(let a=0;a<this.children.length;a++)s.children.push(this.children[a].toJSON(e).object)}if(this.animations.length>0){s.animations=[];for(let a=0;a<this.animations.length;a++){let l=this.animations[a];s.animations.push(r(e.animations,l))}}if(t){let a=o(e.geometries),l=o(e.materials),c=o(e.textures),h=o(e.images),u=o(e.shapes),f=o(e.skeletons),d=o(e.animations),g=o(e.nodes);a.length>0&&(i.geometries=a),l.length>0&&(i.materials=l),c.length>0&&(i.textures=c),h.length>0&&(i.images=h),u.length>0&&(i.shapes=u),f.length>0&&(i.skeletons=f),d.length>0&&(i.animations=d),g.length>0&&(i.nodes=g)}return i.object=s,i;function o(a){let l=[];for(let c in a){let h=a[c];delete h.metadata,l.push(h)}return l}}clone(e){return new this.constructor().copy(this,e)}copy(e,t=!0){if(this.name=e.name,this.up.copy(e.up),this.position.copy(e.position),this.rotation.order=e.rotation.order,this.quaternion.copy(e.quaternion),this.scale.copy(e.scale),this.pivot=e.pivot!==null?e.pivot.clone():null,this.matrix.copy(e.matrix),this.matrixWorld.copy(e.matrixWorld),this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrixWorldAutoUpdate=e.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=e.matrixWorldNeedsUpdate,this.layers.mask=e.layers.mask,this.visible=e.visible,this.castShadow=e.castShadow,this.receiveShadow=e.receiveShadow,this.frustumCulled=e.frustumCulled,this.renderOrder=e.renderOrder,this.static=e.static,this.animations=e.animations.slice(),this.userData=JSON.parse(JSON.stringify(e.userData)),t===!0)for(let i=0;i<e.children.length;i++){let s=e.children[i];this.add(s.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};Cn.DEFAULT_UP=new O(0,1,0);Cn.DEFAULT_MATRIX_AUTO_UPDATE=!0;Cn.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var Ut=class extends Cn{constructor(){super(),this.isGroup=!0,this.type="Group"}},aw={type:"move"},sa=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new Ut,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new Ut,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new O,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new O),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new Ut,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new O,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new O,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(e){return this._targetRay!==null&&this._targetRay.dispatchEvent(e),this._grip!==null&&this._grip.dispatchEvent(e),this._hand!==null&&this._hand.dispatchEvent(e),this}connect(e){if(e&&e.hand){let t=this._hand;if(t)for(let i of e.hand.values())this._getHandJoint(t,i)}return this.dispatchEvent({type:"connected",data:e}),this}disconnect(e){return this.dispatchEvent({type:"disconnected",data:e}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(e,t,i){let s=null,r=null,o=null,a=this._targetRay,l=this._grip,c=this._hand;if(e&&t.session.visibilityState!=="visible-blurred"){if(c&&e.hand){o=!0;for(let _ of e.hand.values()){let m=t.getJointPose(_,i),p=this._getHandJoint(c,_);m!==null&&(p.matrix.fromArray(m.transform.matrix),p.matrix.decompose(p.position,p.quaternion,p.scale),p.matrixWorldNeedsUpdate=!0,p.jointRadius=m.radius),p.visible=m!==null}let h=c.joints["index-finger-tip"],u=c.joints["thumb-tip"],f=h.position.distanceTo(u.position),d=.02,g=.005;c.inputState.pinching&&f>d+g?(c.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:e.handedness,target:this})):!c.inputState.pinching&&f<=d-g&&(c.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:e.handedness,target:this}))}else l!==null&&e.gripSpace&&(r=t.getPose(e.gripSpace,i),r!==null&&(l.matrix.fromArray(r.transform.matrix),l.matrix.decompose(l.position,l.quaternion,l.scale),l.matrixWorldNeedsUpdate=!0,r.linearVelocity?(l.hasLinearVelocity=!0,l.linearVelocity.copy(r.linearVelocity)):l.hasLinearVelocity=!1,r.angularVelocity?(l.hasAngularVelocity=!0,l.angularVelocity.copy(r.angularVelocity)):l.hasAngularVelocity=!1,l.eventsEnabled&&l.dispatchEvent({type:"gripUpdated",data:e,target:this})));a!==null&&(s=t.getPose(e.targetRaySpace,i),s===null&&r!==null&&(s=r),s!==null&&(a.matrix.fromArray(s.transform.matrix),a.matrix.decompose(a.position,a.quaternion,a.scale),a.matrixWorldNeedsUpdate=!0,s.linearVelocity?(a.hasLinearVelocity=!0,a.linearVelocity.copy(s.linearVelocity)):a.hasLinearVelocity=!1,s.angularVelocity?(a.hasAngularVelocity=!0,a.angularVelocity.copy(s.angularVelocity)):a.hasAngularVelocity=!1,this.dispatchEvent(aw)))}return a!==null&&(a.visible=s!==null),l!==null&&(l.visible=r!==null),c!==null&&(c.visible=o!==null),this}_getHandJoint(e,t){if(e.joints[t.jointName]===void 0){let i=new Ut;i.matrixAutoUpdate=!1,i.visible=!1,e.joints[t.jointName]=i,e.add(i)}return e.joints[t.jointName]}},hy={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},gr={h:0,s:0,l:0},eh={h:0,s:0,l:0};function Od(n,e,t){return t<0&&(t+=1),t>1&&(t-=1),t<1/6?n+(e-n)*6*t:t<1/2?e:t<2/3?n+(e-n)*6*(2/3-t):n}var Ke=class{constructor(e,t,i){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(e,t,i)}set(e,t,i){if(t===void 0&&i===void 0){let s=e;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(e,t,i);return this}setScalar(e){return this.r=e,this.g=e,this.b=e,this}setHex(e,t=Ai){return e=Math.floor(e),this.r=(e>>16&255)/255,this.g=(e>>8&255)/255,this.b=(e&255)/255,bt.colorSpaceToWorking(this,t),this}setRGB(e,t,i,s=bt.workingColorSpace){return this.r=e,this.g=t,this.b=i,bt.colorSpaceToWorking(this,s),this}setHSL(e,t,i,s=bt.workingColorSpace){if(e=Np(e,1),t=yt(t,0,1),i=yt(i,0,1),t===0)this.r=this.g=this.b=i;else{let r=i<=.5?i*(1+t):i+t-i*t,o=2*i-r;this.r=Od(o,r,e+1/3),this.g=Od(o,r,e),this.b=Od(o,r,e-1/3)}return bt.colorSpaceToWorking(this,s),this}setStyle(e,t=Ai){function i(r){r!==void 0&&parseFloat(r)<1&&Je("Color: Alpha component of "+e+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(e)){let r,o=s[1],a=s[2];switch(o){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,t);if(r=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setRGB(Math.min(100,parseFloat(r[1]))/100,Math.min(100,parseFloat(r[2]))/100,Math.min(100,parseFloat(r[3]))/100,t);break;case"hsl":case"hsla":if(r=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,t);break;default:Je("Color: Unknown color model "+e)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(e)){let r=s[1],o=r.length;if(o===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,t);if(o===6)return this.setHex(parseInt(r,16),t);Je("Color: Invalid hex color "+e)}else if(e&&e.length>0)return this.setColorName(e,t);return this}setColorName(e,t=Ai){let i=hy[e.toLowerCase()];return i!==void 0?this.setHex(i,t):Je("Color: Unknown color "+e),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(e){return this.r=e.r,this.g=e.g,this.b=e.b,this}copySRGBToLinear(e){return this.r=$s(e.r),this.g=$s(e.g),this.b=$s(e.b),this}copyLinearToSRGB(e){return this.r=jo(e.r),this.g=jo(e.g),this.b=jo(e.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(e=Ai){return bt.workingToColorSpace(Kn.copy(this),e),Math.round(yt(Kn.r*255,0,255))*65536+Math.round(yt(Kn.g*255,0,255))*256+Math.round(yt(Kn.b*255,0,255))}getHexString(e=Ai){return("000000"+this.getHex(e).toString(16)).slice(-6)}getHSL(e,t=bt.workingColorSpace){bt.workingToColorSpace(Kn.copy(this),t);let i=Kn.r,s=Kn.g,r=Kn.b,o=Math.max(i,s,r),a=Math.min(i,s,r),l,c,h=(a+o)/2;if(a===o)l=0,c=0;else{let u=o-a;switch(c=h<=.5?u/(o+a):u/(2-o-a),o){case i:l=(s-r)/u+(s<r?6:0);break;case s:l=(r-i)/u+2;break;case r:l=(i-s)/u+4;break}l/=6}return e.h=l,e.s=c,e.l=h,e}getRGB(e,t=bt.workingColorSpace){return bt.workingToColorSpace(Kn.copy(this),t),e.r=Kn.r,e.g=Kn.g,e.b=Kn.b,e}getStyle(e=Ai){bt.workingToColorSpace(Kn.copy(this),e);let t=Kn.r,i=Kn.g,s=Kn.b;return e!==Ai?`color(${e} ${t.toFixed(3)} ${i.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(t*255)},${Math.round(i*255)},${Math.round(s*255)})`}offsetHSL(e,t,i){return this.getHSL(gr),this.setHSL(gr.h+e,gr.s+t,gr.l+i)}add(e){return this.r+=e.r,this.g+=e.g,this.b+=e.b,this}addColors(e,t){return this.r=e.r+t.r,this.g=e.g+t.g,this.b=e.b+t.b,this}addScalar(e){return this.r+=e,this.g+=e,this.b+=e,this}sub(e){return this.r=Math.max(0,this.r-e.r),this.g=Math.max(0,this.g-e.g),this.b=Math.max(0,this.b-e.b),this}multiply(e){return this.r*=e.r,this.g*=e.g,this.b*=e.b,this}multiplyScalar(e){return this.r*=e,this.g*=e,this.b*=e,this}lerp(e,t){return this.r+=(e.r-this.r)*t,this.g+=(e.g-this.g)*t,this.b+=(e.b-this.b)*t,this}lerpColors(e,t,i){return this.r=e.r+(t.r-e.r)*i,this.g=e.g+(t.g-e.g)*i,this.b=e.b+(t.b-e.b)*i,this}lerpHSL(e,t){this.getHSL(gr),e.getHSL(eh);let i=yl(gr.h,eh.h,t),s=yl(gr.s,eh.s,t),r=yl(gr.l,eh.l,t);return this.setHSL(i,s,r),this}setFromVector3(e){return this.r=e.x,this.g=e.y,this.b=e.z,this}applyMatrix3(e){let t=this.r,i=this.g,s=this.b,r=e.elements;return this.r=r[0]*t+r[3]*i+r[6]*s,this.g=r[1]*t+r[4]*i+r[7]*s,this.b=r[2]*t+r[5]*i+r[8]*s,this}equals(e){return e.r===this.r&&e.g===this.g&&e.b===this.b}fromArray(e,t=0){return this.r=e[t],this.g=e[t+1],this.b=e[t+2],this}toArray(e=[],t=0){return e[t]=this.r,e[t+1]=this.g,e[t+2]=this.b,e}fromBufferAttribute(e,t){return this.r=e.getX(t),this.g=e.getY(t),this.b=e.getZ(t),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},Kn=new Ke;Ke.NAMES=hy;var El=class extends Cn{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new Ks,this.environmentIntensity=1,this.environmentRotation=new Ks,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(e,t){return super.copy(e,t),this.background=e.background!==null?e.background.clone():null,this.environment=e.environment!==null?e.environment.clone():null,this.fog=e.fog!==null?e.fog.clone():null,this.backgroundBlurriness=e.backgroundBlurriness,this.backgroundIntensity=e.backgroundIntensity,this.backgroundRotation.copy(e.backgroundRotation),this.environmentIntensity=e.environmentIntensity,this.environmentRotation.copy(e.environmentRotation),this.overrideMaterial=e.overrideMaterial!==null?e.overrideMaterial.clone():null,this.matrixAutoUpdate=e.matrixAutoUpdate,this}toJSON(e){let t=super.toJSON(e);return this.fog!==null&&(t.object.fog=this.fog.toJSON()),t.object.backgroundBlurriness=this.backgroundBlurriness,t.object.backgroundIntensity=this.backgroundIntensity,t.object.backgroundRotation=this.backgroundRotation.toArray(),t.object.environmentIntensity=this.environmentIntensity,t.object.environmentRotation=this.environmentRotation.toArray(),t}},Ki=new O,Gs=new O,kd=new O,Ws=new O,Bo=new O,zo=new O,av=new O,Bd=new O,zd=new O,Vd=new O,Hd=new rn,Gd=new rn,Wd=new rn,Ys=class n{constructor(e=new O,t=new O,i=new O){this.a=e,this.b=t,this.c=i}static getNormal(e,t,i,s){s.subVectors(i,t),Ki.subVectors(e,t),s.cross(Ki);let r=s.lengthSq();return r>0?s.multiplyScalar(1/Math.sqrt(r)):s.set(0,0,0)}static getBarycoord(e,t,i,s,r){Ki.subVectors(s,t),Gs.subVectors(i,t),kd.subVectors(e,t);let o=Ki.dot(Ki),a=Ki.dot(Gs),l=Ki.dot(kd),c=Gs.dot(Gs),h=Gs.dot(kd),u=o*c-a*a;if(u===0)return r.set(0,0,0),null;let f=1/u,d=(c*l-a*h)*f,g=(o*h-a*l)*f;return r.set(1-d-g,g,d)}static containsPoint(e,t,i,s){return this.getBarycoord(e,t,i,s,Ws)===null?!1:Ws.x>=0&&Ws.y>=0&&Ws.x+Ws.y<=1}static getInterpolation(e,t,i,s,r,o,a,l){return this.getBarycoord(e,t,i,s,Ws)===null?(l.x=0,l.y=0,"z"in l&&(l.z=0),"w"in l&&(l.w=0),null):(l.setScalar(0),l.addScaledVector(r,Ws.x),l.addScaledVector(o,Ws.y),l.addScaledVector(a,Ws.z),l)}static getInterpolatedAttribute(e,t,i,s,r,o){return Hd.setScalar(0),Gd.setScalar(0),Wd.setScalar(0),Hd.fromBufferAttribute(e,t),Gd.fromBufferAttribute(e,i),Wd.fromBufferAttribute(e,s),o.setScalar(0),o.addScaledVector(Hd,r.x),o.addScaledVector(Gd,r.y),o.addScaledVector(Wd,r.z),o}static isFrontFacing(e,t,i,s){return Ki.subVectors(i,t),Gs.subVectors(e,t),Ki.cross(Gs).dot(s)<0}set(e,t,i){return this.a.copy(e),this.b.copy(t),this.c.copy(i),this}setFromPointsAndIndices(e,t,i,s){return this.a.copy(e[t]),this.b.copy(e[i]),this.c.copy(e[s]),this}setFromAttributeAndIndices(e,t,i,s){return this.a.fromBufferAttribute(e,t),this.b.fromBufferAttribute(e,i),this.c.fromBufferAttribute(e,s),this}clone(){return new this.constructor().copy(this)}copy(e){return this.a.copy(e.a),this.b.copy(e.b),this.c.copy(e.c),this}getArea(){return Ki.subVectors(this.c,this.b),Gs.subVectors(this.a,this.b),Ki.cross(Gs).length()*.5}getMidpoint(e){return e.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(e){return n.getNormal(this.a,this.b,this.c,e)}getPlane(e){return e.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(e,t){return n.getBarycoord(e,this.a,this.b,this.c,t)}getInterpolation(e,t,i,s,r){return n.getInterpolation(e,this.a,this.b,this.c,t,i,s,r)}containsPoint(e){return n.containsPoint(e,this.a,this.b,this.c)}isFrontFacing(e){return n.isFrontFacing(this.a,this.b,this.c,e)}intersectsBox(e){return e.intersectsTriangle(this)}closestPointToPoint(e,t){let i=this.a,s=this.b,r=this.c,o,a;Bo.subVectors(s,i),zo.subVectors(r,i),Bd.subVectors(e,i);let l=Bo.dot(Bd),c=zo.dot(Bd);if(l<=0&&c<=0)return t.copy(i);zd.subVectors(e,s);let h=Bo.dot(zd),u=zo.dot(zd);if(h>=0&&u<=h)return t.copy(s);let f=l*u-h*c;if(f<=0&&l>=0&&h<=0&&l-h>0)return o=l/(l-h),t.copy(i).addScaledVector(Bo,o);Vd.subVectors(e,r);let d=Bo.dot(Vd),g=zo.dot(Vd);if(g>=0&&d<=g)return t.copy(r);let _=d*c-l*g;if(_<=0&&c>=0&&g<=0)return a=c/(c-g),t.copy(i).addScaledVector(zo,a);let m=h*g-d*u;if(m<=0&&u-h>=0&&d-g>=0)return av.subVectors(r,s),a=(u-h)/(u-h+(d-g)),t.copy(s).addScaledVector(av,a);let p=1/(m+_+f);return o=_*p,a=f*p,t.copy(i).addScaledVector(Bo,o).addScaledVector(zo,a)}equals(e){return e.a.equals(this.a)&&e.b.equals(this.b)&&e.c.equals(this.c)}},Hi=class{constructor(e=new O(1/0,1/0,1/0),t=new O(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=e,this.max=t}set(e,t){return this.min.copy(e),this.max.copy(t),this}setFromArray(e){this.makeEmpty();for(let t=0,i=e.length;t<i;t+=3)this.expandByPoint(Ji.fromArray(e,t));return this}setFromBufferAttribute(e){this.makeEmpty();for(let t=0,i=e.count;t<i;t++)this.expandByPoint(Ji.fromBufferAttribute(e,t));return this}setFromPoints(e){this.makeEmpty();for(let t=0,i=e.length;t<i;t++)this.expandByPoint(e[t]);return this}setFromCenterAndSize(e,t){let i=Ji.copy(t).multiplyScalar(.5);return this.min.copy(e).sub(i),this.max.copy(e).add(i),this}setFromObject(e,t=!1){return this.makeEmpty(),this.expandByObject(e,t)}clone(){return new this.constructor().copy(this)}copy(e){return this.min.copy(e.min),this.max.copy(e.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(e){return this.isEmpty()?e.set(0,0,0):e.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(e){return this.isEmpty()?e.set(0,0,0):e.subVectors(this.max,this.min)}expandByPoint(e){return this.min.min(e),this.max.max(e),this}expandByVector(e){return this.min.sub(e),this.max.add(e),this}expandByScalar(e){return this.min.addScalar(-e),this.max.addScalar(e),this}expandByObject(e,t=!1){e.updateWorldMatrix(!1,!1);let i=e.geometry;if(i!==void 0){let r=i.getAttribute("position");if(t===!0&&r!==void 0&&e.isInstancedMesh!==!0&&e.isBatchedMesh!==!0)for(let o=0,a=r.count;o<a;o++)e.isMesh===!0?e.getVertexPosition(o,Ji):Ji.fromBufferAttribute(r,o),Ji.applyMatrix4(e.matrixWorld),this.expandByPoint(Ji);else e.boundingBox!==void 0?(e.boundingBox===null&&e.computeBoundingBox(),th.copy(e.boundingBox)):(i.boundingBox===null&&i.computeBoundingBox(),th.copy(i.boundingBox)),th.applyMatrix4(e.matrixWorld),this.union(th)}let s=e.children;for(let r=0,o=s.length;r<o;r++)this.expandByObject(s[r],t);return this}containsPoint(e){return e.x>=this.min.x&&e.x<=this.max.x&&e.y>=this.min.y&&e.y<=this.max.y&&e.z>=this.min.z&&e.z<=this.max.z}containsBox(e){return this.min.x<=e.min.x&&e.max.x<=this.max.x&&this.min.y<=e.min.y&&e.max.y<=this.max.y&&this.min.z<=e.min.z&&e.max.z<=this.max.z}getParameter(e,t){return t.set((e.x-this.min.x)/(this.max.x-this.min.x),(e.y-this.min.y)/(this.max.y-this.min.y),(e.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(e){return e.max.x>=this.min.x&&e.min.x<=this.max.x&&e.max.y>=this.min.y&&e.min.y<=this.max.y&&e.max.z>=this.min.z&&e.min.z<=this.max.z}intersectsSphere(e){return this.clampPoint(e.center,Ji),Ji.distanceToSquared(e.center)<=e.radius*e.radius}intersectsPlane(e){let t,i;return e.normal.x>0?(t=e.normal.x*this.min.x,i=e.normal.x*this.max.x):(t=e.normal.x*this.max.x,i=e.normal.x*this.min.x),e.normal.y>0?(t+=e.normal.y*this.min.y,i+=e.normal.y*this.max.y):(t+=e.normal.y*this.max.y,i+=e.normal.y*this.min.y),e.normal.z>0?(t+=e.normal.z*this.min.z,i+=e.normal.z*this.max.z):(t+=e.normal.z*this.max.z,i+=e.normal.z*this.min.z),t<=-e.constant&&i>=-e.constant}intersectsTriangle(e){if(this.isEmpty())return!1;this.getCenter(cl),nh.subVectors(this.max,cl),Vo.subVectors(e.a,cl),Ho.subVectors(e.b,cl),Go.subVectors(e.c,cl),vr.subVectors(Ho,Vo),yr.subVectors(Go,Ho),$r.subVectors(Vo,Go);let t=[0,-vr.z,vr.y,0,-yr.z,yr.y,0,-$r.z,$r.y,vr.z,0,-vr.x,yr.z,0,-yr.x,$r.z,0,-$r.x,-vr.y,vr.x,0,-yr.y,yr.x,0,-$r.y,$r.x,0];return!Xd(t,Vo,Ho,Go,nh)||(t=[1,0,0,0,1,0,0,0,1],!Xd(t,Vo,Ho,Go,nh))?!1:(ih.crossVectors(vr,yr),t=[ih.x,ih.y,ih.z],Xd(t,Vo,Ho,Go,nh))}clampPoint(e,t){return t.copy(e).clamp(this.min,this.max)}distanceToPoint(e){return this.clampPoint(e,Ji).distanceTo(e)}getBoundingSphere(e){return this.isEmpty()?e.makeEmpty():(this.getCenter(e.center),e.radius=this.getSize(Ji).length()*.5),e}intersect(e){return this.min.max(e.min),this.max.min(e.max),this.isEmpty()&&this.makeEmpty(),this}union(e){return this.min.min(e.min),this.max.max(e.max),this}applyMatrix4(e){return this.isEmpty()?this:(Xs[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(e),Xs[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(e),Xs[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(e),Xs[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(e),Xs[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(e),Xs[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(e),Xs[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(e),Xs[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(e),this.setFromPoints(Xs),this)}translate(e){return this.min.add(e),this.max.add(e),this}equals(e){return e.min.equals(this.min)&&e.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(e){return this.min.fromArray(e.min),this.max.fromArray(e.max),this}},Xs=[new O,new O,new O,new O,new O,new O,new O,new O],Ji=new O,th=new Hi,Vo=new O,Ho=new O,Go=new O,vr=new O,yr=new O,$r=new O,cl=new O,nh=new O,ih=new O,Zr=new O;function Xd(n,e,t,i,s){for(let r=0,o=n.length-3;r<=o;r+=3){Zr.fromArray(n,r);let a=s.x*Math.abs(Zr.x)+s.y*Math.abs(Zr.y)+s.z*Math.abs(Zr.z),l=e.dot(Zr),c=t.dot(Zr),h=i.dot(Zr);if(Math.max(-Math.max(l,c,h),Math.min(l,c,h))>a)return!1}return!0}var Mn=new O,sh=new $e,lw=0,fn=class extends ji{constructor(e,t,i=!1){if(super(),Array.isArray(e))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:lw++}),this.name="",this.array=e,this.itemSize=t,this.count=e!==void 0?e.length/t:0,this.normalized=i,this.usage=Dp,this.updateRanges=[],this.gpuType=ns,this.version=0,this._normalizationScale=e!==void 0?Yu(e):void 0}onUploadCallback(){}set needsUpdate(e){e===!0&&this.version++}setUsage(e){return this.usage=e,this}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}copy(e){return this.name=e.name,this.array=new e.array.constructor(e.array),this.itemSize=e.itemSize,this.count=e.count,this.normalized=e.normalized,this.usage=e.usage,this.gpuType=e.gpuType,this._normalizationScale=e._normalizationScale,this}copyAt(e,t,i){e*=this.itemSize,i*=t.itemSize;for(let s=0,r=this.itemSize;s<r;s++)this.array[e+s]=t.array[i+s];return this}copyArray(e){return this.array.set(e),this}applyMatrix3(e){if(this.itemSize===2)for(let t=0,i=this.count;t<i;t++)sh.fromBufferAttribute(this,t),sh.applyMatrix3(e),this.setXY(t,sh.x,sh.y);else if(this.itemSize===3)for(let t=0,i=this.count;t<i;t++)Mn.fromBufferAttribute(this,t),Mn.applyMatrix3(e),this.setXYZ(t,Mn.x,Mn.y,Mn.z);return this}applyMatrix4(e){for(let t=0,i=this.count;t<i;t++)Mn.fromBufferAttribute(this,t),Mn.applyMatrix4(e),this.setXYZ(t,Mn.x,Mn.y,Mn.z);return this}applyNormalMatrix(e){for(let t=0,i=this.count;t<i;t++)Mn.fromBufferAttribute(this,t),Mn.applyNormalMatrix(e),this.setXYZ(t,Mn.x,Mn.y,Mn.z);return this}transformDirection(e){for(let t=0,i=this.count;t<i;t++)Mn.fromBufferAttribute(this,t),Mn.transformDirection(e),this.setXYZ(t,Mn.x,Mn.y,Mn.z);return this}set(e,t=0){return this.array.set(e,t),this}getComponent(e,t){let i=this.array[e*this.itemSize+t];return this.normalized&&(i=this._denormalize(i)),i}setComponent(e,t,i){return this.normalized&&(i=this._normalize(i)),this.array[e*this.itemSize+t]=i,this}getX(e){let t=this.array[e*this.itemSize];return this.normalized&&(t=this._denormalize(t)),t}setX(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize]=t,this}getY(e){let t=this.array[e*this.itemSize+1];return this.normalized&&(t=this._denormalize(t)),t}setY(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+1]=t,this}getZ(e){let t=this.array[e*this.itemSize+2];return this.normalized&&(t=this._denormalize(t)),t}setZ(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+2]=t,this}getW(e){let t=this.array[e*this.itemSize+3];return this.normalized&&(t=this._denormalize(t)),t}setW(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+3]=t,this}setXY(e,t,i){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),i=this._normalize(i)),this.array[e+0]=t,this.array[e+1]=i,this}setXYZ(e,t,i,s){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),i=this._normalize(i),s=this._normalize(s)),this.array[e+0]=t,this.array[e+1]=i,this.array[e+2]=s,this}setXYZW(e,t,i,s,r){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),i=this._normalize(i),s=this._normalize(s),r=this._normalize(r)),this.array[e+0]=t,this.array[e+1]=i,this.array[e+2]=s,this.array[e+3]=r,this}onUpload(e){return this.onUploadCallback=e,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let e={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return e.name=this.name,e.usage=this.usage,e.gpuType=this.gpuType,e}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(e){let t=this._normalizationScale;return t!==void 0?Math.max(e/t,-1):Fp(e,this.array)}_normalize(e){let t=this._normalizationScale;return t!==void 0?Math.round(e*t):Op(e,this.array)}};var Al=class extends fn{constructor(e,t,i){super(new Uint16Array(e),t,i)}};var Cl=class extends fn{constructor(e,t,i){super(new Uint32Array(e),t,i)}};var dn=class extends fn{constructor(e,t,i){super(new Float32Array(e),t,i)}},cw=new Hi,hl=new O,qd=new O,xr=class{constructor(e=new O,t=-1){this.isSphere=!0,this.center=e,this.radius=t}set(e,t){return this.center.copy(e),this.radius=t,this}setFromPoints(e,t){let i=this.center;t!==void 0?i.copy(t):cw.setFromPoints(e).getCenter(i);let s=0;for(let r=0,o=e.length;r<o;r++)s=Math.max(s,i.distanceToSquared(e[r]));return this.radius=Math.sqrt(s),this}copy(e){return this.center.copy(e.center),this.radius=e.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(e){return e.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(e){return e.distanceTo(this.center)-this.radius}intersectsSphere(e){let t=this.radius+e.radius;return e.center.distanceToSquared(this.center)<=t*t}intersectsBox(e){return e.intersectsSphere(this)}intersectsPlane(e){return Math.abs(e.distanceToPoint(this.center))<=this.radius}clampPoint(e,t){let i=this.center.distanceToSquared(e);return t.copy(e),i>this.radius*this.radius&&(t.sub(this.center).normalize(),t.multiplyScalar(this.radius).add(this.center)),t}getBoundingBox(e){return this.isEmpty()?(e.makeEmpty(),e):(e.set(this.center,this.center),e.expandByScalar(this.radius),e)}applyMatrix4(e){return this.center.applyMatrix4(e),this.radius=this.radius*e.getMaxScaleOnAxis(),this}translate(e){return this.center.add(e),this}expandByPoint(e){if(this.isEmpty())return this.center.copy(e),this.radius=0,this;hl.subVectors(e,this.center);let t=hl.lengthSq();if(t>this.radius*this.radius){let i=Math.sqrt(t),s=(i-this.radius)*.5;this.center.addScaledVector(hl,s/i),this.radius+=s}return this}union(e){return e.isEmpty()?this:this.isEmpty()?(this.copy(e),this):(this.center.equals(e.center)===!0?this.radius=Math.max(this.radius,e.radius):(qd.subVectors(e.center,this.center).setLength(e.radius),this.expandByPoint(hl.copy(e.center).add(qd)),this.expandByPoint(hl.copy(e.center).sub(qd))),this)}equals(e){return e.center.equals(this.center)&&e.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(e){return this.radius=e.radius,this.center.fromArray(e.center),this}},hw=0,zi=new Dt,Yd=new Cn,Wo=new O,Ei=new Hi,ul=new Hi,Vn=new O,$t=class n extends ji{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:hw++}),this.uuid=Dr(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(e){return Array.isArray(e)?this.index=new(UM(e)?Cl:Al)(e,1):this.index=e,this}setIndirect(e,t=0){return this.indirect=e,this.indirectOffset=t,this}getIndirect(){return this.indirect}getAttribute(e){return this.attributes[e]}setAttribute(e,t){return this.attributes[e]=t,this}deleteAttribute(e){return delete this.attributes[e],this}hasAttribute(e){return this.attributes[e]!==void 0}addGroup(e,t,i=0){this.groups.push({start:e,count:t,materialIndex:i})}clearGroups(){this.groups=[]}setDrawRange(e,t){this.drawRange.start=e,this.drawRange.count=t}applyMatrix4(e){let t=this.attributes.position;t!==void 0&&(t.applyMatrix4(e),t.needsUpdate=!0);let i=this.attributes.normal;if(i!==void 0){let r=new Qe().getNormalMatrix(e);i.applyNormalMatrix(r),i.needsUpdate=!0}let s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(e),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(e){return zi.makeRotationFromQuaternion(e),this.applyMatrix4(zi),this}rotateX(e){return zi.makeRotationX(e),this.applyMatrix4(zi),this}rotateY(e){return zi.makeRotationY(e),this.applyMatrix4(zi),this}rotateZ(e){return zi.makeRotationZ(e),this.applyMatrix4(zi),this}translate(e,t,i){return zi.makeTranslation(e,t,i),this.applyMatrix4(zi),this}scale(e,t,i){return zi.makeScale(e,t,i),this.applyMatrix4(zi),this}lookAt(e){return Yd.lookAt(e),Yd.updateMatrix(),this.applyMatrix4(Yd.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(Wo).negate(),this.translate(Wo.x,Wo.y,Wo.z),this}setFromPoints(e){let t=this.getAttribute("position");if(t===void 0){let i=[];for(let s=0,r=e.length;s<r;s++){let o=e[s];i.push(o.x,o.y,o.z||0)}this.setAttribute("position",new dn(i,3))}else{let i=Math.min(e.length,t.count);for(let s=0;s<i;s++){let r=e[s];t.setXYZ(s,r.x,r.y,r.z||0)}e.length>t.count&&Je("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),t.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new Hi);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){st("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new O(-1/0,-1/0,-1/0),new O(1/0,1/0,1/0));return}if(e!==void 0){if(this.boundingBox.setFromBufferAttribute(e),t)for(let i=0,s=t.length;i<s;i++){let r=t[i];Ei.setFromBufferAttribute(r),this.morphTargetsRelative?(Vn.addVectors(this.boundingBox.min,Ei.min),this.boundingBox.expandByPoint(Vn),Vn.addVectors(this.boundingBox.max,Ei.max),this.boundingBox.expandByPoint(Vn)):(this.boundingBox.expandByPoint(Ei.min),this.boundingBox.expandByPoint(Ei.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&st('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new xr);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){st("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new O,1/0);return}if(e){let i=this.boundingSphere.center;if(Ei.setFromBufferAttribute(e),t)for(let r=0,o=t.length;r<o;r++){let a=t[r];ul.setFromBufferAttribute(a),this.morphTargetsRelative?(Vn.addVectors(Ei.min,ul.min),Ei.expandByPoint(Vn),Vn.addVectors(Ei.max,ul.max),Ei.expandByPoint(Vn)):(Ei.expandByPoint(ul.min),Ei.expandByPoint(ul.max))}Ei.getCenter(i);let s=0;for(let r=0,o=e.count;r<o;r++)Vn.fromBufferAttribute(e,r),s=Math.max(s,i.distanceToSquared(Vn));if(t)for(let r=0,o=t.length;r<o;r++){let a=t[r],l=this.morphTargetsRelative;for(let c=0,h=a.count;c<h;c++)Vn.fromBufferAttribute(a,c),l&&(Wo.fromBufferAttribute(e,c),Vn.add(Wo)),s=Math.max(s,i.distanceToSquared(Vn))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&st('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let e=this.index,t=this.attributes;if(e===null||t.position===void 0||t.normal===void 0||t.uv===void 0){st("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let i=t.position,s=t.normal,r=t.uv,o=this.getAttribute("tangent");(o===void 0||o.count!==i.count)&&(o=new fn(new Float32Array(4*i.count),4),this.setAttribute("tangent",o));let a=[],l=[],c=new Uint8Array(i.count);for(let k=0;k<i.count;k++)a[k]=new O,l[k]=new O;let h=new O,u=new O,f=new O,d=new $e,g=new $e,_=new $e,m=new O,p=new O;function x(k,N,I){c[k]=c[N]=c[I]=1,h.fromBufferAttribute(i,k),u.fromBufferAttribute(i,N),f.fromBufferAttribute(i,I),d.fromBufferAttribute(r,k),g.fromBufferAttribute(r,N),_.fromBufferAttribute(r,I),u.sub(h),f.sub(h),g.sub(d),_.sub(d);let z=1/(g.x*_.y-_.x*g.y);isFinite(z)&&(m.copy(u).multiplyScalar(_.y).addScaledVector(f,-g.y).multiplyScalar(z),p.copy(f).multiplyScalar(g.x).addScaledVector(u,-_.x).multiplyScalar(z),a[k].add(m),a[N].add(m),a[I].add(m),l[k].add(p),l[N].add(p),l[I].add(p))}let A=this.groups;A.length===0&&(A=[{start:0,count:e.count}]);for(let k=0,N=A.length;k<N;++k){let I=A[k],z=I.start,W=I.count;for(let L=z,X=z+W;L<X;L+=3)x(e.getX(L+0),e.getX(L+1),e.getX(L+2))}let w=new O,P=new O,E=new O,y=new O;function T(k){E.fromBufferAttribute(s,k),y.copy(E);let N=a[k];w.copy(N),w.sub(E.multiplyScalar(E.dot(N))).normalize(),P.crossVectors(y,N);let z=P.dot(l[k])<0?-1:1;o.setXYZW(k,w.x,w.y,w.z,z)}for(let k=0,N=i.count;k<N;++k)c[k]&&T(k);this._transformed=!0}computeVertexNormals(){let e=this.index,t=this.getAttribute("position");if(t!==void 0){let i=this.getAttribute("normal");if(i===void 0||i.count!==t.count)i=new fn(new Float32Array(t.count*3),3),this.setAttribute("normal",i);else for(let f=0,d=i.count;f<d;f++)i.setXYZ(f,0,0,0);let s=new O,r=new O,o=new O,a=new O,l=new O,c=new O,h=new O,u=new O;if(e)for(let f=0,d=e.count;f<d;f+=3){let g=e.getX(f+0),_=e.getX(f+1),m=e.getX(f+2);s.fromBufferAttribute(t,g),r.fromBufferAttribute(t,_),o.fromBufferAttribute(t,m),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),a.fromBufferAttribute(i,g),l.fromBufferAttribute(i,_),c.fromBufferAttribute(i,m),a.add(h),l.add(h),c.add(h),i.setXYZ(g,a.x,a.y,a.z),i.setXYZ(_,l.x,l.y,l.z),i.setXYZ(m,c.x,c.y,c.z)}else for(let f=0,d=t.count;f<d;f+=3)s.fromBufferAttribute(t,f+0),r.fromBufferAttribute(t,f+1),o.fromBufferAttribute(t,f+2),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),i.setXYZ(f+0,h.x,h.y,h.z),i.setXYZ(f+1,h.x,h.y,h.z),i.setXYZ(f+2,h.x,h.y,h.z);this.normalizeNormals(),i.needsUpdate=!0}}normalizeNormals(){let e=this.attributes.normal;for(let t=0,i=e.count;t<i;t++)Vn.fromBufferAttribute(e,t),Vn.normalize(),e.setXYZ(t,Vn.x,Vn.y,Vn.z)}toNonIndexed(){function e(a,l){let c=a.array,h=a.itemSize,u=a.normalized,f=new c.constructor(l.length*h),d=0,g=0;for(let _=0,m=l.length;_<m;_++){a.isInterleavedBufferAttribute?d=l[_]*a.data.stride+a.offset:d=l[_]*h;for(let p=0;p<h;p++)f[g++]=c[d++]}return new fn(f,h,u)}if(this.index===null)return Je("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let t=new n,i=this.index.array,s=this.attributes;for(let a in s){let l=s[a],c=e(l,i);t.setAttribute(a,c)}let r=this.morphAttributes;for(let a in r){let l=[],c=r[a];for(let h=0,u=c.length;h<u;h++){let f=c[h],d=e(f,i);l.push(d)}t.morphAttributes[a]=l}t.morphTargetsRelative=this.morphTargetsRelative;let o=this.groups;for(let a=0,l=o.length;a<l;a++){let c=o[a];t.addGroup(c.start,c.count,c.materialIndex)}return t}toJSON(){let e={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(e.uuid=this.uuid,e.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,e.name=this.name,Object.keys(this.userData).length>0&&(e.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let l=this.parameters;for(let c in l)l[c]!==void 0&&(e[c]=l[c]);return e}e.data={attributes:{}};let t=this.index;t!==null&&(e.data.index={type:t.array.constructor.name,array:Array.prototype.slice.call(t.array)});let i=this.attributes;for(let l in i){let c=i[l];e.data.attributes[l]=c.toJSON(e.data)}let s={},r=!1;for(let l in this.morphAttributes){let c=this.morphAttributes[l],h=[];for(let u=0,f=c.length;u<f;u++){let d=c[u];h.push(d.toJSON(e.data))}h.length>0&&(s[l]=h,r=!0)}r&&(e.data.morphAttributes=s,e.data.morphTargetsRelative=this.morphTargetsRelative);let o=this.groups;o.length>0&&(e.data.groups=JSON.parse(JSON.stringify(o)));let a=this.boundingSphere;return a!==null&&(e.data.boundingSphere=a.toJSON()),e}clone(){return new this.constructor().copy(this)}copy(e){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let t={};this.name=e.name;let i=e.index;i!==null&&this.setIndex(i.clone());let s=e.attributes;for(let c in s){let h=s[c];this.setAttribute(c,h.clone(t))}let r=e.morphAttributes;for(let c in r){let h=[],u=r[c];for(let f=0,d=u.length;f<d;f++)h.push(u[f].clone(t));this.morphAttributes[c]=h}this.morphTargetsRelative=e.morphTargetsRelative;let o=e.groups;for(let c=0,h=o.length;c<h;c++){let u=o[c];this.addGroup(u.start,u.count,u.materialIndex)}let a=e.boundingBox;a!==null&&(this.boundingBox=a.clone());let l=e.boundingSphere;return l!==null&&(this.boundingSphere=l.clone()),this.drawRange.start=e.drawRange.start,this.drawRange.count=e.drawRange.count,this.userData=e.userData,this._transformed=e._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}},zh=class{constructor(e,t){this.isInterleavedBuffer=!0,this.array=e,this.stride=t,this.count=e!==void 0?e.length/t:0,this.usage=Dp,this.updateRanges=[],this.version=0,this.uuid=Dr()}onUploadCallback(){}set needsUpdate(e){e===!0&&this.version++}setUsage(e){return this.usage=e,this}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}copy(e){return this.array=new e.array.constructor(e.array),this.count=e.count,this.stride=e.stride,this.usage=e.usage,this}copyAt(e,t,i){e*=this.stride,i*=t.stride;for(let s=0,r=this.stride;s<r;s++)this.array[e+s]=t.array[i+s];return this}set(e,t=0){return this.array.set(e,t),this}clone(e){e.arrayBuffers===void 0&&(e.arrayBuffers={});let t=lv(this.array);e.arrayBuffers[t]===void 0&&(e.arrayBuffers[t]=this.array.slice(0).buffer);let i=new this.array.constructor(e.arrayBuffers[t]),s=new this.constructor(i,this.stride);return s.setUsage(this.usage),s}onUpload(e){return this.onUploadCallback=e,this}toJSON(e){e.arrayBuffers===void 0&&(e.arrayBuffers={});let t=lv(this.array);e.arrayBuffers[t]===void 0&&(e.arrayBuffers[t]=Array.from(new Uint32Array(this.array.slice(0).buffer)));let i={uuid:this.uuid,buffer:t,type:this.array.constructor.name,stride:this.stride};return i.usage=this.usage,i}};function lv(n){return n.buffer._uuid===void 0&&(n.buffer._uuid=Dr()),n.byteOffset===0&&n.byteLength===n.buffer.byteLength?n.buffer._uuid:n.buffer._uuid+":"+n.byteOffset+":"+n.byteLength}var ri=new O,Rl=class n{constructor(e,t,i,s=!1){this.isInterleavedBufferAttribute=!0,this.name="",this.data=e,this.itemSize=t,this.offset=i,this.normalized=s,this._normalizationScale=e!==void 0?Yu(e.array):void 0}get count(){return this.data.count}get array(){return this.data.array}set needsUpdate(e){this.data.needsUpdate=e}applyMatrix4(e){for(let t=0,i=this.data.count;t<i;t++)ri.fromBufferAttribute(this,t),ri.applyMatrix4(e),this.setXYZ(t,ri.x,ri.y,ri.z);return this}applyNormalMatrix(e){for(let t=0,i=this.count;t<i;t++)ri.fromBufferAttribute(this,t),ri.applyNormalMatrix(e),this.setXYZ(t,ri.x,ri.y,ri.z);return this}transformDirection(e){for(let t=0,i=this.count;t<i;t++)ri.fromBufferAttribute(this,t),ri.transformDirection(e),this.setXYZ(t,ri.x,ri.y,ri.z);return this}getComponent(e,t){let i=this.array[e*this.data.stride+this.offset+t];return this.normalized&&(i=this._denormalize(i)),i}setComponent(e,t,i){return this.normalized&&(i=this._normalize(i)),this.data.array[e*this.data.stride+this.offset+t]=i,this}setX(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset]=t,this}setY(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+1]=t,this}setZ(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+2]=t,this}setW(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+3]=t,this}getX(e){let t=this.data.array[e*this.data.stride+this.offset];return this.normalized&&(t=this._denormalize(t)),t}getY(e){let t=this.data.array[e*this.data.stride+this.offset+1];return this.normalized&&(t=this._denormalize(t)),t}getZ(e){let t=this.data.array[e*this.data.stride+this.offset+2];return this.normalized&&(t=this._denormalize(t)),t}getW(e){let t=this.data.array[e*this.data.stride+this.offset+3];return this.normalized&&(t=this._denormalize(t)),t}setXY(e,t,i){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),i=this._normalize(i)),this.data.array[e+0]=t,this.data.array[e+1]=i,this}setXYZ(e,t,i,s){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),i=this._normalize(i),s=this._normalize(s)),this.data.array[e+0]=t,this.data.array[e+1]=i,this.data.array[e+2]=s,this}setXYZW(e,t,i,s,r){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),i=this._normalize(i),s=this._normalize(s),r=this._normalize(r)),this.data.array[e+0]=t,this.data.array[e+1]=i,this.data.array[e+2]=s,this.data.array[e+3]=r,this}clone(e){if(e===void 0){Ml("InterleavedBufferAttribute.clone(): Cloning an interleaved buffer attribute will de-interleave buffer data.");let t=[];for(let i=0;i<this.count;i++){let s=i*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)t.push(this.data.array[s+r])}return new fn(new this.array.constructor(t),this.itemSize,this.normalized)}else return e.interleavedBuffers===void 0&&(e.interleavedBuffers={}),e.interleavedBuffers[this.data.uuid]===void 0&&(e.interleavedBuffers[this.data.uuid]=this.data.clone(e)),new n(e.interleavedBuffers[this.data.uuid],this.itemSize,this.offset,this.normalized)}toJSON(e){if(e===void 0){Ml("InterleavedBufferAttribute.toJSON(): Serializing an interleaved buffer attribute will de-interleave buffer data.");let t=[];for(let i=0;i<this.count;i++){let s=i*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)t.push(this.data.array[s+r])}return{itemSize:this.itemSize,type:this.array.constructor.name,array:t,normalized:this.normalized}}else return e.interleavedBuffers===void 0&&(e.interleavedBuffers={}),e.interleavedBuffers[this.data.uuid]===void 0&&(e.interleavedBuffers[this.data.uuid]=this.data.toJSON(e)),{isInterleavedBufferAttribute:!0,itemSize:this.itemSize,data:this.data.uuid,offset:this.offset,normalized:this.normalized}}_denormalize(e){let t=this._normalizationScale;return t!==void 0?Math.max(e/t,-1):Fp(e,this.data.array)}_normalize(e){let t=this._normalizationScale;return t!==void 0?Math.round(e*t):Op(e,this.data.array)}},$d=new O,uw=new O,fw=new Qe,Ci=class{constructor(e=new O(1,0,0),t=0){this.isPlane=!0,this.normal=e,this.constant=t}set(e,t){return this.normal.copy(e),this.constant=t,this}setComponents(e,t,i,s){return this.normal.set(e,t,i),this.constant=s,this}setFromNormalAndCoplanarPoint(e,t){return this.normal.copy(e),this.constant=-t.dot(this.normal),this}setFromCoplanarPoints(e,t,i){let s=$d.subVectors(i,t).cross(uw.subVectors(e,t)).normalize();return this.setFromNormalAndCoplanarPoint(s,e),this}copy(e){return this.normal.copy(e.normal),this.constant=e.constant,this}normalize(){let e=1/this.normal.length();return this.normal.multiplyScalar(e),this.constant*=e,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(e){return this.normal.dot(e)+this.constant}distanceToSphere(e){return this.distanceToPoint(e.center)-e.radius}projectPoint(e,t){return t.copy(e).addScaledVector(this.normal,-this.distanceToPoint(e))}intersectLine(e,t,i=!0){let s=e.delta($d),r=this.normal.dot(s);if(r===0)return this.distanceToPoint(e.start)===0?t.copy(e.start):null;let o=-(e.start.dot(this.normal)+this.constant)/r;return i===!0&&(o<0||o>1)?null:t.copy(e.start).addScaledVector(s,o)}intersectsLine(e){let t=this.distanceToPoint(e.start),i=this.distanceToPoint(e.end);return t<0&&i>0||i<0&&t>0}intersectsBox(e){return e.intersectsPlane(this)}intersectsSphere(e){return e.intersectsPlane(this)}coplanarPoint(e){return e.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(e,t){let i=t||fw.getNormalMatrix(e),s=this.coplanarPoint($d).applyMatrix4(e),r=this.normal.applyMatrix3(i).normalize();return this.constant=-s.dot(r),this}translate(e){return this.constant-=e.dot(this.normal),this}equals(e){return e.normal.equals(this.normal)&&e.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(e){return this.normal.fromArray(e.normal),this.constant=e.constant,this}},dw=0,Qi=class extends ji{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:dw++}),this.uuid=Dr(),this.name="",this.type="Material",this.blending=ua,this.side=Pr,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=fp,this.blendDst=dp,this.blendEquation=to,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new Ke(0,0,0),this.blendAlpha=0,this.depthFunc=Qo,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=ey,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=Eh,this.stencilZFail=Eh,this.stencilZPass=Eh,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(e){this._alphaTest>0!=e>0&&this.version++,this._alphaTest=e}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(e){if(e!==void 0)for(let t in e){let i=e[t];if(i===void 0){Je(`Material: parameter '${t}' has value of undefined.`);continue}let s=this[t];if(s===void 0){Je(`Material: '${t}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(i):s&&s.isVector2&&i&&i.isVector2||s&&s.isEuler&&i&&i.isEuler||s&&s.isVector3&&i&&i.isVector3?s.copy(i):this[t]=i}}toJSON(e){let t=e===void 0||typeof e=="string";t&&(e={textures:{},images:{}});let i={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};i.uuid=this.uuid,i.type=this.type,i.blending=this.blending,i.side=this.side,i.shadowSide=this.shadowSide,i.vertexColors=this.vertexColors,i.opacity=this.opacity,i.transparent=this.transparent,i.blendSrc=this.blendSrc,i.blendDst=this.blendDst,i.blendEquation=this.blendEquation,i.blendSrcAlpha=this.blendSrcAlpha,i.blendDstAlpha=this.blendDstAlpha,i.blendEquationAlpha=this.blendEquationAlpha,i.blendColor=this.blendColor.getHex(),i.blendAlpha=this.blendAlpha,i.depthFunc=this.depthFunc,i.depthTest=this.depthTest,i.depthWrite=this.depthWrite,i.colorWrite=this.colorWrite,i.clipIntersection=this.clipIntersection,i.clipShadows=this.clipShadows,i.stencilWriteMask=this.stencilWriteMask,i.stencilFunc=this.stencilFunc,i.stencilRef=this.stencilRef,i.stencilFuncMask=this.stencilFuncMask,i.stencilFail=this.stencilFail,i.stencilZFail=this.stencilZFail,i.stencilZPass=this.stencilZPass,i.stencilWrite=this.stencilWrite,i.polygonOffset=this.polygonOffset,i.polygonOffsetFactor=this.polygonOffsetFactor,i.polygonOffsetUnits=this.polygonOffsetUnits,i.dithering=this.dithering,i.alphaTest=this.alphaTest,i.alphaHash=this.alphaHash,i.alphaToCoverage=this.alphaToCoverage,i.premultipliedAlpha=this.premultipliedAlpha,i.forceSinglePass=this.forceSinglePass,i.allowOverride=this.allowOverride,i.visible=this.visible,i.toneMapped=this.toneMapped,i.name=this.name,this.color&&this.color.isColor&&(i.color=this.color.getHex()),this.roughness!==void 0&&(i.roughness=this.roughness),this.metalness!==void 0&&(i.metalness=this.metalness),this.sheen!==void 0&&(i.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(i.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(i.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(i.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(i.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(i.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(i.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(i.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(i.shininess=this.shininess),this.clearcoat!==void 0&&(i.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(i.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(i.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(i.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(e).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(i.clearcoatMap=this.clearcoatMap.toJSON(e).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(i.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(e).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(i.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(e).uuid,i.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(i.sheenColorMap=this.sheenColorMap.toJSON(e).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(i.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(e).uuid),this.dispersion!==void 0&&(i.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(i.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(i.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(i.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(i.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(i.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(i.iridescenceMap=this.iridescenceMap.toJSON(e).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(i.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(e).uuid),this.anisotropy!==void 0&&(i.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(i.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(i.anisotropyMap=this.anisotropyMap.toJSON(e).uuid),this.map&&this.map.isTexture&&(i.map=this.map.toJSON(e).uuid),this.matcap&&this.matcap.isTexture&&(i.matcap=this.matcap.toJSON(e).uuid),this.alphaMap&&this.alphaMap.isTexture&&(i.alphaMap=this.alphaMap.toJSON(e).uuid),this.lightMap&&this.lightMap.isTexture&&(i.lightMap=this.lightMap.toJSON(e).uuid,i.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(i.aoMap=this.aoMap.toJSON(e).uuid,i.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(i.bumpMap=this.bumpMap.toJSON(e).uuid,i.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(i.normalMap=this.normalMap.toJSON(e).uuid,i.normalMapType=this.normalMapType,i.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(i.displacementMap=this.displacementMap.toJSON(e).uuid,i.displacementScale=this.displacementScale,i.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(i.roughnessMap=this.roughnessMap.toJSON(e).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(i.metalnessMap=this.metalnessMap.toJSON(e).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(i.emissiveMap=this.emissiveMap.toJSON(e).uuid),this.specularMap&&this.specularMap.isTexture&&(i.specularMap=this.specularMap.toJSON(e).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(i.specularIntensityMap=this.specularIntensityMap.toJSON(e).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(i.specularColorMap=this.specularColorMap.toJSON(e).uuid),this.envMap&&this.envMap.isTexture&&(i.envMap=this.envMap.toJSON(e).uuid,this.combine!==void 0&&(i.combine=this.combine)),this.envMapRotation!==void 0&&(i.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(i.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(i.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(i.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(i.gradientMap=this.gradientMap.toJSON(e).uuid),this.transmission!==void 0&&(i.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(i.transmissionMap=this.transmissionMap.toJSON(e).uuid),this.thickness!==void 0&&(i.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(i.thicknessMap=this.thicknessMap.toJSON(e).uuid),this.attenuationDistance!==void 0&&(i.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(i.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(i.size=this.size),this.sizeAttenuation!==void 0&&(i.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(i.clippingPlanes=this.clippingPlanes.map(r=>r.toJSON())),this.rotation!==void 0&&(i.rotation=this.rotation),this.depthPacking!==void 0&&(i.depthPacking=this.depthPacking),this.linewidth!==void 0&&(i.linewidth=this.linewidth),this.linecap!==void 0&&(i.linecap=this.linecap),this.linejoin!==void 0&&(i.linejoin=this.linejoin),this.dashSize!==void 0&&(i.dashSize=this.dashSize),this.gapSize!==void 0&&(i.gapSize=this.gapSize),this.scale!==void 0&&(i.scale=this.scale),this.wireframe!==void 0&&(i.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(i.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(i.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(i.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(i.flatShading=this.flatShading),this.fog!==void 0&&(i.fog=this.fog),Object.keys(this.userData).length>0&&(i.userData=this.userData);function s(r){let o=[];for(let a in r){let l=r[a];delete l.metadata,o.push(l)}return o}if(t){let r=s(e.textures),o=s(e.images);r.length>0&&(i.textures=r),o.length>0&&(i.images=o)}return i}fromJSON(e,t){if(e.uuid!==void 0&&(this.uuid=e.uuid),e.name!==void 0&&(this.name=e.name),e.color!==void 0&&this.color!==void 0&&this.color.setHex(e.color),e.roughness!==void 0&&(this.roughness=e.roughness),e.metalness!==void 0&&(this.metalness=e.metalness),e.sheen!==void 0&&(this.sheen=e.sheen),e.sheenColor!==void 0&&(this.sheenColor=new Ke().setHex(e.sheenColor)),e.sheenRoughness!==void 0&&(this.sheenRoughness=e.sheenRoughness),e.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(e.emissive),e.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(e.specular),e.specularIntensity!==void 0&&(this.specularIntensity=e.specularIntensity),e.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(e.specularColor),e.shininess!==void 0&&(this.shininess=e.shininess),e.clearcoat!==void 0&&(this.clearcoat=e.clearcoat),e.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=e.clearcoatRoughness),e.diffuseRoughness!==void 0&&(this.diffuseRoughness=e.diffuseRoughness),e.dispersion!==void 0&&(this.dispersion=e.dispersion),e.retroreflectivity!==void 0&&(this.retroreflectivity=e.retroreflectivity),e.iridescence!==void 0&&(this.iridescence=e.iridescence),e.iridescenceIOR!==void 0&&(this.iridescenceIOR=e.iridescenceIOR),e.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessMinimum),e.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=e.iridescenceThicknessMaximum),e.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=e.iridescenceThicknessRange[1]),e.transmission!==void 0&&(this.transmission=e.transmission),e.thickness!==void 0&&(this.thickness=e.thickness),e.attenuationDistance!==void 0&&(this.attenuationDistance=e.attenuationDistance),e.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(e.attenuationColor),e.anisotropy!==void 0&&(this.anisotropy=e.anisotropy),e.anisotropyRotation!==void 0&&(this.anisotropyRotation=e.anisotropyRotation),e.fog!==void 0&&(this.fog=e.fog),e.flatShading!==void 0&&(this.flatShading=e.flatShading),e.blending!==void 0&&(this.blending=e.blending),e.combine!==void 0&&(this.combine=e.combine),e.side!==void 0&&(this.side=e.side),e.shadowSide!==void 0&&(this.shadowSide=e.shadowSide),e.opacity!==void 0&&(this.opacity=e.opacity),e.transparent!==void 0&&(this.transparent=e.transparent),e.alphaTest!==void 0&&(this.alphaTest=e.alphaTest),e.alphaHash!==void 0&&(this.alphaHash=e.alphaHash),e.depthFunc!==void 0&&(this.depthFunc=e.depthFunc),e.depthTest!==void 0&&(this.depthTest=e.depthTest),e.depthWrite!==void 0&&(this.depthWrite=e.depthWrite),e.colorWrite!==void 0&&(this.colorWrite=e.colorWrite),e.clippingPlanes!==void 0&&(this.clippingPlanes=e.clippingPlanes.map(i=>new Ci().fromJSON(i))),e.clipIntersection!==void 0&&(this.clipIntersection=e.clipIntersection),e.clipShadows!==void 0&&(this.clipShadows=e.clipShadows),e.depthPacking!==void 0&&(this.depthPacking=e.depthPacking),e.blendSrc!==void 0&&(this.blendSrc=e.blendSrc),e.blendDst!==void 0&&(this.blendDst=e.blendDst),e.blendEquation!==void 0&&(this.blendEquation=e.blendEquation),e.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=e.blendSrcAlpha),e.blendDstAlpha!==void 0&&(this.blendDstAlpha=e.blendDstAlpha),e.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=e.blendEquationAlpha),e.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(e.blendColor),e.blendAlpha!==void 0&&(this.blendAlpha=e.blendAlpha),e.stencilWriteMask!==void 0&&(this.stencilWriteMask=e.stencilWriteMask),e.stencilFunc!==void 0&&(this.stencilFunc=e.stencilFunc),e.stencilRef!==void 0&&(this.stencilRef=e.stencilRef),e.stencilFuncMask!==void 0&&(this.stencilFuncMask=e.stencilFuncMask),e.stencilFail!==void 0&&(this.stencilFail=e.stencilFail),e.stencilZFail!==void 0&&(this.stencilZFail=e.stencilZFail),e.stencilZPass!==void 0&&(this.stencilZPass=e.stencilZPass),e.stencilWrite!==void 0&&(this.stencilWrite=e.stencilWrite),e.wireframe!==void 0&&(this.wireframe=e.wireframe),e.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=e.wireframeLinewidth),e.wireframeLinecap!==void 0&&(this.wireframeLinecap=e.wireframeLinecap),e.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=e.wireframeLinejoin),e.rotation!==void 0&&(this.rotation=e.rotation),e.linewidth!==void 0&&(this.linewidth=e.linewidth),e.linecap!==void 0&&(this.linecap=e.linecap),e.linejoin!==void 0&&(this.linejoin=e.linejoin),e.dashSize!==void 0&&(this.dashSize=e.dashSize),e.gapSize!==void 0&&(this.gapSize=e.gapSize),e.scale!==void 0&&(this.scale=e.scale),e.polygonOffset!==void 0&&(this.polygonOffset=e.polygonOffset),e.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=e.polygonOffsetFactor),e.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=e.polygonOffsetUnits),e.dithering!==void 0&&(this.dithering=e.dithering),e.alphaToCoverage!==void 0&&(this.alphaToCoverage=e.alphaToCoverage),e.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=e.premultipliedAlpha),e.forceSinglePass!==void 0&&(this.forceSinglePass=e.forceSinglePass),e.allowOverride!==void 0&&(this.allowOverride=e.allowOverride),e.visible!==void 0&&(this.visible=e.visible),e.toneMapped!==void 0&&(this.toneMapped=e.toneMapped),e.userData!==void 0&&(this.userData=e.userData),e.vertexColors!==void 0&&(typeof e.vertexColors=="number"?this.vertexColors=e.vertexColors>0:this.vertexColors=e.vertexColors),e.size!==void 0&&(this.size=e.size),e.sizeAttenuation!==void 0&&(this.sizeAttenuation=e.sizeAttenuation),e.map!==void 0&&(this.map=t[e.map]||null),e.matcap!==void 0&&(this.matcap=t[e.matcap]||null),e.alphaMap!==void 0&&(this.alphaMap=t[e.alphaMap]||null),e.bumpMap!==void 0&&(this.bumpMap=t[e.bumpMap]||null),e.bumpScale!==void 0&&(this.bumpScale=e.bumpScale),e.normalMap!==void 0&&(this.normalMap=t[e.normalMap]||null),e.normalMapType!==void 0&&(this.normalMapType=e.normalMapType),e.normalScale!==void 0){let i=e.normalScale;Array.isArray(i)===!1&&(i=[i,i]),this.normalScale=new $e().fromArray(i)}return e.displacementMap!==void 0&&(this.displacementMap=t[e.displacementMap]||null),e.displacementScale!==void 0&&(this.displacementScale=e.displacementScale),e.displacementBias!==void 0&&(this.displacementBias=e.displacementBias),e.roughnessMap!==void 0&&(this.roughnessMap=t[e.roughnessMap]||null),e.metalnessMap!==void 0&&(this.metalnessMap=t[e.metalnessMap]||null),e.emissiveMap!==void 0&&(this.emissiveMap=t[e.emissiveMap]||null),e.emissiveIntensity!==void 0&&(this.emissiveIntensity=e.emissiveIntensity),e.specularMap!==void 0&&(this.specularMap=t[e.specularMap]||null),e.specularIntensityMap!==void 0&&(this.specularIntensityMap=t[e.specularIntensityMap]||null),e.specularColorMap!==void 0&&(this.specularColorMap=t[e.specularColorMap]||null),e.envMap!==void 0&&(this.envMap=t[e.envMap]||null),e.envMapRotation!==void 0&&this.envMapRotation.fromArray(e.envMapRotation),e.envMapIntensity!==void 0&&(this.envMapIntensity=e.envMapIntensity),e.reflectivity!==void 0&&(this.reflectivity=e.reflectivity),e.refractionRatio!==void 0&&(this.refractionRatio=e.refractionRatio),e.lightMap!==void 0&&(this.lightMap=t[e.lightMap]||null),e.lightMapIntensity!==void 0&&(this.lightMapIntensity=e.lightMapIntensity),e.aoMap!==void 0&&(this.aoMap=t[e.aoMap]||null),e.aoMapIntensity!==void 0&&(this.aoMapIntensity=e.aoMapIntensity),e.gradientMap!==void 0&&(this.gradientMap=t[e.gradientMap]||null),e.clearcoatMap!==void 0&&(this.clearcoatMap=t[e.clearcoatMap]||null),e.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=t[e.clearcoatRoughnessMap]||null),e.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=t[e.clearcoatNormalMap]||null),e.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new $e().fromArray(e.clearcoatNormalScale)),e.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=t[e.diffuseRoughnessMap]||null),e.iridescenceMap!==void 0&&(this.iridescenceMap=t[e.iridescenceMap]||null),e.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=t[e.iridescenceThicknessMap]||null),e.transmissionMap!==void 0&&(this.transmissionMap=t[e.transmissionMap]||null),e.thicknessMap!==void 0&&(this.thicknessMap=t[e.thicknessMap]||null),e.anisotropyMap!==void 0&&(this.anisotropyMap=t[e.anisotropyMap]||null),e.sheenColorMap!==void 0&&(this.sheenColorMap=t[e.sheenColorMap]||null),e.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=t[e.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(e){this.name=e.name,this.blending=e.blending,this.side=e.side,this.vertexColors=e.vertexColors,this.opacity=e.opacity,this.transparent=e.transparent,this.blendSrc=e.blendSrc,this.blendDst=e.blendDst,this.blendEquation=e.blendEquation,this.blendSrcAlpha=e.blendSrcAlpha,this.blendDstAlpha=e.blendDstAlpha,this.blendEquationAlpha=e.blendEquationAlpha,this.blendColor.copy(e.blendColor),this.blendAlpha=e.blendAlpha,this.depthFunc=e.depthFunc,this.depthTest=e.depthTest,this.depthWrite=e.depthWrite,this.stencilWriteMask=e.stencilWriteMask,this.stencilFunc=e.stencilFunc,this.stencilRef=e.stencilRef,this.stencilFuncMask=e.stencilFuncMask,this.stencilFail=e.stencilFail,this.stencilZFail=e.stencilZFail,this.stencilZPass=e.stencilZPass,this.stencilWrite=e.stencilWrite;let t=e.clippingPlanes,i=null;if(t!==null){let s=t.length;i=new Array(s);for(let r=0;r!==s;++r)i[r]=t[r].clone()}return this.clippingPlanes=i,this.clipIntersection=e.clipIntersection,this.clipShadows=e.clipShadows,this.shadowSide=e.shadowSide,this.colorWrite=e.colorWrite,this.precision=e.precision,this.polygonOffset=e.polygonOffset,this.polygonOffsetFactor=e.polygonOffsetFactor,this.polygonOffsetUnits=e.polygonOffsetUnits,this.dithering=e.dithering,this.alphaTest=e.alphaTest,this.alphaHash=e.alphaHash,this.alphaToCoverage=e.alphaToCoverage,this.premultipliedAlpha=e.premultipliedAlpha,this.forceSinglePass=e.forceSinglePass,this.allowOverride=e.allowOverride,this.visible=e.visible,this.toneMapped=e.toneMapped,this.userData=JSON.parse(JSON.stringify(e.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(e){e===!0&&this.version++}},ra=class extends Qi{constructor(e){super(),this.isSpriteMaterial=!0,this.type="SpriteMaterial",this.color=new Ke(16777215),this.map=null,this.alphaMap=null,this.rotation=0,this.sizeAttenuation=!0,this.transparent=!0,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.alphaMap=e.alphaMap,this.rotation=e.rotation,this.sizeAttenuation=e.sizeAttenuation,this.fog=e.fog,this}},Xo,fl=new O,qo=new O,Yo=new O,$o=new $e,dl=new $e,uy=new Dt,rh=new O,pl=new O,oh=new O,cv=new $e,Zd=new $e,hv=new $e,Js=class extends Cn{constructor(e=new ra){if(super(),this.isSprite=!0,this.type="Sprite",Xo===void 0){Xo=new $t;let t=new Float32Array([-.5,-.5,0,0,0,.5,-.5,0,1,0,.5,.5,0,1,1,-.5,.5,0,0,1]),i=new zh(t,5);Xo.setIndex([0,1,2,0,2,3]),Xo.setAttribute("position",new Rl(i,3,0,!1)),Xo.setAttribute("uv",new Rl(i,2,3,!1))}this.geometry=Xo,this.material=e,this.center=new $e(.5,.5),this.count=1}intersectsFrustum(e){return e.intersectsSprite(this)}raycast(e,t){e.camera===null&&st('Sprite: "Raycaster.camera" needs to be set in order to raycast against sprites.'),qo.setFromMatrixScale(this.matrixWorld),uy.copy(e.camera.matrixWorld),this.modelViewMatrix.multiplyMatrices(e.camera.matrixWorldInverse,this.matrixWorld),Yo.setFromMatrixPosition(this.modelViewMatrix),e.camera.isPerspectiveCamera&&this.material.sizeAttenuation===!1&&qo.multiplyScalar(-Yo.z);let i=this.material.rotation,s,r;i!==0&&(r=Math.cos(i),s=Math.sin(i));let o=this.center;ah(rh.set(-.5,-.5,0),Yo,o,qo,s,r),ah(pl.set(.5,-.5,0),Yo,o,qo,s,r),ah(oh.set(.5,.5,0),Yo,o,qo,s,r),cv.set(0,0),Zd.set(1,0),hv.set(1,1);let a=e.ray.intersectTriangle(rh,pl,oh,!1,fl);if(a===null&&(ah(pl.set(-.5,.5,0),Yo,o,qo,s,r),Zd.set(0,1),a=e.ray.intersectTriangle(rh,oh,pl,!1,fl),a===null))return;let l=e.ray.origin.distanceTo(fl);l<e.near||l>e.far||t.push({distance:l,point:fl.clone(),uv:Ys.getInterpolation(fl,rh,pl,oh,cv,Zd,hv,new $e),face:null,object:this})}copy(e,t){return super.copy(e,t),e.center!==void 0&&this.center.copy(e.center),this.material=e.material,this}toJSON(e){let t=super.toJSON(e);return t.object.center=this.center.toArray(),t}};function ah(n,e,t,i,s,r){$o.subVectors(n,t).addScalar(.5).multiply(i),s!==void 0?(dl.x=r*$o.x-s*$o.y,dl.y=s*$o.x+r*$o.y):dl.copy($o),n.copy(e),n.x+=dl.x,n.y+=dl.y,n.applyMatrix4(uy)}var qs=new O,Kd=new O,lh=new O,ch=new O,Sr=class{constructor(e=new O,t=new O(0,0,-1)){this.origin=e,this.direction=t}set(e,t){return this.origin.copy(e),this.direction.copy(t),this}copy(e){return this.origin.copy(e.origin),this.direction.copy(e.direction),this}at(e,t){return t.copy(this.origin).addScaledVector(this.direction,e)}lookAt(e){return this.direction.copy(e).sub(this.origin).normalize(),this}recast(e){return this.origin.copy(this.at(e,qs)),this}closestPointToPoint(e,t){t.subVectors(e,this.origin);let i=t.dot(this.direction);return i<0?t.copy(this.origin):t.copy(this.origin).addScaledVector(this.direction,i)}distanceToPoint(e){return Math.sqrt(this.distanceSqToPoint(e))}distanceSqToPoint(e){let t=qs.subVectors(e,this.origin).dot(this.direction);return t<0?this.origin.distanceToSquared(e):(qs.copy(this.origin).addScaledVector(this.direction,t),qs.distanceToSquared(e))}distanceSqToSegment(e,t,i,s){Kd.copy(e).add(t).multiplyScalar(.5),lh.copy(t).sub(e).normalize(),ch.copy(this.origin).sub(Kd);let r=e.distanceTo(t)*.5,o=-this.direction.dot(lh),a=ch.dot(this.direction),l=-ch.dot(lh),c=ch.lengthSq(),h=Math.abs(1-o*o),u,f,d,g;if(h>0)if(u=o*l-a,f=o*a-l,g=r*h,u>=0)if(f>=-g)if(f<=g){let _=1/h;u*=_,f*=_,d=u*(u+o*f+2*a)+f*(o*u+f+2*l)+c}else f=r,u=Math.max(0,-(o*f+a)),d=-u*u+f*(f+2*l)+c;else f=-r,u=Math.max(0,-(o*f+a)),d=-u*u+f*(f+2*l)+c;else f<=-g?(u=Math.max(0,-(-o*r+a)),f=u>0?-r:Math.min(Math.max(-r,-l),r),d=-u*u+f*(f+2*l)+c):f<=g?(u=0,f=Math.min(Math.max(-r,-l),r),d=f*(f+2*l)+c):(u=Math.max(0,-(o*r+a)),f=u>0?r:Math.min(Math.max(-r,-l),r),d=-u*u+f*(f+2*l)+c);else f=o>0?-r:r,u=Math.max(0,-(o*f+a)),d=-u*u+f*(f+2*l)+c;return i&&i.copy(this.origin).addScaledVector(this.direction,u),s&&s.copy(Kd).addScaledVector(lh,f),d}intersectSphere(e,t){if(e.radius<0)return null;qs.subVectors(e.center,this.origin);let i=qs.dot(this.direction),s=qs.dot(qs)-i*i,r=e.radius*e.radius;if(s>r)return null;let o=Math.sqrt(r-s),a=i-o,l=i+o;return l<0?null:a<0?this.at(l,t):this.at(a,t)}intersectsSphere(e){return e.radius<0?!1:this.distanceSqToPoint(e.center)<=e.radius*e.radius}distanceToPlane(e){let t=e.normal.dot(this.direction);if(t===0)return e.distanceToPoint(this.origin)===0?0:null;let i=-(this.origin.dot(e.normal)+e.constant)/t;return i>=0?i:null}intersectPlane(e,t){let i=this.distanceToPlane(e);return i===null?null:this.at(i,t)}intersectsPlane(e){let t=e.distanceToPoint(this.origin);return t===0||e.normal.dot(this.direction)*t<0}intersectBox(e,t){let i,s,r,o,a,l,c=1/this.direction.x,h=1/this.direction.y,u=1/this.direction.z,f=this.origin;return c>=0?(i=(e.min.x-f.x)*c,s=(e.max.x-f.x)*c):(i=(e.max.x-f.x)*c,s=(e.min.x-f.x)*c),h>=0?(r=(e.min.y-f.y)*h,o=(e.max.y-f.y)*h):(r=(e.max.y-f.y)*h,o=(e.min.y-f.y)*h),i>o||r>s||((r>i||isNaN(i))&&(i=r),(o<s||isNaN(s))&&(s=o),u>=0?(a=(e.min.z-f.z)*u,l=(e.max.z-f.z)*u):(a=(e.max.z-f.z)*u,l=(e.min.z-f.z)*u),i>l||a>s)||((a>i||i!==i)&&(i=a),(l<s||s!==s)&&(s=l),s<0)?null:this.at(i>=0?i:s,t)}intersectsBox(e){return this.intersectBox(e,qs)!==null}intersectTriangle(e,t,i,s,r){let o=this.origin,a=this.direction,l=a.x,c=a.y,h=a.z,u=e.x-o.x,f=e.y-o.y,d=e.z-o.z,g=t.x-o.x,_=t.y-o.y,m=t.z-o.z,p=i.x-o.x,x=i.y-o.y,A=i.z-o.z,w=Math.abs(l),P=Math.abs(c),E=Math.abs(h),y,T,k,N,I,z,W,L,X,$,V,ce;if(w>=P&&w>=E?(k=l,z=u,X=g,ce=p,l>=0?(y=c,T=h,N=f,I=d,W=_,L=m,$=x,V=A):(y=h,T=c,N=d,I=f,W=m,L=_,$=A,V=x)):P>=E?(k=c,z=f,X=_,ce=x,c>=0?(y=h,T=l,N=d,I=u,W=m,L=g,$=A,V=p):(y=l,T=h,N=u,I=d,W=g,L=m,$=p,V=A)):(k=h,z=d,X=m,ce=A,h>=0?(y=l,T=c,N=u,I=f,W=g,L=_,$=p,V=x):(y=c,T=l,N=f,I=u,W=_,L=g,$=x,V=p)),k===0)return null;let K=y/k,ee=T/k,se=1/k,de=N-K*z,he=I-ee*z,te=W-K*X,me=L-ee*X,ve=$-K*ce,Me=V-ee*ce,xe=ve*me-Me*te,We=de*Me-he*ve,ot=te*he-me*de;if(s){if(xe<0||We<0||ot<0)return null}else if((xe<0||We<0||ot<0)&&(xe>0||We>0||ot>0))return null;let He=xe+We+ot;if(He===0)return null;let ut=se*(xe*z+We*X+ot*ce);return(He>0?ut<0:ut>0)?null:this.at(ut/He,r)}applyMatrix4(e){return this.origin.applyMatrix4(e),this.direction.transformDirection(e),this}equals(e){return e.origin.equals(this.origin)&&e.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},js=class extends Qi{constructor(e){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new Ke(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new Ks,this.combine=ou,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.specularMap=e.specularMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.combine=e.combine,this.reflectivity=e.reflectivity,this.refractionRatio=e.refractionRatio,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.fog=e.fog,this}},uv=new Dt,Kr=new Sr,hh=new xr,fv=new O,uh=new O,fh=new O,dh=new O,Jd=new O,ph=new O,dv=new O,mh=new O,Gn=class extends Cn{constructor(e=new $t,t=new js){super(),this.isMesh=!0,this.type="Mesh",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}updateMorphTargets(){let t=this.geometry.morphAttributes,i=Object.keys(t);if(i.length>0){let s=t[i[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}getVertexPosition(e,t){let i=this.geometry,s=i.attributes.position,r=i.morphAttributes.position,o=i.morphTargetsRelative;t.fromBufferAttribute(s,e);let a=this.morphTargetInfluences;if(r&&a){ph.set(0,0,0);for(let l=0,c=r.length;l<c;l++){let h=a[l],u=r[l];h!==0&&(Jd.fromBufferAttribute(u,e),o?ph.addScaledVector(Jd,h):ph.addScaledVector(Jd.sub(t),h))}t.add(ph)}return t}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let i=this.geometry,s=this.material,r=this.matrixWorld;s!==void 0&&(i.boundingSphere===null&&i.computeBoundingSphere(),hh.copy(i.boundingSphere),hh.applyMatrix4(r),Kr.copy(e.ray).recast(e.near),!(hh.containsPoint(Kr.origin)===!1&&(Kr.intersectSphere(hh,fv)===null||Kr.origin.distanceToSquared(fv)>(e.far-e.near)**2))&&(uv.copy(r).invert(),Kr.copy(e.ray).applyMatrix4(uv),!(i.boundingBox!==null&&Kr.intersectsBox(i.boundingBox)===!1)&&this._computeIntersections(e,t,Kr)))}_computeIntersections(e,t,i){let s,r=this.geometry,o=this.material,a=r.index,l=r.attributes.position,c=r.attributes.uv,h=r.attributes.uv1,u=r.attributes.normal,f=r.groups,d=r.drawRange;if(a!==null)if(Array.isArray(o))for(let g=0,_=f.length;g<_;g++){let m=f[g],p=o[m.materialIndex],x=Math.max(m.start,d.start),A=Math.min(a.count,Math.min(m.start+m.count,d.start+d.count));for(let w=x,P=A;w<P;w+=3){let E=a.getX(w),y=a.getX(w+1),T=a.getX(w+2);s=gh(this,p,e,i,c,h,u,E,y,T),s&&(s.faceIndex=Math.floor(w/3),s.face.materialIndex=m.materialIndex,t.push(s))}}else{let g=Math.max(0,d.start),_=Math.min(a.count,d.start+d.count);for(let m=g,p=_;m<p;m+=3){let x=a.getX(m),A=a.getX(m+1),w=a.getX(m+2);s=gh(this,o,e,i,c,h,u,x,A,w),s&&(s.faceIndex=Math.floor(m/3),t.push(s))}}else if(l!==void 0)if(Array.isArray(o))for(let g=0,_=f.length;g<_;g++){let m=f[g],p=o[m.materialIndex],x=Math.max(m.start,d.start),A=Math.min(l.count,Math.min(m.start+m.count,d.start+d.count));for(let w=x,P=A;w<P;w+=3){let E=w,y=w+1,T=w+2;s=gh(this,p,e,i,c,h,u,E,y,T),s&&(s.faceIndex=Math.floor(w/3),s.face.materialIndex=m.materialIndex,t.push(s))}}else{let g=Math.max(0,d.start),_=Math.min(l.count,d.start+d.count);for(let m=g,p=_;m<p;m+=3){let x=m,A=m+1,w=m+2;s=gh(this,o,e,i,c,h,u,x,A,w),s&&(s.faceIndex=Math.floor(m/3),t.push(s))}}}};function pw(n,e,t,i,s,r,o,a){let l;if(e.side===hi?l=i.intersectTriangle(o,r,s,!0,a):l=i.intersectTriangle(s,r,o,e.side===Pr,a),l===null)return null;mh.copy(a),mh.applyMatrix4(n.matrixWorld);let c=t.ray.origin.distanceTo(mh);return c<t.near||c>t.far?null:{distance:c,point:mh.clone(),object:n}}function gh(n,e,t,i,s,r,o,a,l,c){n.getVertexPosition(a,uh),n.getVertexPosition(l,fh),n.getVertexPosition(c,dh);let h=pw(n,e,t,i,uh,fh,dh,dv);if(h){let u=new O;Ys.getBarycoord(dv,uh,fh,dh,u),s&&(h.uv=Ys.getInterpolatedAttribute(s,a,l,c,u,new $e)),r&&(h.uv1=Ys.getInterpolatedAttribute(r,a,l,c,u,new $e)),o&&(h.normal=Ys.getInterpolatedAttribute(o,a,l,c,u,new O),h.normal.dot(i.direction)>0&&h.normal.multiplyScalar(-1));let f={a,b:l,c,normal:new O,materialIndex:0};Ys.getNormal(uh,fh,dh,f.normal),h.face=f,h.barycoord=u}return h}var oa=class extends ci{constructor(e=null,t=1,i=1,s,r,o,a,l,c=Hn,h=Hn,u,f){super(null,o,a,l,c,h,s,r,u,f),this.isDataTexture=!0,this.image={data:e,width:t,height:i},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}};var Jr=new xr,mw=new $e(.5,.5),vh=new O,br=class{constructor(e=new Ci,t=new Ci,i=new Ci,s=new Ci,r=new Ci,o=new Ci){this.planes=[e,t,i,s,r,o]}set(e,t,i,s,r,o){let a=this.planes;return a[0].copy(e),a[1].copy(t),a[2].copy(i),a[3].copy(s),a[4].copy(r),a[5].copy(o),this}copy(e){let t=this.planes;for(let i=0;i<6;i++)t[i].copy(e.planes[i]);return this}setFromProjectionMatrix(e,t=Vi,i=!1){let s=this.planes,r=e.elements,o=r[0],a=r[1],l=r[2],c=r[3],h=r[4],u=r[5],f=r[6],d=r[7],g=r[8],_=r[9],m=r[10],p=r[11],x=r[12],A=r[13],w=r[14],P=r[15];if(s[0].setComponents(c-o,d-h,p-g,P-x).normalize(),s[1].setComponents(c+o,d+h,p+g,P+x).normalize(),s[2].setComponents(c+a,d+u,p+_,P+A).normalize(),s[3].setComponents(c-a,d-u,p-_,P-A).normalize(),i)s[4].setComponents(l,f,m,w).normalize(),s[5].setComponents(c-l,d-f,p-m,P-w).normalize();else if(s[4].setComponents(c-l,d-f,p-m,P-w).normalize(),t===Vi)s[5].setComponents(c+l,d+f,p+m,P+w).normalize();else if(t===ea)s[5].setComponents(l,f,m,w).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+t);return this}intersectsObject(e){if(e.boundingSphere!==void 0)e.boundingSphere===null&&e.computeBoundingSphere(),Jr.copy(e.boundingSphere).applyMatrix4(e.matrixWorld);else{let t=e.geometry;t.boundingSphere===null&&t.computeBoundingSphere(),Jr.copy(t.boundingSphere).applyMatrix4(e.matrixWorld)}return this.intersectsSphere(Jr)}intersectsSprite(e){Jr.center.set(0,0,0);let t=mw.distanceTo(e.center);return Jr.radius=.7071067811865476+t,Jr.applyMatrix4(e.matrixWorld),this.intersectsSphere(Jr)}intersectsSphere(e){let t=this.planes,i=e.center,s=-e.radius;for(let r=0;r<6;r++)if(t[r].distanceToPoint(i)<s)return!1;return!0}intersectsBox(e){let t=this.planes;for(let i=0;i<6;i++){let s=t[i];if(vh.x=s.normal.x>0?e.max.x:e.min.x,vh.y=s.normal.y>0?e.max.y:e.min.y,vh.z=s.normal.z>0?e.max.z:e.min.z,s.distanceToPoint(vh)<0)return!1}return!0}containsPoint(e){let t=this.planes;for(let i=0;i<6;i++)if(t[i].distanceToPoint(e)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},pv=new Dt,Vh=class n{constructor(){this.coordinateSystem=Vi,this._frustums=[],this._count=0}setFromArrayCamera(e){let t=e.cameras,i=this._frustums;for(let s=0;s<t.length;s++){let r=t[s];pv.multiplyMatrices(r.projectionMatrix,r.matrixWorldInverse),i[s]===void 0&&(i[s]=new br),i[s].setFromProjectionMatrix(pv,r.coordinateSystem,r.reversedDepth)}return this._count=t.length,this}getFrustum(e){return this._frustums[e]}intersectsObject(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].intersectsObject(e))return!0;return!1}intersectsSprite(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].intersectsSprite(e))return!0;return!1}intersectsSphere(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].intersectsSphere(e))return!0;return!1}intersectsBox(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].intersectsBox(e))return!0;return!1}containsPoint(e){let t=this._frustums;for(let i=0;i<this._count;i++)if(t[i].containsPoint(e))return!0;return!1}copy(e){this.coordinateSystem=e.coordinateSystem;let t=this._frustums,i=e._frustums;for(let s=0;s<e._count;s++)t[s]===void 0&&(t[s]=new br),t[s].copy(i[s]);return this._count=e._count,this}clone(){return new n().copy(this)}};var es=class extends Qi{constructor(e){super(),this.isLineBasicMaterial=!0,this.type="LineBasicMaterial",this.color=new Ke(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.linewidth=e.linewidth,this.linecap=e.linecap,this.linejoin=e.linejoin,this.fog=e.fog,this}},Hh=new O,Gh=new O,mv=new Dt,ml=new Sr,yh=new xr,jd=new O,gv=new O,Wh=class extends Cn{constructor(e=new $t,t=new es){super(),this.isLine=!0,this.type="Line",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}computeLineDistances(){let e=this.geometry;if(e.index===null){let t=e.attributes.position,i=[0];for(let s=1,r=t.count;s<r;s++)Hh.fromBufferAttribute(t,s-1),Gh.fromBufferAttribute(t,s),i[s]=i[s-1],i[s]+=Hh.distanceTo(Gh);e.setAttribute("lineDistance",new dn(i,1))}else Je("Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let i=this.geometry,s=this.matrixWorld,r=e.params.Line.threshold,o=i.drawRange;if(i.boundingSphere===null&&i.computeBoundingSphere(),yh.copy(i.boundingSphere),yh.applyMatrix4(s),yh.radius+=r,e.ray.intersectsSphere(yh)===!1)return;mv.copy(s).invert(),ml.copy(e.ray).applyMatrix4(mv);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=this.isLineSegments?2:1,h=i.index,f=i.attributes.position;if(h!==null){let d=Math.max(0,o.start),g=Math.min(h.count,o.start+o.count);for(let _=d,m=g-1;_<m;_+=c){let p=h.getX(_),x=h.getX(_+1),A=_h(this,e,ml,l,p,x,_);A&&t.push(A)}if(this.isLineLoop){let _=h.getX(g-1),m=h.getX(d),p=_h(this,e,ml,l,_,m,g-1);p&&t.push(p)}}else{let d=Math.max(0,o.start),g=Math.min(f.count,o.start+o.count);for(let _=d,m=g-1;_<m;_+=c){let p=_h(this,e,ml,l,_,_+1,_);p&&t.push(p)}if(this.isLineLoop){let _=_h(this,e,ml,l,g-1,d,g-1);_&&t.push(_)}}}updateMorphTargets(){let t=this.geometry.morphAttributes,i=Object.keys(t);if(i.length>0){let s=t[i[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function _h(n,e,t,i,s,r,o){let a=n.geometry.attributes.position;if(Hh.fromBufferAttribute(a,s),Gh.fromBufferAttribute(a,r),t.distanceSqToSegment(Hh,Gh,jd,gv)>i)return;jd.applyMatrix4(n.matrixWorld);let c=e.ray.origin.distanceTo(jd);if(!(c<e.near||c>e.far))return{distance:c,point:gv.clone().applyMatrix4(n.matrixWorld),index:o,face:null,faceIndex:null,barycoord:null,object:n}}var vv=new O,yv=new O,ws=class extends Wh{constructor(e,t){super(e,t),this.isLineSegments=!0,this.type="LineSegments"}computeLineDistances(){let e=this.geometry;if(e.index===null){let t=e.attributes.position,i=[];for(let s=0,r=t.count;s<r;s+=2)vv.fromBufferAttribute(t,s),yv.fromBufferAttribute(t,s+1),i[s]=s===0?0:i[s-1],i[s+1]=i[s]+vv.distanceTo(yv);e.setAttribute("lineDistance",new dn(i,1))}else Je("LineSegments.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}};var jr=class extends Qi{constructor(e){super(),this.isPointsMaterial=!0,this.type="PointsMaterial",this.color=new Ke(16777215),this.map=null,this.alphaMap=null,this.size=1,this.sizeAttenuation=!0,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.alphaMap=e.alphaMap,this.size=e.size,this.sizeAttenuation=e.sizeAttenuation,this.fog=e.fog,this}},_v=new Dt,sp=new Sr,xh=new xr,Sh=new O,aa=class extends Cn{constructor(e=new $t,t=new jr){super(),this.isPoints=!0,this.type="Points",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let i=this.geometry,s=this.matrixWorld,r=e.params.Points.threshold,o=i.drawRange;if(i.boundingSphere===null&&i.computeBoundingSphere(),xh.copy(i.boundingSphere),xh.applyMatrix4(s),xh.radius+=r,e.ray.intersectsSphere(xh)===!1)return;_v.copy(s).invert(),sp.copy(e.ray).applyMatrix4(_v);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=i.index,u=i.attributes.position;if(c!==null){let f=Math.max(0,o.start),d=Math.min(c.count,o.start+o.count);for(let g=f,_=d;g<_;g++){let m=c.getX(g);Sh.fromBufferAttribute(u,m),xv(Sh,m,l,s,e,t,this)}}else{let f=Math.max(0,o.start),d=Math.min(u.count,o.start+o.count);for(let g=f,_=d;g<_;g++)Sh.fromBufferAttribute(u,g),xv(Sh,g,l,s,e,t,this)}}updateMorphTargets(){let t=this.geometry.morphAttributes,i=Object.keys(t);if(i.length>0){let s=t[i[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function xv(n,e,t,i,s,r,o){let a=sp.distanceSqToPoint(n);if(a<t){let l=new O;sp.closestPointToPoint(n,l),l.applyMatrix4(i);let c=s.ray.origin.distanceTo(l);if(c<s.near||c>s.far)return;r.push({distance:c,distanceToRay:Math.sqrt(a),point:l,index:e,face:null,faceIndex:null,barycoord:null,object:o})}}var Pl=class extends ci{constructor(e=[],t=no,i,s,r,o,a,l,c,h){super(e,t,i,s,r,o,a,l,c,h),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(e){this.image=e}},Il=class extends ci{constructor(e,t,i,s,r,o,a,l,c){super(e,t,i,s,r,o,a,l,c),this.isCanvasTexture=!0,this.needsUpdate=!0}};var Qs=class extends ci{constructor(e,t,i=ts,s,r,o,a=Hn,l=Hn,c,h=Zs,u=1){if(h!==Zs&&h!==tr)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let f={width:e,height:t,depth:u};super(f,s,r,o,a,l,h,i,c),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(e){return super.copy(e),this.source=new ia(Object.assign({},e.image)),this.compareFunction=e.compareFunction,this}toJSON(e){let t=super.toJSON(e);return t.compareFunction=this.compareFunction,t}},Dl=class extends Qs{constructor(e,t=ts,i=no,s,r,o=Hn,a=Hn,l,c=Zs){let h={width:e,height:e,depth:1},u=[h,h,h,h,h,h];super(e,e,t,i,s,r,o,a,l,c),this.image=u,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(e){this.image=e}},Ll=class extends ci{constructor(e=null){super(),this.sourceTexture=e,this.isExternalTexture=!0}copy(e){return super.copy(e),this.sourceTexture=e.sourceTexture,this}},Mr=class n extends $t{constructor(e=1,t=1,i=1,s=1,r=1,o=1){super(),this.type="BoxGeometry",this.parameters={width:e,height:t,depth:i,widthSegments:s,heightSegments:r,depthSegments:o};let a=this;s=Math.floor(s),r=Math.floor(r),o=Math.floor(o);let l=[],c=[],h=[],u=[],f=0,d=0;g("z","y","x",-1,-1,i,t,e,o,r,0),g("z","y","x",1,-1,i,t,-e,o,r,1),g("x","z","y",1,1,e,i,t,s,o,2),g("x","z","y",1,-1,e,i,-t,s,o,3),g("x","y","z",1,-1,e,t,i,s,r,4),g("x","y","z",-1,-1,e,t,-i,s,r,5),this.setIndex(l),this.setAttribute("position",new dn(c,3)),this.setAttribute("normal",new dn(h,3)),this.setAttribute("uv",new dn(u,2));function g(_,m,p,x,A,w,P,E,y,T,k){let N=w/y,I=P/T,z=w/2,W=P/2,L=E/2,X=y+1,$=T+1,V=0,ce=0,K=new O;for(let ee=0;ee<$;ee++){let se=ee*I-W;for(let de=0;de<X;de++){let he=de*N-z;K[_]=he*x,K[m]=se*A,K[p]=L,c.push(K.x,K.y,K.z),K[_]=0,K[m]=0,K[p]=E>0?1:-1,h.push(K.x,K.y,K.z),u.push(de/y),u.push(1-ee/T),V+=1}}for(let ee=0;ee<T;ee++)for(let se=0;se<y;se++){let de=f+se+X*ee,he=f+se+X*(ee+1),te=f+(se+1)+X*(ee+1),me=f+(se+1)+X*ee;l.push(de,he,me),l.push(he,te,me),ce+=6}a.addGroup(d,ce,k),d+=ce,f+=V}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new n(e.width,e.height,e.depth,e.widthSegments,e.heightSegments,e.depthSegments)}};var wr=class n extends $t{constructor(e=1,t=1,i=1,s=32,r=1,o=!1,a=0,l=Math.PI*2){super(),this.type="CylinderGeometry",this.parameters={radiusTop:e,radiusBottom:t,height:i,radialSegments:s,heightSegments:r,openEnded:o,thetaStart:a,thetaLength:l};let c=this;s=Math.floor(s),r=Math.floor(r);let h=[],u=[],f=[],d=[],g=0,_=[],m=i/2,p=0;x(),o===!1&&(e>0&&A(!0),t>0&&A(!1)),this.setIndex(h),this.setAttribute("position",new dn(u,3)),this.setAttribute("normal",new dn(f,3)),this.setAttribute("uv",new dn(d,2));function x(){let w=new O,P=new O,E=0,y=(t-e)/i;for(let T=0;T<=r;T++){let k=[],N=T/r,I=N*(t-e)+e;for(let z=0;z<=s;z++){let W=z/s,L=W*l+a,X=Math.sin(L),$=Math.cos(L);P.x=I*X,P.y=-N*i+m,P.z=I*$,u.push(P.x,P.y,P.z),w.set(X,y,$).normalize(),f.push(w.x,w.y,w.z),d.push(W,1-N),k.push(g++)}_.push(k)}for(let T=0;T<s;T++)for(let k=0;k<r;k++){let N=_[k][T],I=_[k+1][T],z=_[k+1][T+1],W=_[k][T+1];(e>0||k!==0)&&(h.push(N,I,W),E+=3),(t>0||k!==r-1)&&(h.push(I,z,W),E+=3)}c.addGroup(p,E,0),p+=E}function A(w){let P=g,E=new $e,y=new O,T=0,k=w===!0?e:t,N=w===!0?1:-1;for(let z=1;z<=s;z++)u.push(0,m*N,0),f.push(0,N,0),d.push(.5,.5),g++;let I=g;for(let z=0;z<=s;z++){let L=z/s*l+a,X=Math.cos(L),$=Math.sin(L);y.x=k*$,y.y=m*N,y.z=k*X,u.push(y.x,y.y,y.z),f.push(0,N,0),E.x=X*.5+.5,E.y=$*.5*N+.5,d.push(E.x,E.y),g++}for(let z=0;z<s;z++){let W=P+z,L=I+z;w===!0?h.push(L,L+1,W):h.push(L+1,L,W),T+=3}c.addGroup(p,T,w===!0?1:2),p+=T}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new n(e.radiusTop,e.radiusBottom,e.height,e.radialSegments,e.heightSegments,e.openEnded,e.thetaStart,e.thetaLength)}},Nl=class n extends wr{constructor(e=1,t=1,i=32,s=1,r=!1,o=0,a=Math.PI*2){super(0,e,t,i,s,r,o,a),this.type="ConeGeometry",this.parameters={radius:e,height:t,radialSegments:i,heightSegments:s,openEnded:r,thetaStart:o,thetaLength:a}}static fromJSON(e){return new n(e.radius,e.height,e.radialSegments,e.heightSegments,e.openEnded,e.thetaStart,e.thetaLength)}};var Ul=class n extends $t{constructor(e=1,t=1,i=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:e,height:t,widthSegments:i,heightSegments:s};let r=e/2,o=t/2,a=Math.floor(i),l=Math.floor(s),c=a+1,h=l+1,u=e/a,f=t/l,d=[],g=[],_=[],m=[];for(let p=0;p<h;p++){let x=p*f-o;for(let A=0;A<c;A++){let w=A*u-r;g.push(w,-x,0),_.push(0,0,1),m.push(A/a),m.push(1-p/l)}}for(let p=0;p<l;p++)for(let x=0;x<a;x++){let A=x+c*p,w=x+c*(p+1),P=x+1+c*(p+1),E=x+1+c*p;d.push(A,w,E),d.push(w,P,E)}this.setIndex(d),this.setAttribute("position",new dn(g,3)),this.setAttribute("normal",new dn(_,3)),this.setAttribute("uv",new dn(m,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new n(e.width,e.height,e.widthSegments,e.heightSegments)}};var Qr=class n extends $t{constructor(e=1,t=32,i=16,s=0,r=Math.PI*2,o=0,a=Math.PI){super(),this.type="SphereGeometry",this.parameters={radius:e,widthSegments:t,heightSegments:i,phiStart:s,phiLength:r,thetaStart:o,thetaLength:a},t=Math.max(3,Math.floor(t)),i=Math.max(2,Math.floor(i));let l=Math.min(o+a,Math.PI),c=0,h=[],u=new O,f=new O,d=[],g=[],_=[],m=[];for(let p=0;p<=i;p++){let x=[],A=p/i,w=o+A*a,P=e*Math.cos(w),E=Math.sqrt(e*e-P*P),y=0;p===0&&o===0?y=.5/t:p===i&&l===Math.PI&&(y=-.5/t);for(let T=0;T<=t;T++){let k=T/t,N=s+k*r;u.x=-E*Math.cos(N),u.y=P,u.z=E*Math.sin(N),g.push(u.x,u.y,u.z),f.copy(u).normalize(),_.push(f.x,f.y,f.z),m.push(k+y,1-A),x.push(c++)}h.push(x)}for(let p=0;p<i;p++)for(let x=0;x<t;x++){let A=h[p][x+1],w=h[p][x],P=h[p+1][x],E=h[p+1][x+1];(p!==0||o>0)&&d.push(A,w,E),(p!==i-1||l<Math.PI)&&d.push(w,P,E)}this.setIndex(d),this.setAttribute("position",new dn(g,3)),this.setAttribute("normal",new dn(_,3)),this.setAttribute("uv",new dn(m,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new n(e.radius,e.widthSegments,e.heightSegments,e.phiStart,e.phiLength,e.thetaStart,e.thetaLength)}};function so(n){let e={};for(let t in n){e[t]={};for(let i in n[t]){let s=n[t][i];if(Sv(s))s.isRenderTargetTexture?(Je("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),e[t][i]=null):e[t][i]=s.clone();else if(Array.isArray(s))if(Sv(s[0])){let r=[];for(let o=0,a=s.length;o<a;o++)r[o]=s[o].clone();e[t][i]=r}else e[t][i]=s.slice();else e[t][i]=s}}return e}function Jn(n){let e={};for(let t=0;t<n.length;t++){let i=so(n[t]);for(let s in i)e[s]=i[s]}return e}function Sv(n){return n&&(n.isColor||n.isMatrix3||n.isMatrix4||n.isVector2||n.isVector3||n.isVector4||n.isTexture||n.isQuaternion)}function gw(n){let e=[];for(let t=0;t<n.length;t++)e.push(n[t].clone());return e}function Bp(n){let e=n.getRenderTarget();return e===null?n.outputColorSpace:e.isXRRenderTarget===!0?e.texture.colorSpace:bt.workingColorSpace}var fy={clone:so,merge:Jn},vw=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,yw=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,Ts=class extends Qi{constructor(e){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=vw,this.fragmentShader=yw,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,e!==void 0&&this.setValues(e)}copy(e){return super.copy(e),this.fragmentShader=e.fragmentShader,this.vertexShader=e.vertexShader,this.uniforms=so(e.uniforms),this.uniformsGroups=gw(e.uniformsGroups),this.defines=Object.assign({},e.defines),this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.fog=e.fog,this.lights=e.lights,this.clipping=e.clipping,this.extensions=Object.assign({},e.extensions),this.glslVersion=e.glslVersion,this.defaultAttributeValues=Object.assign({},e.defaultAttributeValues),this.index0AttributeName=e.index0AttributeName,this.uniformsNeedUpdate=e.uniformsNeedUpdate,this}toJSON(e){let t=super.toJSON(e);t.glslVersion=this.glslVersion,t.uniforms={};for(let s in this.uniforms){let o=this.uniforms[s].value;o&&o.isTexture?t.uniforms[s]={type:"t",value:o.toJSON(e).uuid}:o&&o.isColor?t.uniforms[s]={type:"c",value:o.getHex()}:o&&o.isVector2?t.uniforms[s]={type:"v2",value:o.toArray()}:o&&o.isVector3?t.uniforms[s]={type:"v3",value:o.toArray()}:o&&o.isVector4?t.uniforms[s]={type:"v4",value:o.toArray()}:o&&o.isMatrix3?t.uniforms[s]={type:"m3",value:o.toArray()}:o&&o.isMatrix4?t.uniforms[s]={type:"m4",value:o.toArray()}:t.uniforms[s]={value:o}}Object.keys(this.defines).length>0&&(t.defines=this.defines),t.vertexShader=this.vertexShader,t.fragmentShader=this.fragmentShader,t.lights=this.lights,t.clipping=this.clipping;let i={};for(let s in this.extensions)this.extensions[s]===!0&&(i[s]=!0);return Object.keys(i).length>0&&(t.extensions=i),t}fromJSON(e,t){if(super.fromJSON(e,t),e.uniforms!==void 0)for(let i in e.uniforms){let s=e.uniforms[i];switch(this.uniforms[i]={},s.type){case"t":this.uniforms[i].value=t[s.value]||null;break;case"c":this.uniforms[i].value=new Ke().setHex(s.value);break;case"v2":this.uniforms[i].value=new $e().fromArray(s.value);break;case"v3":this.uniforms[i].value=new O().fromArray(s.value);break;case"v4":this.uniforms[i].value=new rn().fromArray(s.value);break;case"m3":this.uniforms[i].value=new Qe().fromArray(s.value);break;case"m4":this.uniforms[i].value=new Dt().fromArray(s.value);break;default:this.uniforms[i].value=s.value}}if(e.defines!==void 0&&(this.defines=e.defines),e.vertexShader!==void 0&&(this.vertexShader=e.vertexShader),e.fragmentShader!==void 0&&(this.fragmentShader=e.fragmentShader),e.glslVersion!==void 0&&(this.glslVersion=e.glslVersion),e.extensions!==void 0)for(let i in e.extensions)this.extensions[i]=e.extensions[i];return e.lights!==void 0&&(this.lights=e.lights),e.clipping!==void 0&&(this.clipping=e.clipping),this}},Xh=class extends Ts{constructor(e){super(e),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}};var Fl=class extends Qi{constructor(e){super(),this.isMeshLambertMaterial=!0,this.type="MeshLambertMaterial",this.color=new Ke(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new Ke(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=qu,this.normalScale=new $e(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new Ks,this.combine=ou,this.reflectivity=1,this.envMapIntensity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.emissive.copy(e.emissive),this.emissiveMap=e.emissiveMap,this.emissiveIntensity=e.emissiveIntensity,this.bumpMap=e.bumpMap,this.bumpScale=e.bumpScale,this.normalMap=e.normalMap,this.normalMapType=e.normalMapType,this.normalScale.copy(e.normalScale),this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.specularMap=e.specularMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.combine=e.combine,this.reflectivity=e.reflectivity,this.envMapIntensity=e.envMapIntensity,this.refractionRatio=e.refractionRatio,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.flatShading=e.flatShading,this.fog=e.fog,this}},qh=class extends Qi{constructor(e){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=jv,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(e)}copy(e){return super.copy(e),this.depthPacking=e.depthPacking,this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this}},Yh=class extends Qi{constructor(e){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(e)}copy(e){return super.copy(e),this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this}};function Zo(n,e){return!n||n.constructor===e?n:typeof e.BYTES_PER_ELEMENT=="number"?new e(n):Array.prototype.slice.call(n)}function bh(n){return n!==void 0&&n.inTangents!==void 0&&n.outTangents!==void 0}var Tr=class{constructor(e,t,i,s){this.parameterPositions=e,this._cachedIndex=0,this.resultBuffer=s!==void 0?s:new t.constructor(i),this.sampleValues=t,this.valueSize=i,this.settings=null,this.DefaultSettings_={}}evaluate(e){let t=this.parameterPositions,i=this._cachedIndex,s=t[i],r=t[i-1];n:{e:{let o;t:{i:if(!(e<s)){for(let a=i+2;;){if(s===void 0){if(e<r)break i;return i=t.length,this._cachedIndex=i,this.copySampleValue_(i-1)}if(i===a)break;if(r=s,s=t[++i],e<s)break e}o=t.length;break t}if(!(e>=r)){let a=t[1];e<a&&(i=2,r=a);for(let l=i-2;;){if(r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(i===l)break;if(s=r,r=t[--i-1],e>=r)break e}o=i,i=0;break t}break n}for(;i<o;){let a=i+o>>>1;e<t[a]?o=a:i=a+1}if(s=t[i],r=t[i-1],r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(s===void 0)return i=t.length,this._cachedIndex=i,this.copySampleValue_(i-1)}this._cachedIndex=i,this.intervalChanged_(i,r,s)}return this.interpolate_(i,r,e,s)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(e){let t=this.resultBuffer,i=this.sampleValues,s=this.valueSize,r=e*s;for(let o=0;o!==s;++o)t[o]=i[r+o];return t}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},$h=class extends Tr{constructor(e,t,i,s){super(e,t,i,s),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:tp,endingEnd:tp}}intervalChanged_(e,t,i){let s=this.parameterPositions,r=e-2,o=e+1,a=s[r],l=s[o];if(a===void 0)switch(this.getSettings_().endingStart){case np:r=e,a=2*t-i;break;case ip:r=s.length-2,a=t+s[r]-s[r+1];break;default:r=e,a=i}if(l===void 0)switch(this.getSettings_().endingEnd){case np:o=e,l=2*i-t;break;case ip:o=1,l=i+s[1]-s[0];break;default:o=e-1,l=t}let c=(i-t)*.5,h=this.valueSize;this._weightPrev=c/(t-a),this._weightNext=c/(l-i),this._offsetPrev=r*h,this._offsetNext=o*h}interpolate_(e,t,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=this._offsetPrev,u=this._offsetNext,f=this._weightPrev,d=this._weightNext,g=(i-t)/(s-t),_=g*g,m=_*g,p=-f*m+2*f*_-f*g,x=(1+f)*m+(-1.5-2*f)*_+(-.5+f)*g+1,A=(-1-d)*m+(1.5+d)*_+.5*g,w=d*m-d*_;for(let P=0;P!==a;++P)r[P]=p*o[h+P]+x*o[c+P]+A*o[l+P]+w*o[u+P];return r}},Zh=class extends Tr{constructor(e,t,i,s){super(e,t,i,s)}interpolate_(e,t,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=(i-t)/(s-t),u=1-h;for(let f=0;f!==a;++f)r[f]=o[c+f]*u+o[l+f]*h;return r}},Kh=class extends Tr{constructor(e,t,i,s){super(e,t,i,s)}interpolate_(e){return this.copySampleValue_(e-1)}},Jh=class extends Tr{interpolate_(e,t,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=this.inTangents,u=this.outTangents;if(!h||!u){let g=(i-t)/(s-t),_=1-g;for(let m=0;m!==a;++m)r[m]=o[c+m]*_+o[l+m]*g;return r}let f=a*2,d=e-1;for(let g=0;g!==a;++g){let _=o[c+g],m=o[l+g],p=d*f+g*2,x=u[p],A=u[p+1],w=e*f+g*2,P=h[w],E=h[w+1],y=xw(i,t,x,P,s);r[g]=dy(y,_,A,E,m)}return r}};function dy(n,e,t,i,s){let r=1-n;return r*r*r*e+3*r*r*n*t+3*r*n*n*i+n*n*n*s}function _w(n,e,t,i,s){let r=1-n;return 3*r*r*(t-e)+6*r*n*(i-t)+3*n*n*(s-i)}function xw(n,e,t,i,s){let r=(n-e)/(s-e);for(let o=0;o<8;o++){let a=dy(r,e,t,i,s)-n;if(Math.abs(a)<1e-10)break;let l=_w(r,e,t,i,s);if(Math.abs(l)<1e-10)break;r=Math.max(0,Math.min(1,r-a/l))}return r}var Pi=class{constructor(e,t,i,s){if(e===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(t===void 0||t.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+e);this.name=e,this.times=Zo(t,this.TimeBufferType),this.values=Zo(i,this.ValueBufferType),this.setInterpolation(s||this.DefaultInterpolation)}static toJSON(e){let t=e.constructor,i;if(t.toJSON!==this.toJSON)i=t.toJSON(e);else{i={name:e.name,times:Zo(e.times,Array),values:Zo(e.values,Array)};let s=e.getInterpolation();s!==e.DefaultInterpolation&&(i.interpolation=s),bh(e.settings)&&(i.settings={inTangents:Zo(e.settings.inTangents,Array),outTangents:Zo(e.settings.outTangents,Array)})}return i.type=e.ValueTypeName,i}InterpolantFactoryMethodDiscrete(e){return new Kh(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodLinear(e){return new Zh(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodSmooth(e){return new $h(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodBezier(e){let t=new Jh(this.times,this.values,this.getValueSize(),e);return this.settings&&(t.inTangents=this.settings.inTangents,t.outTangents=this.settings.outTangents),t}setInterpolation(e){let t;switch(e){case _l:t=this.InterpolantFactoryMethodDiscrete;break;case Fh:t=this.InterpolantFactoryMethodLinear;break;case Th:t=this.InterpolantFactoryMethodSmooth;break;case ep:t=this.InterpolantFactoryMethodBezier;break}if(t===void 0){let i="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(e!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(i);return Je("KeyframeTrack:",i),this}return this.createInterpolant=t,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return _l;case this.InterpolantFactoryMethodLinear:return Fh;case this.InterpolantFactoryMethodSmooth:return Th;case this.InterpolantFactoryMethodBezier:return ep}}getValueSize(){return this.values.length/this.times.length}shift(e){if(e!==0){let t=this.times;for(let i=0,s=t.length;i!==s;++i)t[i]+=e;bh(this.settings)&&(bv(this.settings.inTangents,e),bv(this.settings.outTangents,e))}return this}scale(e){if(e!==1){let t=this.times;for(let i=0,s=t.length;i!==s;++i)t[i]*=e;bh(this.settings)&&(Mv(this.settings.inTangents,e),Mv(this.settings.outTangents,e))}return this}trim(e,t){let i=this.times,s=i.length,r=0,o=s-1;for(;r!==s&&i[r]<e;)++r;for(;o!==-1&&i[o]>t;)--o;if(++o,r!==0||o!==s){r>=o&&(o=Math.max(o,1),r=o-1);let a=this.getValueSize();this.times=i.slice(r,o),this.values=this.values.slice(r*a,o*a)}return this}validate(){let e=!0,t=this.getValueSize();t-Math.floor(t)!==0&&(st("KeyframeTrack: Invalid value size in track.",this),e=!1);let i=this.times,s=this.values,r=i.length;r===0&&(st("KeyframeTrack: Track is empty.",this),e=!1);let o=null;for(let a=0;a!==r;a++){let l=i[a];if(typeof l=="number"&&isNaN(l)){st("KeyframeTrack: Time is not a valid number.",this,a,l),e=!1;break}if(o!==null&&o>l){st("KeyframeTrack: Out of order keys.",this,a,l,o),e=!1;break}o=l}if(s!==void 0&&FM(s))for(let a=0,l=s.length;a!==l;++a){let c=s[a];if(isNaN(c)){st("KeyframeTrack: Value is not a valid number.",this,a,c),e=!1;break}}return e}optimize(){let e=this.times.slice(),t=this.values.slice(),i=this.getValueSize(),s=this.getInterpolation()===Th,r=e.length-1,o=1;for(let a=1;a<r;++a){let l=!1,c=e[a],h=e[a+1];if(c!==h&&(a!==1||c!==e[0]))if(s)l=!0;else{let u=a*i,f=u-i,d=u+i;for(let g=0;g!==i;++g){let _=t[u+g];if(_!==t[f+g]||_!==t[d+g]){l=!0;break}}}if(l){if(a!==o){e[o]=e[a];let u=a*i,f=o*i;for(let d=0;d!==i;++d)t[f+d]=t[u+d]}++o}}if(r>0){e[o]=e[r];for(let a=r*i,l=o*i,c=0;c!==i;++c)t[l+c]=t[a+c];++o}return o!==e.length?(this.times=e.slice(0,o),this.values=t.slice(0,o*i)):(this.times=e,this.values=t),this}clone(){let e=this.times.slice(),t=this.values.slice(),i=this.constructor,s=new i(this.name,e,t);return s.createInterpolant=this.createInterpolant,bh(this.settings)&&(s.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),s}};function bv(n,e){for(let t=0,i=n.length;t!==i;t+=2)n[t]+=e}function Mv(n,e){for(let t=0,i=n.length;t!==i;t+=2)n[t]*=e}Pi.prototype.ValueTypeName="";Pi.prototype.TimeBufferType=Float32Array;Pi.prototype.ValueBufferType=Float32Array;Pi.prototype.DefaultInterpolation=Fh;var Er=class extends Pi{constructor(e,t,i){super(e,t,i)}};Er.prototype.ValueTypeName="bool";Er.prototype.ValueBufferType=Array;Er.prototype.DefaultInterpolation=_l;Er.prototype.InterpolantFactoryMethodLinear=void 0;Er.prototype.InterpolantFactoryMethodSmooth=void 0;var jh=class extends Pi{constructor(e,t,i,s){super(e,t,i,s)}};jh.prototype.ValueTypeName="color";var Qh=class extends Pi{constructor(e,t,i,s){super(e,t,i,s)}};Qh.prototype.ValueTypeName="number";var eu=class extends Tr{constructor(e,t,i,s){super(e,t,i,s)}interpolate_(e,t,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=(i-t)/(s-t),c=e*a;for(let h=c+a;c!==h;c+=4)li.slerpFlat(r,0,o,c-a,o,c,l);return r}},Ol=class extends Pi{constructor(e,t,i,s){super(e,t,i,s)}InterpolantFactoryMethodLinear(e){return new eu(this.times,this.values,this.getValueSize(),e)}};Ol.prototype.ValueTypeName="quaternion";Ol.prototype.InterpolantFactoryMethodSmooth=void 0;var Ar=class extends Pi{constructor(e,t,i){super(e,t,i)}};Ar.prototype.ValueTypeName="string";Ar.prototype.ValueBufferType=Array;Ar.prototype.DefaultInterpolation=_l;Ar.prototype.InterpolantFactoryMethodLinear=void 0;Ar.prototype.InterpolantFactoryMethodSmooth=void 0;var tu=class extends Pi{constructor(e,t,i,s){super(e,t,i,s)}};tu.prototype.ValueTypeName="vector";var nu=class{constructor(e,t,i){let s=this,r=!1,o=0,a=0,l,c=[];this.onStart=void 0,this.onLoad=e,this.onProgress=t,this.onError=i,this._abortController=null,this.itemStart=function(h){a++,r===!1&&s.onStart!==void 0&&s.onStart(h,o,a),r=!0},this.itemEnd=function(h){o++,s.onProgress!==void 0&&s.onProgress(h,o,a),o===a&&(r=!1,s.onLoad!==void 0&&s.onLoad())},this.itemError=function(h){s.onError!==void 0&&s.onError(h)},this.resolveURL=function(h){return h=h.normalize("NFC"),l?l(h):h},this.setURLModifier=function(h){return l=h,this},this.addHandler=function(h,u){return c.push(h,u),this},this.removeHandler=function(h){let u=c.indexOf(h);return u!==-1&&c.splice(u,2),this},this.getHandler=function(h){for(let u=0,f=c.length;u<f;u+=2){let d=c[u],g=c[u+1];if(d.global&&(d.lastIndex=0),d.test(h))return g}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},py=new nu,iu=class{constructor(e){this.manager=e!==void 0?e:py,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(e,t){let i=this;return new Promise(function(s,r){i.load(e,s,t,r)})}parse(){}setCrossOrigin(e){return this.crossOrigin=e,this}setWithCredentials(e){return this.withCredentials=e,this}setPath(e){return this.path=e,this}setResourcePath(e){return this.resourcePath=e,this}setRequestHeader(e){return this.requestHeader=e,this}setPriority(e){return this.priority=e,this}setCache(e){return this.cache=e,this}abort(){return this}};iu.DEFAULT_MATERIAL_NAME="__DEFAULT";var kl=class extends Cn{static registerNode(e){this.prototype._lightNode=e}constructor(e,t=1){super(),this.isLight=!0,this.type="Light",this.color=new Ke(e),this.intensity=t}copy(e,t){return super.copy(e,t),this.color.copy(e.color),this.intensity=e.intensity,this}toJSON(e){let t=super.toJSON(e);return t.object.color=this.color.getHex(),t.object.intensity=this.intensity,t}},Bl=class extends kl{constructor(e,t,i){super(e,i),this.isHemisphereLight=!0,this.type="HemisphereLight",this.position.copy(Cn.DEFAULT_UP),this.updateMatrix(),this.groundColor=new Ke(t)}copy(e,t){return super.copy(e,t),this.groundColor.copy(e.groundColor),this}toJSON(e){let t=super.toJSON(e);return t.object.groundColor=this.groundColor.getHex(),t}},Qd=new Dt,wv=new O,Tv=new O,su=class{constructor(e){this.camera=e,this.intensity=1,this.bias=0,this.biasNode=null,this.normalBias=0,this.radius=1,this.blurSamples=8,this.mapSize=new $e(512,512),this.mapType=di,this.map=null,this.mapPass=null,this.matrix=new Dt,this.autoUpdate=!0,this.needsUpdate=!1,this._frustum=new br,this._frameExtents=new $e(1,1),this._viewportCount=1,this._viewports=[new rn(0,0,1,1)]}getViewportCount(){return this._viewportCount}getCamera(){return this.camera}getFrustum(){return this._frustum}updateMatrices(e){let t=this.camera;wv.setFromMatrixPosition(e.matrixWorld),t.position.copy(wv),Tv.setFromMatrixPosition(e.target.matrixWorld),t.lookAt(Tv),t.updateMatrixWorld(),this._updateMatrix(t,this.matrix,this._frustum)}_updateMatrix(e,t,i,s){Qd.multiplyMatrices(e.projectionMatrix,e.matrixWorldInverse),i.setFromProjectionMatrix(Qd,e.coordinateSystem,e.reversedDepth);let r=this._frameExtents,o=s?s.z/r.x:1,a=s?s.w/r.y:1,l=s?s.x/r.x:0,c=s?s.y/r.y:0;e.coordinateSystem===ea||e.reversedDepth?t.set(.5*o,0,0,.5*o+l,0,.5*a,0,.5*a+c,0,0,1,0,0,0,0,1):t.set(.5*o,0,0,.5*o+l,0,.5*a,0,.5*a+c,0,0,.5,.5,0,0,0,1),t.multiply(Qd)}getViewport(e){return this._viewports[e]}getFrameExtents(){return this._frameExtents}dispose(){this.map&&this.map.dispose(),this.mapPass&&this.mapPass.dispose()}copy(e){return this.camera=e.camera.clone(),this.intensity=e.intensity,this.bias=e.bias,this.radius=e.radius,this.autoUpdate=e.autoUpdate,this.needsUpdate=e.needsUpdate,this.normalBias=e.normalBias,this.blurSamples=e.blurSamples,this.mapSize.copy(e.mapSize),this.mapType=e.mapType,this.biasNode=e.biasNode,this}clone(){return new this.constructor().copy(this)}toJSON(){let e={};return e.intensity=this.intensity,e.bias=this.bias,e.normalBias=this.normalBias,e.radius=this.radius,e.blurSamples=this.blurSamples,e.mapSize=this.mapSize.toArray(),e.mapType=this.mapType,e.camera=this.camera.toJSON(!1).object,delete e.camera.matrix,e}},Mh=new O,wh=new li,bs=new O,zl=class extends Cn{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new Dt,this.projectionMatrix=new Dt,this.projectionMatrixInverse=new Dt,this.coordinateSystem=Vi,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(e,t){return super.copy(e,t),this.matrixWorldInverse.copy(e.matrixWorldInverse),this.projectionMatrix.copy(e.projectionMatrix),this.projectionMatrixInverse.copy(e.projectionMatrixInverse),this.coordinateSystem=e.coordinateSystem,this}getWorldDirection(e){return super.getWorldDirection(e).negate()}updateMatrixWorld(e){super.updateMatrixWorld(e),this.matrixWorld.decompose(Mh,wh,bs),bs.x===1&&bs.y===1&&bs.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Mh,wh,bs.set(1,1,1)).invert()}updateWorldMatrix(e,t,i=!1){super.updateWorldMatrix(e,t,i),this.matrixWorld.decompose(Mh,wh,bs),bs.x===1&&bs.y===1&&bs.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Mh,wh,bs.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},_r=new O,Ev=new $e,Av=new $e,oi=class extends zl{constructor(e=50,t=1,i=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=e,this.zoom=1,this.near=i,this.far=s,this.focus=10,this.aspect=t,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.fov=e.fov,this.zoom=e.zoom,this.near=e.near,this.far=e.far,this.focus=e.focus,this.aspect=e.aspect,this.view=e.view===null?null:Object.assign({},e.view),this.filmGauge=e.filmGauge,this.filmOffset=e.filmOffset,this}setFocalLength(e){let t=.5*this.getFilmHeight()/e;this.fov=na*2*Math.atan(t),this.updateProjectionMatrix()}getFocalLength(){let e=Math.tan(vl*.5*this.fov);return .5*this.getFilmHeight()/e}getEffectiveFOV(){return na*2*Math.atan(Math.tan(vl*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(e,t,i){_r.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),t.set(_r.x,_r.y).multiplyScalar(-e/_r.z),_r.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),i.set(_r.x,_r.y).multiplyScalar(-e/_r.z)}getViewSize(e,t){return this.getViewBounds(e,Ev,Av),t.subVectors(Av,Ev)}setViewOffset(e,t,i,s,r,o){this.aspect=e/t,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=i,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=this.near,t=e*Math.tan(vl*.5*this.fov)/this.zoom,i=2*t,s=this.aspect*i,r=-.5*s,o=this.view;if(this.view!==null&&this.view.enabled){let l=o.fullWidth,c=o.fullHeight;r+=o.offsetX*s/l,t-=o.offsetY*i/c,s*=o.width/l,i*=o.height/c}let a=this.filmOffset;a!==0&&(r+=e*a/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+s,t,t-i,e,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.fov=this.fov,t.object.zoom=this.zoom,t.object.near=this.near,t.object.far=this.far,t.object.focus=this.focus,t.object.aspect=this.aspect,this.view!==null&&(t.object.view=Object.assign({},this.view)),t.object.filmGauge=this.filmGauge,t.object.filmOffset=this.filmOffset,t}};var Vl=class extends zl{constructor(e=-1,t=1,i=1,s=-1,r=.1,o=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=e,this.right=t,this.top=i,this.bottom=s,this.near=r,this.far=o,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.left=e.left,this.right=e.right,this.top=e.top,this.bottom=e.bottom,this.near=e.near,this.far=e.far,this.zoom=e.zoom,this.view=e.view===null?null:Object.assign({},e.view),this}setViewOffset(e,t,i,s,r,o){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=i,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=(this.right-this.left)/(2*this.zoom),t=(this.top-this.bottom)/(2*this.zoom),i=(this.right+this.left)/2,s=(this.top+this.bottom)/2,r=i-e,o=i+e,a=s+t,l=s-t;if(this.view!==null&&this.view.enabled){let c=(this.right-this.left)/this.view.fullWidth/this.zoom,h=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=c*this.view.offsetX,o=r+c*this.view.width,a-=h*this.view.offsetY,l=a-h*this.view.height}this.projectionMatrix.makeOrthographic(r,o,a,l,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.zoom=this.zoom,t.object.left=this.left,t.object.right=this.right,t.object.top=this.top,t.object.bottom=this.bottom,t.object.near=this.near,t.object.far=this.far,this.view!==null&&(t.object.view=Object.assign({},this.view)),t}},rp=class extends su{constructor(){super(new Vl(-5,5,5,-5,.5,500)),this.isDirectionalLightShadow=!0}},Hl=class extends kl{constructor(e,t){super(e,t),this.isDirectionalLight=!0,this.type="DirectionalLight",this.position.copy(Cn.DEFAULT_UP),this.updateMatrix(),this.target=new Cn,this.shadow=new rp}dispose(){super.dispose(),this.shadow.dispose()}copy(e){return super.copy(e),this.target=e.target.clone(),this.shadow=e.shadow.clone(),this}toJSON(e){let t=super.toJSON(e);return t.object.shadow=this.shadow.toJSON(),t.object.target=this.target.uuid,t}};var Ko=-90,Jo=1,la=class extends Cn{constructor(e,t,i){super(),this.type="CubeCamera",this.renderTarget=i,this.coordinateSystem=null,this.activeMipmapLevel=0;let s=new oi(Ko,Jo,e,t);s.layers=this.layers,this.add(s);let r=new oi(Ko,Jo,e,t);r.layers=this.layers,this.add(r);let o=new oi(Ko,Jo,e,t);o.layers=this.layers,this.add(o);let a=new oi(Ko,Jo,e,t);a.layers=this.layers,this.add(a);let l=new oi(Ko,Jo,e,t);l.layers=this.layers,this.add(l);let c=new oi(Ko,Jo,e,t);c.layers=this.layers,this.add(c)}updateCoordinateSystem(){let e=this.coordinateSystem,t=this.children.concat(),[i,s,r,o,a,l]=t;for(let c of t)this.remove(c);if(e===Vi)i.up.set(0,1,0),i.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),o.up.set(0,0,1),o.lookAt(0,-1,0),a.up.set(0,1,0),a.lookAt(0,0,1),l.up.set(0,1,0),l.lookAt(0,0,-1);else if(e===ea)i.up.set(0,-1,0),i.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),o.up.set(0,0,-1),o.lookAt(0,-1,0),a.up.set(0,-1,0),a.lookAt(0,0,1),l.up.set(0,-1,0),l.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+e);for(let c of t)this.add(c),c.updateMatrixWorld()}update(e,t){this.parent===null&&this.updateMatrixWorld();let{renderTarget:i,activeMipmapLevel:s}=this;this.coordinateSystem!==e.coordinateSystem&&(this.coordinateSystem=e.coordinateSystem,this.updateCoordinateSystem());let[r,o,a,l,c,h]=this.children,u=e.getRenderTarget(),f=e.getActiveCubeFace(),d=e.getActiveMipmapLevel(),g=e.xr.enabled;e.xr.enabled=!1;let _=i.texture.mipmapsAutoUpdate;i.texture.mipmapsAutoUpdate=!1;let m=!1;e.isWebGLRenderer===!0?m=e.state.buffers.depth.getReversed():m=e.reversedDepthBuffer,e.setRenderTarget(i,0,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,r),e.setRenderTarget(i,1,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,o),e.setRenderTarget(i,2,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,a),e.setRenderTarget(i,3,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,l),e.setRenderTarget(i,4,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,c),i.texture.mipmapsAutoUpdate=_,e.setRenderTarget(i,5,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,h),e.setRenderTarget(u,f,d),e.xr.enabled=g,i.texture.needsPMREMUpdate=!0}},ru=class extends oi{constructor(e=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=e,this.perCameraFrustumCulled=!1}};var zp="\\[\\]\\.:\\/",Sw=new RegExp("["+zp+"]","g"),Vp="[^"+zp+"]",bw="[^"+zp.replace("\\.","")+"]",Mw=/((?:WC+[\/:])*)/.source.replace("WC",Vp),ww=/(WCOD+)?/.source.replace("WCOD",bw),Tw=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",Vp),Ew=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",Vp),Aw=new RegExp("^"+Mw+ww+Tw+Ew+"$"),Cw=["material","materials","bones","map"],op=class{constructor(e,t,i){let s=i||en.parseTrackName(t);this._targetGroup=e,this._bindings=e.subscribe_(t,s)}getValue(e,t){this.bind();let i=this._targetGroup.nCachedObjects_,s=this._bindings[i];s!==void 0&&s.getValue(e,t)}setValue(e,t){let i=this._bindings;for(let s=this._targetGroup.nCachedObjects_,r=i.length;s!==r;++s)i[s].setValue(e,t)}bind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,i=e.length;t!==i;++t)e[t].bind()}unbind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,i=e.length;t!==i;++t)e[t].unbind()}},en=class n{constructor(e,t,i){this.path=t,this.parsedPath=i||n.parseTrackName(t),this.node=n.findNode(e,this.parsedPath.nodeName),this.rootNode=e,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(e,t,i){return e&&e.isAnimationObjectGroup?new n.Composite(e,t,i):new n(e,t,i)}static sanitizeNodeName(e){return e.replace(/\s/g,"_").replace(Sw,"")}static parseTrackName(e){let t=Aw.exec(e);if(t===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+e);let i={nodeName:t[2],objectName:t[3],objectIndex:t[4],propertyName:t[5],propertyIndex:t[6]},s=i.nodeName&&i.nodeName.lastIndexOf(".");if(s!==void 0&&s!==-1){let r=i.nodeName.substring(s+1);Cw.indexOf(r)!==-1&&(i.nodeName=i.nodeName.substring(0,s),i.objectName=r)}if(i.propertyName===null||i.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+e);return i}static findNode(e,t){if(t===void 0||t===""||t==="."||t===-1||t===e.name||t===e.uuid)return e;if(e.skeleton){let i=e.skeleton.getBoneByName(t);if(i!==void 0)return i}if(e.children){let i=function(r){for(let o=0;o<r.length;o++){let a=r[o];if(a.name===t||a.uuid===t)return a;let l=i(a.children);if(l)return l}return null},s=i(e.children);if(s)return s}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(e,t){e[t]=this.targetObject[this.propertyName]}_getValue_array(e,t){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)e[t++]=i[s]}_getValue_arrayElement(e,t){e[t]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(e,t){this.resolvedProperty.toArray(e,t)}_setValue_direct(e,t){this.targetObject[this.propertyName]=e[t]}_setValue_direct_setNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(e,t){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=e[t++]}_setValue_array_setNeedsUpdate(e,t){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=e[t++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(e,t){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=e[t++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(e,t){this.resolvedProperty[this.propertyIndex]=e[t]}_setValue_arrayElement_setNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(e,t){this.resolvedProperty.fromArray(e,t)}_setValue_fromArray_setNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(e,t){this.bind(),this.getValue(e,t)}_setValue_unbound(e,t){this.bind(),this.setValue(e,t)}bind(){let e=this.node,t=this.parsedPath,i=t.objectName,s=t.propertyName,r=t.propertyIndex;if(e||(e=n.findNode(this.rootNode,t.nodeName),this.node=e),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!e){Je("PropertyBinding: No target node found for track: "+this.path+".");return}if(i){let c=t.objectIndex;switch(i){case"materials":if(!e.material){st("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.materials){st("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}e=e.material.materials;break;case"bones":if(!e.skeleton){st("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}e=e.skeleton.bones;for(let h=0;h<e.length;h++)if(e[h].name===c){c=h;break}break;case"map":if("map"in e){e=e.map;break}if(!e.material){st("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.map){st("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}e=e.material.map;break;default:if(e[i]===void 0){st("PropertyBinding: Can not bind to objectName of node undefined.",this);return}e=e[i]}if(c!==void 0){if(e[c]===void 0){st("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,e);return}e=e[c]}}let o=e[s];if(o===void 0){let c=t.nodeName;st("PropertyBinding: Trying to update property for track: "+c+"."+s+" but it wasn't found.",e);return}let a=this.Versioning.None;this.targetObject=e,e.isMaterial===!0?a=this.Versioning.NeedsUpdate:e.isObject3D===!0&&(a=this.Versioning.MatrixWorldNeedsUpdate);let l=this.BindingType.Direct;if(r!==void 0){if(s==="morphTargetInfluences"){if(!e.geometry){st("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!e.geometry.morphAttributes){st("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}e.morphTargetDictionary[r]!==void 0&&(r=e.morphTargetDictionary[r])}l=this.BindingType.ArrayElement,this.resolvedProperty=o,this.propertyIndex=r}else o.fromArray!==void 0&&o.toArray!==void 0?(l=this.BindingType.HasFromToArray,this.resolvedProperty=o):Array.isArray(o)?(l=this.BindingType.EntireArray,this.resolvedProperty=o):this.propertyName=s;this.getValue=this.GetterByBindingType[l],this.setValue=this.SetterByBindingTypeAndVersioning[l][a]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};en.Composite=op;en.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};en.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};en.prototype.GetterByBindingType=[en.prototype._getValue_direct,en.prototype._getValue_array,en.prototype._getValue_arrayElement,en.prototype._getValue_toArray];en.prototype.SetterByBindingTypeAndVersioning=[[en.prototype._setValue_direct,en.prototype._setValue_direct_setNeedsUpdate,en.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[en.prototype._setValue_array,en.prototype._setValue_array_setNeedsUpdate,en.prototype._setValue_array_setMatrixWorldNeedsUpdate],[en.prototype._setValue_arrayElement,en.prototype._setValue_arrayElement_setNeedsUpdate,en.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[en.prototype._setValue_fromArray,en.prototype._setValue_fromArray_setNeedsUpdate,en.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var K3=new Float32Array(1);var ca=class{constructor(e=1,t=0,i=0){this.radius=e,this.phi=t,this.theta=i}set(e,t,i){return this.radius=e,this.phi=t,this.theta=i,this}copy(e){return this.radius=e.radius,this.phi=e.phi,this.theta=e.theta,this}makeSafe(){return this.phi=yt(this.phi,1e-6,Math.PI-1e-6),this}setFromVector3(e){return this.setFromCartesianCoords(e.x,e.y,e.z)}setFromCartesianCoords(e,t,i){return this.radius=Math.sqrt(e*e+t*t+i*i),this.radius===0?(this.theta=0,this.phi=0):(this.theta=Math.atan2(e,i),this.phi=Math.acos(yt(t/this.radius,-1,1))),this}clone(){return new this.constructor().copy(this)}};var ap=class{static{this.prototype.isMatrix2=!0}constructor(e,t,i,s){this.elements=[1,0,0,1],e!==void 0&&this.set(e,t,i,s)}identity(){return this.set(1,0,0,1),this}fromArray(e,t=0){for(let i=0;i<4;i++)this.elements[i]=e[i+t];return this}set(e,t,i,s){let r=this.elements;return r[0]=e,r[2]=t,r[1]=i,r[3]=s,this}};var Gl=class extends ws{constructor(e=10,t=10,i=4473924,s=8947848){i=new Ke(i),s=new Ke(s);let r=t/2,o=e/t,a=e/2,l=[],c=[];for(let f=0,d=0,g=-a;f<=t;f++,g+=o){l.push(-a,0,g,a,0,g),l.push(g,0,-a,g,0,a);let _=f===r?i:s;_.toArray(c,d),d+=3,_.toArray(c,d),d+=3,_.toArray(c,d),d+=3,_.toArray(c,d),d+=3}let h=new $t;h.setAttribute("position",new dn(l,3)),h.setAttribute("color",new dn(c,3));let u=new es({vertexColors:!0,toneMapped:!1});super(h,u),this.type="GridHelper"}dispose(){super.dispose(),this.geometry.dispose(),this.material.dispose()}};var Wl=class extends ji{constructor(e,t=null){super(),this.object=e,this.domElement=t,this.enabled=!0,this.state=-1,this.keys={},this.mouseButtons={LEFT:null,MIDDLE:null,RIGHT:null},this.touches={ONE:null,TWO:null}}connect(e){this.domElement!==null&&this.disconnect(),this.domElement=e}disconnect(){}dispose(){}update(){}};function Hp(n,e,t,i){let s=Rw(i);switch(t){case Ep:return n*e;case Cp:return n*e/s.components*s.byteLength;case du:return n*e/s.components*s.byteLength;case Ir:return n*e*2/s.components*s.byteLength;case pu:return n*e*2/s.components*s.byteLength;case Ap:return n*e*3/s.components*s.byteLength;case ss:return n*e*4/s.components*s.byteLength;case mu:return n*e*4/s.components*s.byteLength;case Yl:case $l:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*8;case Zl:case Kl:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*16;case vu:case _u:return Math.max(n,16)*Math.max(e,8)/4;case gu:case yu:return Math.max(n,8)*Math.max(e,8)/2;case xu:case Su:case Mu:case wu:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*8;case bu:case Jl:case Tu:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*16;case Eu:return Math.floor((n+3)/4)*Math.floor((e+3)/4)*16;case Au:return Math.floor((n+4)/5)*Math.floor((e+3)/4)*16;case Cu:return Math.floor((n+4)/5)*Math.floor((e+4)/5)*16;case Ru:return Math.floor((n+5)/6)*Math.floor((e+4)/5)*16;case Pu:return Math.floor((n+5)/6)*Math.floor((e+5)/6)*16;case Iu:return Math.floor((n+7)/8)*Math.floor((e+4)/5)*16;case Du:return Math.floor((n+7)/8)*Math.floor((e+5)/6)*16;case Lu:return Math.floor((n+7)/8)*Math.floor((e+7)/8)*16;case Nu:return Math.floor((n+9)/10)*Math.floor((e+4)/5)*16;case Uu:return Math.floor((n+9)/10)*Math.floor((e+5)/6)*16;case Fu:return Math.floor((n+9)/10)*Math.floor((e+7)/8)*16;case Ou:return Math.floor((n+9)/10)*Math.floor((e+9)/10)*16;case ku:return Math.floor((n+11)/12)*Math.floor((e+9)/10)*16;case Bu:return Math.floor((n+11)/12)*Math.floor((e+11)/12)*16;case zu:case Vu:case Hu:return Math.ceil(n/4)*Math.ceil(e/4)*16;case Gu:case Wu:return Math.ceil(n/4)*Math.ceil(e/4)*8;case jl:case Xu:return Math.ceil(n/4)*Math.ceil(e/4)*16}throw new Error(`Unable to determine texture byte length for ${t} format.`)}function Rw(n){switch(n){case di:case bp:return{byteLength:1,components:1};case da:case Mp:case is:return{byteLength:2,components:1};case uu:case fu:return{byteLength:2,components:4};case ts:case hu:case ns:return{byteLength:4,components:1};case wp:case Tp:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${n}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?Je("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");function Fy(){let n=null,e=!1,t=null,i=null;function s(r,o){i=n.requestAnimationFrame(s),t(r,o)}return{start:function(){e!==!0&&t!==null&&n!==null&&(i=n.requestAnimationFrame(s),e=!0)},stop:function(){n!==null&&n.cancelAnimationFrame(i),e=!1},setAnimationLoop:function(r){t=r},setContext:function(r){n=r}}}function Iw(n){let e=new WeakMap;function t(a,l){let c=a.array,h=a.usage,u=c.byteLength,f=n.createBuffer();n.bindBuffer(l,f),n.bufferData(l,c,h),a.onUploadCallback();let d;if(c instanceof Float32Array)d=n.FLOAT;else if(typeof Float16Array<"u"&&c instanceof Float16Array)d=n.HALF_FLOAT;else if(c instanceof Uint16Array)a.isFloat16BufferAttribute?d=n.HALF_FLOAT:d=n.UNSIGNED_SHORT;else if(c instanceof Int16Array)d=n.SHORT;else if(c instanceof Uint32Array)d=n.UNSIGNED_INT;else if(c instanceof Int32Array)d=n.INT;else if(c instanceof Int8Array)d=n.BYTE;else if(c instanceof Uint8Array)d=n.UNSIGNED_BYTE;else if(c instanceof Uint8ClampedArray)d=n.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+c);return{buffer:f,type:d,bytesPerElement:c.BYTES_PER_ELEMENT,version:a.version,size:u}}function i(a,l,c){let h=l.array,u=l.updateRanges;if(n.bindBuffer(c,a),u.length===0)n.bufferSubData(c,0,h);else{u.sort((d,g)=>d.start-g.start);let f=0;for(let d=1;d<u.length;d++){let g=u[f],_=u[d];_.start<=g.start+g.count+1?g.count=Math.max(g.count,_.start+_.count-g.start):(++f,u[f]=_)}u.length=f+1;for(let d=0,g=u.length;d<g;d++){let _=u[d];n.bufferSubData(c,_.start*h.BYTES_PER_ELEMENT,h,_.start,_.count)}l.clearUpdateRanges()}l.onUploadCallback()}function s(a){return a.isInterleavedBufferAttribute&&(a=a.data),e.get(a)}function r(a){a.isInterleavedBufferAttribute&&(a=a.data);let l=e.get(a);l&&(n.deleteBuffer(l.buffer),e.delete(a))}function o(a,l){if(a.isInterleavedBufferAttribute&&(a=a.data),a.isGLBufferAttribute){let h=e.get(a);(!h||h.version<a.version)&&e.set(a,{buffer:a.buffer,type:a.type,bytesPerElement:a.elementSize,version:a.version});return}let c=e.get(a);if(c===void 0)e.set(a,t(a,l));else if(c.version<a.version){if(c.size!==a.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");i(c.buffer,a,l),c.version=a.version}}return{get:s,remove:r,update:o}}var Dw=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,Lw=`#ifdef USE_ALPHAHASH
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
#endif`,Nw=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,Uw=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,Fw=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,Ow=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,kw=`#ifdef USE_AOMAP
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
#endif`,Bw=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,zw=`#ifdef USE_BATCHING
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
#endif`,Vw=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,Hw=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,Gw=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,Ww=`float G_BlinnPhong_Implicit( ) {
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
} // validated`,Xw=`#ifdef USE_IRIDESCENCE
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
#endif`,qw=`#ifdef USE_BUMPMAP
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
#endif`,Yw=`#if NUM_CLIPPING_PLANES > 0
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
#endif`,$w=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,Zw=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,Kw=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,Jw=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#endif`,jw=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#endif`,Qw=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec4 vColor;
#endif`,e1=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
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
#endif`,t1=`#define PI 3.141592653589793
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
} // validated`,n1=`vec3 transformedNormal = objectNormal;
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
#endif`,i1=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,s1=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,r1=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,o1=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,a1="gl_FragColor = linearToOutputTexel( gl_FragColor );",l1=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,c1=`#ifdef USE_ENVMAP
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
#endif`,h1=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform mat3 envMapRotation;
	uniform samplerCube envMap;
	#ifdef ENVMAP_TYPE_PMREM
		float roughnessToMip( const in float roughness ) {
			float r = clamp( roughness, 0.0, 1.0 );
			return ENVMAP_MAX_LOD * r * ( 2.0 - r );
		}
	#endif
#endif`,u1=`#ifdef USE_ENVMAP
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
#endif`,f1=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,d1=`#ifdef USE_ENVMAP
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
#endif`,p1=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,m1=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,g1=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,v1=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,y1=`#ifdef USE_GRADIENTMAP
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
}`,_1=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,x1=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,S1=`varying vec3 vViewPosition;
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
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,b1=`uniform bool receiveShadow;
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
#include <lightprobes_pars_fragment>`,M1=`#ifdef USE_ENVMAP
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
#endif`,w1=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,T1=`varying vec3 vViewPosition;
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
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,E1=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,A1=`varying vec3 vViewPosition;
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
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,C1=`PhysicalMaterial material;
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
#endif`,R1=`uniform sampler2D dfgLUT;
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
}`,P1=`
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
#endif`,I1=`#if defined( RE_IndirectDiffuse )
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
#endif`,D1=`#if defined( RE_IndirectDiffuse )
	#if defined( LAMBERT ) || defined( PHONG )
		irradiance += iblIrradiance;
	#endif
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,L1=`#if NUM_LIGHT_PROBE_GRIDS > 0
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
#endif`,N1=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,U1=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,F1=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,O1=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,k1=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,B1=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,z1=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
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
#endif`,V1=`#if defined( USE_POINTS_UV )
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
#endif`,H1=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,G1=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,W1=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,X1=`#if defined( USE_MORPHCOLORS )
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
#endif`,q1=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,Y1=`#ifdef USE_MORPHTARGETS
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
#endif`,$1=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,Z1=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
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
vec3 nonPerturbedNormal = normal;`,K1=`#ifdef USE_NORMALMAP_OBJECTSPACE
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
#endif`,J1=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,j1=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,Q1=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
		#ifdef FLIP_SIDED
			vBitangent = - vBitangent;
		#endif
	#endif
#endif`,eT=`#ifdef USE_NORMALMAP
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
#endif`,tT=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,nT=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,iT=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,sT=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,rT=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,oT=`vec3 packNormalToRGB( const in vec3 normal ) {
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
}`,aT=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,lT=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,cT=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,hT=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,uT=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,fT=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,dT=`#if NUM_SPOT_LIGHT_COORDS > 0
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
#endif`,pT=`#if NUM_SPOT_LIGHT_COORDS > 0
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
#endif`,mT=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
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
#endif`,gT=`float getShadowMask() {
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
}`,vT=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,yT=`#ifdef USE_SKINNING
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
#endif`,_T=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,xT=`#ifdef USE_SKINNING
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
#endif`,ST=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,bT=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,MT=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,wT=`#ifndef saturate
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
vec3 CustomToneMapping( vec3 color ) { return color; }`,TT=`#ifdef USE_TRANSMISSION
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
#endif`,ET=`#ifdef USE_TRANSMISSION
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
#endif`,AT=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
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
#endif`,CT=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
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
#endif`,RT=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
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
#endif`,PT=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,IT=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,DT=`uniform sampler2D t2D;
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
}`,LT=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,NT=`uniform float backgroundBlurriness;
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
}`,UT=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,FT=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,OT=`#include <common>
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
}`,kT=`#if DEPTH_PACKING == 3200
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
}`,BT=`#define DISTANCE
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
}`,zT=`#define DISTANCE
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
}`,VT=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,HT=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,GT=`uniform float scale;
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
}`,WT=`uniform vec3 diffuse;
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
}`,XT=`#include <common>
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
}`,qT=`uniform vec3 diffuse;
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
}`,YT=`#define LAMBERT
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
}`,$T=`#define LAMBERT
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
}`,ZT=`#define MATCAP
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
}`,KT=`#define MATCAP
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
}`,JT=`#define NORMAL
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
}`,jT=`#define NORMAL
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
}`,QT=`#define PHONG
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
}`,eE=`#define PHONG
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
}`,tE=`#define STANDARD
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
}`,nE=`#define STANDARD
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
}`,iE=`#define TOON
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
}`,sE=`#define TOON
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
}`,rE=`uniform float size;
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
}`,oE=`uniform vec3 diffuse;
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
}`,aE=`#include <common>
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
}`,lE=`uniform vec3 color;
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
}`,cE=`uniform float rotation;
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
}`,hE=`uniform vec3 diffuse;
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
}`,mt={alphahash_fragment:Dw,alphahash_pars_fragment:Lw,alphamap_fragment:Nw,alphamap_pars_fragment:Uw,alphatest_fragment:Fw,alphatest_pars_fragment:Ow,aomap_fragment:kw,aomap_pars_fragment:Bw,batching_pars_vertex:zw,batching_vertex:Vw,begin_vertex:Hw,beginnormal_vertex:Gw,bsdfs:Ww,iridescence_fragment:Xw,bumpmap_pars_fragment:qw,clipping_planes_fragment:Yw,clipping_planes_pars_fragment:$w,clipping_planes_pars_vertex:Zw,clipping_planes_vertex:Kw,color_fragment:Jw,color_pars_fragment:jw,color_pars_vertex:Qw,color_vertex:e1,common:t1,defaultnormal_vertex:n1,displacementmap_pars_vertex:i1,displacementmap_vertex:s1,emissivemap_fragment:r1,emissivemap_pars_fragment:o1,colorspace_fragment:a1,colorspace_pars_fragment:l1,envmap_fragment:c1,envmap_common_pars_fragment:h1,envmap_pars_fragment:u1,envmap_pars_vertex:f1,envmap_physical_pars_fragment:M1,envmap_vertex:d1,fog_vertex:p1,fog_pars_vertex:m1,fog_fragment:g1,fog_pars_fragment:v1,gradientmap_pars_fragment:y1,lightmap_pars_fragment:_1,lights_lambert_fragment:x1,lights_lambert_pars_fragment:S1,lights_pars_begin:b1,lights_toon_fragment:w1,lights_toon_pars_fragment:T1,lights_phong_fragment:E1,lights_phong_pars_fragment:A1,lights_physical_fragment:C1,lights_physical_pars_fragment:R1,lights_fragment_begin:P1,lights_fragment_maps:I1,lights_fragment_end:D1,lightprobes_pars_fragment:L1,logdepthbuf_fragment:N1,logdepthbuf_pars_fragment:U1,logdepthbuf_pars_vertex:F1,logdepthbuf_vertex:O1,map_fragment:k1,map_pars_fragment:B1,map_particle_fragment:z1,map_particle_pars_fragment:V1,metalnessmap_fragment:H1,metalnessmap_pars_fragment:G1,morphinstance_vertex:W1,morphcolor_vertex:X1,morphnormal_vertex:q1,morphtarget_pars_vertex:Y1,morphtarget_vertex:$1,normal_fragment_begin:Z1,normal_fragment_maps:K1,normal_pars_fragment:J1,normal_pars_vertex:j1,normal_vertex:Q1,normalmap_pars_fragment:eT,clearcoat_normal_fragment_begin:tT,clearcoat_normal_fragment_maps:nT,clearcoat_pars_fragment:iT,iridescence_pars_fragment:sT,opaque_fragment:rT,packing:oT,premultiplied_alpha_fragment:aT,project_vertex:lT,dithering_fragment:cT,dithering_pars_fragment:hT,roughnessmap_fragment:uT,roughnessmap_pars_fragment:fT,shadowmap_pars_fragment:dT,shadowmap_pars_vertex:pT,shadowmap_vertex:mT,shadowmask_pars_fragment:gT,skinbase_vertex:vT,skinning_pars_vertex:yT,skinning_vertex:_T,skinnormal_vertex:xT,specularmap_fragment:ST,specularmap_pars_fragment:bT,tonemapping_fragment:MT,tonemapping_pars_fragment:wT,transmission_fragment:TT,transmission_pars_fragment:ET,uv_pars_fragment:AT,uv_pars_vertex:CT,uv_vertex:RT,worldpos_vertex:PT,background_vert:IT,background_frag:DT,backgroundCube_vert:LT,backgroundCube_frag:NT,cube_vert:UT,cube_frag:FT,depth_vert:OT,depth_frag:kT,distance_vert:BT,distance_frag:zT,equirect_vert:VT,equirect_frag:HT,linedashed_vert:GT,linedashed_frag:WT,meshbasic_vert:XT,meshbasic_frag:qT,meshlambert_vert:YT,meshlambert_frag:$T,meshmatcap_vert:ZT,meshmatcap_frag:KT,meshnormal_vert:JT,meshnormal_frag:jT,meshphong_vert:QT,meshphong_frag:eE,meshphysical_vert:tE,meshphysical_frag:nE,meshtoon_vert:iE,meshtoon_frag:sE,points_vert:rE,points_frag:oE,shadow_vert:aE,shadow_frag:lE,sprite_vert:cE,sprite_frag:hE},Le={common:{diffuse:{value:new Ke(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new Qe},alphaMap:{value:null},alphaMapTransform:{value:new Qe},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new Qe}},envmap:{envMap:{value:null},envMapRotation:{value:new Qe},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new Qe}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new Qe}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new Qe},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new Qe},normalScale:{value:new $e(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new Qe},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new Qe}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new Qe}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new Qe}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new Ke(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new Ke(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new Qe},alphaTest:{value:0},uvTransform:{value:new Qe}},sprite:{diffuse:{value:new Ke(16777215)},opacity:{value:1},center:{value:new $e(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new Qe},alphaMap:{value:null},alphaMapTransform:{value:new Qe},alphaTest:{value:0}}},Cs={basic:{uniforms:Jn([Le.common,Le.specularmap,Le.envmap,Le.aomap,Le.lightmap,Le.fog]),vertexShader:mt.meshbasic_vert,fragmentShader:mt.meshbasic_frag},lambert:{uniforms:Jn([Le.common,Le.specularmap,Le.envmap,Le.aomap,Le.lightmap,Le.emissivemap,Le.bumpmap,Le.normalmap,Le.displacementmap,Le.fog,Le.lights,{emissive:{value:new Ke(0)},envMapIntensity:{value:1}}]),vertexShader:mt.meshlambert_vert,fragmentShader:mt.meshlambert_frag},phong:{uniforms:Jn([Le.common,Le.specularmap,Le.envmap,Le.aomap,Le.lightmap,Le.emissivemap,Le.bumpmap,Le.normalmap,Le.displacementmap,Le.fog,Le.lights,{emissive:{value:new Ke(0)},specular:{value:new Ke(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:mt.meshphong_vert,fragmentShader:mt.meshphong_frag},standard:{uniforms:Jn([Le.common,Le.envmap,Le.aomap,Le.lightmap,Le.emissivemap,Le.bumpmap,Le.normalmap,Le.displacementmap,Le.roughnessmap,Le.metalnessmap,Le.fog,Le.lights,{emissive:{value:new Ke(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:mt.meshphysical_vert,fragmentShader:mt.meshphysical_frag},toon:{uniforms:Jn([Le.common,Le.aomap,Le.lightmap,Le.emissivemap,Le.bumpmap,Le.normalmap,Le.displacementmap,Le.gradientmap,Le.fog,Le.lights,{emissive:{value:new Ke(0)}}]),vertexShader:mt.meshtoon_vert,fragmentShader:mt.meshtoon_frag},matcap:{uniforms:Jn([Le.common,Le.bumpmap,Le.normalmap,Le.displacementmap,Le.fog,{matcap:{value:null}}]),vertexShader:mt.meshmatcap_vert,fragmentShader:mt.meshmatcap_frag},points:{uniforms:Jn([Le.points,Le.fog]),vertexShader:mt.points_vert,fragmentShader:mt.points_frag},dashed:{uniforms:Jn([Le.common,Le.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:mt.linedashed_vert,fragmentShader:mt.linedashed_frag},depth:{uniforms:Jn([Le.common,Le.displacementmap]),vertexShader:mt.depth_vert,fragmentShader:mt.depth_frag},normal:{uniforms:Jn([Le.common,Le.bumpmap,Le.normalmap,Le.displacementmap,{opacity:{value:1}}]),vertexShader:mt.meshnormal_vert,fragmentShader:mt.meshnormal_frag},sprite:{uniforms:Jn([Le.sprite,Le.fog]),vertexShader:mt.sprite_vert,fragmentShader:mt.sprite_frag},background:{uniforms:{uvTransform:{value:new Qe},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:mt.background_vert,fragmentShader:mt.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new Qe}},vertexShader:mt.backgroundCube_vert,fragmentShader:mt.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:mt.cube_vert,fragmentShader:mt.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:mt.equirect_vert,fragmentShader:mt.equirect_frag},distance:{uniforms:Jn([Le.common,Le.displacementmap,{referencePosition:{value:new O},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:mt.distance_vert,fragmentShader:mt.distance_frag},shadow:{uniforms:Jn([Le.lights,Le.fog,{color:{value:new Ke(0)},opacity:{value:1}}]),vertexShader:mt.shadow_vert,fragmentShader:mt.shadow_frag}};Cs.physical={uniforms:Jn([Cs.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new Qe},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new Qe},clearcoatNormalScale:{value:new $e(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new Qe},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new Qe},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new Qe},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new Qe},sheen:{value:0},sheenColor:{value:new Ke(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new Qe},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new Qe},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new Qe},transmissionSamplerSize:{value:new $e},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new Qe},attenuationDistance:{value:0},attenuationColor:{value:new Ke(0)},specularColor:{value:new Ke(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new Qe},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new Qe},anisotropyVector:{value:new $e},anisotropyMap:{value:null},anisotropyMapTransform:{value:new Qe}}]),vertexShader:mt.meshphysical_vert,fragmentShader:mt.meshphysical_frag};var $u={r:0,b:0,g:0},uE=new Dt,Oy=new Qe;Oy.set(-1,0,0,0,1,0,0,0,1);function fE(n,e,t,i,s,r){let o=new Ke(0),a=s===!0?0:1,l,c,h=null,u=0,f=null;function d(x){let A=x.isScene===!0?x.background:null;if(A&&A.isTexture){let w=x.backgroundBlurriness>0;A=e.get(A,w)}return A}function g(x){let A=!1,w=d(x);w===null?m(o,a):w&&w.isColor&&(m(w,1),A=!0);let P=n.xr.getEnvironmentBlendMode();P==="additive"?t.buffers.color.setClear(0,0,0,1,r):P==="alpha-blend"&&t.buffers.color.setClear(0,0,0,0,r),(n.autoClear||A)&&(t.buffers.depth.setTest(!0),t.buffers.depth.setMask(!0),t.buffers.color.setMask(!0),n.clear(n.autoClearColor,n.autoClearDepth,n.autoClearStencil))}function _(x,A){let w=d(A);w&&w.isCubeTexture?(c===void 0&&(c=new Gn(new Mr(1,1,1),new Ts({name:"BackgroundCubeMaterial",uniforms:so(Cs.backgroundCube.uniforms),vertexShader:Cs.backgroundCube.vertexShader,fragmentShader:Cs.backgroundCube.fragmentShader,side:hi,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),c.geometry.deleteAttribute("normal"),c.geometry.deleteAttribute("uv"),c.onBeforeRender=function(P,E,y){this.matrixWorld.copyPosition(y.matrixWorld)},Object.defineProperty(c.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),i.update(c)),c.material.uniforms.envMap.value=w,c.material.uniforms.backgroundBlurriness.value=A.backgroundBlurriness,c.material.uniforms.backgroundIntensity.value=A.backgroundIntensity,c.material.uniforms.backgroundRotation.value.setFromMatrix4(uE.makeRotationFromEuler(A.backgroundRotation)).transpose(),w.isRenderTargetTexture===!1&&c.material.uniforms.backgroundRotation.value.premultiply(Oy),c.material.toneMapped=bt.getTransfer(w.colorSpace)!==Ft,(h!==w||u!==w.version||f!==n.toneMapping)&&(c.material.needsUpdate=!0,h=w,u=w.version,f=n.toneMapping),c.layers.enableAll(),x.unshift(c,c.geometry,c.material,0,0,null)):w&&w.isTexture&&(l===void 0&&(l=new Gn(new Ul(2,2),new Ts({name:"BackgroundMaterial",uniforms:so(Cs.background.uniforms),vertexShader:Cs.background.vertexShader,fragmentShader:Cs.background.fragmentShader,side:Pr,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),l.geometry.deleteAttribute("normal"),Object.defineProperty(l.material,"map",{get:function(){return this.uniforms.t2D.value}}),i.update(l)),l.material.uniforms.t2D.value=w,l.material.uniforms.backgroundIntensity.value=A.backgroundIntensity,l.material.toneMapped=bt.getTransfer(w.colorSpace)!==Ft,w.matrixAutoUpdate===!0&&w.updateMatrix(),l.material.uniforms.uvTransform.value.copy(w.matrix),(h!==w||u!==w.version||f!==n.toneMapping)&&(l.material.needsUpdate=!0,h=w,u=w.version,f=n.toneMapping),l.layers.enableAll(),x.unshift(l,l.geometry,l.material,0,0,null))}function m(x,A){x.getRGB($u,Bp(n)),t.buffers.color.setClear($u.r,$u.g,$u.b,A,r)}function p(){c!==void 0&&(c.geometry.dispose(),c.material.dispose(),c=void 0),l!==void 0&&(l.geometry.dispose(),l.material.dispose(),l=void 0)}return{getClearColor:function(){return o},setClearColor:function(x,A=1){o.set(x),a=A,m(o,a)},getClearAlpha:function(){return a},setClearAlpha:function(x){a=x,m(o,a)},render:g,addToRenderList:_,dispose:p}}function dE(n,e){let t=n.getParameter(n.MAX_VERTEX_ATTRIBS),i={},s=f(null),r=s,o=!1;function a(I,z,W,L,X){let $=!1,V=u(I,L,W,z);r!==V&&(r=V,c(r.object)),$=d(I,L,W,X),$&&g(I,L,W,X),X!==null&&e.update(X,n.ELEMENT_ARRAY_BUFFER),($||o)&&(o=!1,w(I,z,W,L),X!==null&&n.bindBuffer(n.ELEMENT_ARRAY_BUFFER,e.get(X).buffer))}function l(){return n.createVertexArray()}function c(I){return n.bindVertexArray(I)}function h(I){return n.deleteVertexArray(I)}function u(I,z,W,L){let X=L.wireframe===!0,$=i[z.id];$===void 0&&($={},i[z.id]=$);let V=I.isInstancedMesh===!0?I.id:0,ce=$[V];ce===void 0&&(ce={},$[V]=ce);let K=ce[W.id];K===void 0&&(K={},ce[W.id]=K);let ee=K[X];return ee===void 0&&(ee=f(l()),K[X]=ee),ee}function f(I){let z=[],W=[],L=[];for(let X=0;X<t;X++)z[X]=0,W[X]=0,L[X]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:z,enabledAttributes:W,attributeDivisors:L,object:I,attributes:{},index:null}}function d(I,z,W,L){let X=r.attributes,$=z.attributes,V=0,ce=W.getAttributes();for(let K in ce)if(ce[K].location>=0){let se=X[K],de=$[K];if(de===void 0&&(K==="instanceMatrix"&&I.instanceMatrix&&(de=I.instanceMatrix),K==="instanceColor"&&I.instanceColor&&(de=I.instanceColor)),se===void 0||se.attribute!==de||de&&se.data!==de.data)return!0;V++}return r.attributesNum!==V||r.index!==L}function g(I,z,W,L){let X={},$=z.attributes,V=0,ce=W.getAttributes();for(let K in ce)if(ce[K].location>=0){let se=$[K];se===void 0&&(K==="instanceMatrix"&&I.instanceMatrix&&(se=I.instanceMatrix),K==="instanceColor"&&I.instanceColor&&(se=I.instanceColor));let de={};de.attribute=se,se&&se.data&&(de.data=se.data),X[K]=de,V++}r.attributes=X,r.attributesNum=V,r.index=L}function _(){let I=r.newAttributes;for(let z=0,W=I.length;z<W;z++)I[z]=0}function m(I){p(I,0)}function p(I,z){let W=r.newAttributes,L=r.enabledAttributes,X=r.attributeDivisors;W[I]=1,L[I]===0&&(n.enableVertexAttribArray(I),L[I]=1),X[I]!==z&&(n.vertexAttribDivisor(I,z),X[I]=z)}function x(){let I=r.newAttributes,z=r.enabledAttributes;for(let W=0,L=z.length;W<L;W++)z[W]!==I[W]&&(n.disableVertexAttribArray(W),z[W]=0)}function A(I,z,W,L,X,$,V){V===!0?n.vertexAttribIPointer(I,z,W,X,$):n.vertexAttribPointer(I,z,W,L,X,$)}function w(I,z,W,L){_();let X=L.attributes,$=W.getAttributes(),V=z.defaultAttributeValues;for(let ce in $){let K=$[ce];if(K.location>=0){let ee=X[ce];if(ee===void 0&&(ce==="instanceMatrix"&&I.instanceMatrix&&(ee=I.instanceMatrix),ce==="instanceColor"&&I.instanceColor&&(ee=I.instanceColor)),ee!==void 0){let se=ee.normalized,de=ee.itemSize,he=e.get(ee);if(he===void 0)continue;let te=he.buffer,me=he.type,ve=he.bytesPerElement,Me=me===n.INT||me===n.UNSIGNED_INT||ee.gpuType===hu;if(ee.isInterleavedBufferAttribute){let xe=ee.data,We=xe.isInterleavedBuffer===!0?xe.stride:xe.itemSize,ot=ee.offset;if(xe.isInstancedInterleavedBuffer||xe.isInstancedBufferAttribute){for(let He=0;He<K.locationSize;He++)p(K.location+He,xe.meshPerAttribute);I.isInstancedMesh!==!0&&L._maxInstanceCount===void 0&&(L._maxInstanceCount=xe.meshPerAttribute*xe.count)}else for(let He=0;He<K.locationSize;He++)m(K.location+He);n.bindBuffer(n.ARRAY_BUFFER,te);for(let He=0;He<K.locationSize;He++)A(K.location+He,de/K.locationSize,me,se,We*ve,(ot+de/K.locationSize*He)*ve,Me)}else{if(ee.isInstancedBufferAttribute){for(let xe=0;xe<K.locationSize;xe++)p(K.location+xe,ee.meshPerAttribute);I.isInstancedMesh!==!0&&L._maxInstanceCount===void 0&&(L._maxInstanceCount=ee.meshPerAttribute*ee.count)}else for(let xe=0;xe<K.locationSize;xe++)m(K.location+xe);n.bindBuffer(n.ARRAY_BUFFER,te);for(let xe=0;xe<K.locationSize;xe++)A(K.location+xe,de/K.locationSize,me,se,de*ve,de/K.locationSize*xe*ve,Me)}}else if(V!==void 0){let se=V[ce];if(se!==void 0)switch(se.length){case 2:n.vertexAttrib2fv(K.location,se);break;case 3:n.vertexAttrib3fv(K.location,se);break;case 4:n.vertexAttrib4fv(K.location,se);break;default:n.vertexAttrib1fv(K.location,se)}}}}x()}function P(){k();for(let I in i){let z=i[I];for(let W in z){let L=z[W];for(let X in L){let $=L[X];for(let V in $)h($[V].object),delete $[V];delete L[X]}}delete i[I]}}function E(I){if(i[I.id]===void 0)return;let z=i[I.id];for(let W in z){let L=z[W];for(let X in L){let $=L[X];for(let V in $)h($[V].object),delete $[V];delete L[X]}}delete i[I.id]}function y(I){for(let z in i){let W=i[z];for(let L in W){let X=W[L];if(X[I.id]===void 0)continue;let $=X[I.id];for(let V in $)h($[V].object),delete $[V];delete X[I.id]}}}function T(I){for(let z in i){let W=i[z],L=I.isInstancedMesh===!0?I.id:0,X=W[L];if(X!==void 0){for(let $ in X){let V=X[$];for(let ce in V)h(V[ce].object),delete V[ce];delete X[$]}delete W[L],Object.keys(W).length===0&&delete i[z]}}}function k(){N(),o=!0,r!==s&&(r=s,c(r.object))}function N(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:a,reset:k,resetDefaultState:N,dispose:P,releaseStatesOfGeometry:E,releaseStatesOfObject:T,releaseStatesOfProgram:y,initAttributes:_,enableAttribute:m,disableUnusedAttributes:x}}function pE(n,e,t){let i;function s(l){i=l}function r(l,c){n.drawArrays(i,l,c),t.update(c,i,1)}function o(l,c,h){h!==0&&(n.drawArraysInstanced(i,l,c,h),t.update(c,i,h))}function a(l,c,h){if(h===0)return;e.get("WEBGL_multi_draw").multiDrawArraysWEBGL(i,l,0,c,0,h);let f=0;for(let d=0;d<h;d++)f+=c[d];t.update(f,i,1)}this.setMode=s,this.render=r,this.renderInstances=o,this.renderMultiDraw=a}function mE(n,e,t,i){let s;function r(){if(s!==void 0)return s;if(e.has("EXT_texture_filter_anisotropic")===!0){let y=e.get("EXT_texture_filter_anisotropic");s=n.getParameter(y.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function o(y){return!(y!==ss&&i.convert(y)!==n.getParameter(n.IMPLEMENTATION_COLOR_READ_FORMAT))}function a(y){let T=y===is&&(e.has("EXT_color_buffer_half_float")||e.has("EXT_color_buffer_float"));return!(y!==di&&y!==ns&&!T&&i.convert(y)!==n.getParameter(n.IMPLEMENTATION_COLOR_READ_TYPE))}function l(y){if(y==="highp"){if(n.getShaderPrecisionFormat(n.VERTEX_SHADER,n.HIGH_FLOAT).precision>0&&n.getShaderPrecisionFormat(n.FRAGMENT_SHADER,n.HIGH_FLOAT).precision>0)return"highp";y="mediump"}return y==="mediump"&&n.getShaderPrecisionFormat(n.VERTEX_SHADER,n.MEDIUM_FLOAT).precision>0&&n.getShaderPrecisionFormat(n.FRAGMENT_SHADER,n.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let c=t.precision!==void 0?t.precision:"highp",h=l(c);h!==c&&(Je("WebGLRenderer:",c,"not supported, using",h,"instead."),c=h);let u=t.reversedDepthBuffer===!0&&e.has("EXT_clip_control"),f=t.logarithmicDepthBuffer===!0&&u===!1;t.reversedDepthBuffer===!0&&u===!1&&Je("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),t.logarithmicDepthBuffer===!0&&u===!0&&Je("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let d=n.getParameter(n.MAX_TEXTURE_IMAGE_UNITS),g=n.getParameter(n.MAX_VERTEX_TEXTURE_IMAGE_UNITS),_=n.getParameter(n.MAX_TEXTURE_SIZE),m=n.getParameter(n.MAX_CUBE_MAP_TEXTURE_SIZE),p=n.getParameter(n.MAX_VERTEX_ATTRIBS),x=n.getParameter(n.MAX_VERTEX_UNIFORM_VECTORS),A=n.getParameter(n.MAX_VARYING_VECTORS),w=n.getParameter(n.MAX_FRAGMENT_UNIFORM_VECTORS),P=n.getParameter(n.MAX_SAMPLES),E=n.getParameter(n.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:l,textureFormatReadable:o,textureTypeReadable:a,precision:c,logarithmicDepthBuffer:f,reversedDepthBuffer:u,maxTextures:d,maxVertexTextures:g,maxTextureSize:_,maxCubemapSize:m,maxAttributes:p,maxVertexUniforms:x,maxVaryings:A,maxFragmentUniforms:w,maxSamples:P,samples:E}}function gE(n){let e=this,t=null,i=0,s=!1,r=!1,o=new Ci,a=new Qe,l={value:null,needsUpdate:!1};this.uniform=l,this.numPlanes=0,this.numIntersection=0,this.init=function(u,f){let d=u.length!==0||f||i!==0||s;return s=f,i=u.length,d},this.beginShadows=function(){r=!0,h(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(u,f){t=h(u,f,0)},this.setState=function(u,f,d){let g=u.clippingPlanes,_=u.clipIntersection,m=u.clipShadows,p=n.get(u);if(!s||g===null||g.length===0||r&&!m)r?h(null):c();else{let x=r?0:i,A=x*4,w=p.clippingState||null;l.value=w,w=h(g,f,A,d);for(let P=0;P!==A;++P)w[P]=t[P];p.clippingState=w,this.numIntersection=_?this.numPlanes:0,this.numPlanes+=x}};function c(){l.value!==t&&(l.value=t,l.needsUpdate=i>0),e.numPlanes=i,e.numIntersection=0}function h(u,f,d,g){let _=u!==null?u.length:0,m=null;if(_!==0){if(m=l.value,g!==!0||m===null){let p=d+_*4,x=f.matrixWorldInverse;a.getNormalMatrix(x),(m===null||m.length<p)&&(m=new Float32Array(p));for(let A=0,w=d;A!==_;++A,w+=4)o.copy(u[A]).applyMatrix4(x,a),o.normal.toArray(m,w),m[w+3]=o.constant}l.value=m,l.needsUpdate=!0}return e.numPlanes=_,e.numIntersection=0,m}}var tc=class extends Ri{constructor(e=1,t={}){super(e,e,t),this.isWebGLCubeRenderTarget=!0;let i={width:e,height:e,depth:1},s=[i,i,i,i,i,i];this.texture=new Pl(s),this._setTextureOptions(t),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(e,t){this.texture.type=t.type,this.texture.colorSpace=t.colorSpace,this.texture.generateMipmaps=t.generateMipmaps,this.texture.minFilter=t.minFilter,this.texture.magFilter=t.magFilter;let i={uniforms:{tEquirect:{value:null}},vertexShader:`

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
			`},s=new Mr(5,5,5),r=new Ts({name:"CubemapFromEquirect",uniforms:so(i.uniforms),vertexShader:i.vertexShader,fragmentShader:i.fragmentShader,side:hi,blending:eo});r.uniforms.tEquirect.value=t;let o=new Gn(s,r),a=t.minFilter;return t.minFilter===er&&(t.minFilter=ai),new la(1,10,this).update(e,o),t.minFilter=a,o.geometry.dispose(),o.material.dispose(),this}clear(e,t=!0,i=!0,s=!0){let r=e.getRenderTarget();for(let o=0;o<6;o++)e.setRenderTarget(this,o),e.clear(t,i,s);e.setRenderTarget(r)}},my=256,vE=3,yE=20,ky=256,By=16,_E=3,xE=new O,SE=new Ke,Ku=class n{constructor(e){this._renderer=e,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new la(1,10,null),this._boxMesh=new Gn(new Mr(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(e,t=0,i=.1,s=100,r={}){let{size:o=256,position:a=xE}=r,l=this._renderer;this._setSize(o);let c=this._allocateTarget(),h=this._getSourceTarget(!0);t>0&&(h.texture.mipmapsAutoUpdate=!1);let u=l.autoClear,f=l.autoClearColor,d=l.autoClearDepth,g=l.autoClearStencil,_=e.background;l.autoClear=!0,l.autoClearColor=!0,l.autoClearDepth=!0,l.autoClearStencil=!0,_===null&&(e.background=l.getClearColor(SE));let m=new la(i,s,h);return m.position.copy(a),m.update(l,e),l.autoClear=u,l.autoClearColor=f,l.autoClearDepth=d,l.autoClearStencil=g,e.background=_,t>0&&(h.texture.mipmapsAutoUpdate=!0,this._blur(c,t)),this._applyPMREM(c),c}fromEquirectangular(e,t=null){return this._fromTexture(e,t)}fromCubemap(e,t=null){return this._fromTexture(e,t)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=yy(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=vy(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(e,t){return t>0?1-Math.sqrt(1-e/t):0}_setSize(e){this._cubeSize=Math.max(my,Up(e))}_fromTexture(e,t){e.mapping===no||e.mapping===fa?this._setSize(e.image.length===0?my:e.image[0].width||e.image[0].image.width):this._setSize(e.image.width/4);let i=t||this._allocateTarget();return this._textureToCubemap(e),this._applyPMREM(i),i}_allocateTarget(){let e=this._cubeSize,t=gy(e,!1,!1),i=Math.log2(e)-vE;for(let s=0;s<=i;s++)t.texture.mipmaps.push({width:e>>s,height:e>>s});return t.texture.name="PMREM",t.texture.isPMREMTexture=!0,t}_getSourceTarget(e=!1){let t=this._cubeSize,i=this._sourceTarget;return(i===null||i.width!==t||e&&i.depthBuffer===!1)&&(i!==null&&i.dispose(),this._sourceTarget=gy(t,!0,e)),this._sourceTarget}_compileMaterial(e){this._boxMesh.material=e,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(e,t,i){let s=this._boxMesh,r=this._cubeCamera;s.material=i,r.renderTarget=e,r.activeMipmapLevel=t;let o=e.width>>t;e.viewport.set(0,0,o,o),r.update(this._renderer,s),e.viewport.set(0,0,e.width,e.height)}_textureToCubemap(e){let t;e.mapping===no||e.mapping===fa?(this._cubemapMaterial===null&&(this._cubemapMaterial=yy()),t=this._cubemapMaterial,t.uniforms.flipEnvMap.value=e.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=vy()),t=this._equirectMaterial),t.uniforms.envMap.value=e,this._renderCube(this._getSourceTarget(),0,t)}_applyPMREM(e){this._ggxMaterial===null&&(this._ggxMaterial=bE(),this._integrationMaterial=ME());let t=this._cubeSize,i=e.texture.mipmaps.length-1,s=this._ggxMaterial.uniforms;s.envMap.value=this._sourceTarget.texture;let r=this._integrationMaterial.uniforms;r.envMap.value=this._sourceTarget.texture,r.sourceLod.value=Math.log2(t/By);for(let o=0;o<=i;o++){let a=n.lodToRoughness(o,i);if(o>i-_E)r.roughness.value=a,this._renderCube(e,o,this._integrationMaterial);else{let l=a>0?Math.log2(t)+.5*Math.log2(6/(ky*Math.pow(a,4)))+.5:0;s.roughness.value=a,s.lodBias.value=l,this._renderCube(e,o,this._ggxMaterial)}}}_blur(e,t){this._blurMaterial===null&&(this._blurMaterial=wE());let i=this._blurMaterial,s=i.uniforms,r=this._sourceTarget;s.sigma.value=Math.min(t,Math.PI)/Math.SQRT2,s.envMap.value=r.texture,this._renderCube(e,0,i),s.envMap.value=e.texture,this._renderCube(r,0,i)}};function gy(n,e,t){return new tc(n,{minFilter:er,generateMipmaps:e,type:is,colorSpace:xl,depthBuffer:t})}function nc(n,e,t){return new Ts({name:n,uniforms:e,vertexShader:mt.cube_vert,fragmentShader:t,side:hi,blending:eo,depthTest:!1,depthWrite:!1})}function bE(){return nc("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${ky}u

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
	`)}function ME(){return nc("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:By}},`

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
	`)}function wE(){return nc("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${yE}
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
	`)}function vy(){return nc("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

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
	`)}function yy(){return nc("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function TE(n){let e=new WeakMap,t=new WeakMap,i=null;function s(f,d=!1){return f==null?null:d?o(f):r(f)}function r(f){if(f&&f.isTexture){let d=f.mapping;if(d===au||d===lu)if(e.has(f)){let g=e.get(f).texture;return a(g,f.mapping)}else{let g=f.image;if(g&&g.height>0){let _=new tc(g.height);return _.fromEquirectangularTexture(n,f),e.set(f,_),f.addEventListener("dispose",c),a(_.texture,f.mapping)}else return null}}return f}function o(f){if(f&&f.isTexture&&f.isPMREMTexture!==!0){let d=f.mapping,g=d===au||d===lu,_=d===no||d===fa;if(g||_){let m=t.get(f),p=m!==void 0?m.texture.pmremVersion:0;if(f.isRenderTargetTexture&&f.pmremVersion!==p)return i===null&&(i=new Ku(n)),m=g?i.fromEquirectangular(f,m):i.fromCubemap(f,m),m.texture.pmremVersion=f.pmremVersion,t.set(f,m),m.texture;if(m!==void 0)return m.texture;{let x=f.image;return g&&x&&x.height>0||_&&x&&l(x)?(i===null&&(i=new Ku(n)),m=g?i.fromEquirectangular(f):i.fromCubemap(f),m.texture.pmremVersion=f.pmremVersion,t.set(f,m),f.addEventListener("dispose",h),m.texture):null}}}return f}function a(f,d){return d===au?f.mapping=no:d===lu&&(f.mapping=fa),f}function l(f){let d=0,g=6;for(let _=0;_<g;_++)f[_]!==void 0&&d++;return d===g}function c(f){let d=f.target;d.removeEventListener("dispose",c);let g=e.get(d);g!==void 0&&(e.delete(d),g.dispose())}function h(f){let d=f.target;d.removeEventListener("dispose",h);let g=t.get(d);g!==void 0&&(t.delete(d),g.dispose())}function u(){e=new WeakMap,t=new WeakMap,i!==null&&(i.dispose(),i=null)}return{get:s,dispose:u}}function EE(n){let e={};function t(i){if(e[i]!==void 0)return e[i];let s=n.getExtension(i);return e[i]=s,s}return{has:function(i){return t(i)!==null},init:function(){t("EXT_color_buffer_float"),t("WEBGL_clip_cull_distance"),t("OES_texture_float_linear"),t("EXT_color_buffer_half_float"),t("WEBGL_multisampled_render_to_texture"),t("WEBGL_render_shared_exponent")},get:function(i){let s=t(i);return s===null&&gl("WebGLRenderer: "+i+" extension not supported."),s}}}function AE(n,e,t,i){let s={},r=new WeakMap,o=new FinalizationRegistry(g=>delete s[g]);function a(g){l(g.target)}function l(g){g.index!==null&&e.remove(g.index);for(let m in g.attributes)e.remove(g.attributes[m]);g.removeEventListener("dispose",a),delete s[g.id],o.unregister(g);let _=r.get(g);_&&(e.remove(_),r.delete(g)),i.releaseStatesOfGeometry(g),g.isInstancedBufferGeometry===!0&&delete g._maxInstanceCount,t.memory.geometries--}function c(g,_){return s[_.id]!==void 0||(_.addEventListener("dispose",a),s[_.id]=new WeakRef(_),o.register(_,_.id,_),t.memory.geometries++),_}function h(g){let _=g.attributes;for(let m in _)e.update(_[m],n.ARRAY_BUFFER)}function u(g){let _=g.index,m=g.attributes.position,p=0;if(m===void 0)return;let x=_!==null?_.array.length:m.array.length/3-1,A=m.count>=65535?Cl:Al,w=new A(Math.ceil(x/3)*6,1),P=w.array;if(_!==null){let y=_.array;p=_.version;for(let T=0,k=0;T<x;T+=3){let N=y[T+0],I=y[T+1],z=y[T+2];P[k++]=N,P[k++]=I,P[k++]=I,P[k++]=z,P[k++]=z,P[k++]=N}}else{p=m.version;for(let y=0,T=0;y<x;y+=3){let k=y+0,N=y+1,I=y+2;P[T++]=k,P[T++]=N,P[T++]=N,P[T++]=I,P[T++]=I,P[T++]=k}}w.version=p;let E=r.get(g);E&&e.remove(E),r.set(g,w)}function f(g){let _=r.get(g);if(_){let m=g.index;m!==null&&_.version<m.version&&u(g)}else u(g);return r.get(g)}function d(){for(let g in s){let _=s[g].deref();_!==void 0&&l(_)}}return{get:c,update:h,getWireframeAttribute:f,dispose:d}}function CE(n,e,t){let i;function s(u){i=u}let r,o;function a(u){r=u.type,o=u.bytesPerElement}function l(u,f){n.drawElements(i,f,r,u*o),t.update(f,i,1)}function c(u,f,d){d!==0&&(n.drawElementsInstanced(i,f,r,u*o,d),t.update(f,i,d))}function h(u,f,d){if(d===0)return;e.get("WEBGL_multi_draw").multiDrawElementsWEBGL(i,f,0,r,u,0,d);let _=0;for(let m=0;m<d;m++)_+=f[m];t.update(_,i,1)}this.setMode=s,this.setIndex=a,this.render=l,this.renderInstances=c,this.renderMultiDraw=h}function RE(n){let e={geometries:0,textures:0},t={frame:0,calls:0,triangles:0,points:0,lines:0};function i(r,o,a){switch(t.calls++,o){case n.TRIANGLES:t.triangles+=a*(r/3);break;case n.LINES:t.lines+=a*(r/2);break;case n.LINE_STRIP:t.lines+=a*(r-1);break;case n.LINE_LOOP:t.lines+=a*r;break;case n.POINTS:t.points+=a*r;break;default:st("WebGLInfo: Unknown draw mode:",o);break}}function s(){t.calls=0,t.triangles=0,t.points=0,t.lines=0}return{memory:e,render:t,programs:null,autoReset:!0,reset:s,update:i}}function PE(n,e,t){let i=new WeakMap,s=new rn;function r(o,a,l){let c=o.morphTargetInfluences,h=a.morphAttributes.position||a.morphAttributes.normal||a.morphAttributes.color,u=h!==void 0?h.length:0,f=i.get(a);if(f===void 0||f.count!==u){let k=function(){y.dispose(),i.delete(a),a.removeEventListener("dispose",k)};f!==void 0&&f.texture.dispose();let d=a.morphAttributes.position!==void 0,g=a.morphAttributes.normal!==void 0,_=a.morphAttributes.color!==void 0,m=a.morphAttributes.position||[],p=a.morphAttributes.normal||[],x=a.morphAttributes.color||[],A=0;d===!0&&(A=1),g===!0&&(A=2),_===!0&&(A=3);let w=a.attributes.position.count*A,P=1;w>e.maxTextureSize&&(P=Math.ceil(w/e.maxTextureSize),w=e.maxTextureSize);let E=new Float32Array(w*P*4*u),y=new wl(E,w,P,u);y.type=ns,y.needsUpdate=!0;let T=A*4;for(let N=0;N<u;N++){let I=m[N],z=p[N],W=x[N],L=w*P*4*N;for(let X=0;X<I.count;X++){let $=X*T;d===!0&&(s.fromBufferAttribute(I,X),E[L+$+0]=s.x,E[L+$+1]=s.y,E[L+$+2]=s.z,E[L+$+3]=0),g===!0&&(s.fromBufferAttribute(z,X),E[L+$+4]=s.x,E[L+$+5]=s.y,E[L+$+6]=s.z,E[L+$+7]=0),_===!0&&(s.fromBufferAttribute(W,X),E[L+$+8]=s.x,E[L+$+9]=s.y,E[L+$+10]=s.z,E[L+$+11]=W.itemSize===4?s.w:1)}}f={count:u,texture:y,size:new $e(w,P)},i.set(a,f),a.addEventListener("dispose",k)}if(o.isInstancedMesh===!0&&o.morphTexture!==null)l.getUniforms().setValue(n,"morphTexture",o.morphTexture,t);else{let d=0;for(let _=0;_<c.length;_++)d+=c[_];let g=a.morphTargetsRelative?1:1-d;l.getUniforms().setValue(n,"morphTargetBaseInfluence",g),l.getUniforms().setValue(n,"morphTargetInfluences",c)}l.getUniforms().setValue(n,"morphTargetsTexture",f.texture,t),l.getUniforms().setValue(n,"morphTargetsTextureSize",f.size)}return{update:r}}function IE(n,e,t,i,s){let r=new WeakMap;function o(c){let h=s.render.frame,u=c.geometry,f=e.get(c,u);if(r.get(f)!==h&&(e.update(f),r.set(f,h)),c.isInstancedMesh&&(c.hasEventListener("dispose",l)===!1&&c.addEventListener("dispose",l),r.get(c)!==h&&(t.update(c.instanceMatrix,n.ARRAY_BUFFER),c.instanceColor!==null&&t.update(c.instanceColor,n.ARRAY_BUFFER),r.set(c,h))),c.isSkinnedMesh){let d=c.skeleton;r.get(d)!==h&&(d.update(),r.set(d,h))}return f}function a(){r=new WeakMap}function l(c){let h=c.target;h.removeEventListener("dispose",l),i.releaseStatesOfObject(h),t.remove(h.instanceMatrix),h.instanceColor!==null&&t.remove(h.instanceColor)}return{update:o,dispose:a}}var DE={[pp]:"LINEAR_TONE_MAPPING",[mp]:"REINHARD_TONE_MAPPING",[gp]:"CINEON_TONE_MAPPING",[vp]:"ACES_FILMIC_TONE_MAPPING",[_p]:"AGX_TONE_MAPPING",[xp]:"NEUTRAL_TONE_MAPPING",[yp]:"CUSTOM_TONE_MAPPING"};function LE(n,e,t,i,s,r){let o=new Ri(e,t,{type:n,depthBuffer:s,stencilBuffer:r,samples:i?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),a=null,l=null,c=null,h=new $t;h.setAttribute("position",new dn([-1,3,0,-1,-1,0,3,-1,0],3)),h.setAttribute("uv",new dn([0,2,0,0,2,0],2));let u=new Xh({uniforms:{tDiffuse:{value:null}},vertexShader:`
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
			}`,depthTest:!1,depthWrite:!1}),f=new Gn(h,u),d=new Vl(-1,1,1,-1,0,1),g=null,_=null,m=!1,p,x=null,A=[],w=!1;this.setSize=function(P,E){o.setSize(P,E),a!==null&&a.setSize(P,E),l!==null&&l.setSize(P,E);for(let y=0;y<A.length;y++){let T=A[y];T.setSize&&T.setSize(P,E)}},this.setEffects=function(P){A=P,w=A.length>0&&A[0].isRenderPass===!0;let E=o.width,y=o.height;A.length>0&&a===null&&(a=new Ri(E,y,{type:is,depthBuffer:!1,stencilBuffer:!1}),l=new Ri(E,y,{type:is,depthBuffer:!1,stencilBuffer:!1}));let T=s===!0&&A.some(k=>k.needsDepthTexture===!0);T!==(o.depthTexture!==null)&&(T===!0&&c===null&&(c=new Qs(E,y),r===!0&&(c.format=tr,c.type=io)),o.dispose(),o.depthTexture=T?c:null,o.resolveDepthBuffer=T,o.storeMultisampledDepthBuffer=T);for(let k=0;k<A.length;k++){let N=A[k];N.setSize&&N.setSize(E,y),T&&N.needsDepthTexture===!0&&N.setDepthTexture&&N.setDepthTexture(c)}},this.begin=function(P,E){if(m||P.toneMapping===Es&&A.length===0)return!1;if(x=E,E!==null){let y=E.width,T=E.height;(o.width!==y||o.height!==T)&&this.setSize(y,T)}return w===!1&&P.setRenderTarget(o),p=P.toneMapping,P.toneMapping=Es,!0},this.hasRenderPass=function(){return w},this.end=function(P,E){P.toneMapping=p,m=!0;let y=o,T=a;for(let k=0;k<A.length;k++){let N=A[k];N.enabled!==!1&&(N.render(P,T,y,E),N.needsSwap!==!1&&(y=T,T=T===a?l:a))}if(g!==P.outputColorSpace||_!==P.toneMapping){g=P.outputColorSpace,_=P.toneMapping,u.defines={},bt.getTransfer(g)===Ft&&(u.defines.SRGB_TRANSFER="");let k=DE[_];k&&(u.defines[k]=""),u.needsUpdate=!0}u.uniforms.tDiffuse.value=y.texture,P.setRenderTarget(x),P.render(f,d),x=null,m=!1},this.isCompositing=function(){return m},this.dispose=function(){o.dispose(),a!==null&&a.dispose(),l!==null&&l.dispose(),h.dispose(),u.dispose()}}var zy=new ci,Vy=new Qs(1,1),Hy=new Dl(1),Gy=new wl,Wy=new Bh,Xy=new Pl,_y=[],xy=[],Sy=new Float32Array(16),by=new Float32Array(9),My=new Float32Array(4);function ma(n,e,t){let i=n[0];if(i<=0||i>0)return n;let s=e*t,r=_y[s];if(r===void 0&&(r=new Float32Array(s),_y[s]=r),e!==0){i.toArray(r,0);for(let o=1,a=0;o!==e;++o)a+=t,n[o].toArray(r,a)}return r}function Rn(n,e){if(n.length!==e.length)return!1;for(let t=0,i=n.length;t<i;t++)if(n[t]!==e[t])return!1;return!0}function Pn(n,e){for(let t=0,i=e.length;t<i;t++)n[t]=e[t]}function ju(n,e){let t=xy[e];t===void 0&&(t=new Int32Array(e),xy[e]=t);for(let i=0;i!==e;++i)t[i]=n.allocateTextureUnit();return t}function NE(n,e){let t=this.cache;t[0]!==e&&(n.uniform1f(this.addr,e),t[0]=e)}function UE(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(n.uniform2f(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(Rn(t,e))return;n.uniform2fv(this.addr,e),Pn(t,e)}}function FE(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(n.uniform3f(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else if(e.r!==void 0)(t[0]!==e.r||t[1]!==e.g||t[2]!==e.b)&&(n.uniform3f(this.addr,e.r,e.g,e.b),t[0]=e.r,t[1]=e.g,t[2]=e.b);else{if(Rn(t,e))return;n.uniform3fv(this.addr,e),Pn(t,e)}}function OE(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(n.uniform4f(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(Rn(t,e))return;n.uniform4fv(this.addr,e),Pn(t,e)}}function kE(n,e){let t=this.cache,i=e.elements;if(i===void 0){if(Rn(t,e))return;n.uniformMatrix2fv(this.addr,!1,e),Pn(t,e)}else{if(Rn(t,i))return;My.set(i),n.uniformMatrix2fv(this.addr,!1,My),Pn(t,i)}}function BE(n,e){let t=this.cache,i=e.elements;if(i===void 0){if(Rn(t,e))return;n.uniformMatrix3fv(this.addr,!1,e),Pn(t,e)}else{if(Rn(t,i))return;by.set(i),n.uniformMatrix3fv(this.addr,!1,by),Pn(t,i)}}function zE(n,e){let t=this.cache,i=e.elements;if(i===void 0){if(Rn(t,e))return;n.uniformMatrix4fv(this.addr,!1,e),Pn(t,e)}else{if(Rn(t,i))return;Sy.set(i),n.uniformMatrix4fv(this.addr,!1,Sy),Pn(t,i)}}function VE(n,e){let t=this.cache;t[0]!==e&&(n.uniform1i(this.addr,e),t[0]=e)}function HE(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(n.uniform2i(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(Rn(t,e))return;n.uniform2iv(this.addr,e),Pn(t,e)}}function GE(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(n.uniform3i(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(Rn(t,e))return;n.uniform3iv(this.addr,e),Pn(t,e)}}function WE(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(n.uniform4i(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(Rn(t,e))return;n.uniform4iv(this.addr,e),Pn(t,e)}}function XE(n,e){let t=this.cache;t[0]!==e&&(n.uniform1ui(this.addr,e),t[0]=e)}function qE(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(n.uniform2ui(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(Rn(t,e))return;n.uniform2uiv(this.addr,e),Pn(t,e)}}function YE(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(n.uniform3ui(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(Rn(t,e))return;n.uniform3uiv(this.addr,e),Pn(t,e)}}function $E(n,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(n.uniform4ui(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(Rn(t,e))return;n.uniform4uiv(this.addr,e),Pn(t,e)}}function Qu(n){return n.version===0&&(n.compareFunction=Ip,n.needsUpdate=!0),n}function ZE(n,e,t){let i=this.cache,s=t.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s);let r;this.type===n.SAMPLER_2D_SHADOW?r=Qu(Vy):r=zy,t.setTexture2D(e||r,s)}function KE(n,e,t){let i=this.cache,s=t.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s),t.setTexture3D(e||Wy,s)}function JE(n,e,t){let i=this.cache,s=t.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s);let r;this.type===n.SAMPLER_CUBE_SHADOW?r=Qu(Hy):r=Xy,t.setTextureCube(e||r,s)}function jE(n,e,t){let i=this.cache,s=t.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s),t.setTexture2DArray(e||Gy,s)}function QE(n){switch(n){case 5126:return NE;case 35664:return UE;case 35665:return FE;case 35666:return OE;case 35674:return kE;case 35675:return BE;case 35676:return zE;case 5124:case 35670:return VE;case 35667:case 35671:return HE;case 35668:case 35672:return GE;case 35669:case 35673:return WE;case 5125:return XE;case 36294:return qE;case 36295:return YE;case 36296:return $E;case 35678:case 36198:case 36298:case 36306:case 35682:return ZE;case 35679:case 36299:case 36307:return KE;case 35680:case 36300:case 36308:case 36293:return JE;case 36289:case 36303:case 36311:case 36292:return jE}}function eA(n,e){n.uniform1fv(this.addr,e)}function tA(n,e){let t=ma(e,this.size,2);n.uniform2fv(this.addr,t)}function nA(n,e){let t=ma(e,this.size,3);n.uniform3fv(this.addr,t)}function iA(n,e){let t=ma(e,this.size,4);n.uniform4fv(this.addr,t)}function sA(n,e){let t=ma(e,this.size,4);n.uniformMatrix2fv(this.addr,!1,t)}function rA(n,e){let t=ma(e,this.size,9);n.uniformMatrix3fv(this.addr,!1,t)}function oA(n,e){let t=ma(e,this.size,16);n.uniformMatrix4fv(this.addr,!1,t)}function aA(n,e){n.uniform1iv(this.addr,e)}function lA(n,e){n.uniform2iv(this.addr,e)}function cA(n,e){n.uniform3iv(this.addr,e)}function hA(n,e){n.uniform4iv(this.addr,e)}function uA(n,e){n.uniform1uiv(this.addr,e)}function fA(n,e){n.uniform2uiv(this.addr,e)}function dA(n,e){n.uniform3uiv(this.addr,e)}function pA(n,e){n.uniform4uiv(this.addr,e)}function mA(n,e,t){let i=this.cache,s=e.length,r=ju(t,s);Rn(i,r)||(n.uniform1iv(this.addr,r),Pn(i,r));let o;this.type===n.SAMPLER_2D_SHADOW?o=Qu(Vy):o=zy;for(let a=0;a!==s;++a)t.setTexture2D(e[a]||o,r[a])}function gA(n,e,t){let i=this.cache,s=e.length,r=ju(t,s);Rn(i,r)||(n.uniform1iv(this.addr,r),Pn(i,r));for(let o=0;o!==s;++o)t.setTexture3D(e[o]||Wy,r[o])}function vA(n,e,t){let i=this.cache,s=e.length,r=ju(t,s);Rn(i,r)||(n.uniform1iv(this.addr,r),Pn(i,r));let o;this.type===n.SAMPLER_CUBE_SHADOW?o=Qu(Hy):o=Xy;for(let a=0;a!==s;++a)t.setTextureCube(e[a]||o,r[a])}function yA(n,e,t){let i=this.cache,s=e.length,r=ju(t,s);Rn(i,r)||(n.uniform1iv(this.addr,r),Pn(i,r));for(let o=0;o!==s;++o)t.setTexture2DArray(e[o]||Gy,r[o])}function _A(n){switch(n){case 5126:return eA;case 35664:return tA;case 35665:return nA;case 35666:return iA;case 35674:return sA;case 35675:return rA;case 35676:return oA;case 5124:case 35670:return aA;case 35667:case 35671:return lA;case 35668:case 35672:return cA;case 35669:case 35673:return hA;case 5125:return uA;case 36294:return fA;case 36295:return dA;case 36296:return pA;case 35678:case 36198:case 36298:case 36306:case 35682:return mA;case 35679:case 36299:case 36307:return gA;case 35680:case 36300:case 36308:case 36293:return vA;case 36289:case 36303:case 36311:case 36292:return yA}}var Xp=class{constructor(e,t,i){this.id=e,this.addr=i,this.cache=[],this.type=t.type,this.setValue=QE(t.type)}},qp=class{constructor(e,t,i){this.id=e,this.addr=i,this.cache=[],this.type=t.type,this.size=t.size,this.setValue=_A(t.type)}},Yp=class{constructor(e){this.id=e,this.seq=[],this.map={}}setValue(e,t,i){let s=this.seq;for(let r=0,o=s.length;r!==o;++r){let a=s[r];a.setValue(e,t[a.id],i)}}},Gp=/(\w+)(\])?(\[|\.)?/g;function wy(n,e){n.seq.push(e),n.map[e.id]=e}function xA(n,e,t){let i=n.name,s=i.length;for(Gp.lastIndex=0;;){let r=Gp.exec(i),o=Gp.lastIndex,a=r[1],l=r[2]==="]",c=r[3];if(l&&(a=a|0),c===void 0||c==="["&&o+2===s){wy(t,c===void 0?new Xp(a,n,e):new qp(a,n,e));break}else{let u=t.map[a];u===void 0&&(u=new Yp(a),wy(t,u)),t=u}}}var pa=class{constructor(e,t){this.seq=[],this.map={};let i=e.getProgramParameter(t,e.ACTIVE_UNIFORMS);for(let o=0;o<i;++o){let a=e.getActiveUniform(t,o),l=e.getUniformLocation(t,a.name);xA(a,l,this)}let s=[],r=[];for(let o of this.seq)o.type===e.SAMPLER_2D_SHADOW||o.type===e.SAMPLER_CUBE_SHADOW||o.type===e.SAMPLER_2D_ARRAY_SHADOW?s.push(o):r.push(o);s.length>0&&(this.seq=s.concat(r))}setValue(e,t,i,s){let r=this.map[t];r!==void 0&&r.setValue(e,i,s)}setOptional(e,t,i){let s=t[i];s!==void 0&&this.setValue(e,i,s)}static upload(e,t,i,s){for(let r=0,o=t.length;r!==o;++r){let a=t[r],l=i[a.id];l.needsUpdate!==!1&&a.setValue(e,l.value,s)}}static seqWithValue(e,t){let i=[];for(let s=0,r=e.length;s!==r;++s){let o=e[s];o.id in t&&i.push(o)}return i}};function Ty(n,e,t){let i=n.createShader(e);return n.shaderSource(i,t),n.compileShader(i),i}var SA=37297,bA=0;function MA(n,e){let t=n.split(`
`),i=[],s=Math.max(e-6,0),r=Math.min(e+6,t.length);for(let o=s;o<r;o++){let a=o+1;i.push(`${a===e?">":" "} ${a}: ${t[o]}`)}return i.join(`
`)}var Ey=new Qe;function wA(n){bt._getMatrix(Ey,bt.workingColorSpace,n);let e=`mat3( ${Ey.elements.map(t=>t.toFixed(4))} )`;switch(bt.getTransfer(n)){case Sl:return[e,"LinearTransferOETF"];case Ft:return[e,"sRGBTransferOETF"];default:return Je("WebGLProgram: Unsupported color space: ",n),[e,"LinearTransferOETF"]}}function Ay(n,e,t){let i=n.getShaderParameter(e,n.COMPILE_STATUS),r=(n.getShaderInfoLog(e)||"").trim();if(i&&r==="")return"";let o=/ERROR: 0:(\d+)/.exec(r);if(o){let a=parseInt(o[1]);return t.toUpperCase()+`

`+r+`

`+MA(n.getShaderSource(e),a)}else return r}function TA(n,e){let t=wA(e);return[`vec4 ${n}( vec4 value ) {`,`	return ${t[1]}( vec4( ${t[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var EA={[pp]:"Linear",[mp]:"Reinhard",[gp]:"Cineon",[vp]:"ACESFilmic",[_p]:"AgX",[xp]:"Neutral",[yp]:"Custom"};function AA(n,e){let t=EA[e];return t===void 0?(Je("WebGLProgram: Unsupported toneMapping:",e),"vec3 "+n+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+n+"( vec3 color ) { return "+t+"ToneMapping( color ); }"}var Zu=new O;function CA(){bt.getLuminanceCoefficients(Zu);let n=Zu.x.toFixed(4),e=Zu.y.toFixed(4),t=Zu.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${n}, ${e}, ${t} );`,"	return dot( weights, rgb );","}"].join(`
`)}function RA(n){return[n.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",n.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(ec).join(`
`)}function PA(n){let e=[];for(let t in n){let i=n[t];i!==!1&&e.push("#define "+t+" "+i)}return e.join(`
`)}function IA(n,e){let t={},i=n.getProgramParameter(e,n.ACTIVE_ATTRIBUTES);for(let s=0;s<i;s++){let r=n.getActiveAttrib(e,s),o=r.name,a=1;r.type===n.FLOAT_MAT2&&(a=2),r.type===n.FLOAT_MAT3&&(a=3),r.type===n.FLOAT_MAT4&&(a=4),t[o]={type:r.type,location:n.getAttribLocation(e,o),locationSize:a}}return t}function ec(n){return n!==""}function Cy(n,e){let t=e.numSpotLightShadows+e.numSpotLightMaps-e.numSpotLightShadowsWithMaps;return n.replace(/NUM_SUN_LIGHTS/g,e.numSunLights).replace(/NUM_DIR_LIGHTS/g,e.numDirLights).replace(/NUM_SPOT_LIGHTS/g,e.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,e.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,t).replace(/NUM_RECT_AREA_LIGHTS/g,e.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,e.numPointLights).replace(/NUM_HEMI_LIGHTS/g,e.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,e.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,e.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,e.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,e.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,e.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,e.numLightProbeGrids)}function Ry(n,e){return n.replace(/NUM_CLIPPING_PLANES/g,e.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,e.numClippingPlanes-e.numClipIntersection)}var DA=/^[ \t]*#include +<([\w\d./]+)>/gm;function $p(n){return n.replace(DA,LA)}function LA(n,e){let t=mt[e];if(t===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+e+">");return $p(t)}var NA=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function Py(n){return n.replace(NA,UA)}function UA(n,e,t,i){let s="";for(let r=parseInt(e);r<parseInt(t);r++)s+=i.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return s}function Iy(n){let e=`precision ${n.precision} float;
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
#define LOW_PRECISION`),e}var FA={[Xl]:"SHADOWMAP_TYPE_PCF",[ha]:"SHADOWMAP_TYPE_VSM"};function OA(n){return FA[n.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var kA={[fa]:"ENVMAP_MODE_REFRACTION"};function BA(n){return n.envMap===!1?"ENVMAP_MODE_REFLECTION":kA[n.envMapMode]||"ENVMAP_MODE_REFLECTION"}var zA={[ou]:"ENVMAP_BLENDING_MULTIPLY",[Zv]:"ENVMAP_BLENDING_MIX",[Kv]:"ENVMAP_BLENDING_ADD"};function VA(n){return n.envMap===!1?"ENVMAP_BLENDING_NONE":zA[n.combine]||"ENVMAP_BLENDING_NONE"}function HA(n,e,t,i){let s=n.getContext(),r=t.defines,o=t.vertexShader,a=t.fragmentShader,l=OA(t),c=t.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",h=BA(t),u=VA(t),f=RA(t),d=PA(r),g=s.createProgram(),_,m,p=t.glslVersion?"#version "+t.glslVersion+`
`:"";t.isRawShaderMaterial?(_=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,d].filter(ec).join(`
`),_.length>0&&(_+=`
`),m=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,d].filter(ec).join(`
`),m.length>0&&(m+=`
`)):(_=[Iy(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,d,t.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",t.batching?"#define USE_BATCHING":"",t.batchingColor?"#define USE_BATCHING_COLOR":"",t.instancing?"#define USE_INSTANCING":"",t.instancingColor?"#define USE_INSTANCING_COLOR":"",t.instancingMorph?"#define USE_INSTANCING_MORPH":"",t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.map?"#define USE_MAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+h:"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.displacementMap?"#define USE_DISPLACEMENTMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.mapUv?"#define MAP_UV "+t.mapUv:"",t.alphaMapUv?"#define ALPHAMAP_UV "+t.alphaMapUv:"",t.lightMapUv?"#define LIGHTMAP_UV "+t.lightMapUv:"",t.aoMapUv?"#define AOMAP_UV "+t.aoMapUv:"",t.emissiveMapUv?"#define EMISSIVEMAP_UV "+t.emissiveMapUv:"",t.bumpMapUv?"#define BUMPMAP_UV "+t.bumpMapUv:"",t.normalMapUv?"#define NORMALMAP_UV "+t.normalMapUv:"",t.displacementMapUv?"#define DISPLACEMENTMAP_UV "+t.displacementMapUv:"",t.metalnessMapUv?"#define METALNESSMAP_UV "+t.metalnessMapUv:"",t.roughnessMapUv?"#define ROUGHNESSMAP_UV "+t.roughnessMapUv:"",t.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+t.anisotropyMapUv:"",t.clearcoatMapUv?"#define CLEARCOATMAP_UV "+t.clearcoatMapUv:"",t.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+t.clearcoatNormalMapUv:"",t.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+t.clearcoatRoughnessMapUv:"",t.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+t.diffuseRoughnessMapUv:"",t.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+t.iridescenceMapUv:"",t.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+t.iridescenceThicknessMapUv:"",t.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+t.sheenColorMapUv:"",t.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+t.sheenRoughnessMapUv:"",t.specularMapUv?"#define SPECULARMAP_UV "+t.specularMapUv:"",t.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+t.specularColorMapUv:"",t.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+t.specularIntensityMapUv:"",t.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+t.transmissionMapUv:"",t.thicknessMapUv?"#define THICKNESSMAP_UV "+t.thicknessMapUv:"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexNormals?"#define HAS_NORMAL":"",t.vertexColors?"#define USE_COLOR":"",t.vertexAlphas?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.flatShading?"#define FLAT_SHADED":"",t.skinning?"#define USE_SKINNING":"",t.morphTargets?"#define USE_MORPHTARGETS":"",t.morphNormals&&t.flatShading===!1?"#define USE_MORPHNORMALS":"",t.morphColors?"#define USE_MORPHCOLORS":"",t.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+t.morphTextureStride:"",t.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+t.morphTargetsCount:"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+l:"",t.sizeAttenuation?"#define USE_SIZEATTENUATION":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(ec).join(`
`),m=[Iy(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,d,t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",t.map?"#define USE_MAP":"",t.matcap?"#define USE_MATCAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+c:"",t.envMap?"#define "+h:"",t.envMap?"#define "+u:"",t.envMapPMREM?"#define ENVMAP_MAX_LOD "+t.envMapMaxLod+".0":"",t.envMapPMREM?"#define ENVMAP_SIZE "+t.envMapSize+".0":"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoat?"#define USE_CLEARCOAT":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.dispersion?"#define USE_DISPERSION":"",t.retroreflection?"#define USE_RETROREFLECTION":"",t.iridescence?"#define USE_IRIDESCENCE":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaTest?"#define USE_ALPHATEST":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.sheen?"#define USE_SHEEN":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexColors||t.instancingColor?"#define USE_COLOR":"",t.vertexAlphas||t.batchingColor?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.gradientMap?"#define USE_GRADIENTMAP":"",t.flatShading?"#define FLAT_SHADED":"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+l:"",t.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",t.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",t.toneMapping!==Es?"#define TONE_MAPPING":"",t.toneMapping!==Es?mt.tonemapping_pars_fragment:"",t.toneMapping!==Es?AA("toneMapping",t.toneMapping):"",t.dithering?"#define DITHERING":"",t.opaque?"#define OPAQUE":"",mt.colorspace_pars_fragment,TA("linearToOutputTexel",t.outputColorSpace),CA(),t.useDepthPacking?"#define DEPTH_PACKING "+t.depthPacking:"",`
`].filter(ec).join(`
`)),o=$p(o),o=Cy(o,t),o=Ry(o,t),a=$p(a),a=Cy(a,t),a=Ry(a,t),o=Py(o),a=Py(a),t.isRawShaderMaterial!==!0&&(p=`#version 300 es
`,_=[f,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+_,m=["#define varying in",t.glslVersion===Lp?"":"layout(location = 0) out highp vec4 pc_fragColor;",t.glslVersion===Lp?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+m);let x=p+_+o,A=p+m+a,w=Ty(s,s.VERTEX_SHADER,x),P=Ty(s,s.FRAGMENT_SHADER,A);s.attachShader(g,w),s.attachShader(g,P),t.index0AttributeName!==void 0?s.bindAttribLocation(g,0,t.index0AttributeName):t.hasPositionAttribute===!0&&s.bindAttribLocation(g,0,"position"),s.linkProgram(g);function E(N){if(n.debug.checkShaderErrors){let I=s.getProgramInfoLog(g)||"",z=s.getShaderInfoLog(w)||"",W=s.getShaderInfoLog(P)||"",L=I.trim(),X=z.trim(),$=W.trim(),V=!0,ce=!0;if(s.getProgramParameter(g,s.LINK_STATUS)===!1)if(V=!1,typeof n.debug.onShaderError=="function")n.debug.onShaderError(s,g,w,P);else{let K=Ay(s,w,"vertex"),ee=Ay(s,P,"fragment");st("WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(g,s.VALIDATE_STATUS)+`

Material Name: `+N.name+`
Material Type: `+N.type+`

Program Info Log: `+L+`
`+K+`
`+ee)}else L!==""?Je("WebGLProgram: Program Info Log:",L):(X===""||$==="")&&(ce=!1);ce&&(N.diagnostics={runnable:V,programLog:L,vertexShader:{log:X,prefix:_},fragmentShader:{log:$,prefix:m}})}s.deleteShader(w),s.deleteShader(P),y=new pa(s,g),T=IA(s,g)}let y;this.getUniforms=function(){return y===void 0&&E(this),y};let T;this.getAttributes=function(){return T===void 0&&E(this),T};let k=t.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return k===!1&&(k=s.getProgramParameter(g,SA)),k},this.destroy=function(){i.releaseStatesOfProgram(this),s.deleteProgram(g),this.program=void 0},this.type=t.shaderType,this.name=t.shaderName,this.id=bA++,this.cacheKey=e,this.usedTimes=1,this.program=g,this.vertexShader=w,this.fragmentShader=P,this}var GA=0,Zp=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(e,t,i){let s=this._getShaderCacheForMaterial(e);return s.has(t)===!1&&(s.add(t),t.usedTimes++),s.has(i)===!1&&(s.add(i),i.usedTimes++),this}remove(e){let t=this.materialCache.get(e);for(let i of t)i.usedTimes--,i.usedTimes===0&&this.shaderCache.delete(i.code);return this.materialCache.delete(e),this}getVertexShaderStage(e){return this._getShaderStage(e.vertexShader)}getFragmentShaderStage(e){return this._getShaderStage(e.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(e){let t=this.materialCache,i=t.get(e);return i===void 0&&(i=new Set,t.set(e,i)),i}_getShaderStage(e){let t=this.shaderCache,i=t.get(e);return i===void 0&&(i=new Kp(e),t.set(e,i)),i}},Kp=class{constructor(e){this.id=GA++,this.code=e,this.usedTimes=0}};function WA(n){return n===Ir||n===Jl||n===jl}function XA(n,e,t,i,s,r){let o=new Tl,a=new Zp,l=new Set,c=[],h=new Map,u=i.logarithmicDepthBuffer,f={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function d(y){return l.add(y),y===0?"uv":`uv${y}`}function g(y,T,k,N,I,z){let W=N.fog,L=I.geometry,X=y.isMeshStandardMaterial||y.isMeshLambertMaterial||y.isMeshPhongMaterial?N.environment:null,$=y.isMeshStandardMaterial||y.isMeshLambertMaterial&&!y.envMap||y.isMeshPhongMaterial&&!y.envMap,V=e.get(y.envMap||X,$),ce=f[y.type],K=i.precision;y.precision!==null&&(K=i.getMaxPrecision(y.precision),K!==y.precision&&Je("WebGLProgram.getParameters:",y.precision,"not supported, using",K,"instead."));let ee=L.morphAttributes.position||L.morphAttributes.normal||L.morphAttributes.color,se=ee!==void 0?ee.length:0,de=0;L.morphAttributes.position!==void 0&&(de=1),L.morphAttributes.normal!==void 0&&(de=2),L.morphAttributes.color!==void 0&&(de=3);let he,te,me,ve;if(ce){let Re=Cs[ce];he=Re.vertexShader,te=Re.fragmentShader}else{he=y.vertexShader,te=y.fragmentShader;let Re=a.getVertexShaderStage(y),ft=a.getFragmentShaderStage(y);a.update(y,Re,ft),me=Re.id,ve=ft.id}let Me=n.getRenderTarget(),xe=n.state.buffers.depth.getReversed(),We=I.isInstancedMesh===!0,ot=I.isBatchedMesh===!0,He=!!y.map,ut=!!y.matcap,ht=!!V,at=ht&&V.isPMREMTexture===!0,nn=!!y.aoMap,qt=!!y.lightMap,gn=!!y.bumpMap&&y.wireframe===!1,Vt=!!y.normalMap,Nn=!!y.displacementMap,wt=!!y.emissiveMap,Tn=!!y.metalnessMap,an=!!y.roughnessMap,vn=y.anisotropy>0,F=y.clearcoat>0,Pe=y.diffuseRoughness>0,je=y.dispersion>0,ct=y.retroreflectivity>0,Te=y.iridescence>0,Gt=y.sheen>0,Ge=y.transmission>0,Ze=vn&&!!y.anisotropyMap,C=F&&!!y.clearcoatMap,S=F&&!!y.clearcoatNormalMap,Y=F&&!!y.clearcoatRoughnessMap,fe=Pe&&!!y.diffuseRoughnessMap,ae=Te&&!!y.iridescenceMap,_e=Te&&!!y.iridescenceThicknessMap,Se=Gt&&!!y.sheenColorMap,ne=Gt&&!!y.sheenRoughnessMap,re=!!y.specularMap,ge=!!y.specularColorMap,U=!!y.specularIntensityMap,oe=Ge&&!!y.transmissionMap,ie=Ge&&!!y.thicknessMap,Ee=!!y.gradientMap,ye=!!y.alphaMap,we=y.alphaTest>0,Xe=!!y.alphaHash,tt=!!y.extensions,ue=Es;y.toneMapped&&(Me===null||Me.isXRRenderTarget===!0)&&(ue=n.toneMapping);let Be=at?V.isCompressedCubeTexture?V.image[0].mipmaps:V.mipmaps:null,nt={shaderID:ce,shaderType:y.type,shaderName:y.name,vertexShader:he,fragmentShader:te,defines:y.defines,customVertexShaderID:me,customFragmentShaderID:ve,isRawShaderMaterial:y.isRawShaderMaterial===!0,glslVersion:y.glslVersion,precision:K,batching:ot,batchingColor:ot&&I._colorsTexture!==null,instancing:We,instancingColor:We&&I.instanceColor!==null,instancingMorph:We&&I.morphTexture!==null,outputColorSpace:Me===null?n.outputColorSpace:Me.isXRRenderTarget===!0?Me.texture.colorSpace:bt.workingColorSpace,alphaToCoverage:!!y.alphaToCoverage,map:He,matcap:ut,envMap:ht,envMapMode:ht&&V.mapping,envMapPMREM:at,envMapMaxLod:at?Be.length-1:null,envMapSize:at?Be[0].width:null,aoMap:nn,lightMap:qt,bumpMap:gn,normalMap:Vt,displacementMap:Nn,emissiveMap:wt,normalMapObjectSpace:Vt&&y.normalMapType===Qv,normalMapTangentSpace:Vt&&y.normalMapType===qu,packedNormalMap:Vt&&y.normalMapType===qu&&WA(y.normalMap.format),metalnessMap:Tn,roughnessMap:an,anisotropy:vn,anisotropyMap:Ze,clearcoat:F,clearcoatMap:C,clearcoatNormalMap:S,clearcoatRoughnessMap:Y,diffuseRoughness:Pe,diffuseRoughnessMap:fe,dispersion:je,retroreflection:ct,iridescence:Te,iridescenceMap:ae,iridescenceThicknessMap:_e,sheen:Gt,sheenColorMap:Se,sheenRoughnessMap:ne,specularMap:re,specularColorMap:ge,specularIntensityMap:U,transmission:Ge,transmissionMap:oe,thicknessMap:ie,gradientMap:Ee,opaque:y.transparent===!1&&y.blending===ua&&y.alphaToCoverage===!1,alphaMap:ye,alphaTest:we,alphaHash:Xe,combine:y.combine,mapUv:He&&d(y.map.channel),aoMapUv:nn&&d(y.aoMap.channel),lightMapUv:qt&&d(y.lightMap.channel),bumpMapUv:gn&&d(y.bumpMap.channel),normalMapUv:Vt&&d(y.normalMap.channel),displacementMapUv:Nn&&d(y.displacementMap.channel),emissiveMapUv:wt&&d(y.emissiveMap.channel),metalnessMapUv:Tn&&d(y.metalnessMap.channel),roughnessMapUv:an&&d(y.roughnessMap.channel),anisotropyMapUv:Ze&&d(y.anisotropyMap.channel),clearcoatMapUv:C&&d(y.clearcoatMap.channel),clearcoatNormalMapUv:S&&d(y.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:Y&&d(y.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:fe&&d(y.diffuseRoughnessMap.channel),iridescenceMapUv:ae&&d(y.iridescenceMap.channel),iridescenceThicknessMapUv:_e&&d(y.iridescenceThicknessMap.channel),sheenColorMapUv:Se&&d(y.sheenColorMap.channel),sheenRoughnessMapUv:ne&&d(y.sheenRoughnessMap.channel),specularMapUv:re&&d(y.specularMap.channel),specularColorMapUv:ge&&d(y.specularColorMap.channel),specularIntensityMapUv:U&&d(y.specularIntensityMap.channel),transmissionMapUv:oe&&d(y.transmissionMap.channel),thicknessMapUv:ie&&d(y.thicknessMap.channel),alphaMapUv:ye&&d(y.alphaMap.channel),vertexTangents:!!L.attributes.tangent&&(Vt||vn),vertexNormals:!!L.attributes.normal,vertexColors:y.vertexColors,vertexAlphas:y.vertexColors===!0&&!!L.attributes.color&&L.attributes.color.itemSize===4,pointsUvs:I.isPoints===!0&&!!L.attributes.uv&&(He||ye),fog:!!W,useFog:y.fog===!0,fogExp2:!!W&&W.isFogExp2,flatShading:y.wireframe===!1&&(y.flatShading===!0||L.attributes.normal===void 0&&Vt===!1&&(y.isMeshLambertMaterial||y.isMeshPhongMaterial||y.isMeshStandardMaterial||y.isMeshPhysicalMaterial)),sizeAttenuation:y.sizeAttenuation===!0,logarithmicDepthBuffer:u,reversedDepthBuffer:xe,skinning:I.isSkinnedMesh===!0,hasPositionAttribute:L.attributes.position!==void 0,morphTargets:L.morphAttributes.position!==void 0,morphNormals:L.morphAttributes.normal!==void 0,morphColors:L.morphAttributes.color!==void 0,morphTargetsCount:se,morphTextureStride:de,numSunLights:T.sun.length,numDirLights:T.directional.length,numPointLights:T.point.length,numSpotLights:T.spot.length,numSpotLightMaps:T.spotLightMap.length,numRectAreaLights:T.rectArea.length,numHemiLights:T.hemi.length,numSunLightShadows:T.sunShadowMap.length,numDirLightShadows:T.directionalShadowMap.length,numPointLightShadows:T.pointShadowMap.length,numSpotLightShadows:T.spotShadowMap.length,numSpotLightShadowsWithMaps:T.numSpotLightShadowsWithMaps,numLightProbes:T.numLightProbes,numLightProbeGrids:z.filter(Re=>Re.texture!==null).length,numClippingPlanes:r.numPlanes,numClipIntersection:r.numIntersection,dithering:y.dithering,shadowMapEnabled:n.shadowMap.enabled&&k.length>0,shadowMapType:n.shadowMap.type,toneMapping:ue,decodeVideoTexture:He&&y.map.isVideoTexture===!0&&bt.getTransfer(y.map.colorSpace)===Ft,decodeVideoTextureEmissive:wt&&y.emissiveMap.isVideoTexture===!0&&bt.getTransfer(y.emissiveMap.colorSpace)===Ft,premultipliedAlpha:y.premultipliedAlpha,doubleSided:y.side===ui,flipSided:y.side===hi,useDepthPacking:y.depthPacking>=0,depthPacking:y.depthPacking||0,index0AttributeName:y.index0AttributeName,extensionClipCullDistance:tt&&y.extensions.clipCullDistance===!0&&t.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(tt&&y.extensions.multiDraw===!0||ot)&&t.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:t.has("KHR_parallel_shader_compile"),customProgramCacheKey:y.customProgramCacheKey()};return nt.vertexUv1s=l.has(1),nt.vertexUv2s=l.has(2),nt.vertexUv3s=l.has(3),l.clear(),nt}function _(y){let T=[];if(y.shaderID?T.push(y.shaderID):(T.push(y.customVertexShaderID),T.push(y.customFragmentShaderID)),y.defines!==void 0)for(let k in y.defines)T.push(k),T.push(y.defines[k]);return y.isRawShaderMaterial===!1&&(m(T,y),p(T,y),T.push(n.outputColorSpace)),T.push(y.customProgramCacheKey),T.join()}function m(y,T){y.push(T.precision),y.push(T.outputColorSpace),y.push(T.envMapMode),y.push(T.envMapPMREM),y.push(T.envMapMaxLod),y.push(T.envMapSize),y.push(T.mapUv),y.push(T.alphaMapUv),y.push(T.lightMapUv),y.push(T.aoMapUv),y.push(T.bumpMapUv),y.push(T.normalMapUv),y.push(T.displacementMapUv),y.push(T.emissiveMapUv),y.push(T.metalnessMapUv),y.push(T.roughnessMapUv),y.push(T.anisotropyMapUv),y.push(T.clearcoatMapUv),y.push(T.clearcoatNormalMapUv),y.push(T.clearcoatRoughnessMapUv),y.push(T.diffuseRoughnessMapUv),y.push(T.iridescenceMapUv),y.push(T.iridescenceThicknessMapUv),y.push(T.sheenColorMapUv),y.push(T.sheenRoughnessMapUv),y.push(T.specularMapUv),y.push(T.specularColorMapUv),y.push(T.specularIntensityMapUv),y.push(T.transmissionMapUv),y.push(T.thicknessMapUv),y.push(T.combine),y.push(T.fogExp2),y.push(T.sizeAttenuation),y.push(T.morphTargetsCount),y.push(T.numSunLights),y.push(T.numDirLights),y.push(T.numPointLights),y.push(T.numSpotLights),y.push(T.numSpotLightMaps),y.push(T.numHemiLights),y.push(T.numRectAreaLights),y.push(T.numSunLightShadows),y.push(T.numDirLightShadows),y.push(T.numPointLightShadows),y.push(T.numSpotLightShadows),y.push(T.numSpotLightShadowsWithMaps),y.push(T.numLightProbes),y.push(T.numLightProbeGrids),y.push(T.shadowMapType),y.push(T.toneMapping),y.push(T.numClippingPlanes),y.push(T.numClipIntersection),y.push(T.depthPacking)}function p(y,T){o.disableAll(),T.instancing&&o.enable(0),T.instancingColor&&o.enable(1),T.instancingMorph&&o.enable(2),T.matcap&&o.enable(3),T.envMap&&o.enable(4),T.normalMapObjectSpace&&o.enable(5),T.normalMapTangentSpace&&o.enable(6),T.clearcoat&&o.enable(7),T.iridescence&&o.enable(8),T.alphaTest&&o.enable(9),T.vertexColors&&o.enable(10),T.vertexAlphas&&o.enable(11),T.vertexUv1s&&o.enable(12),T.vertexUv2s&&o.enable(13),T.vertexUv3s&&o.enable(14),T.vertexTangents&&o.enable(15),T.anisotropy&&o.enable(16),T.alphaHash&&o.enable(17),T.batching&&o.enable(18),T.dispersion&&o.enable(19),T.retroreflection&&o.enable(24),T.diffuseRoughness&&o.enable(25),T.batchingColor&&o.enable(20),T.gradientMap&&o.enable(21),T.packedNormalMap&&o.enable(22),T.vertexNormals&&o.enable(23),y.push(o.mask),o.disableAll(),T.fog&&o.enable(0),T.useFog&&o.enable(1),T.flatShading&&o.enable(2),T.logarithmicDepthBuffer&&o.enable(3),T.reversedDepthBuffer&&o.enable(4),T.skinning&&o.enable(5),T.morphTargets&&o.enable(6),T.morphNormals&&o.enable(7),T.morphColors&&o.enable(8),T.premultipliedAlpha&&o.enable(9),T.shadowMapEnabled&&o.enable(10),T.doubleSided&&o.enable(11),T.flipSided&&o.enable(12),T.useDepthPacking&&o.enable(13),T.dithering&&o.enable(14),T.transmission&&o.enable(15),T.sheen&&o.enable(16),T.opaque&&o.enable(17),T.pointsUvs&&o.enable(18),T.decodeVideoTexture&&o.enable(19),T.decodeVideoTextureEmissive&&o.enable(20),T.alphaToCoverage&&o.enable(21),T.numLightProbeGrids>0&&o.enable(22),T.hasPositionAttribute&&o.enable(23),y.push(o.mask)}function x(y){let T=f[y.type],k;if(T){let N=Cs[T];k=fy.clone(N.uniforms)}else k=y.uniforms;return k}function A(y,T){let k=h.get(T);return k!==void 0?++k.usedTimes:(k=new HA(n,T,y,s),c.push(k),h.set(T,k)),k}function w(y){if(--y.usedTimes===0){let T=c.indexOf(y);c[T]=c[c.length-1],c.pop(),h.delete(y.cacheKey),y.destroy()}}function P(y){a.remove(y)}function E(){a.dispose()}return{getParameters:g,getProgramCacheKey:_,getUniforms:x,acquireProgram:A,releaseProgram:w,releaseShaderCache:P,programs:c,dispose:E}}function qA(){let n=new WeakMap;function e(o){return n.has(o)}function t(o){let a=n.get(o);return a===void 0&&(a={},n.set(o,a)),a}function i(o){n.delete(o)}function s(o,a,l){n.get(o)[a]=l}function r(){n=new WeakMap}return{has:e,get:t,remove:i,update:s,dispose:r}}function YA(n,e){return n.groupOrder!==e.groupOrder?n.groupOrder-e.groupOrder:n.renderOrder!==e.renderOrder?n.renderOrder-e.renderOrder:n.material.id!==e.material.id?n.material.id-e.material.id:n.materialVariant!==e.materialVariant?n.materialVariant-e.materialVariant:n.z!==e.z?n.z-e.z:n.id-e.id}function Dy(n,e){return n.groupOrder!==e.groupOrder?n.groupOrder-e.groupOrder:n.renderOrder!==e.renderOrder?n.renderOrder-e.renderOrder:n.z!==e.z?e.z-n.z:n.id-e.id}function Ly(){let n=[],e=0,t=[],i=[],s=[];function r(){e=0,t.length=0,i.length=0,s.length=0}function o(f){let d=0;return f.isInstancedMesh&&(d+=2),f.isSkinnedMesh&&(d+=1),d}function a(f,d,g,_,m,p){let x=n[e];return x===void 0?(x={id:f.id,object:f,geometry:d,material:g,materialVariant:o(f),groupOrder:_,renderOrder:f.renderOrder,z:m,group:p},n[e]=x):(x.id=f.id,x.object=f,x.geometry=d,x.material=g,x.materialVariant=o(f),x.groupOrder=_,x.renderOrder=f.renderOrder,x.z=m,x.group=p),e++,x}function l(f,d,g,_,m,p,x){x.reversedDepth===!0&&(m=-m);let A=a(f,d,g,_,m,p);g.transmission>0?i.push(A):g.transparent===!0?s.push(A):t.push(A)}function c(f,d,g,_,m,p){let x=a(f,d,g,_,m,p);g.transmission>0?i.unshift(x):g.transparent===!0?s.unshift(x):t.unshift(x)}function h(f,d){t.length>1&&t.sort(f||YA),i.length>1&&i.sort(d||Dy),s.length>1&&s.sort(d||Dy)}function u(){for(let f=e,d=n.length;f<d;f++){let g=n[f];if(g.id===null)break;g.id=null,g.object=null,g.geometry=null,g.material=null,g.group=null}}return{opaque:t,transmissive:i,transparent:s,init:r,push:l,unshift:c,finish:u,sort:h}}function $A(){let n=new WeakMap;function e(i,s){let r=n.get(i),o;return r===void 0?(o=new Ly,n.set(i,[o])):s>=r.length?(o=new Ly,r.push(o)):o=r[s],o}function t(){n=new WeakMap}return{get:e,dispose:t}}function ZA(){let n={};return{get:function(e){if(n[e.id]!==void 0)return n[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={direction:new O,color:new Ke};break;case"SpotLight":t={position:new O,direction:new O,color:new Ke,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":t={position:new O,color:new Ke,distance:0,decay:0};break;case"HemisphereLight":t={direction:new O,skyColor:new Ke,groundColor:new Ke};break;case"RectAreaLight":t={color:new Ke,position:new O,halfWidth:new O,halfHeight:new O};break}return n[e.id]=t,t}}}function KA(){let n={};return{get:function(e){if(n[e.id]!==void 0)return n[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new $e};break;case"SpotLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new $e};break;case"PointLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new $e,shadowCameraNear:1,shadowCameraFar:1e3};break}return n[e.id]=t,t}}}var JA=0;function jA(n,e){return(e.castShadow?2:0)-(n.castShadow?2:0)+(e.map?1:0)-(n.map?1:0)}function QA(n){let e=new ZA,t=KA(),i={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let c=0;c<9;c++)i.probe.push(new O);let s=new O,r=new Dt,o=new Dt;function a(c){let h=0,u=0,f=0;for(let z=0;z<9;z++)i.probe[z].set(0,0,0);let d=0,g=0,_=0,m=0,p=0,x=0,A=0,w=0,P=0,E=0,y=0,T=0,k=0,N=0;c.sort(jA);for(let z=0,W=c.length;z<W;z++){let L=c[z],X=L.color,$=L.intensity,V=L.distance,ce=null;if(L.shadow&&L.shadow.map&&(L.shadow.map.texture.format===Ir?ce=L.shadow.map.texture:ce=L.shadow.map.depthTexture||L.shadow.map.texture),L.isAmbientLight)h+=X.r*$,u+=X.g*$,f+=X.b*$;else if(L.isLightProbe){for(let K=0;K<9;K++)i.probe[K].addScaledVector(L.sh.coefficients[K],$);N++}else if(L.isSunLight){let K=e.get(L);if(K.color.copy(L.color).multiplyScalar(L.intensity),L.castShadow){let ee=L.shadow,se=t.get(L);se.shadowIntensity=ee.intensity,se.shadowBias=ee.bias,se.shadowNormalBias=ee.normalBias,se.shadowRadius=ee.radius,se.shadowMapSize.copy(ee.mapSize).multiply(ee.getFrameExtents()),i.sunShadow[g]=se,i.sunShadowMap[g]=ce;let de=ee.getViewportCount();for(let he=0;he<de;he++)i.sunShadowMatrix[_+he]=ee.getMatrix(he),i.sunShadowCascade[_+he]=ee._cascadeData[he];_+=de,g++}i.sun[d]=K,d++}else if(L.isDirectionalLight){let K=e.get(L);if(K.color.copy(L.color).multiplyScalar(L.intensity),L.castShadow){let ee=L.shadow,se=t.get(L);se.shadowIntensity=ee.intensity,se.shadowBias=ee.bias,se.shadowNormalBias=ee.normalBias,se.shadowRadius=ee.radius,se.shadowMapSize=ee.mapSize,i.directionalShadow[m]=se,i.directionalShadowMap[m]=ce,i.directionalShadowMatrix[m]=L.shadow.matrix,P++}i.directional[m]=K,m++}else if(L.isSpotLight){let K=e.get(L);K.position.setFromMatrixPosition(L.matrixWorld),K.color.copy(X).multiplyScalar($),K.distance=V,K.coneCos=Math.cos(L.angle),K.penumbraCos=Math.cos(L.angle*(1-L.penumbra)),K.decay=L.decay,i.spot[x]=K;let ee=L.shadow;if(L.map&&(i.spotLightMap[T]=L.map,T++,ee.updateMatrices(L),L.castShadow&&k++),i.spotLightMatrix[x]=ee.matrix,L.castShadow){let se=t.get(L);se.shadowIntensity=ee.intensity,se.shadowBias=ee.bias,se.shadowNormalBias=ee.normalBias,se.shadowRadius=ee.radius,se.shadowMapSize=ee.mapSize,i.spotShadow[x]=se,i.spotShadowMap[x]=ce,y++}x++}else if(L.isRectAreaLight){let K=e.get(L);K.color.copy(X).multiplyScalar($),K.halfWidth.set(L.width*.5,0,0),K.halfHeight.set(0,L.height*.5,0),i.rectArea[A]=K,A++}else if(L.isPointLight){let K=e.get(L);if(K.color.copy(L.color).multiplyScalar(L.intensity),K.distance=L.distance,K.decay=L.decay,L.castShadow){let ee=L.shadow,se=t.get(L);se.shadowIntensity=ee.intensity,se.shadowBias=ee.bias,se.shadowNormalBias=ee.normalBias,se.shadowRadius=ee.radius,se.shadowMapSize=ee.mapSize,se.shadowCameraNear=ee.camera.near,se.shadowCameraFar=ee.camera.far,i.pointShadow[p]=se,i.pointShadowMap[p]=ce,i.pointShadowMatrix[p]=L.shadow.matrix,E++}i.point[p]=K,p++}else if(L.isHemisphereLight){let K=e.get(L);K.skyColor.copy(L.color).multiplyScalar($),K.groundColor.copy(L.groundColor).multiplyScalar($),i.hemi[w]=K,w++}}A>0&&(n.has("OES_texture_float_linear")===!0?(i.rectAreaLTC1=Le.LTC_FLOAT_1,i.rectAreaLTC2=Le.LTC_FLOAT_2):(i.rectAreaLTC1=Le.LTC_HALF_1,i.rectAreaLTC2=Le.LTC_HALF_2)),i.ambient[0]=h,i.ambient[1]=u,i.ambient[2]=f;let I=i.hash;(I.sunLength!==d||I.directionalLength!==m||I.pointLength!==p||I.spotLength!==x||I.rectAreaLength!==A||I.hemiLength!==w||I.numSunShadows!==g||I.numDirectionalShadows!==P||I.numPointShadows!==E||I.numSpotShadows!==y||I.numSpotMaps!==T||I.numLightProbes!==N)&&(i.sun.length=d,i.directional.length=m,i.spot.length=x,i.rectArea.length=A,i.point.length=p,i.hemi.length=w,i.sunShadow.length=g,i.sunShadowMap.length=g,i.sunShadowMatrix.length=_,i.sunShadowCascade.length=_,i.directionalShadow.length=P,i.directionalShadowMap.length=P,i.directionalShadowMatrix.length=P,i.pointShadow.length=E,i.pointShadowMap.length=E,i.pointShadowMatrix.length=E,i.spotShadow.length=y,i.spotShadowMap.length=y,i.spotLightMatrix.length=y+T-k,i.spotLightMap.length=T,i.numSpotLightShadowsWithMaps=k,i.numLightProbes=N,I.sunLength=d,I.directionalLength=m,I.pointLength=p,I.spotLength=x,I.rectAreaLength=A,I.hemiLength=w,I.numSunShadows=g,I.numDirectionalShadows=P,I.numPointShadows=E,I.numSpotShadows=y,I.numSpotMaps=T,I.numLightProbes=N,i.version=JA++)}function l(c,h){let u=0,f=0,d=0,g=0,_=0,m=0,p=h.matrixWorldInverse;for(let x=0,A=c.length;x<A;x++){let w=c[x];if(w.isSunLight){let P=i.sun[u];P.direction.setFromMatrixPosition(w.matrixWorld),P.direction.transformDirection(p),u++}else if(w.isDirectionalLight){let P=i.directional[f];P.direction.setFromMatrixPosition(w.matrixWorld),s.setFromMatrixPosition(w.target.matrixWorld),P.direction.sub(s),P.direction.transformDirection(p),f++}else if(w.isSpotLight){let P=i.spot[g];P.position.setFromMatrixPosition(w.matrixWorld),P.position.applyMatrix4(p),P.direction.setFromMatrixPosition(w.matrixWorld),s.setFromMatrixPosition(w.target.matrixWorld),P.direction.sub(s),P.direction.transformDirection(p),g++}else if(w.isRectAreaLight){let P=i.rectArea[_];P.position.setFromMatrixPosition(w.matrixWorld),P.position.applyMatrix4(p),o.identity(),r.copy(w.matrixWorld),r.premultiply(p),o.extractRotation(r),P.halfWidth.set(w.width*.5,0,0),P.halfHeight.set(0,w.height*.5,0),P.halfWidth.applyMatrix4(o),P.halfHeight.applyMatrix4(o),_++}else if(w.isPointLight){let P=i.point[d];P.position.setFromMatrixPosition(w.matrixWorld),P.position.applyMatrix4(p),d++}else if(w.isHemisphereLight){let P=i.hemi[m];P.direction.setFromMatrixPosition(w.matrixWorld),P.direction.transformDirection(p),m++}}}return{setup:a,setupView:l,state:i}}function Ny(n){let e=new QA(n),t=[],i=[],s=[];function r(u){h.camera=u,t.length=0,i.length=0,s.length=0}function o(u){u.isLightProbeGrid?s.push(u):t.push(u)}function a(u){i.push(u)}function l(){e.setup(t),s.sort((u,f)=>u.priority-f.priority||u.id-f.id)}function c(u){e.setupView(t,u)}let h={lightsArray:t,shadowsArray:i,lightProbeGridArray:s,camera:null,lights:e,transmissionRenderTarget:{},textureUnits:0};return{init:r,state:h,setupLights:l,setupLightsView:c,pushLight:o,pushShadow:a}}function eC(n){let e=new WeakMap;function t(s,r=0){let o=e.get(s),a;return o===void 0?(a=new Ny(n),e.set(s,[a])):r>=o.length?(a=new Ny(n),o.push(a)):a=o[r],a}function i(){e=new WeakMap}return{get:t,dispose:i}}var tC=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,nC=`uniform sampler2D shadow_pass;
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
}`,iC=[new O(1,0,0),new O(-1,0,0),new O(0,1,0),new O(0,-1,0),new O(0,0,1),new O(0,0,-1)],sC=[new O(0,-1,0),new O(0,-1,0),new O(0,0,1),new O(0,0,-1),new O(0,-1,0),new O(0,-1,0)],Uy=new Dt,Ql=new O,Wp=new O;function rC(n,e,t){let i=new br,s=new $e,r=new $e,o=new rn,a=new qh,l=new Yh,c={},h=t.maxTextureSize,u={[Pr]:hi,[hi]:Pr,[ui]:ui},f=new Ts({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new $e},radius:{value:4}},vertexShader:tC,fragmentShader:nC}),d=f.clone();d.defines.HORIZONTAL_PASS=1;let g=new $t;g.setAttribute("position",new fn(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let _=new Gn(g,f),m=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=Xl;let p=this.type;this.render=function(E,y,T){if(m.enabled===!1||m.autoUpdate===!1&&m.needsUpdate===!1||E.length===0)return;this.type===Pv&&(Je("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=Xl);let k=n.getRenderTarget(),N=n.getActiveCubeFace(),I=n.getActiveMipmapLevel(),z=n.state;z.setBlending(eo),z.buffers.depth.getReversed()===!0?z.buffers.color.setClear(0,0,0,0):z.buffers.color.setClear(1,1,1,1),z.buffers.depth.setTest(!0),z.setScissorTest(!1);let W=p!==this.type;W&&y.traverse(function(L){L.material&&(Array.isArray(L.material)?L.material.forEach(X=>X.needsUpdate=!0):L.material.needsUpdate=!0)});for(let L=0,X=E.length;L<X;L++){let $=E[L],V=$.shadow;if(V===void 0){Je("WebGLShadowMap:",$,"has no shadow.");continue}if(V.autoUpdate===!1&&V.needsUpdate===!1)continue;s.copy(V.mapSize);let ce=V.getFrameExtents();s.multiply(ce),r.copy(V.mapSize),(s.x>h||s.y>h)&&(s.x>h&&(r.x=Math.floor(h/ce.x),s.x=r.x*ce.x,V.mapSize.x=r.x),s.y>h&&(r.y=Math.floor(h/ce.y),s.y=r.y*ce.y,V.mapSize.y=r.y));let K=n.state.buffers.depth.getReversed();if(V.camera._reversedDepth=K,V.map===null||W===!0){if(V.map!==null&&(V.map.depthTexture!==null&&(V.map.depthTexture.dispose(),V.map.depthTexture=null),V.map.dispose()),this.type===ha){if($.isPointLight){Je("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}V.map=new Ri(s.x,s.y,{format:Ir,type:is,minFilter:ai,magFilter:ai,generateMipmaps:!1}),V.map.texture.name=$.name+".shadowMap",V.map.depthTexture=new Qs(s.x,s.y,ns),V.map.depthTexture.name=$.name+".shadowMapDepth",V.map.depthTexture.format=Zs,V.map.depthTexture.compareFunction=null,V.map.depthTexture.minFilter=Hn,V.map.depthTexture.magFilter=Hn}else $.isPointLight?(V.map=new tc(s.x),V.map.depthTexture=new Dl(s.x,ts)):(V.map=new Ri(s.x,s.y),V.map.depthTexture=new Qs(s.x,s.y,ts)),V.map.depthTexture.name=$.name+".shadowMap",V.map.depthTexture.format=Zs,this.type===Xl?(V.map.depthTexture.compareFunction=K?Pp:Rp,V.map.depthTexture.minFilter=ai,V.map.depthTexture.magFilter=ai):(V.map.depthTexture.compareFunction=null,V.map.depthTexture.minFilter=Hn,V.map.depthTexture.magFilter=Hn);V.camera.updateProjectionMatrix()}V.map.isWebGLCubeRenderTarget!==!0&&(V.map.width!==s.x||V.map.height!==s.y)&&V.map.setSize(s.x,s.y);let ee=V.map.isWebGLCubeRenderTarget?6:V.getViewportCount();$.isPointLight!==!0&&V.updateMatrices($,T);let se=(V.camera.layers.mask&4294967294)!==0?V.camera.layers:T.layers;for(let de=0;de<ee;de++){let he=V.getCamera(de);if($.isPointLight){let te=V.camera,me=V.matrix,ve=$.distance||te.far;ve!==te.far&&(te.far=ve,te.updateProjectionMatrix()),Ql.setFromMatrixPosition($.matrixWorld),te.position.copy(Ql),Wp.copy(te.position),Wp.add(iC[de]),te.up.copy(sC[de]),te.lookAt(Wp),te.updateMatrixWorld(),me.makeTranslation(-Ql.x,-Ql.y,-Ql.z),Uy.multiplyMatrices(te.projectionMatrix,te.matrixWorldInverse),V._frustum.setFromProjectionMatrix(Uy,te.coordinateSystem,te.reversedDepth)}if(V.map.isWebGLCubeRenderTarget)n.setRenderTarget(V.map,de),n.clear();else{de===0&&(n.setRenderTarget(V.map),n.clear());let te=V.getViewport(de);o.set(r.x*te.x,r.y*te.y,r.x*te.z,r.y*te.w),z.viewport(o)}i=V.getFrustum(de),w(y,T,he,$,se,this.type)}V.isPointLightShadow!==!0&&this.type===ha&&x(V,T),V.needsUpdate=!1}p=this.type,m.needsUpdate=!1,n.setRenderTarget(k,N,I)};function x(E,y){let T=e.update(_);f.defines.VSM_SAMPLES!==E.blurSamples&&(f.defines.VSM_SAMPLES=E.blurSamples,d.defines.VSM_SAMPLES=E.blurSamples,f.needsUpdate=!0,d.needsUpdate=!0),E.mapPass===null?E.mapPass=new Ri(s.x,s.y,{format:Ir,type:is}):(E.mapPass.width!==E.map.width||E.mapPass.height!==E.map.height)&&E.mapPass.setSize(E.map.width,E.map.height),f.uniforms.shadow_pass.value=E.map.depthTexture,f.uniforms.resolution.value.set(E.map.width,E.map.height),f.uniforms.radius.value=E.radius,n.setRenderTarget(E.mapPass),n.clear(),n.renderBufferDirect(y,null,T,f,_,null),d.uniforms.shadow_pass.value=E.mapPass.texture,d.uniforms.resolution.value.set(E.map.width,E.map.height),d.uniforms.radius.value=E.radius,n.setRenderTarget(E.map),n.clear(),n.renderBufferDirect(y,null,T,d,_,null)}function A(E,y,T,k){let N=null,I=T.isPointLight===!0?E.customDistanceMaterial:E.customDepthMaterial;if(I!==void 0)N=I;else if(N=T.isPointLight===!0?l:a,n.localClippingEnabled&&y.clipShadows===!0&&Array.isArray(y.clippingPlanes)&&y.clippingPlanes.length!==0||y.displacementMap&&y.displacementScale!==0||y.alphaMap&&y.alphaTest>0||y.map&&y.alphaTest>0||y.alphaToCoverage===!0){let z=N.uuid,W=y.uuid,L=c[z];L===void 0&&(L={},c[z]=L);let X=L[W];X===void 0&&(X=N.clone(),L[W]=X,y.addEventListener("dispose",P)),N=X}if(N.visible=y.visible,N.wireframe=y.wireframe,k===ha?N.side=y.shadowSide!==null?y.shadowSide:y.side:N.side=y.shadowSide!==null?y.shadowSide:u[y.side],N.alphaMap=y.alphaMap,N.alphaTest=y.alphaToCoverage===!0?.5:y.alphaTest,N.map=y.map,N.clipShadows=y.clipShadows,N.clippingPlanes=y.clippingPlanes,N.clipIntersection=y.clipIntersection,N.displacementMap=y.displacementMap,N.displacementScale=y.displacementScale,N.displacementBias=y.displacementBias,N.wireframeLinewidth=y.wireframeLinewidth,N.linewidth=y.linewidth,T.isPointLight===!0&&N.isMeshDistanceMaterial===!0){let z=n.properties.get(N);z.light=T}return N}function w(E,y,T,k,N,I){if(E.visible===!1)return;if(E.layers.test(N)&&(E.isMesh||E.isLine||E.isPoints)&&(E.castShadow||E.receiveShadow&&I===ha)&&(!E.frustumCulled||E.intersectsFrustum(i))){E.modelViewMatrix.multiplyMatrices(T.matrixWorldInverse,E.matrixWorld);let L=e.update(E),X=E.material;if(Array.isArray(X)){let $=L.groups;for(let V=0,ce=$.length;V<ce;V++){let K=$[V],ee=X[K.materialIndex];if(ee&&ee.visible){let se=A(E,ee,k,I);E.onBeforeShadow(n,E,y,T,L,se,K),n.renderBufferDirect(T,null,L,se,E,K),E.onAfterShadow(n,E,y,T,L,se,K)}}}else if(X.visible){let $=A(E,X,k,I);E.onBeforeShadow(n,E,y,T,L,$,null),n.renderBufferDirect(T,null,L,$,E,null),E.onAfterShadow(n,E,y,T,L,$,null)}}let W=E.children;for(let L=0,X=W.length;L<X;L++)w(W[L],y,T,k,N,I)}function P(E){E.target.removeEventListener("dispose",P);for(let T in c){let k=c[T],N=E.target.uuid;N in k&&(k[N].dispose(),delete k[N])}}}function oC(n,e){function t(){let U=!1,oe=new rn,ie=null,Ee=new rn(0,0,0,0);return{setMask:function(ye){ie!==ye&&!U&&(n.colorMask(ye,ye,ye,ye),ie=ye)},setLocked:function(ye){U=ye},setClear:function(ye,we,Xe,tt,ue){ue===!0&&(ye*=tt,we*=tt,Xe*=tt),oe.set(ye,we,Xe,tt),Ee.equals(oe)===!1&&(n.clearColor(ye,we,Xe,tt),Ee.copy(oe))},reset:function(){U=!1,ie=null,Ee.set(-1,0,0,0)}}}function i(){let U=!1,oe=!1,ie=null,Ee=null,ye=null;return{setReversed:function(we){if(oe!==we){let Xe=e.get("EXT_clip_control");we?Xe.clipControlEXT(Xe.LOWER_LEFT_EXT,Xe.ZERO_TO_ONE_EXT):Xe.clipControlEXT(Xe.LOWER_LEFT_EXT,Xe.NEGATIVE_ONE_TO_ONE_EXT),oe=we;let tt=ye;ye=null,this.setClear(tt)}},getReversed:function(){return oe},setTest:function(we){we?xe(n.DEPTH_TEST):We(n.DEPTH_TEST)},setMask:function(we){ie!==we&&!U&&(n.depthMask(we),ie=we)},setFunc:function(we){if(oe&&(we=cy[we]),Ee!==we){switch(we){case Ah:n.depthFunc(n.NEVER);break;case Ch:n.depthFunc(n.ALWAYS);break;case Rh:n.depthFunc(n.LESS);break;case Qo:n.depthFunc(n.LEQUAL);break;case Ph:n.depthFunc(n.EQUAL);break;case Ih:n.depthFunc(n.GEQUAL);break;case Dh:n.depthFunc(n.GREATER);break;case Lh:n.depthFunc(n.NOTEQUAL);break;default:n.depthFunc(n.LEQUAL)}Ee=we}},setLocked:function(we){U=we},setClear:function(we){ye!==we&&(ye=we,oe&&(we=1-we),n.clearDepth(we))},reset:function(){U=!1,ie=null,Ee=null,ye=null,oe=!1}}}function s(){let U=!1,oe=null,ie=null,Ee=null,ye=null,we=null,Xe=null,tt=null,ue=null;return{setTest:function(Be){U||(Be?xe(n.STENCIL_TEST):We(n.STENCIL_TEST))},setMask:function(Be){oe!==Be&&!U&&(n.stencilMask(Be),oe=Be)},setFunc:function(Be,nt,Re){(ie!==Be||Ee!==nt||ye!==Re)&&(n.stencilFunc(Be,nt,Re),ie=Be,Ee=nt,ye=Re)},setOp:function(Be,nt,Re){(we!==Be||Xe!==nt||tt!==Re)&&(n.stencilOp(Be,nt,Re),we=Be,Xe=nt,tt=Re)},setLocked:function(Be){U=Be},setClear:function(Be){ue!==Be&&(n.clearStencil(Be),ue=Be)},reset:function(){U=!1,oe=null,ie=null,Ee=null,ye=null,we=null,Xe=null,tt=null,ue=null}}}let r=new t,o=new i,a=new s,l={},c=new WeakMap,h={},u={},f={},d=new WeakMap,g=[],_=null,m=!1,p=null,x=null,A=null,w=null,P=null,E=null,y=null,T=new Ke(0,0,0),k=0,N=!1,I=null,z=null,W=null,L=null,X=null,$=n.getParameter(n.MAX_COMBINED_TEXTURE_IMAGE_UNITS),V=!1,ce=0,K=n.getParameter(n.VERSION);K.indexOf("WebGL")!==-1?(ce=parseFloat(/^WebGL (\d)/.exec(K)[1]),V=ce>=1):K.indexOf("OpenGL ES")!==-1&&(ce=parseFloat(/^OpenGL ES (\d)/.exec(K)[1]),V=ce>=2);let ee=null,se={},de=n.getParameter(n.SCISSOR_BOX),he=n.getParameter(n.VIEWPORT),te=new rn().fromArray(de),me=new rn().fromArray(he);function ve(U,oe,ie,Ee){let ye=new Uint8Array(4),we=n.createTexture();n.bindTexture(U,we),n.texParameteri(U,n.TEXTURE_MIN_FILTER,n.NEAREST),n.texParameteri(U,n.TEXTURE_MAG_FILTER,n.NEAREST);for(let Xe=0;Xe<ie;Xe++)U===n.TEXTURE_3D||U===n.TEXTURE_2D_ARRAY?n.texImage3D(oe,0,n.RGBA,1,1,Ee,0,n.RGBA,n.UNSIGNED_BYTE,ye):n.texImage2D(oe+Xe,0,n.RGBA,1,1,0,n.RGBA,n.UNSIGNED_BYTE,ye);return we}let Me={};Me[n.TEXTURE_2D]=ve(n.TEXTURE_2D,n.TEXTURE_2D,1),Me[n.TEXTURE_CUBE_MAP]=ve(n.TEXTURE_CUBE_MAP,n.TEXTURE_CUBE_MAP_POSITIVE_X,6),Me[n.TEXTURE_2D_ARRAY]=ve(n.TEXTURE_2D_ARRAY,n.TEXTURE_2D_ARRAY,1,1),Me[n.TEXTURE_3D]=ve(n.TEXTURE_3D,n.TEXTURE_3D,1,1),r.setClear(0,0,0,1),o.setClear(1),a.setClear(0),xe(n.DEPTH_TEST),o.setFunc(Qo),gn(!1),Vt(lp),xe(n.CULL_FACE),nn(eo);function xe(U){h[U]!==!0&&(n.enable(U),h[U]=!0)}function We(U){h[U]!==!1&&(n.disable(U),h[U]=!1)}function ot(U,oe){return f[U]!==oe?(n.bindFramebuffer(U,oe),f[U]=oe,U===n.DRAW_FRAMEBUFFER&&(f[n.FRAMEBUFFER]=oe),U===n.FRAMEBUFFER&&(f[n.DRAW_FRAMEBUFFER]=oe),!0):!1}function He(U,oe){let ie=g,Ee=!1;if(U){ie=d.get(oe),ie===void 0&&(ie=[],d.set(oe,ie));let ye=U.textures;if(ie.length!==ye.length||ie[0]!==n.COLOR_ATTACHMENT0){for(let we=0,Xe=ye.length;we<Xe;we++)ie[we]=n.COLOR_ATTACHMENT0+we;ie.length=ye.length,Ee=!0}}else ie[0]!==n.BACK&&(ie[0]=n.BACK,Ee=!0);Ee&&n.drawBuffers(ie)}function ut(U){return _!==U?(n.useProgram(U),_=U,!0):!1}let ht={[to]:n.FUNC_ADD,[Dv]:n.FUNC_SUBTRACT,[Lv]:n.FUNC_REVERSE_SUBTRACT};ht[Nv]=n.MIN,ht[Uv]=n.MAX;let at={[Fv]:n.ZERO,[Ov]:n.ONE,[kv]:n.SRC_COLOR,[fp]:n.SRC_ALPHA,[Wv]:n.SRC_ALPHA_SATURATE,[Hv]:n.DST_COLOR,[zv]:n.DST_ALPHA,[Bv]:n.ONE_MINUS_SRC_COLOR,[dp]:n.ONE_MINUS_SRC_ALPHA,[Gv]:n.ONE_MINUS_DST_COLOR,[Vv]:n.ONE_MINUS_DST_ALPHA,[Xv]:n.CONSTANT_COLOR,[qv]:n.ONE_MINUS_CONSTANT_COLOR,[Yv]:n.CONSTANT_ALPHA,[$v]:n.ONE_MINUS_CONSTANT_ALPHA};function nn(U,oe,ie,Ee,ye,we,Xe,tt,ue,Be){if(U===eo){m===!0&&(We(n.BLEND),m=!1);return}if(m===!1&&(xe(n.BLEND),m=!0),U!==Iv){if(U!==p||Be!==N){if((x!==to||P!==to)&&(n.blendEquation(n.FUNC_ADD),x=to,P=to),Be)switch(U){case ua:n.blendFuncSeparate(n.ONE,n.ONE_MINUS_SRC_ALPHA,n.ONE,n.ONE_MINUS_SRC_ALPHA);break;case cp:n.blendFunc(n.ONE,n.ONE);break;case hp:n.blendFuncSeparate(n.ZERO,n.ONE_MINUS_SRC_COLOR,n.ZERO,n.ONE);break;case up:n.blendFuncSeparate(n.DST_COLOR,n.ONE_MINUS_SRC_ALPHA,n.ZERO,n.ONE);break;default:st("WebGLState: Invalid blending: ",U);break}else switch(U){case ua:n.blendFuncSeparate(n.SRC_ALPHA,n.ONE_MINUS_SRC_ALPHA,n.ONE,n.ONE_MINUS_SRC_ALPHA);break;case cp:n.blendFuncSeparate(n.SRC_ALPHA,n.ONE,n.ONE,n.ONE);break;case hp:st("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case up:st("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:st("WebGLState: Invalid blending: ",U);break}A=null,w=null,E=null,y=null,T.set(0,0,0),k=0,p=U,N=Be}return}ye=ye||oe,we=we||ie,Xe=Xe||Ee,(oe!==x||ye!==P)&&(n.blendEquationSeparate(ht[oe],ht[ye]),x=oe,P=ye),(ie!==A||Ee!==w||we!==E||Xe!==y)&&(n.blendFuncSeparate(at[ie],at[Ee],at[we],at[Xe]),A=ie,w=Ee,E=we,y=Xe),(tt.equals(T)===!1||ue!==k)&&(n.blendColor(tt.r,tt.g,tt.b,ue),T.copy(tt),k=ue),p=U,N=!1}function qt(U,oe){U.side===ui?We(n.CULL_FACE):xe(n.CULL_FACE);let ie=U.side===hi;oe&&(ie=!ie),gn(ie),U.blending===ua&&U.transparent===!1?nn(eo):nn(U.blending,U.blendEquation,U.blendSrc,U.blendDst,U.blendEquationAlpha,U.blendSrcAlpha,U.blendDstAlpha,U.blendColor,U.blendAlpha,U.premultipliedAlpha),o.setFunc(U.depthFunc),o.setTest(U.depthTest),o.setMask(U.depthWrite),r.setMask(U.colorWrite);let Ee=U.stencilWrite;a.setTest(Ee),Ee&&(a.setMask(U.stencilWriteMask),a.setFunc(U.stencilFunc,U.stencilRef,U.stencilFuncMask),a.setOp(U.stencilFail,U.stencilZFail,U.stencilZPass)),wt(U.polygonOffset,U.polygonOffsetFactor,U.polygonOffsetUnits),U.alphaToCoverage===!0?xe(n.SAMPLE_ALPHA_TO_COVERAGE):We(n.SAMPLE_ALPHA_TO_COVERAGE)}function gn(U){I!==U&&(U?n.frontFace(n.CW):n.frontFace(n.CCW),I=U)}function Vt(U){U!==Cv?(xe(n.CULL_FACE),U!==z&&(U===lp?n.cullFace(n.BACK):U===Rv?n.cullFace(n.FRONT):n.cullFace(n.FRONT_AND_BACK))):We(n.CULL_FACE),z=U}function Nn(U){U!==W&&(V&&n.lineWidth(U),W=U)}function wt(U,oe,ie){U?(xe(n.POLYGON_OFFSET_FILL),(L!==oe||X!==ie)&&(L=oe,X=ie,o.getReversed()&&(oe=-oe,ie=-ie),n.polygonOffset(oe,ie))):We(n.POLYGON_OFFSET_FILL)}function Tn(U){U?xe(n.SCISSOR_TEST):We(n.SCISSOR_TEST)}function an(U){U===void 0&&(U=n.TEXTURE0+$-1),ee!==U&&(n.activeTexture(U),ee=U)}function vn(U,oe,ie){ie===void 0&&(ee===null?ie=n.TEXTURE0+$-1:ie=ee);let Ee=se[ie];Ee===void 0&&(Ee={type:void 0,texture:void 0},se[ie]=Ee),(Ee.type!==U||Ee.texture!==oe)&&(ee!==ie&&(n.activeTexture(ie),ee=ie),n.bindTexture(U,oe||Me[U]),Ee.type=U,Ee.texture=oe)}function F(){let U=se[ee];U!==void 0&&U.type!==void 0&&(n.bindTexture(U.type,null),U.type=void 0,U.texture=void 0)}function Pe(){try{n.compressedTexImage2D(...arguments)}catch(U){st("WebGLState:",U)}}function je(){try{n.compressedTexImage3D(...arguments)}catch(U){st("WebGLState:",U)}}function ct(){try{n.texSubImage2D(...arguments)}catch(U){st("WebGLState:",U)}}function Te(){try{n.texSubImage3D(...arguments)}catch(U){st("WebGLState:",U)}}function Gt(){try{n.compressedTexSubImage2D(...arguments)}catch(U){st("WebGLState:",U)}}function Ge(){try{n.compressedTexSubImage3D(...arguments)}catch(U){st("WebGLState:",U)}}function Ze(){try{n.texStorage2D(...arguments)}catch(U){st("WebGLState:",U)}}function C(){try{n.texStorage3D(...arguments)}catch(U){st("WebGLState:",U)}}function S(){try{n.texImage2D(...arguments)}catch(U){st("WebGLState:",U)}}function Y(){try{n.texImage3D(...arguments)}catch(U){st("WebGLState:",U)}}function fe(U){return u[U]!==void 0?u[U]:n.getParameter(U)}function ae(U,oe){u[U]!==oe&&(n.pixelStorei(U,oe),u[U]=oe)}function _e(U){te.equals(U)===!1&&(n.scissor(U.x,U.y,U.z,U.w),te.copy(U))}function Se(U){me.equals(U)===!1&&(n.viewport(U.x,U.y,U.z,U.w),me.copy(U))}function ne(U,oe){let ie=c.get(oe);ie===void 0&&(ie=new WeakMap,c.set(oe,ie));let Ee=ie.get(U);Ee===void 0&&(Ee=n.getUniformBlockIndex(oe,U.name),n.uniformBlockBinding(oe,Ee,Ee),ie.set(U,Ee))}function re(U,oe,ie){let ye=c.get(oe).get(U);l[ye]!==ie&&(n.bindBufferBase(n.UNIFORM_BUFFER,ye,ie),l[ye]=ie)}function ge(){n.disable(n.BLEND),n.disable(n.CULL_FACE),n.disable(n.DEPTH_TEST),n.disable(n.POLYGON_OFFSET_FILL),n.disable(n.SCISSOR_TEST),n.disable(n.STENCIL_TEST),n.disable(n.SAMPLE_ALPHA_TO_COVERAGE),n.blendEquation(n.FUNC_ADD),n.blendFunc(n.ONE,n.ZERO),n.blendFuncSeparate(n.ONE,n.ZERO,n.ONE,n.ZERO),n.blendColor(0,0,0,0),n.colorMask(!0,!0,!0,!0),n.clearColor(0,0,0,0),n.depthMask(!0),n.depthFunc(n.LESS),o.setReversed(!1),n.clearDepth(1),n.stencilMask(4294967295),n.stencilFunc(n.ALWAYS,0,4294967295),n.stencilOp(n.KEEP,n.KEEP,n.KEEP),n.clearStencil(0),n.cullFace(n.BACK),n.frontFace(n.CCW),n.polygonOffset(0,0),n.activeTexture(n.TEXTURE0),n.bindFramebuffer(n.FRAMEBUFFER,null),n.bindFramebuffer(n.DRAW_FRAMEBUFFER,null),n.bindFramebuffer(n.READ_FRAMEBUFFER,null),n.useProgram(null),n.lineWidth(1),n.scissor(0,0,n.canvas.width,n.canvas.height),n.viewport(0,0,n.canvas.width,n.canvas.height),n.pixelStorei(n.PACK_ALIGNMENT,4),n.pixelStorei(n.UNPACK_ALIGNMENT,4),n.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,!1),n.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),n.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,n.BROWSER_DEFAULT_WEBGL),n.pixelStorei(n.PACK_ROW_LENGTH,0),n.pixelStorei(n.PACK_SKIP_PIXELS,0),n.pixelStorei(n.PACK_SKIP_ROWS,0),n.pixelStorei(n.UNPACK_ROW_LENGTH,0),n.pixelStorei(n.UNPACK_IMAGE_HEIGHT,0),n.pixelStorei(n.UNPACK_SKIP_PIXELS,0),n.pixelStorei(n.UNPACK_SKIP_ROWS,0),n.pixelStorei(n.UNPACK_SKIP_IMAGES,0),h={},u={},ee=null,se={},f={},l={},d=new WeakMap,g=[],_=null,m=!1,p=null,x=null,A=null,w=null,P=null,E=null,y=null,T=new Ke(0,0,0),k=0,N=!1,I=null,z=null,W=null,L=null,X=null,te.set(0,0,n.canvas.width,n.canvas.height),me.set(0,0,n.canvas.width,n.canvas.height),r.reset(),o.reset(),a.reset()}return{buffers:{color:r,depth:o,stencil:a},enable:xe,disable:We,bindFramebuffer:ot,drawBuffers:He,useProgram:ut,setBlending:nn,setMaterial:qt,setFlipSided:gn,setCullFace:Vt,setLineWidth:Nn,setPolygonOffset:wt,setScissorTest:Tn,activeTexture:an,bindTexture:vn,unbindTexture:F,compressedTexImage2D:Pe,compressedTexImage3D:je,texImage2D:S,texImage3D:Y,pixelStorei:ae,getParameter:fe,updateUBOMapping:ne,uniformBlockBinding:re,texStorage2D:Ze,texStorage3D:C,texSubImage2D:ct,texSubImage3D:Te,compressedTexSubImage2D:Gt,compressedTexSubImage3D:Ge,scissor:_e,viewport:Se,reset:ge}}function aC(n,e,t,i,s,r,o){let a=e.has("WEBGL_multisampled_render_to_texture")?e.get("WEBGL_multisampled_render_to_texture"):null,l=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),c=new $e,h=new WeakMap,u=new Set,f,d=new WeakMap,g=new Set,_=new FinalizationRegistry(C=>g.delete(C)),m=!1;try{m=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function p(C,S){return m?new OffscreenCanvas(C,S):bl("canvas")}function x(C,S,Y){let fe=1,ae=Ze(C);if((ae.width>Y||ae.height>Y)&&(fe=Y/Math.max(ae.width,ae.height)),fe<1)if(typeof HTMLImageElement<"u"&&C instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&C instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&C instanceof ImageBitmap||typeof VideoFrame<"u"&&C instanceof VideoFrame){let _e=Math.floor(fe*ae.width),Se=Math.floor(fe*ae.height);f===void 0&&(f=p(_e,Se));let ne=S?p(_e,Se):f;return ne.width=_e,ne.height=Se,ne.getContext("2d").drawImage(C,0,0,_e,Se),Je("WebGLRenderer: Texture has been resized from ("+ae.width+"x"+ae.height+") to ("+_e+"x"+Se+")."),ne}else return"data"in C&&Je("WebGLRenderer: Image in DataTexture is too big ("+ae.width+"x"+ae.height+")."),C;return C}function A(C){return C.generateMipmaps}function w(C){n.generateMipmap(C)}function P(C){return C.isWebGLCubeRenderTarget?n.TEXTURE_CUBE_MAP:C.isWebGL3DRenderTarget?n.TEXTURE_3D:C.isWebGLArrayRenderTarget||C.isCompressedArrayTexture?n.TEXTURE_2D_ARRAY:n.TEXTURE_2D}function E(C,S,Y,fe,ae,_e=!1){if(C!==null){if(n[C]!==void 0)return n[C];Je("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+C+"'")}let Se;fe&&(Se=e.get("EXT_texture_norm16"),Se||Je("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let ne=S;if(S===n.RED&&(Y===n.FLOAT&&(ne=n.R32F),Y===n.HALF_FLOAT&&(ne=n.R16F),Y===n.UNSIGNED_BYTE&&(ne=n.R8),Y===n.UNSIGNED_SHORT&&Se&&(ne=Se.R16_EXT),Y===n.SHORT&&Se&&(ne=Se.R16_SNORM_EXT)),S===n.RED_INTEGER&&(Y===n.UNSIGNED_BYTE&&(ne=n.R8UI),Y===n.UNSIGNED_SHORT&&(ne=n.R16UI),Y===n.UNSIGNED_INT&&(ne=n.R32UI),Y===n.BYTE&&(ne=n.R8I),Y===n.SHORT&&(ne=n.R16I),Y===n.INT&&(ne=n.R32I)),S===n.RG&&(Y===n.FLOAT&&(ne=n.RG32F),Y===n.HALF_FLOAT&&(ne=n.RG16F),Y===n.UNSIGNED_BYTE&&(ne=n.RG8),Y===n.UNSIGNED_SHORT&&Se&&(ne=Se.RG16_EXT),Y===n.SHORT&&Se&&(ne=Se.RG16_SNORM_EXT)),S===n.RG_INTEGER&&(Y===n.UNSIGNED_BYTE&&(ne=n.RG8UI),Y===n.UNSIGNED_SHORT&&(ne=n.RG16UI),Y===n.UNSIGNED_INT&&(ne=n.RG32UI),Y===n.BYTE&&(ne=n.RG8I),Y===n.SHORT&&(ne=n.RG16I),Y===n.INT&&(ne=n.RG32I)),S===n.RGB_INTEGER&&(Y===n.UNSIGNED_BYTE&&(ne=n.RGB8UI),Y===n.UNSIGNED_SHORT&&(ne=n.RGB16UI),Y===n.UNSIGNED_INT&&(ne=n.RGB32UI),Y===n.BYTE&&(ne=n.RGB8I),Y===n.SHORT&&(ne=n.RGB16I),Y===n.INT&&(ne=n.RGB32I)),S===n.RGBA_INTEGER&&(Y===n.UNSIGNED_BYTE&&(ne=n.RGBA8UI),Y===n.UNSIGNED_SHORT&&(ne=n.RGBA16UI),Y===n.UNSIGNED_INT&&(ne=n.RGBA32UI),Y===n.BYTE&&(ne=n.RGBA8I),Y===n.SHORT&&(ne=n.RGBA16I),Y===n.INT&&(ne=n.RGBA32I)),S===n.RGB&&(Y===n.UNSIGNED_SHORT&&Se&&(ne=Se.RGB16_EXT),Y===n.SHORT&&Se&&(ne=Se.RGB16_SNORM_EXT),Y===n.UNSIGNED_INT_5_9_9_9_REV&&(ne=n.RGB9_E5),Y===n.UNSIGNED_INT_10F_11F_11F_REV&&(ne=n.R11F_G11F_B10F)),S===n.RGBA){let re=_e?Sl:bt.getTransfer(ae);Y===n.FLOAT&&(ne=n.RGBA32F),Y===n.HALF_FLOAT&&(ne=n.RGBA16F),Y===n.UNSIGNED_BYTE&&(ne=re===Ft?n.SRGB8_ALPHA8:n.RGBA8),Y===n.UNSIGNED_SHORT&&Se&&(ne=Se.RGBA16_EXT),Y===n.SHORT&&Se&&(ne=Se.RGBA16_SNORM_EXT),Y===n.UNSIGNED_SHORT_4_4_4_4&&(ne=n.RGBA4),Y===n.UNSIGNED_SHORT_5_5_5_1&&(ne=n.RGB5_A1)}return(ne===n.R16F||ne===n.R32F||ne===n.RG16F||ne===n.RG32F||ne===n.RGBA16F||ne===n.RGBA32F)&&e.get("EXT_color_buffer_float"),ne}function y(C,S){let Y;return C?S===null||S===ts||S===io?Y=n.DEPTH24_STENCIL8:S===ns?Y=n.DEPTH32F_STENCIL8:S===da&&(Y=n.DEPTH24_STENCIL8,Je("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):S===null||S===ts||S===io?Y=n.DEPTH_COMPONENT24:S===ns?Y=n.DEPTH_COMPONENT32F:S===da&&(Y=n.DEPTH_COMPONENT16),Y}function T(C,S){return A(C)===!0||C.isFramebufferTexture&&C.minFilter!==Hn&&C.minFilter!==ai?Math.log2(Math.max(S.width,S.height))+1:C.mipmaps.length>0?C.mipmaps.length:C.isCompressedTexture&&Array.isArray(C.image)?S.mipmaps.length:1}function k(C){let S=new WeakRef(C);i.get(C).__ref=S,g.add(S),_.register(C,S,S)}function N(C){let S=i.get(C).__ref;S!==void 0&&(g.delete(S),_.unregister(S))}function I(C){W(C.target)}function z(C){L(C.target)}function W(C){C.removeEventListener("dispose",I),N(C),$(C),C.isVideoTexture&&h.delete(C),C.isHTMLTexture&&u.delete(C)}function L(C){C.removeEventListener("dispose",z),N(C),ce(C)}function X(){for(let C of g){let S=C.deref();S!==void 0&&(S.isRenderTarget===!0?L(S):W(S))}g.clear(),u.clear()}function $(C){let S=i.get(C);if(S.__webglInit===void 0)return;let Y=C.source,fe=d.get(Y);if(fe){let ae=fe[S.__cacheKey];ae.usedTimes--,ae.usedTimes===0&&V(C),Object.keys(fe).length===0&&d.delete(Y)}i.remove(C)}function V(C){let S=i.get(C);n.deleteTexture(S.__webglTexture);let Y=C.source,fe=d.get(Y);delete fe[S.__cacheKey],o.memory.textures--}function ce(C){let S=i.get(C);S.__depthDisposeCallback&&S.__depthDisposeCallback();let Y=C.depthTexture;if(Y&&Y.renderTarget===C&&W(Y),C.isWebGLCubeRenderTarget)for(let ae=0;ae<6;ae++){if(Array.isArray(S.__webglFramebuffer[ae]))for(let _e=0;_e<S.__webglFramebuffer[ae].length;_e++)n.deleteFramebuffer(S.__webglFramebuffer[ae][_e]);else n.deleteFramebuffer(S.__webglFramebuffer[ae]);S.__webglDepthbuffer&&n.deleteRenderbuffer(S.__webglDepthbuffer[ae])}else{if(Array.isArray(S.__webglFramebuffer))for(let ae=0;ae<S.__webglFramebuffer.length;ae++)n.deleteFramebuffer(S.__webglFramebuffer[ae]);else n.deleteFramebuffer(S.__webglFramebuffer);if(S.__webglDepthbuffer&&n.deleteRenderbuffer(S.__webglDepthbuffer),S.__webglMultisampledFramebuffer&&n.deleteFramebuffer(S.__webglMultisampledFramebuffer),S.__webglColorRenderbuffer)for(let ae=0;ae<S.__webglColorRenderbuffer.length;ae++)S.__webglColorRenderbuffer[ae]&&n.deleteRenderbuffer(S.__webglColorRenderbuffer[ae]);S.__webglDepthRenderbuffer&&n.deleteRenderbuffer(S.__webglDepthRenderbuffer)}let fe=C.textures;for(let ae=0,_e=fe.length;ae<_e;ae++){let Se=i.get(fe[ae]);Se.__webglTexture&&(n.deleteTexture(Se.__webglTexture),o.memory.textures--),i.remove(fe[ae])}i.remove(C)}let K=0;function ee(){K=0}function se(){return K}function de(C){K=C}function he(){let C=K;return C>=s.maxTextures&&Je("WebGLTextures: Trying to use "+(C+1)+" texture units while this GPU supports only "+s.maxTextures),K+=1,C}function te(C){let S=[];return S.push(C.wrapS),S.push(C.wrapT),S.push(C.wrapR||0),S.push(C.magFilter),S.push(C.minFilter),S.push(C.anisotropy),S.push(C.internalFormat),S.push(C.format),S.push(C.type),S.push(C.generateMipmaps),S.push(C.mipmapsAutoUpdate),S.push(C.premultiplyAlpha),S.push(C.flipY),S.push(C.unpackAlignment),S.push(C.colorSpace),S.join()}function me(C,S){let Y=i.get(C);if(C.isVideoTexture&&Gt(C),C.isRenderTargetTexture===!1&&C.isExternalTexture!==!0&&C.version>0&&Y.__version!==C.version){let fe=C.image;if(fe===null)Je("WebGLRenderer: Texture marked for update but no image data found.");else if(fe.complete===!1)Je("WebGLRenderer: Texture marked for update but image is incomplete");else{qt(Y,C,S);return}}else C.isExternalTexture&&(Y.__webglTexture=C.sourceTexture?C.sourceTexture:null);t.bindTexture(n.TEXTURE_2D,Y.__webglTexture,n.TEXTURE0+S)}function ve(C,S){let Y=i.get(C);if(C.isRenderTargetTexture===!1&&C.version>0&&Y.__version!==C.version){qt(Y,C,S);return}else C.isExternalTexture&&(Y.__webglTexture=C.sourceTexture?C.sourceTexture:null);t.bindTexture(n.TEXTURE_2D_ARRAY,Y.__webglTexture,n.TEXTURE0+S)}function Me(C,S){let Y=i.get(C);if(C.isRenderTargetTexture===!1&&C.version>0&&Y.__version!==C.version){qt(Y,C,S);return}t.bindTexture(n.TEXTURE_3D,Y.__webglTexture,n.TEXTURE0+S)}function xe(C,S){let Y=i.get(C);if(C.version>0&&Y.__version!==C.version){gn(Y,C,S);return}t.bindTexture(n.TEXTURE_CUBE_MAP,Y.__webglTexture,n.TEXTURE0+S)}let We={[Nh]:n.REPEAT,[Ms]:n.CLAMP_TO_EDGE,[Uh]:n.MIRRORED_REPEAT},ot={[Hn]:n.NEAREST,[Jv]:n.NEAREST_MIPMAP_NEAREST,[ql]:n.NEAREST_MIPMAP_LINEAR,[ai]:n.LINEAR,[cu]:n.LINEAR_MIPMAP_NEAREST,[er]:n.LINEAR_MIPMAP_LINEAR},He={[ty]:n.NEVER,[Ip]:n.ALWAYS,[ny]:n.LESS,[Rp]:n.LEQUAL,[iy]:n.EQUAL,[Pp]:n.GEQUAL,[sy]:n.GREATER,[ry]:n.NOTEQUAL};function ut(C,S){if(S.type===ns&&e.has("OES_texture_float_linear")===!1&&(S.magFilter===ai||S.magFilter===cu||S.magFilter===ql||S.magFilter===er||S.minFilter===ai||S.minFilter===cu||S.minFilter===ql||S.minFilter===er)&&Je("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),n.texParameteri(C,n.TEXTURE_WRAP_S,We[S.wrapS]),n.texParameteri(C,n.TEXTURE_WRAP_T,We[S.wrapT]),(C===n.TEXTURE_3D||C===n.TEXTURE_2D_ARRAY)&&n.texParameteri(C,n.TEXTURE_WRAP_R,We[S.wrapR]),n.texParameteri(C,n.TEXTURE_MAG_FILTER,ot[S.magFilter]),n.texParameteri(C,n.TEXTURE_MIN_FILTER,ot[S.minFilter]),S.compareFunction&&(n.texParameteri(C,n.TEXTURE_COMPARE_MODE,n.COMPARE_REF_TO_TEXTURE),n.texParameteri(C,n.TEXTURE_COMPARE_FUNC,He[S.compareFunction])),e.has("EXT_texture_filter_anisotropic")===!0){if(S.magFilter===Hn||S.minFilter!==ql&&S.minFilter!==er||S.type===ns&&e.has("OES_texture_float_linear")===!1)return;if(S.anisotropy>1||i.get(S).__currentAnisotropy){let Y=e.get("EXT_texture_filter_anisotropic");n.texParameterf(C,Y.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(S.anisotropy,s.getMaxAnisotropy())),i.get(S).__currentAnisotropy=S.anisotropy}}}function ht(C,S){let Y=!1;C.__webglInit===void 0&&(C.__webglInit=!0,S.addEventListener("dispose",I),k(S));let fe=S.source,ae=d.get(fe);ae===void 0&&(ae={},d.set(fe,ae));let _e=te(S);if(_e!==C.__cacheKey){ae[_e]===void 0&&(ae[_e]={texture:n.createTexture(),usedTimes:0},o.memory.textures++,Y=!0),ae[_e].usedTimes++;let Se=ae[C.__cacheKey];Se!==void 0&&(ae[C.__cacheKey].usedTimes--,Se.usedTimes===0&&V(S)),C.__cacheKey=_e,C.__webglTexture=ae[_e].texture}return Y}function at(C,S,Y){return Math.floor(Math.floor(C/Y)/S)}function nn(C,S,Y,fe){let _e=C.updateRanges;if(_e.length===0)t.texSubImage2D(n.TEXTURE_2D,0,0,0,S.width,S.height,Y,fe,S.data);else{_e.sort((U,oe)=>U.start-oe.start);let Se=0;for(let U=1;U<_e.length;U++){let oe=_e[Se],ie=_e[U],Ee=oe.start+oe.count,ye=at(ie.start,S.width,4),we=at(oe.start,S.width,4);ie.start<=Ee+1&&ye===we&&at(ie.start+ie.count-1,S.width,4)===ye?oe.count=Math.max(oe.count,ie.start+ie.count-oe.start):(++Se,_e[Se]=ie)}_e.length=Se+1;let ne=t.getParameter(n.UNPACK_ROW_LENGTH),re=t.getParameter(n.UNPACK_SKIP_PIXELS),ge=t.getParameter(n.UNPACK_SKIP_ROWS);t.pixelStorei(n.UNPACK_ROW_LENGTH,S.width);for(let U=0,oe=_e.length;U<oe;U++){let ie=_e[U],Ee=Math.floor(ie.start/4),ye=Math.ceil(ie.count/4),we=Ee%S.width,Xe=Math.floor(Ee/S.width),tt=ye,ue=1;t.pixelStorei(n.UNPACK_SKIP_PIXELS,we),t.pixelStorei(n.UNPACK_SKIP_ROWS,Xe),t.texSubImage2D(n.TEXTURE_2D,0,we,Xe,tt,ue,Y,fe,S.data)}C.clearUpdateRanges(),t.pixelStorei(n.UNPACK_ROW_LENGTH,ne),t.pixelStorei(n.UNPACK_SKIP_PIXELS,re),t.pixelStorei(n.UNPACK_SKIP_ROWS,ge)}}function qt(C,S,Y){let fe=n.TEXTURE_2D;(S.isDataArrayTexture||S.isCompressedArrayTexture)&&(fe=n.TEXTURE_2D_ARRAY),S.isData3DTexture&&(fe=n.TEXTURE_3D);let ae=ht(C,S),_e=S.source;t.bindTexture(fe,C.__webglTexture,n.TEXTURE0+Y);let Se=i.get(_e);if(_e.version!==Se.__version||ae===!0){if(t.activeTexture(n.TEXTURE0+Y),(typeof ImageBitmap<"u"&&S.image instanceof ImageBitmap)===!1){let ue=bt.getPrimaries(bt.workingColorSpace),Be=S.colorSpace===nr?null:bt.getPrimaries(S.colorSpace),nt=S.colorSpace===nr||ue===Be?n.NONE:n.BROWSER_DEFAULT_WEBGL;t.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,S.flipY),t.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,S.premultiplyAlpha),t.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,nt)}t.pixelStorei(n.UNPACK_ALIGNMENT,S.unpackAlignment);let re=x(S.image,!1,s.maxTextureSize);re=Ge(S,re);let ge=r.convert(S.format,S.colorSpace),U=r.convert(S.type),oe=E(S.internalFormat,ge,U,S.normalized,S.colorSpace,S.isVideoTexture);ut(fe,S);let ie,Ee=S.mipmaps,ye=S.isVideoTexture!==!0,we=Se.__version===void 0||ae===!0,Xe=_e.dataReady,tt=T(S,re);if(S.isDepthTexture)oe=y(S.format===tr,S.type),we&&(ye?t.texStorage2D(n.TEXTURE_2D,1,oe,re.width,re.height):t.texImage2D(n.TEXTURE_2D,0,oe,re.width,re.height,0,ge,U,null));else if(S.isDataTexture)if(Ee.length>0){ye&&we&&t.texStorage2D(n.TEXTURE_2D,tt,oe,Ee[0].width,Ee[0].height);for(let ue=0,Be=Ee.length;ue<Be;ue++)ie=Ee[ue],ye?Xe&&t.texSubImage2D(n.TEXTURE_2D,ue,0,0,ie.width,ie.height,ge,U,ie.data):t.texImage2D(n.TEXTURE_2D,ue,oe,ie.width,ie.height,0,ge,U,ie.data);S.generateMipmaps=!1}else ye?(we&&t.texStorage2D(n.TEXTURE_2D,tt,oe,re.width,re.height),Xe&&nn(S,re,ge,U)):t.texImage2D(n.TEXTURE_2D,0,oe,re.width,re.height,0,ge,U,re.data);else if(S.isCompressedTexture)if(S.isCompressedArrayTexture){ye&&we&&t.texStorage3D(n.TEXTURE_2D_ARRAY,tt,oe,Ee[0].width,Ee[0].height,re.depth);for(let ue=0,Be=Ee.length;ue<Be;ue++)if(ie=Ee[ue],S.format!==ss)if(ge!==null)if(ye){if(Xe)if(S.layerUpdates.size>0){let nt=Hp(ie.width,ie.height,S.format,S.type);for(let Re of S.layerUpdates){let ft=ie.data.subarray(Re*nt/ie.data.BYTES_PER_ELEMENT,(Re+1)*nt/ie.data.BYTES_PER_ELEMENT);t.compressedTexSubImage3D(n.TEXTURE_2D_ARRAY,ue,0,0,Re,ie.width,ie.height,1,ge,ft)}}else t.compressedTexSubImage3D(n.TEXTURE_2D_ARRAY,ue,0,0,0,ie.width,ie.height,re.depth,ge,ie.data)}else t.compressedTexImage3D(n.TEXTURE_2D_ARRAY,ue,oe,ie.width,ie.height,re.depth,0,ie.data,0,0);else Je("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else ye?Xe&&t.texSubImage3D(n.TEXTURE_2D_ARRAY,ue,0,0,0,ie.width,ie.height,re.depth,ge,U,ie.data):t.texImage3D(n.TEXTURE_2D_ARRAY,ue,oe,ie.width,ie.height,re.depth,0,ge,U,ie.data);S.layerUpdates.size>0&&S.clearLayerUpdates()}else{ye&&we&&t.texStorage2D(n.TEXTURE_2D,tt,oe,Ee[0].width,Ee[0].height);for(let ue=0,Be=Ee.length;ue<Be;ue++)ie=Ee[ue],S.format!==ss?ge!==null?ye?Xe&&t.compressedTexSubImage2D(n.TEXTURE_2D,ue,0,0,ie.width,ie.height,ge,ie.data):t.compressedTexImage2D(n.TEXTURE_2D,ue,oe,ie.width,ie.height,0,ie.data):Je("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):ye?Xe&&t.texSubImage2D(n.TEXTURE_2D,ue,0,0,ie.width,ie.height,ge,U,ie.data):t.texImage2D(n.TEXTURE_2D,ue,oe,ie.width,ie.height,0,ge,U,ie.data)}else if(S.isDataArrayTexture)if(ye){if(we&&t.texStorage3D(n.TEXTURE_2D_ARRAY,tt,oe,re.width,re.height,re.depth),Xe)if(S.layerUpdates.size>0){let ue=Hp(re.width,re.height,S.format,S.type);for(let Be of S.layerUpdates){let nt=re.data.subarray(Be*ue/re.data.BYTES_PER_ELEMENT,(Be+1)*ue/re.data.BYTES_PER_ELEMENT);t.texSubImage3D(n.TEXTURE_2D_ARRAY,0,0,0,Be,re.width,re.height,1,ge,U,nt)}S.clearLayerUpdates()}else t.texSubImage3D(n.TEXTURE_2D_ARRAY,0,0,0,0,re.width,re.height,re.depth,ge,U,re.data)}else t.texImage3D(n.TEXTURE_2D_ARRAY,0,oe,re.width,re.height,re.depth,0,ge,U,re.data);else if(S.isData3DTexture)ye?(we&&t.texStorage3D(n.TEXTURE_3D,tt,oe,re.width,re.height,re.depth),Xe&&t.texSubImage3D(n.TEXTURE_3D,0,0,0,0,re.width,re.height,re.depth,ge,U,re.data)):t.texImage3D(n.TEXTURE_3D,0,oe,re.width,re.height,re.depth,0,ge,U,re.data);else if(S.isFramebufferTexture){if(we)if(ye)t.texStorage2D(n.TEXTURE_2D,tt,oe,re.width,re.height);else{let ue=re.width,Be=re.height;for(let nt=0;nt<tt;nt++)t.texImage2D(n.TEXTURE_2D,nt,oe,ue,Be,0,ge,U,null),ue>>=1,Be>>=1}}else if(S.isHTMLTexture){if("texElementImage2D"in n){let ue=n.canvas;if(ue.hasAttribute("layoutsubtree")||ue.setAttribute("layoutsubtree","true"),re.parentNode!==ue){ue.appendChild(re),u.add(S),ue.onpaint=Be=>{let nt=Be.changedElements;for(let Re of u)nt.includes(Re.image)&&(Re.needsUpdate=!0)},ue.requestPaint();return}if(n.texElementImage2D.length===3)n.texElementImage2D(n.TEXTURE_2D,n.RGBA8,re);else{let nt=n.RGBA,Re=n.RGBA,ft=n.UNSIGNED_BYTE;n.texElementImage2D(n.TEXTURE_2D,0,nt,Re,ft,re)}n.texParameteri(n.TEXTURE_2D,n.TEXTURE_MIN_FILTER,n.LINEAR),n.texParameteri(n.TEXTURE_2D,n.TEXTURE_WRAP_S,n.CLAMP_TO_EDGE),n.texParameteri(n.TEXTURE_2D,n.TEXTURE_WRAP_T,n.CLAMP_TO_EDGE)}}else if(Ee.length>0){if(ye&&we){let ue=Ze(Ee[0]);t.texStorage2D(n.TEXTURE_2D,tt,oe,ue.width,ue.height)}for(let ue=0,Be=Ee.length;ue<Be;ue++)ie=Ee[ue],ye?Xe&&t.texSubImage2D(n.TEXTURE_2D,ue,0,0,ge,U,ie):t.texImage2D(n.TEXTURE_2D,ue,oe,ge,U,ie);S.generateMipmaps=!1}else if(ye){if(we){let ue=Ze(re);t.texStorage2D(n.TEXTURE_2D,tt,oe,ue.width,ue.height)}Xe&&t.texSubImage2D(n.TEXTURE_2D,0,0,0,ge,U,re)}else t.texImage2D(n.TEXTURE_2D,0,oe,ge,U,re);A(S)&&S.mipmapsAutoUpdate===!0&&w(fe),Se.__version=_e.version,S.onUpdate&&S.onUpdate(S)}C.__version=S.version}function gn(C,S,Y){if(S.image.length!==6)return;let fe=ht(C,S),ae=S.source;t.bindTexture(n.TEXTURE_CUBE_MAP,C.__webglTexture,n.TEXTURE0+Y);let _e=i.get(ae);if(ae.version!==_e.__version||fe===!0){t.activeTexture(n.TEXTURE0+Y);let Se=bt.getPrimaries(bt.workingColorSpace),ne=S.colorSpace===nr?null:bt.getPrimaries(S.colorSpace),re=S.colorSpace===nr||Se===ne?n.NONE:n.BROWSER_DEFAULT_WEBGL;t.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,S.flipY),t.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,S.premultiplyAlpha),t.pixelStorei(n.UNPACK_ALIGNMENT,S.unpackAlignment),t.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,re);let ge=S.isCompressedTexture||S.image[0].isCompressedTexture,U=S.image[0]&&S.image[0].isDataTexture,oe=[];for(let Re=0;Re<6;Re++)!ge&&!U?oe[Re]=x(S.image[Re],!0,s.maxCubemapSize):oe[Re]=U?S.image[Re].image:S.image[Re],oe[Re]=Ge(S,oe[Re]);let ie=oe[0],Ee=r.convert(S.format,S.colorSpace),ye=r.convert(S.type),we=E(S.internalFormat,Ee,ye,S.normalized,S.colorSpace),Xe=S.isVideoTexture!==!0,tt=_e.__version===void 0||fe===!0,ue=ae.dataReady,Be=T(S,ie);ut(n.TEXTURE_CUBE_MAP,S);let nt;if(S.isDepthTexture){if(we=y(S.format===tr,S.type),tt)if(Xe)t.texStorage2D(n.TEXTURE_CUBE_MAP,1,we,ie.width,ie.height);else for(let Re=0;Re<6;Re++)t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,0,we,ie.width,ie.height,0,Ee,ye,null)}else if(ge){Xe&&tt&&t.texStorage2D(n.TEXTURE_CUBE_MAP,Be,we,ie.width,ie.height);for(let Re=0;Re<6;Re++){nt=oe[Re].mipmaps;for(let ft=0;ft<nt.length;ft++){let Zt=nt[ft];S.format!==ss?Ee!==null?Xe?ue&&t.compressedTexSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ft,0,0,Zt.width,Zt.height,Ee,Zt.data):t.compressedTexImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ft,we,Zt.width,Zt.height,0,Zt.data):Je("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):Xe?ue&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ft,0,0,Zt.width,Zt.height,Ee,ye,Zt.data):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ft,we,Zt.width,Zt.height,0,Ee,ye,Zt.data)}}}else{if(nt=S.mipmaps,Xe&&tt){nt.length>0&&Be++;let Re=Ze(oe[0]);t.texStorage2D(n.TEXTURE_CUBE_MAP,Be,we,Re.width,Re.height)}for(let Re=0;Re<6;Re++)if(U){Xe?ue&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,0,0,0,oe[Re].width,oe[Re].height,Ee,ye,oe[Re].data):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,0,we,oe[Re].width,oe[Re].height,0,Ee,ye,oe[Re].data);for(let ft=0;ft<nt.length;ft++){let jn=nt[ft].image[Re].image;Xe?ue&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ft+1,0,0,jn.width,jn.height,Ee,ye,jn.data):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ft+1,we,jn.width,jn.height,0,Ee,ye,jn.data)}}else{Xe?ue&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,0,0,0,Ee,ye,oe[Re]):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,0,we,Ee,ye,oe[Re]);for(let ft=0;ft<nt.length;ft++){let Zt=nt[ft];Xe?ue&&t.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ft+1,0,0,Ee,ye,Zt.image[Re]):t.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+Re,ft+1,we,Ee,ye,Zt.image[Re])}}}A(S)&&S.mipmapsAutoUpdate===!0&&w(n.TEXTURE_CUBE_MAP),_e.__version=ae.version,S.onUpdate&&S.onUpdate(S)}C.__version=S.version}function Vt(C,S,Y,fe,ae,_e){let Se=r.convert(Y.format,Y.colorSpace),ne=r.convert(Y.type),re=E(Y.internalFormat,Se,ne,Y.normalized,Y.colorSpace),ge=i.get(S),U=i.get(Y);if(U.__renderTarget=S,!ge.__hasExternalTextures){let oe=Math.max(1,S.width>>_e),ie=Math.max(1,S.height>>_e);ae===n.TEXTURE_3D||ae===n.TEXTURE_2D_ARRAY?t.texImage3D(ae,_e,re,oe,ie,S.depth,0,Se,ne,null):t.texImage2D(ae,_e,re,oe,ie,0,Se,ne,null)}t.bindFramebuffer(n.FRAMEBUFFER,C),Te(S)?a.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,fe,ae,U.__webglTexture,0,ct(S)):(ae===n.TEXTURE_2D||ae>=n.TEXTURE_CUBE_MAP_POSITIVE_X&&ae<=n.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&n.framebufferTexture2D(n.FRAMEBUFFER,fe,ae,U.__webglTexture,_e),t.bindFramebuffer(n.FRAMEBUFFER,null)}function Nn(C,S,Y){if(n.bindRenderbuffer(n.RENDERBUFFER,C),S.depthBuffer){let fe=S.depthTexture,ae=fe&&fe.isDepthTexture?fe.type:null,_e=y(S.stencilBuffer,ae),Se=S.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;Te(S)?a.renderbufferStorageMultisampleEXT(n.RENDERBUFFER,ct(S),_e,S.width,S.height):Y?n.renderbufferStorageMultisample(n.RENDERBUFFER,ct(S),_e,S.width,S.height):n.renderbufferStorage(n.RENDERBUFFER,_e,S.width,S.height),n.framebufferRenderbuffer(n.FRAMEBUFFER,Se,n.RENDERBUFFER,C)}else{let fe=S.textures;for(let ae=0;ae<fe.length;ae++){let _e=fe[ae],Se=r.convert(_e.format,_e.colorSpace),ne=r.convert(_e.type),re=E(_e.internalFormat,Se,ne,_e.normalized,_e.colorSpace);Te(S)?a.renderbufferStorageMultisampleEXT(n.RENDERBUFFER,ct(S),re,S.width,S.height):Y?n.renderbufferStorageMultisample(n.RENDERBUFFER,ct(S),re,S.width,S.height):n.renderbufferStorage(n.RENDERBUFFER,re,S.width,S.height)}}n.bindRenderbuffer(n.RENDERBUFFER,null)}function wt(C,S,Y){let fe=S.isWebGLCubeRenderTarget===!0;if(t.bindFramebuffer(n.FRAMEBUFFER,C),!(S.depthTexture&&S.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let ae=i.get(S.depthTexture);ae.__renderTarget=S;let _e=fe?S.depthTexture.image[0]:S.depthTexture.image;(!ae.__webglTexture||_e.width!==S.width||_e.height!==S.height)&&(_e.width=S.width,_e.height=S.height,S.depthTexture.needsUpdate=!0),fe?xe(S.depthTexture,0):me(S.depthTexture,0);let Se=ae.__webglTexture,ne=ct(S),re=fe?n.TEXTURE_CUBE_MAP_POSITIVE_X+Y:n.TEXTURE_2D,ge=S.depthTexture.format===tr?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;if(S.depthTexture.format===Zs)Te(S)?a.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,ge,re,Se,0,ne):n.framebufferTexture2D(n.FRAMEBUFFER,ge,re,Se,0);else if(S.depthTexture.format===tr)Te(S)?a.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,ge,re,Se,0,ne):n.framebufferTexture2D(n.FRAMEBUFFER,ge,re,Se,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function Tn(C){let S=i.get(C),Y=C.isWebGLCubeRenderTarget===!0;if(S.__boundDepthTexture!==C.depthTexture){let fe=C.depthTexture;if(S.__depthDisposeCallback&&S.__depthDisposeCallback(),fe){let ae=()=>{delete S.__boundDepthTexture,delete S.__depthDisposeCallback,fe.removeEventListener("dispose",ae)};fe.addEventListener("dispose",ae),S.__depthDisposeCallback=ae}S.__boundDepthTexture=fe}if(C.depthTexture&&!S.__autoAllocateDepthBuffer)if(Y)for(let fe=0;fe<6;fe++)wt(S.__webglFramebuffer[fe],C,fe);else C.texture.mipmaps.length>0?wt(S.__webglFramebuffer[0],C,0):wt(S.__webglFramebuffer,C,0);else if(Y){S.__webglDepthbuffer=[];for(let fe=0;fe<6;fe++)if(t.bindFramebuffer(n.FRAMEBUFFER,S.__webglFramebuffer[fe]),S.__webglDepthbuffer[fe]===void 0)S.__webglDepthbuffer[fe]=n.createRenderbuffer(),Nn(S.__webglDepthbuffer[fe],C,!1);else{let ae=C.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,_e=S.__webglDepthbuffer[fe];n.bindRenderbuffer(n.RENDERBUFFER,_e),n.framebufferRenderbuffer(n.FRAMEBUFFER,ae,n.RENDERBUFFER,_e)}}else if(C.texture.mipmaps.length>0?t.bindFramebuffer(n.FRAMEBUFFER,S.__webglFramebuffer[0]):t.bindFramebuffer(n.FRAMEBUFFER,S.__webglFramebuffer),S.__webglDepthbuffer===void 0)S.__webglDepthbuffer=n.createRenderbuffer(),Nn(S.__webglDepthbuffer,C,!1);else{let ae=C.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,_e=S.__webglDepthbuffer;n.bindRenderbuffer(n.RENDERBUFFER,_e),n.framebufferRenderbuffer(n.FRAMEBUFFER,ae,n.RENDERBUFFER,_e)}t.bindFramebuffer(n.FRAMEBUFFER,null)}function an(C,S,Y){let fe=i.get(C);S!==void 0&&Vt(fe.__webglFramebuffer,C,C.texture,n.COLOR_ATTACHMENT0,n.TEXTURE_2D,0),Y!==void 0&&Tn(C)}function vn(C){let S=C.texture,Y=i.get(C),fe=i.get(S);C.addEventListener("dispose",z),k(C);let ae=C.textures,_e=C.isWebGLCubeRenderTarget===!0,Se=ae.length>1;if(Se||(fe.__webglTexture===void 0&&(fe.__webglTexture=n.createTexture()),fe.__version=S.version,o.memory.textures++),_e){Y.__webglFramebuffer=[];for(let ne=0;ne<6;ne++)if(S.mipmaps.length>0){Y.__webglFramebuffer[ne]=[];for(let re=0;re<S.mipmaps.length;re++)Y.__webglFramebuffer[ne][re]=n.createFramebuffer()}else Y.__webglFramebuffer[ne]=n.createFramebuffer()}else{if(S.mipmaps.length>0){Y.__webglFramebuffer=[];for(let ne=0;ne<S.mipmaps.length;ne++)Y.__webglFramebuffer[ne]=n.createFramebuffer()}else Y.__webglFramebuffer=n.createFramebuffer();if(Se)for(let ne=0,re=ae.length;ne<re;ne++){let ge=i.get(ae[ne]);ge.__webglTexture===void 0&&(ge.__webglTexture=n.createTexture(),o.memory.textures++)}if(C.samples>0&&Te(C)===!1){Y.__webglMultisampledFramebuffer=n.createFramebuffer(),Y.__webglColorRenderbuffer=[],t.bindFramebuffer(n.FRAMEBUFFER,Y.__webglMultisampledFramebuffer);for(let ne=0;ne<ae.length;ne++){let re=ae[ne];Y.__webglColorRenderbuffer[ne]=n.createRenderbuffer(),n.bindRenderbuffer(n.RENDERBUFFER,Y.__webglColorRenderbuffer[ne]);let ge=r.convert(re.format,re.colorSpace),U=r.convert(re.type),oe=E(re.internalFormat,ge,U,re.normalized,re.colorSpace,C.isXRRenderTarget===!0),ie=ct(C);n.renderbufferStorageMultisample(n.RENDERBUFFER,ie,oe,C.width,C.height),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+ne,n.RENDERBUFFER,Y.__webglColorRenderbuffer[ne])}n.bindRenderbuffer(n.RENDERBUFFER,null),C.depthBuffer&&(Y.__webglDepthRenderbuffer=n.createRenderbuffer(),Nn(Y.__webglDepthRenderbuffer,C,!0)),t.bindFramebuffer(n.FRAMEBUFFER,null)}}if(_e){t.bindTexture(n.TEXTURE_CUBE_MAP,fe.__webglTexture),ut(n.TEXTURE_CUBE_MAP,S);for(let ne=0;ne<6;ne++)if(S.mipmaps.length>0)for(let re=0;re<S.mipmaps.length;re++)Vt(Y.__webglFramebuffer[ne][re],C,S,n.COLOR_ATTACHMENT0,n.TEXTURE_CUBE_MAP_POSITIVE_X+ne,re);else Vt(Y.__webglFramebuffer[ne],C,S,n.COLOR_ATTACHMENT0,n.TEXTURE_CUBE_MAP_POSITIVE_X+ne,0);A(S)?w(n.TEXTURE_CUBE_MAP):S.mipmaps.length>0&&n.texParameteri(n.TEXTURE_CUBE_MAP,n.TEXTURE_MAX_LEVEL,S.mipmaps.length-1),t.unbindTexture()}else if(Se){for(let ne=0,re=ae.length;ne<re;ne++){let ge=ae[ne],U=i.get(ge),oe=n.TEXTURE_2D;(C.isWebGL3DRenderTarget||C.isWebGLArrayRenderTarget)&&(oe=C.isWebGL3DRenderTarget?n.TEXTURE_3D:n.TEXTURE_2D_ARRAY),t.bindTexture(oe,U.__webglTexture),ut(oe,ge),Vt(Y.__webglFramebuffer,C,ge,n.COLOR_ATTACHMENT0+ne,oe,0),A(ge)&&w(oe)}t.unbindTexture()}else{let ne=n.TEXTURE_2D;if((C.isWebGL3DRenderTarget||C.isWebGLArrayRenderTarget)&&(ne=C.isWebGL3DRenderTarget?n.TEXTURE_3D:n.TEXTURE_2D_ARRAY),t.bindTexture(ne,fe.__webglTexture),ut(ne,S),S.mipmaps.length>0)for(let re=0;re<S.mipmaps.length;re++)Vt(Y.__webglFramebuffer[re],C,S,n.COLOR_ATTACHMENT0,ne,re);else Vt(Y.__webglFramebuffer,C,S,n.COLOR_ATTACHMENT0,ne,0);A(S)?w(ne):S.mipmaps.length>0&&n.texParameteri(ne,n.TEXTURE_MAX_LEVEL,S.mipmaps.length-1),t.unbindTexture()}C.depthBuffer&&Tn(C)}function F(C){let S=C.textures;for(let Y=0,fe=S.length;Y<fe;Y++){let ae=S[Y];if(A(ae)&&ae.mipmapsAutoUpdate===!0){let _e=P(C),Se=i.get(ae).__webglTexture;t.bindTexture(_e,Se),w(_e),t.unbindTexture()}}}let Pe=[];function je(C){if(C.samples>0){if(Te(C)===!1){let S=C.textures,Y=C.width,fe=C.height,ae=n.COLOR_BUFFER_BIT,_e=C.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,Se=i.get(C),ne=S.length>1;if(ne)for(let ge=0;ge<S.length;ge++)t.bindFramebuffer(n.FRAMEBUFFER,Se.__webglMultisampledFramebuffer),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+ge,n.RENDERBUFFER,null),t.bindFramebuffer(n.FRAMEBUFFER,Se.__webglFramebuffer),n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0+ge,n.TEXTURE_2D,null,0);t.bindFramebuffer(n.READ_FRAMEBUFFER,Se.__webglMultisampledFramebuffer),C.texture.mipmaps.length>0?t.bindFramebuffer(n.DRAW_FRAMEBUFFER,Se.__webglFramebuffer[0]):t.bindFramebuffer(n.DRAW_FRAMEBUFFER,Se.__webglFramebuffer);for(let ge=0;ge<S.length;ge++){if(C.resolveDepthBuffer&&(C.depthBuffer&&(ae|=n.DEPTH_BUFFER_BIT),C.stencilBuffer&&C.resolveStencilBuffer&&(ae|=n.STENCIL_BUFFER_BIT)),ne){n.framebufferRenderbuffer(n.READ_FRAMEBUFFER,n.COLOR_ATTACHMENT0,n.RENDERBUFFER,Se.__webglColorRenderbuffer[ge]);let U=i.get(S[ge]).__webglTexture;n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0,n.TEXTURE_2D,U,0)}n.blitFramebuffer(0,0,Y,fe,0,0,Y,fe,ae,n.NEAREST),l===!0&&(Pe.length=0,Pe.push(n.COLOR_ATTACHMENT0+ge),C.depthBuffer&&C.storeMultisampledDepthBuffer===!1&&Pe.push(_e),n.invalidateFramebuffer(n.READ_FRAMEBUFFER,Pe))}if(t.bindFramebuffer(n.READ_FRAMEBUFFER,null),t.bindFramebuffer(n.DRAW_FRAMEBUFFER,null),ne)for(let ge=0;ge<S.length;ge++){t.bindFramebuffer(n.FRAMEBUFFER,Se.__webglMultisampledFramebuffer),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+ge,n.RENDERBUFFER,Se.__webglColorRenderbuffer[ge]);let U=i.get(S[ge]).__webglTexture;t.bindFramebuffer(n.FRAMEBUFFER,Se.__webglFramebuffer),n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0+ge,n.TEXTURE_2D,U,0)}t.bindFramebuffer(n.DRAW_FRAMEBUFFER,Se.__webglMultisampledFramebuffer)}else if(C.depthBuffer&&C.storeMultisampledDepthBuffer===!1&&l){let S=C.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;n.invalidateFramebuffer(n.DRAW_FRAMEBUFFER,[S])}}}function ct(C){return Math.min(s.maxSamples,C.samples)}function Te(C){let S=i.get(C);return C.samples>0&&e.has("WEBGL_multisampled_render_to_texture")===!0&&S.__useRenderToTexture!==!1}function Gt(C){let S=o.render.frame;h.get(C)!==S&&(h.set(C,S),C.update())}function Ge(C,S){let Y=C.colorSpace,fe=C.format,ae=C.type;return C.isCompressedTexture===!0||C.isVideoTexture===!0||Y!==xl&&Y!==nr&&(bt.getTransfer(Y)===Ft?(fe!==ss||ae!==di)&&Je("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):st("WebGLTextures: Unsupported texture color space:",Y)),S}function Ze(C){return typeof HTMLImageElement<"u"&&C instanceof HTMLImageElement?(c.width=C.naturalWidth||C.width,c.height=C.naturalHeight||C.height):typeof VideoFrame<"u"&&C instanceof VideoFrame?(c.width=C.displayWidth,c.height=C.displayHeight):(c.width=C.width,c.height=C.height),c}this.allocateTextureUnit=he,this.resetTextureUnits=ee,this.getTextureUnits=se,this.setTextureUnits=de,this.setTexture2D=me,this.setTexture2DArray=ve,this.setTexture3D=Me,this.setTextureCube=xe,this.rebindTextures=an,this.setupRenderTarget=vn,this.updateRenderTargetMipmap=F,this.updateMultisampleRenderTarget=je,this.setupDepthRenderbuffer=Tn,this.setupFrameBufferTexture=Vt,this.useMultisampledRTT=Te,this.dispose=X}function lC(n,e){function t(i,s=nr){let r,o=bt.getTransfer(s);if(i===di)return n.UNSIGNED_BYTE;if(i===uu)return n.UNSIGNED_SHORT_4_4_4_4;if(i===fu)return n.UNSIGNED_SHORT_5_5_5_1;if(i===wp)return n.UNSIGNED_INT_5_9_9_9_REV;if(i===Tp)return n.UNSIGNED_INT_10F_11F_11F_REV;if(i===bp)return n.BYTE;if(i===Mp)return n.SHORT;if(i===da)return n.UNSIGNED_SHORT;if(i===hu)return n.INT;if(i===ts)return n.UNSIGNED_INT;if(i===ns)return n.FLOAT;if(i===is)return n.HALF_FLOAT;if(i===Ep)return n.ALPHA;if(i===Ap)return n.RGB;if(i===ss)return n.RGBA;if(i===Zs)return n.DEPTH_COMPONENT;if(i===tr)return n.DEPTH_STENCIL;if(i===Cp)return n.RED;if(i===du)return n.RED_INTEGER;if(i===Ir)return n.RG;if(i===pu)return n.RG_INTEGER;if(i===mu)return n.RGBA_INTEGER;if(i===Yl||i===$l||i===Zl||i===Kl)if(o===Ft)if(r=e.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(i===Yl)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(i===$l)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(i===Zl)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(i===Kl)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=e.get("WEBGL_compressed_texture_s3tc"),r!==null){if(i===Yl)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(i===$l)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(i===Zl)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(i===Kl)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(i===gu||i===vu||i===yu||i===_u)if(r=e.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(i===gu)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(i===vu)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(i===yu)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(i===_u)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(i===xu||i===Su||i===bu||i===Mu||i===wu||i===Jl||i===Tu)if(r=e.get("WEBGL_compressed_texture_etc"),r!==null){if(i===xu||i===Su)return o===Ft?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(i===bu)return o===Ft?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC;if(i===Mu)return r.COMPRESSED_R11_EAC;if(i===wu)return r.COMPRESSED_SIGNED_R11_EAC;if(i===Jl)return r.COMPRESSED_RG11_EAC;if(i===Tu)return r.COMPRESSED_SIGNED_RG11_EAC}else return null;if(i===Eu||i===Au||i===Cu||i===Ru||i===Pu||i===Iu||i===Du||i===Lu||i===Nu||i===Uu||i===Fu||i===Ou||i===ku||i===Bu)if(r=e.get("WEBGL_compressed_texture_astc"),r!==null){if(i===Eu)return o===Ft?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(i===Au)return o===Ft?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(i===Cu)return o===Ft?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(i===Ru)return o===Ft?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(i===Pu)return o===Ft?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(i===Iu)return o===Ft?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(i===Du)return o===Ft?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(i===Lu)return o===Ft?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(i===Nu)return o===Ft?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(i===Uu)return o===Ft?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(i===Fu)return o===Ft?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(i===Ou)return o===Ft?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(i===ku)return o===Ft?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(i===Bu)return o===Ft?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(i===zu||i===Vu||i===Hu)if(r=e.get("EXT_texture_compression_bptc"),r!==null){if(i===zu)return o===Ft?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(i===Vu)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(i===Hu)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(i===Gu||i===Wu||i===jl||i===Xu)if(r=e.get("EXT_texture_compression_rgtc"),r!==null){if(i===Gu)return r.COMPRESSED_RED_RGTC1_EXT;if(i===Wu)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(i===jl)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(i===Xu)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return i===io?n.UNSIGNED_INT_24_8:n[i]!==void 0?n[i]:null}return{convert:t}}var cC=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,hC=`
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

}`,Jp=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(e,t){if(this.texture===null){let i=new Ll(e.texture);(e.depthNear!==t.depthNear||e.depthFar!==t.depthFar)&&(this.depthNear=e.depthNear,this.depthFar=e.depthFar),this.texture=i}}getMesh(e){if(this.texture!==null&&this.mesh===null){let t=e.cameras[0].viewport,i=new Ts({vertexShader:cC,fragmentShader:hC,uniforms:{depthColor:{value:this.texture},depthWidth:{value:t.z},depthHeight:{value:t.w}}});this.mesh=new Gn(new Ul(20,20),i)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},jp=class extends ji{constructor(e,t){super();let i=this,s=null,r=1,o=null,a="local-floor",l=1,c=null,h=null,u=null,f=null,d=null,g=null,_=typeof XRWebGLBinding<"u",m=new Jp,p={},x=t.getContextAttributes(),A=null,w=null,P=[],E=[],y=new $e,T=null,k=null,N=new oi;N.viewport=new rn;let I=new oi;I.viewport=new rn;let z=[N,I],W=new ru,L=null,X=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(te){let me=P[te];return me===void 0&&(me=new sa,P[te]=me),me.getTargetRaySpace()},this.getControllerGrip=function(te){let me=P[te];return me===void 0&&(me=new sa,P[te]=me),me.getGripSpace()},this.getHand=function(te){let me=P[te];return me===void 0&&(me=new sa,P[te]=me),me.getHandSpace()};function $(te){let me=E.indexOf(te.inputSource);if(me===-1)return;let ve=P[me];ve!==void 0&&(ve.update(te.inputSource,te.frame,c||o),ve.dispatchEvent({type:te.type,data:te.inputSource}))}function V(){s.removeEventListener("select",$),s.removeEventListener("selectstart",$),s.removeEventListener("selectend",$),s.removeEventListener("squeeze",$),s.removeEventListener("squeezestart",$),s.removeEventListener("squeezeend",$),s.removeEventListener("end",V),s.removeEventListener("inputsourceschange",ce);for(let te=0;te<P.length;te++){let me=E[te];me!==null&&(E[te]=null,P[te].disconnect(me))}L=null,X=null,m.reset();for(let te in p)delete p[te];if(e.setRenderTarget(A),d=null,f=null,u=null,s=null,w=null,he.stop(),i.isPresenting=!1,e.setPixelRatio(T),e.setSize(y.width,y.height,!1),k!==null){let te=k.camera;te.fov=k.fov,te.zoom=k.zoom,te.updateProjectionMatrix(),k=null}i.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(te){r=te,i.isPresenting===!0&&Je("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(te){a=te,i.isPresenting===!0&&Je("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return c||o},this.setReferenceSpace=function(te){c=te},this.getBaseLayer=function(){return f!==null?f:d},this.getBinding=function(){return u===null&&_&&(u=new XRWebGLBinding(s,t)),u},this.getFrame=function(){return g},this.getSession=function(){return s},this.setSession=async function(te){if(s=te,s!==null){if(A=e.getRenderTarget(),s.addEventListener("select",$),s.addEventListener("selectstart",$),s.addEventListener("selectend",$),s.addEventListener("squeeze",$),s.addEventListener("squeezestart",$),s.addEventListener("squeezeend",$),s.addEventListener("end",V),s.addEventListener("inputsourceschange",ce),x.xrCompatible!==!0&&await t.makeXRCompatible(),T=e.getPixelRatio(),e.getSize(y),_&&"createProjectionLayer"in XRWebGLBinding.prototype){let ve=null,Me=null,xe=null;x.depth&&(xe=x.stencil?t.DEPTH24_STENCIL8:t.DEPTH_COMPONENT24,ve=x.stencil?tr:Zs,Me=x.stencil?io:ts);let We={colorFormat:t.RGBA8,depthFormat:xe,scaleFactor:r};u=this.getBinding(),f=u.createProjectionLayer(We),s.updateRenderState({layers:[f]}),e.setPixelRatio(1),e.setSize(f.textureWidth,f.textureHeight,!1),w=new Ri(f.textureWidth,f.textureHeight,{format:ss,type:di,depthTexture:new Qs(f.textureWidth,f.textureHeight,Me,void 0,void 0,void 0,void 0,void 0,void 0,ve),stencilBuffer:x.stencil,colorSpace:e.outputColorSpace,samples:x.antialias?4:0,resolveDepthBuffer:f.ignoreDepthValues===!1,resolveStencilBuffer:f.ignoreDepthValues===!1,storeMultisampledDepthBuffer:f.ignoreDepthValues===!1,storeMultisampledStencilBuffer:f.ignoreDepthValues===!1})}else{let ve={antialias:x.antialias,alpha:!0,depth:x.depth,stencil:x.stencil,framebufferScaleFactor:r};d=new XRWebGLLayer(s,t,ve),s.updateRenderState({baseLayer:d}),e.setPixelRatio(1),e.setSize(d.framebufferWidth,d.framebufferHeight,!1),w=new Ri(d.framebufferWidth,d.framebufferHeight,{format:ss,type:di,colorSpace:e.outputColorSpace,stencilBuffer:x.stencil,resolveDepthBuffer:d.ignoreDepthValues===!1,resolveStencilBuffer:d.ignoreDepthValues===!1,storeMultisampledDepthBuffer:d.ignoreDepthValues===!1,storeMultisampledStencilBuffer:d.ignoreDepthValues===!1})}w.isXRRenderTarget=!0,this.setFoveation(l),c=null,o=await s.requestReferenceSpace(a),he.setContext(s),he.start(),i.isPresenting=!0,i.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode},this.getDepthTexture=function(){return m.getDepthTexture()};function ce(te){for(let me=0;me<te.removed.length;me++){let ve=te.removed[me],Me=E.indexOf(ve);Me>=0&&(E[Me]=null,P[Me].disconnect(ve))}for(let me=0;me<te.added.length;me++){let ve=te.added[me],Me=E.indexOf(ve);if(Me===-1){for(let We=0;We<P.length;We++)if(We>=E.length){E.push(ve),Me=We;break}else if(E[We]===null){E[We]=ve,Me=We;break}if(Me===-1)break}let xe=P[Me];xe&&xe.connect(ve)}}function K(te,me){me===null?te.matrixWorld.copy(te.matrix):te.matrixWorld.multiplyMatrices(me.matrixWorld,te.matrix),te.matrixWorldInverse.copy(te.matrixWorld).invert()}this.updateCamera=function(te){if(s===null)return;let me=te.near,ve=te.far;m.texture!==null&&(m.depthNear>0&&(me=m.depthNear),m.depthFar>0&&(ve=m.depthFar)),W.near=I.near=N.near=me,W.far=I.far=N.far=ve,(L!==W.near||X!==W.far)&&(s.updateRenderState({depthNear:W.near,depthFar:W.far}),L=W.near,X=W.far),W.layers.mask=te.layers.mask|6,N.layers.mask=W.layers.mask&-5,I.layers.mask=W.layers.mask&-3;let Me=te.parent,xe=W.cameras;K(W,Me);for(let We=0;We<xe.length;We++)K(xe[We],Me);W.projectionMatrix.copy(N.projectionMatrix),W.projectionMatrixInverse.copy(N.projectionMatrixInverse),k===null&&te.isPerspectiveCamera&&(k={camera:te,fov:te.fov,zoom:te.zoom}),ee(te,W,Me)};function ee(te,me,ve){ve===null?te.matrix.copy(me.matrixWorld):(te.matrix.copy(ve.matrixWorld),te.matrix.invert(),te.matrix.multiply(me.matrixWorld)),te.matrix.decompose(te.position,te.quaternion,te.scale),te.updateMatrixWorld(!0),te.projectionMatrix.copy(me.projectionMatrix),te.projectionMatrixInverse.copy(me.projectionMatrixInverse),te.isPerspectiveCamera&&(te.fov=na*2*Math.atan(1/te.projectionMatrix.elements[5]),te.zoom=1)}this.getCamera=function(){return W},this.getFoveation=function(){if(!(f===null&&d===null))return l},this.setFoveation=function(te){l=te,f!==null&&(f.fixedFoveation=te),d!==null&&d.fixedFoveation!==void 0&&(d.fixedFoveation=te)},this.hasDepthSensing=function(){return m.texture!==null},this.getDepthSensingMesh=function(){return m.getMesh(W)},this.getCameraTexture=function(te){return p[te]};let se=null;function de(te,me){if(h=me.getViewerPose(c||o),g=me,h!==null){let ve=h.views;d!==null&&(e.setRenderTargetFramebuffer(w,d.framebuffer),e.setRenderTarget(w));let Me=!1;ve.length!==W.cameras.length&&(W.cameras.length=0,Me=!0);for(let He=0;He<ve.length;He++){let ut=ve[He],ht=null;if(d!==null)ht=d.getViewport(ut);else{let nn=u.getViewSubImage(f,ut);ht=nn.viewport,He===0&&(e.setRenderTargetTextures(w,nn.colorTexture,nn.depthStencilTexture),e.setRenderTarget(w))}let at=z[He];at===void 0&&(at=new oi,at.layers.enable(He),at.viewport=new rn,z[He]=at),at.matrix.fromArray(ut.transform.matrix),at.matrix.decompose(at.position,at.quaternion,at.scale),at.projectionMatrix.fromArray(ut.projectionMatrix),at.projectionMatrixInverse.copy(at.projectionMatrix).invert(),at.viewport.set(ht.x,ht.y,ht.width,ht.height),He===0&&(W.matrix.copy(at.matrix),W.matrix.decompose(W.position,W.quaternion,W.scale)),Me===!0&&W.cameras.push(at)}let xe=s.enabledFeatures;if(xe&&xe.includes("depth-sensing")&&s.depthUsage=="gpu-optimized"&&_){u=i.getBinding();let He=u.getDepthInformation(ve[0]);He&&He.isValid&&He.texture&&m.init(He,s.renderState)}if(xe&&xe.includes("camera-access")&&_){e.state.unbindTexture(),u=i.getBinding();for(let He=0;He<ve.length;He++){let ut=ve[He].camera;if(ut){let ht=p[ut];ht||(ht=new Ll,p[ut]=ht);let at=u.getCameraImage(ut);ht.sourceTexture=at}}}}for(let ve=0;ve<P.length;ve++){let Me=E[ve],xe=P[ve];Me!==null&&xe!==void 0&&xe.update(Me,me,c||o)}se&&se(te,me),me.detectedPlanes&&i.dispatchEvent({type:"planesdetected",data:me}),g=null}let he=new Fy;he.setAnimationLoop(de),this.setAnimationLoop=function(te){se=te},this.dispose=function(){}}},uC=new Dt,qy=new Qe;qy.set(-1,0,0,0,1,0,0,0,1);function fC(n,e){function t(m,p){m.matrixAutoUpdate===!0&&m.updateMatrix(),p.value.copy(m.matrix)}function i(m,p){p.color.getRGB(m.fogColor.value,Bp(n)),p.isFog?(m.fogNear.value=p.near,m.fogFar.value=p.far):p.isFogExp2&&(m.fogDensity.value=p.density)}function s(m,p,x,A,w){p.isNodeMaterial?p.uniformsNeedUpdate=!1:p.isMeshBasicMaterial?r(m,p):p.isMeshLambertMaterial?(r(m,p),p.envMap&&(m.envMapIntensity.value=p.envMapIntensity)):p.isMeshToonMaterial?(r(m,p),u(m,p)):p.isMeshPhongMaterial?(r(m,p),h(m,p),p.envMap&&(m.envMapIntensity.value=p.envMapIntensity)):p.isMeshStandardMaterial?(r(m,p),f(m,p),p.isMeshPhysicalMaterial&&d(m,p,w)):p.isMeshMatcapMaterial?(r(m,p),g(m,p)):p.isMeshDepthMaterial?r(m,p):p.isMeshDistanceMaterial?(r(m,p),_(m,p)):p.isMeshNormalMaterial?r(m,p):p.isLineBasicMaterial?(o(m,p),p.isLineDashedMaterial&&a(m,p)):p.isPointsMaterial?l(m,p,x,A):p.isSpriteMaterial?c(m,p):p.isShadowMaterial?(m.color.value.copy(p.color),m.opacity.value=p.opacity):p.isShaderMaterial&&(p.uniformsNeedUpdate=!1)}function r(m,p){m.opacity.value=p.opacity,p.color&&m.diffuse.value.copy(p.color),p.emissive&&m.emissive.value.copy(p.emissive).multiplyScalar(p.emissiveIntensity),p.map&&(m.map.value=p.map,t(p.map,m.mapTransform)),p.alphaMap&&(m.alphaMap.value=p.alphaMap,t(p.alphaMap,m.alphaMapTransform)),p.bumpMap&&(m.bumpMap.value=p.bumpMap,t(p.bumpMap,m.bumpMapTransform),m.bumpScale.value=p.bumpScale,p.side===hi&&(m.bumpScale.value*=-1)),p.normalMap&&(m.normalMap.value=p.normalMap,t(p.normalMap,m.normalMapTransform),m.normalScale.value.copy(p.normalScale),p.side===hi&&m.normalScale.value.negate()),p.displacementMap&&(m.displacementMap.value=p.displacementMap,t(p.displacementMap,m.displacementMapTransform),m.displacementScale.value=p.displacementScale,m.displacementBias.value=p.displacementBias),p.emissiveMap&&(m.emissiveMap.value=p.emissiveMap,t(p.emissiveMap,m.emissiveMapTransform)),p.specularMap&&(m.specularMap.value=p.specularMap,t(p.specularMap,m.specularMapTransform)),p.alphaTest>0&&(m.alphaTest.value=p.alphaTest);let x=e.get(p),A=x.envMap,w=x.envMapRotation;A&&(m.envMap.value=A,m.envMapRotation.value.setFromMatrix4(uC.makeRotationFromEuler(w)).transpose(),A.isCubeTexture&&A.isRenderTargetTexture===!1&&m.envMapRotation.value.premultiply(qy),m.reflectivity.value=p.reflectivity,m.ior.value=p.ior,m.refractionRatio.value=p.refractionRatio),p.lightMap&&(m.lightMap.value=p.lightMap,m.lightMapIntensity.value=p.lightMapIntensity,t(p.lightMap,m.lightMapTransform)),p.aoMap&&(m.aoMap.value=p.aoMap,m.aoMapIntensity.value=p.aoMapIntensity,t(p.aoMap,m.aoMapTransform))}function o(m,p){m.diffuse.value.copy(p.color),m.opacity.value=p.opacity,p.map&&(m.map.value=p.map,t(p.map,m.mapTransform))}function a(m,p){m.dashSize.value=p.dashSize,m.totalSize.value=p.dashSize+p.gapSize,m.scale.value=p.scale}function l(m,p,x,A){m.diffuse.value.copy(p.color),m.opacity.value=p.opacity,m.size.value=p.size*x,m.scale.value=A*.5,p.map&&(m.map.value=p.map,t(p.map,m.uvTransform)),p.alphaMap&&(m.alphaMap.value=p.alphaMap,t(p.alphaMap,m.alphaMapTransform)),p.alphaTest>0&&(m.alphaTest.value=p.alphaTest)}function c(m,p){m.diffuse.value.copy(p.color),m.opacity.value=p.opacity,m.rotation.value=p.rotation,p.map&&(m.map.value=p.map,t(p.map,m.mapTransform)),p.alphaMap&&(m.alphaMap.value=p.alphaMap,t(p.alphaMap,m.alphaMapTransform)),p.alphaTest>0&&(m.alphaTest.value=p.alphaTest)}function h(m,p){m.specular.value.copy(p.specular),m.shininess.value=Math.max(p.shininess,1e-4)}function u(m,p){p.gradientMap&&(m.gradientMap.value=p.gradientMap)}function f(m,p){m.metalness.value=p.metalness,p.metalnessMap&&(m.metalnessMap.value=p.metalnessMap,t(p.metalnessMap,m.metalnessMapTransform)),m.roughness.value=p.roughness,p.roughnessMap&&(m.roughnessMap.value=p.roughnessMap,t(p.roughnessMap,m.roughnessMapTransform)),p.envMap&&(m.envMapIntensity.value=p.envMapIntensity)}function d(m,p,x){m.ior.value=p.ior,p.diffuseRoughness>0&&(m.diffuseRoughness.value=p.diffuseRoughness,p.diffuseRoughnessMap&&(m.diffuseRoughnessMap.value=p.diffuseRoughnessMap,t(p.diffuseRoughnessMap,m.diffuseRoughnessMapTransform))),p.sheen>0&&(m.sheenColor.value.copy(p.sheenColor).multiplyScalar(p.sheen),m.sheenRoughness.value=p.sheenRoughness,p.sheenColorMap&&(m.sheenColorMap.value=p.sheenColorMap,t(p.sheenColorMap,m.sheenColorMapTransform)),p.sheenRoughnessMap&&(m.sheenRoughnessMap.value=p.sheenRoughnessMap,t(p.sheenRoughnessMap,m.sheenRoughnessMapTransform))),p.clearcoat>0&&(m.clearcoat.value=p.clearcoat,m.clearcoatRoughness.value=p.clearcoatRoughness,p.clearcoatMap&&(m.clearcoatMap.value=p.clearcoatMap,t(p.clearcoatMap,m.clearcoatMapTransform)),p.clearcoatRoughnessMap&&(m.clearcoatRoughnessMap.value=p.clearcoatRoughnessMap,t(p.clearcoatRoughnessMap,m.clearcoatRoughnessMapTransform)),p.clearcoatNormalMap&&(m.clearcoatNormalMap.value=p.clearcoatNormalMap,t(p.clearcoatNormalMap,m.clearcoatNormalMapTransform),m.clearcoatNormalScale.value.copy(p.clearcoatNormalScale),p.side===hi&&m.clearcoatNormalScale.value.negate())),p.dispersion>0&&(m.dispersion.value=p.dispersion),p.retroreflectivity>0&&(m.retroreflectivity.value=p.retroreflectivity),p.iridescence>0&&(m.iridescence.value=p.iridescence,m.iridescenceIOR.value=p.iridescenceIOR,m.iridescenceThicknessMinimum.value=p.iridescenceThicknessMinimum,m.iridescenceThicknessMaximum.value=p.iridescenceThicknessMaximum,p.iridescenceMap&&(m.iridescenceMap.value=p.iridescenceMap,t(p.iridescenceMap,m.iridescenceMapTransform)),p.iridescenceThicknessMap&&(m.iridescenceThicknessMap.value=p.iridescenceThicknessMap,t(p.iridescenceThicknessMap,m.iridescenceThicknessMapTransform))),p.transmission>0&&(m.transmission.value=p.transmission,m.transmissionSamplerMap.value=x.texture,m.transmissionSamplerSize.value.set(x.width,x.height),p.transmissionMap&&(m.transmissionMap.value=p.transmissionMap,t(p.transmissionMap,m.transmissionMapTransform)),m.thickness.value=p.thickness,p.thicknessMap&&(m.thicknessMap.value=p.thicknessMap,t(p.thicknessMap,m.thicknessMapTransform)),m.attenuationDistance.value=p.attenuationDistance,m.attenuationColor.value.copy(p.attenuationColor)),p.anisotropy>0&&(m.anisotropyVector.value.set(p.anisotropy*Math.cos(p.anisotropyRotation),p.anisotropy*Math.sin(p.anisotropyRotation)),p.anisotropyMap&&(m.anisotropyMap.value=p.anisotropyMap,t(p.anisotropyMap,m.anisotropyMapTransform))),m.specularIntensity.value=p.specularIntensity,m.specularColor.value.copy(p.specularColor),p.specularColorMap&&(m.specularColorMap.value=p.specularColorMap,t(p.specularColorMap,m.specularColorMapTransform)),p.specularIntensityMap&&(m.specularIntensityMap.value=p.specularIntensityMap,t(p.specularIntensityMap,m.specularIntensityMapTransform))}function g(m,p){p.matcap&&(m.matcap.value=p.matcap)}function _(m,p){let x=e.get(p).light;m.referencePosition.value.setFromMatrixPosition(x.matrixWorld),m.nearDistance.value=x.shadow.camera.near,m.farDistance.value=x.shadow.camera.far}return{refreshFogUniforms:i,refreshMaterialUniforms:s}}function dC(n,e,t,i){let s={},r={};function o(x,A){let w=A.program;i.uniformBlockBinding(x,w,s[x.id])}function a(x,A){let w=s[x.id];w===void 0&&(g(x),w=l(x),s[x.id]=w,x.addEventListener("dispose",m));let P=A.program;i.updateUBOMapping(x,P);let E=e.render.frame;r[x.id]!==E&&(c(x),r[x.id]=E)}function l(x){let A=n.createBuffer(),w=x.__size,P=x.usage;return n.bindBuffer(n.UNIFORM_BUFFER,A),n.bufferData(n.UNIFORM_BUFFER,w,P),n.bindBuffer(n.UNIFORM_BUFFER,null),A}function c(x){let A=s[x.id],w=x.uniforms,P=x.__cache;n.bindBuffer(n.UNIFORM_BUFFER,A);for(let E=0,y=w.length;E<y;E++){let T=w[E];if(Array.isArray(T))for(let k=0,N=T.length;k<N;k++)h(T[k],E,k,P);else h(T,E,0,P)}n.bindBuffer(n.UNIFORM_BUFFER,null)}function h(x,A,w,P){if(f(x,A,w,P)===!0){let E=x.__offset,y=x.value;if(Array.isArray(y)){let T=0;for(let k=0;k<y.length;k++){let N=y[k],I=_(N,!0);u(N,x.__data,T),T+=I.storage/Float32Array.BYTES_PER_ELEMENT}}else u(y,x.__data,0);n.bufferSubData(n.UNIFORM_BUFFER,E,x.__data)}}function u(x,A,w){typeof x=="number"||typeof x=="boolean"?A[w]=x:x.isMatrix3?(A[w]=x.elements[0],A[w+1]=x.elements[1],A[w+2]=x.elements[2],A[w+3]=0,A[w+4]=x.elements[3],A[w+5]=x.elements[4],A[w+6]=x.elements[5],A[w+7]=0,A[w+8]=x.elements[6],A[w+9]=x.elements[7],A[w+10]=x.elements[8],A[w+11]=0):ArrayBuffer.isView(x)?A.set(x.subarray(0,A.length-w),w):x.toArray(A,w)}function f(x,A,w,P){let E=x.value,y=A+"_"+w;if(Array.isArray(E)){P[y]===void 0&&(P[y]=[]);let T=P[y],k=!1;for(let N=0;N<E.length;N++)d(E[N],T,N)===!0&&(k=!0);return k}return d(E,P,y)}function d(x,A,w){if(A[w]===void 0)return typeof x=="number"||typeof x=="boolean"?A[w]=x:ArrayBuffer.isView(x)?A[w]=x.slice():A[w]=x.clone(),!0;{let P=A[w];if(typeof x=="number"||typeof x=="boolean"){if(P!==x)return A[w]=x,!0}else{if(ArrayBuffer.isView(x))return!0;if(P.equals(x)===!1)return P.copy(x),!0}}return!1}function g(x){let A=x.uniforms,w=0,P=16;for(let y=0,T=A.length;y<T;y++){let k=Array.isArray(A[y])?A[y]:[A[y]];for(let N=0,I=k.length;N<I;N++){let z=k[N],W=Array.isArray(z.value)?z.value:[z.value],L=Array.isArray(A[y])||Array.isArray(z.value),X=w;for(let V=0,ce=W.length;V<ce;V++){let K=W[V],ee=_(K,L),se=w%P,de=se%ee.boundary,he=se+de;w+=de,he!==0&&P-he<ee.storage&&(w+=P-he),V===0&&(X=w),w+=ee.storage}let $=z.type==="int"?Int32Array:z.type==="uint"?Uint32Array:Float32Array;z.__data=new $((w-X)/Float32Array.BYTES_PER_ELEMENT),z.__offset=X}}let E=w%P;return E>0&&(w+=P-E),x.__size=w,x.__cache={},this}function _(x,A){let w={boundary:0,storage:0};return typeof x=="number"||typeof x=="boolean"?(w.boundary=4,w.storage=4):x.isVector2?(w.boundary=8,w.storage=8):x.isVector3||x.isColor?(w.boundary=16,w.storage=12):x.isVector4?(w.boundary=16,w.storage=16):x.isMatrix3?(w.boundary=16,w.storage=48):x.isMatrix4?(w.boundary=16,w.storage=64):x.isTexture?Je("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(x)?(w.boundary=16,w.storage=x.byteLength):Je("WebGLRenderer: Unsupported uniform value type.",x),A===!0&&(w.boundary=16,w.storage=Math.ceil(w.storage/16)*16),w}function m(x){let A=x.target;A.removeEventListener("dispose",m),n.deleteBuffer(s[A.id]),delete s[A.id],delete r[A.id]}function p(){for(let x in s)n.deleteBuffer(s[x]);s={},r={}}return{bind:o,update:a,dispose:p}}var pC=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),As=null;function mC(){return As===null&&(As=new oa(pC,16,16,Ir,is),As.name="DFG_LUT",As.minFilter=ai,As.magFilter=ai,As.wrapS=Ms,As.wrapT=Ms,As.generateMipmaps=!1,As.needsUpdate=!0),As}var Ju=class{constructor(e={}){let{canvas:t=oy(),context:i=null,depth:s=!0,stencil:r=!1,alpha:o=!1,antialias:a=!1,premultipliedAlpha:l=!0,preserveDrawingBuffer:c=!1,powerPreference:h="default",failIfMajorPerformanceCaveat:u=!1,reversedDepthBuffer:f=!1,outputBufferType:d=di}=e;this.isWebGLRenderer=!0;let g;if(i!==null){if(typeof WebGLRenderingContext<"u"&&i instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");g=i.getContextAttributes().alpha}else g=o;let _=d,m=new Set([mu,pu,du]),p=new Set([di,ts,da,io,uu,fu]),x=new Uint32Array(4),A=new Int32Array(4),w={textures:[],min:[],max:[],resolution:[]},P=null,E=null,y=[],T=[],k=null;this.domElement=t,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=Es,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let N=this,I=!1,z=null,W=null,L=null,X=null;this._outputColorSpace=Ai;let $=0,V=0,ce=null,K=-1,ee=null,se=new rn,de=new rn,he=null,te=new Ke(0),me=0,ve=t.width,Me=t.height,xe=1,We=null,ot=null,He=new rn(0,0,ve,Me),ut=new rn(0,0,ve,Me),ht=!1,at=new br,nn=new Vh,qt=!1,gn=!1,Vt=new Dt,Nn=new O,wt=new rn,Tn={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},an=!1;function vn(){return ce===null?xe:1}let F=i;function Pe(M,B){return t.getContext(M,B)}let je,ct,Te,Gt,Ge,Ze,C,S,Y,fe,ae,_e,Se,ne,re,ge,U,oe,ie,Ee,ye,we,Xe;try{let M={alpha:!0,depth:s,stencil:r,antialias:a,premultipliedAlpha:l,preserveDrawingBuffer:c,powerPreference:h,failIfMajorPerformanceCaveat:u};if("setAttribute"in t&&t.setAttribute("data-engine",`three.js r${"187"}`),t.addEventListener("webglcontextlost",Be,!1),t.addEventListener("webglcontextrestored",nt,!1),t.addEventListener("webglcontextcreationerror",Re,!1),F===null){let B="webgl2";if(F=Pe(B,M),F===null)throw Pe(B)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}tt()}catch(M){throw t.removeEventListener("webglcontextlost",Be,!1),t.removeEventListener("webglcontextrestored",nt,!1),t.removeEventListener("webglcontextcreationerror",Re,!1),st("WebGLRenderer: "+M.message),M}function tt(){je=new EE(F),je.init(),ye=new lC(F,je),ct=new mE(F,je,e,ye),Te=new oC(F,je),ct.reversedDepthBuffer&&f&&Te.buffers.depth.setReversed(!0),W=F.createFramebuffer(),L=F.createFramebuffer(),X=F.createFramebuffer(),Gt=new RE(F),Ge=new qA,Ze=new aC(F,je,Te,Ge,ct,ye,Gt),C=new TE(N),S=new Iw(F),we=new dE(F,S),Y=new AE(F,S,Gt,we),fe=new IE(F,Y,S,we,Gt),oe=new PE(F,ct,Ze),re=new gE(Ge),ae=new XA(N,C,je,ct,we,re),_e=new fC(N,Ge),Se=new $A,ne=new eC(je),U=new fE(N,C,Te,fe,g,l),ge=new rC(N,fe,ct),Xe=new dC(F,Gt,ct,Te),ie=new pE(F,je,Gt),Ee=new CE(F,je,Gt),Gt.programs=ae.programs,N.capabilities=ct,N.extensions=je,N.properties=Ge,N.renderLists=Se,N.shadowMap=ge,N.state=Te,N.info=Gt}_!==di&&(k=new LE(_,t.width,t.height,a,s,r));let ue=new jp(N,F);this.xr=ue,this.getContext=function(){return F},this.getContextAttributes=function(){return F.getContextAttributes()},this.forceContextLoss=function(){let M=je.get("WEBGL_lose_context");M&&M.loseContext()},this.forceContextRestore=function(){let M=je.get("WEBGL_lose_context");M&&M.restoreContext()},this.getPixelRatio=function(){return xe},this.setPixelRatio=function(M){M!==void 0&&(xe=M,this.setSize(ve,Me,!1))},this.getSize=function(M){return M.set(ve,Me)},this.setSize=function(M,B,Q=!0){if(ue.isPresenting){Je("WebGLRenderer: Can't change size while VR device is presenting.");return}ve=M,Me=B,t.width=Math.floor(M*xe),t.height=Math.floor(B*xe),Q===!0&&(t.style.width=M+"px",t.style.height=B+"px"),k!==null&&k.setSize(t.width,t.height),this.setViewport(0,0,M,B)},this.getDrawingBufferSize=function(M){return M.set(ve*xe,Me*xe).floor()},this.setDrawingBufferSize=function(M,B,Q){ve=M,Me=B,xe=Q,t.width=Math.floor(M*Q),t.height=Math.floor(B*Q),this.setViewport(0,0,M,B)},this.setEffects=function(M){if(_===di){st("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(M){for(let B=0;B<M.length;B++)if(M[B].isOutputPass===!0){Je("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}k.setEffects(M||[])},this.getCurrentViewport=function(M){return M.copy(se)},this.getViewport=function(M){return M.copy(He)},this.setViewport=function(M,B,Q,Z){M.isVector4?He.set(M.x,M.y,M.z,M.w):He.set(M,B,Q,Z),Te.viewport(se.copy(He).multiplyScalar(vn()).round())},this.getScissor=function(M){return M.copy(ut)},this.setScissor=function(M,B,Q,Z){M.isVector4?ut.set(M.x,M.y,M.z,M.w):ut.set(M,B,Q,Z),Te.scissor(de.copy(ut).multiplyScalar(vn()).round())},this.getScissorTest=function(){return ht},this.setScissorTest=function(M){Te.setScissorTest(ht=M)},this.setOpaqueSort=function(M){We=M},this.setTransparentSort=function(M){ot=M},this.getClearColor=function(M){return M.copy(U.getClearColor())},this.setClearColor=function(){U.setClearColor(...arguments)},this.getClearAlpha=function(){return U.getClearAlpha()},this.setClearAlpha=function(){U.setClearAlpha(...arguments)},this.clear=function(M=!0,B=!0,Q=!0){let Z=0;if(M){let J=!1;if(ce!==null){let Ae=ce.texture.format;J=m.has(Ae)}if(J){let Ae=ce.texture.type,Ie=p.has(Ae),Ce=U.getClearColor(),De=U.getClearAlpha(),Ve=Ce.r,rt=Ce.g,gt=Ce.b;Ie?(x[0]=Ve,x[1]=rt,x[2]=gt,x[3]=De,F.clearBufferuiv(F.COLOR,0,x)):(A[0]=Ve,A[1]=rt,A[2]=gt,A[3]=De,F.clearBufferiv(F.COLOR,0,A))}else Z|=F.COLOR_BUFFER_BIT}B&&(Z|=F.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),Q&&(Z|=F.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),Z!==0&&F.clear(Z)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(M){M.setRenderer(this),z=M},this.dispose=function(){t.removeEventListener("webglcontextlost",Be,!1),t.removeEventListener("webglcontextrestored",nt,!1),t.removeEventListener("webglcontextcreationerror",Re,!1),U.dispose(),Se.dispose(),ne.dispose(),Ze.dispose(),Ge.dispose(),C.dispose(),fe.dispose(),Y.dispose(),we.dispose(),Xe.dispose(),ae.dispose(),ue.dispose(),ue.removeEventListener("sessionstart",mc),ue.removeEventListener("sessionend",hs),Is.stop()};function Be(M){M.preventDefault(),Ml("WebGLRenderer: Context Lost."),I=!0}function nt(){Ml("WebGLRenderer: Context Restored."),I=!1;let M=Gt.autoReset,B=ge.enabled,Q=ge.autoUpdate,Z=ge.needsUpdate,J=ge.type;tt(),Gt.autoReset=M,ge.enabled=B,ge.autoUpdate=Q,ge.needsUpdate=Z,ge.type=J}function Re(M){st("WebGLRenderer: A WebGL context could not be created. Reason: ",M.statusMessage)}function ft(M){let B=M.target;B.removeEventListener("dispose",ft),Zt(B)}function Zt(M){jn(M),Ge.remove(M)}function jn(M){let B=Ge.get(M).programs;B!==void 0&&(B.forEach(function(Q){ae.releaseProgram(Q)}),M.isShaderMaterial&&ae.releaseShaderCache(M))}this.renderBufferDirect=function(M,B,Q,Z,J,Ae){B===null&&(B=Tn);let Ie=J.isMesh&&J.matrixWorld.determinantAffine()<0,Ce=Na(M,B,Q,Z,J);Te.setMaterial(Z,Ie);let De=Q.index,Ve=1;if(Z.wireframe===!0){if(De=Y.getWireframeAttribute(Q),De===void 0)return;Ve=2}let rt=Q.drawRange,gt=Q.attributes.position,ze=rt.start*Ve,vt=(rt.start+rt.count)*Ve;Ae!==null&&(ze=Math.max(ze,Ae.start*Ve),vt=Math.min(vt,(Ae.start+Ae.count)*Ve)),De!==null?(ze=Math.max(ze,0),vt=Math.min(vt,De.count)):gt!=null&&(ze=Math.max(ze,0),vt=Math.min(vt,gt.count));let on=vt-ze;if(on<0||on===1/0)return;we.setup(J,Z,Ce,Q,De);let kt,Bt=ie;if(De!==null&&(kt=S.get(De),Bt=Ee,Bt.setIndex(kt)),J.isMesh)Z.wireframe===!0?(Te.setLineWidth(Z.wireframeLinewidth*vn()),Bt.setMode(F.LINES)):Bt.setMode(F.TRIANGLES);else if(J.isLine){let En=Z.linewidth;En===void 0&&(En=1),Te.setLineWidth(En*vn()),J.isLineSegments?Bt.setMode(F.LINES):J.isLineLoop?Bt.setMode(F.LINE_LOOP):Bt.setMode(F.LINE_STRIP)}else J.isPoints?Bt.setMode(F.POINTS):J.isSprite&&Bt.setMode(F.TRIANGLES);if(J.isBatchedMesh)if(je.get("WEBGL_multi_draw"))Bt.renderMultiDraw(J._multiDrawStarts,J._multiDrawCounts,J._multiDrawCount);else{let En=J._multiDrawStarts,Fe=J._multiDrawCounts,yn=J._multiDrawCount,xt=De?S.get(De).bytesPerElement:1,Ls=Ge.get(Z).currentProgram.getUniforms();for(let _n=0;_n<yn;_n++)Ls.setValue(F,"_gl_DrawID",_n),Bt.render(En[_n]/xt,Fe[_n])}else if(J.isInstancedMesh)Bt.renderInstances(ze,on,J.count);else if(Q.isInstancedBufferGeometry){let En=Q._maxInstanceCount!==void 0?Q._maxInstanceCount:1/0,Fe=Math.min(Q.instanceCount,En);Bt.renderInstances(ze,on,Fe)}else Bt.render(ze,on)};function Ia(M,B,Q,Z){z!==null&&M.isNodeMaterial&&z.setObject(Z,M),qt===!0&&re.setState(M,Q,!1),M.transparent===!0&&M.side===ui&&M.forceSinglePass===!1?(M.side=hi,M.needsUpdate=!0,us(M,B,Z),M.side=Pr,M.needsUpdate=!0,us(M,B,Z),M.side=ui):us(M,B,Z)}this.compile=function(M,B,Q=null){Q===null&&(Q=M),z!==null&&z.renderStart(M,B,Q),E=ne.get(Q),E.init(B),T.push(E),Q.traverseVisible(function(J){J.isLight&&J.layers.test(B.layers)&&(E.pushLight(J),J.castShadow&&E.pushShadow(J))}),M!==Q&&M.traverseVisible(function(J){J.isLight&&J.layers.test(B.layers)&&(E.pushLight(J),J.castShadow&&E.pushShadow(J))}),E.setupLights(),z!==null&&z.updateLights(E.state.lightsArray),gn=this.localClippingEnabled,qt=re.init(this.clippingPlanes,gn),qt===!0&&re.setGlobalState(this.clippingPlanes,B),z!==null&&ge.render(E.state.shadowsArray,Q,B);let Z=new Set;return M.traverse(function(J){if(!(J.isMesh||J.isPoints||J.isLine||J.isSprite))return;let Ae=J.material;if(Ae)if(Array.isArray(Ae))for(let Ie=0;Ie<Ae.length;Ie++){let Ce=Ae[Ie];Ia(Ce,Q,B,J),Z.add(Ce)}else Ia(Ae,Q,B,J),Z.add(Ae)}),E=T.pop(),z!==null&&z.renderEnd(),Z},this.compileAsync=function(M,B,Q=null){let Z=this.compile(M,B,Q);return new Promise(J=>{function Ae(){if(Z.forEach(function(Ie){let De=Ge.get(Ie).currentProgram;(De===void 0||De.isReady())&&Z.delete(Ie)}),Z.size===0){J(M);return}setTimeout(Ae,10)}je.get("KHR_parallel_shader_compile")!==null?Ae():setTimeout(Ae,10)})};let uo=null;function Bf(M){uo&&uo(M)}function mc(){Is.stop()}function hs(){Is.start()}let Is=new Fy;Is.setAnimationLoop(Bf),typeof self<"u"&&Is.setContext(self),this.setAnimationLoop=function(M){uo=M,ue.setAnimationLoop(M),M===null?Is.stop():Is.start()},ue.addEventListener("sessionstart",mc),ue.addEventListener("sessionend",hs),this.render=function(M,B){if(B!==void 0&&B.isCamera!==!0){st("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(I===!0)return;z!==null&&z.renderStart(M,B);let Q=ue.enabled===!0&&ue.isPresenting===!0,Z=k!==null&&(ce===null||Q)&&k.begin(N,ce);if(M.matrixWorldAutoUpdate===!0&&M.updateMatrixWorld(),B.parent===null&&B.matrixWorldAutoUpdate===!0&&B.updateMatrixWorld(),ue.enabled===!0&&ue.isPresenting===!0&&(k===null||k.isCompositing()===!1)&&(ue.cameraAutoUpdate===!0&&ue.updateCamera(B),B=ue.getCamera()),M.isScene===!0&&M.onBeforeRender(N,M,B,ce),E=ne.get(M,T.length),E.init(B),E.state.textureUnits=Ze.getTextureUnits(),T.push(E),Vt.multiplyMatrices(B.projectionMatrix,B.matrixWorldInverse),B.isArrayCamera?nn.setFromArrayCamera(B):at.setFromProjectionMatrix(Vt,Vi,B.reversedDepth),gn=this.localClippingEnabled,qt=re.init(this.clippingPlanes,gn),P=Se.get(M,y.length),P.init(),y.push(P),this.info.render.frame++,ue.enabled===!0&&ue.isPresenting===!0){let Ie=N.xr.getDepthSensingMesh();Ie!==null&&Ds(Ie,B,-1/0,N.sortObjects)}Ds(M,B,0,N.sortObjects),P.finish(),z!==null&&z.updateLights(E.state.lightsArray),N.sortObjects===!0&&P.sort(We,ot),an=ue.enabled===!1||ue.isPresenting===!1||ue.hasDepthSensing()===!1,an&&U.addToRenderList(P,M),this.info.autoReset===!0&&this.info.reset(),qt===!0&&re.beginShadows();let J=E.state.shadowsArray;if(ge.render(J,M,B),qt===!0&&re.endShadows(),(Z&&k.hasRenderPass())===!1){let Ie=P.opaque,Ce=P.transmissive;if(E.setupLights(),B.isArrayCamera){let De=B.cameras;if(Ce.length>0)for(let Ve=0,rt=De.length;Ve<rt;Ve++){let gt=De[Ve];Xi(Ie,Ce,M,gt)}an&&U.render(M);for(let Ve=0,rt=De.length;Ve<rt;Ve++){let gt=De[Ve];Da(P,M,gt,gt.viewport)}}else Ce.length>0&&Xi(Ie,Ce,M,B),an&&U.render(M),Da(P,M,B)}ce!==null&&V===0&&(Ze.updateMultisampleRenderTarget(ce),Ze.updateRenderTargetMipmap(ce)),Z&&k.end(N),M.isScene===!0&&M.onAfterRender(N,M,B),we.resetDefaultState(),K=-1,ee=null,T.pop(),T.length>0?(E=T[T.length-1],Ze.setTextureUnits(E.state.textureUnits),qt===!0&&re.setGlobalState(N.clippingPlanes,E.state.camera)):E=null,y.pop(),y.length>0?P=y[y.length-1]:P=null,z!==null&&z.renderEnd()};function Ds(M,B,Q,Z){if(M.visible===!1)return;if(M.layers.test(B.layers)){if(M.isGroup)Q=M.renderOrder;else if(M.isLOD)M.autoUpdate===!0&&M.update(B);else if(M.isLight)E.pushLight(M),M.castShadow&&E.pushShadow(M);else if(M.isSprite){let Ie=B.isArrayCamera?nn:at;if(!M.frustumCulled||M.intersectsFrustum(Ie)){Z&&wt.setFromMatrixPosition(M.matrixWorld).applyMatrix4(Vt);let Ce=fe.update(M),De=M.material;De.visible&&P.push(M,Ce,De,Q,wt.z,null,B)}}else if(M.isMesh||M.isLine||M.isPoints){let Ie=B.isArrayCamera?nn:at;if(!M.frustumCulled||M.intersectsFrustum(Ie)){let Ce=fe.update(M),De=M.material;if(Z&&(M.boundingSphere!==void 0?(M.boundingSphere===null&&M.computeBoundingSphere(),wt.copy(M.boundingSphere.center)):(Ce.boundingSphere===null&&Ce.computeBoundingSphere(),wt.copy(Ce.boundingSphere.center)),wt.applyMatrix4(M.matrixWorld).applyMatrix4(Vt)),Array.isArray(De)){let Ve=Ce.groups;for(let rt=0,gt=Ve.length;rt<gt;rt++){let ze=Ve[rt],vt=De[ze.materialIndex];vt&&vt.visible&&P.push(M,Ce,vt,Q,wt.z,ze,B)}}else De.visible&&P.push(M,Ce,De,Q,wt.z,null,B)}}}let Ae=M.children;for(let Ie=0,Ce=Ae.length;Ie<Ce;Ie++)Ds(Ae[Ie],B,Q,Z)}function Da(M,B,Q,Z){let{opaque:J,transmissive:Ae,transparent:Ie}=M;E.setupLightsView(Q),qt===!0&&re.setGlobalState(N.clippingPlanes,Q),Z&&Te.viewport(se.copy(Z)),J.length>0&&ln(J,B,Q),Ae.length>0&&ln(Ae,B,Q),Ie.length>0&&ln(Ie,B,Q),Te.buffers.depth.setTest(!0),Te.buffers.depth.setMask(!0),Te.buffers.color.setMask(!0),Te.setPolygonOffset(!1)}function Xi(M,B,Q,Z){if((Q.isScene===!0?Q.overrideMaterial:null)!==null)return;if(E.state.transmissionRenderTarget[Z.id]===void 0){let ze=je.has("EXT_color_buffer_half_float")||je.has("EXT_color_buffer_float");E.state.transmissionRenderTarget[Z.id]=new Ri(1,1,{generateMipmaps:!0,type:ze?is:di,minFilter:er,samples:Math.max(4,ct.samples),stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:bt.workingColorSpace})}let Ae=E.state.transmissionRenderTarget[Z.id],Ie=Z.viewport||se;Ae.setSize(Ie.z*N.transmissionResolutionScale,Ie.w*N.transmissionResolutionScale);let Ce=N.getRenderTarget(),De=N.getActiveCubeFace(),Ve=N.getActiveMipmapLevel();N.setRenderTarget(Ae),N.getClearColor(te),me=N.getClearAlpha(),me<1&&N.setClearColor(16777215,.5),N.clear(),an&&U.render(Q);let rt=N.toneMapping;N.toneMapping=Es;let gt=Z.viewport;if(Z.viewport!==void 0&&(Z.viewport=void 0),E.setupLightsView(Z),qt===!0&&re.setGlobalState(N.clippingPlanes,Z),ln(M,Q,Z),Ze.updateMultisampleRenderTarget(Ae),Ze.updateRenderTargetMipmap(Ae),je.has("WEBGL_multisampled_render_to_texture")===!1){let ze=!1;for(let vt=0,on=B.length;vt<on;vt++){let kt=B[vt],{object:Bt,geometry:En,material:Fe,group:yn}=kt;if(Fe.side===ui&&Bt.layers.test(Z.layers)){let xt=Fe.side;Fe.side=hi,Fe.needsUpdate=!0,pn(Bt,Q,Z,En,Fe,yn),Fe.side=xt,Fe.needsUpdate=!0,ze=!0}}ze===!0&&(Ze.updateMultisampleRenderTarget(Ae),Ze.updateRenderTargetMipmap(Ae))}N.setRenderTarget(Ce,De,Ve),N.setClearColor(te,me),gt!==void 0&&(Z.viewport=gt),N.toneMapping=rt}function ln(M,B,Q){let Z=B.isScene===!0?B.overrideMaterial:null;for(let J=0,Ae=M.length;J<Ae;J++){let Ie=M[J],{object:Ce,geometry:De,group:Ve}=Ie,rt=Ie.material;rt.allowOverride===!0&&Z!==null&&(rt=Z),Ce.layers.test(Q.layers)&&pn(Ce,B,Q,De,rt,Ve)}}function pn(M,B,Q,Z,J,Ae){z!==null&&J.isNodeMaterial&&z.setObject(M,J),M.onBeforeRender(N,B,Q,Z,J,Ae),M.modelViewMatrix.multiplyMatrices(Q.matrixWorldInverse,M.matrixWorld),M.normalMatrix.getNormalMatrix(M.modelViewMatrix),J.onBeforeRender(N,B,Q,Z,M,Ae),J.transparent===!0&&J.side===ui&&J.forceSinglePass===!1?(J.side=hi,J.needsUpdate=!0,N.renderBufferDirect(Q,B,Z,J,M,Ae),J.side=Pr,J.needsUpdate=!0,N.renderBufferDirect(Q,B,Z,J,M,Ae),J.side=ui):N.renderBufferDirect(Q,B,Z,J,M,Ae),M.onAfterRender(N,B,Q,Z,J,Ae)}function mn(M){let B=0;for(let Q of M)Q.texture!==null&&B++;return B}function us(M,B,Q){B.isScene!==!0&&(B=Tn);let Z=Ge.get(M),J=E.state.lights,Ae=E.state.shadowsArray,Ie=J.state.version,Ce=ae.getParameters(M,J.state,Ae,B,Q,E.state.lightProbeGridArray),De=ae.getProgramCacheKey(Ce),Ve=Z.programs;Z.environment=M.isMeshStandardMaterial||M.isMeshLambertMaterial||M.isMeshPhongMaterial?B.environment:null,Z.fog=B.fog;let rt=M.isMeshStandardMaterial||M.isMeshLambertMaterial&&!M.envMap||M.isMeshPhongMaterial&&!M.envMap;Z.envMap=C.get(M.envMap||Z.environment,rt),Z.envMapRotation=Z.environment!==null&&M.envMap===null?B.environmentRotation:M.envMapRotation,Ve===void 0&&(M.addEventListener("dispose",ft),Ve=new Map,Z.programs=Ve,Z.programVariants=new Map);let gt=Ve.get(De);if(gt!==void 0){if(Z.currentProgram===gt&&Z.lightsStateVersion===Ie)return La(M,Ce),gt}else Ce.uniforms=ae.getUniforms(M),z!==null&&M.isNodeMaterial&&z.build(M,Q,Ce),M.onBeforeCompile(Ce,N),gt=ae.acquireProgram(Ce,De),Ve.set(De,gt),Z.uniforms=Ce.uniforms;let ze=Z.uniforms;return(!M.isShaderMaterial&&!M.isRawShaderMaterial||M.clipping===!0)&&(ze.clippingPlanes=re.uniform),La(M,Ce),Z.needsLights=ar(M),Z.lightsStateVersion=Ie,Z.needsLights&&(ze.ambientLightColor.value=J.state.ambient,ze.lightProbe.value=J.state.probe,ze.sunLights.value=J.state.sun,ze.sunLightShadows.value=J.state.sunShadow,ze.directionalLights.value=J.state.directional,ze.directionalLightShadows.value=J.state.directionalShadow,ze.spotLights.value=J.state.spot,ze.spotLightShadows.value=J.state.spotShadow,ze.rectAreaLights.value=J.state.rectArea,ze.ltc_1.value=J.state.rectAreaLTC1,ze.ltc_2.value=J.state.rectAreaLTC2,ze.pointLights.value=J.state.point,ze.pointLightShadows.value=J.state.pointShadow,ze.hemisphereLights.value=J.state.hemi,ze.sunShadowMatrix.value=J.state.sunShadowMatrix,ze.sunShadowCascade.value=J.state.sunShadowCascade,ze.directionalShadowMatrix.value=J.state.directionalShadowMatrix,ze.spotLightMatrix.value=J.state.spotLightMatrix,ze.spotLightMap.value=J.state.spotLightMap,ze.pointShadowMatrix.value=J.state.pointShadowMatrix),Z.numLightProbeGrids=mn(E.state.lightProbeGridArray),Z.currentProgram=gt,Z.uniformsList=null,gt}function gi(M,B,Q,Z,J){let Ae=Ge.get(M),Ie=Ae.currentProgram.id+","+Z+","+J,Ce=Ae.programVariants.get(Ie);return Ce===void 0?(Ce=us(M,B,Q),Ae.programVariants.set(Ie,Ce)):(Ae.currentProgram=Ce,Ae.uniformsList=null,Ae.outputColorSpace=Z,Ae.toneMapping=J),Ce}function or(M){if(M.uniformsList===null){let B=M.currentProgram.getUniforms();M.uniformsList=pa.seqWithValue(B.seq,M.uniforms)}return M.uniformsList}function La(M,B){let Q=Ge.get(M);Q.outputColorSpace=B.outputColorSpace,Q.batching=B.batching,Q.batchingColor=B.batchingColor,Q.instancing=B.instancing,Q.instancingColor=B.instancingColor,Q.instancingMorph=B.instancingMorph,Q.skinning=B.skinning,Q.morphTargets=B.morphTargets,Q.morphNormals=B.morphNormals,Q.morphColors=B.morphColors,Q.morphTargetsCount=B.morphTargetsCount,Q.numClippingPlanes=B.numClippingPlanes,Q.numIntersection=B.numClipIntersection,Q.vertexAlphas=B.vertexAlphas,Q.vertexTangents=B.vertexTangents,Q.toneMapping=B.toneMapping}function Na(M,B,Q,Z,J){B.isScene!==!0&&(B=Tn),Ze.resetTextureUnits();let Ae=B.fog,Ie=Z.isMeshStandardMaterial||Z.isMeshLambertMaterial||Z.isMeshPhongMaterial?B.environment:null,Ce=ce===null?N.outputColorSpace:ce.isXRRenderTarget===!0?ce.texture.colorSpace:bt.workingColorSpace,De=Z.isMeshStandardMaterial||Z.isMeshLambertMaterial&&!Z.envMap||Z.isMeshPhongMaterial&&!Z.envMap,Ve=C.get(Z.envMap||Ie,De),rt=Z.vertexColors===!0&&!!Q.attributes.color&&Q.attributes.color.itemSize===4,gt=!!Q.attributes.tangent&&(!!Z.normalMap||Z.anisotropy>0),ze=!!Q.morphAttributes.position,vt=!!Q.morphAttributes.normal,on=!!Q.morphAttributes.color,kt=Es;Z.toneMapped&&(ce===null||ce.isXRRenderTarget===!0)&&(kt=N.toneMapping);let Bt=Q.morphAttributes.position||Q.morphAttributes.normal||Q.morphAttributes.color,En=Bt!==void 0?Bt.length:0,Fe=Ge.get(Z),yn=E.state.lights;if(qt===!0&&(gn===!0||M!==ee)){let zt=M===ee&&Z.id===K;re.setState(Z,M,zt)}let xt=!1,Ls=!1;Z.version===Fe.__version?Fe.needsLights&&Fe.lightsStateVersion!==yn.state.version||J.isBatchedMesh&&Fe.batching===!1||!J.isBatchedMesh&&Fe.batching===!0||J.isBatchedMesh&&Fe.batchingColor===!0&&J._colorsTexture===null||J.isBatchedMesh&&Fe.batchingColor===!1&&J._colorsTexture!==null||J.isInstancedMesh&&Fe.instancing===!1||!J.isInstancedMesh&&Fe.instancing===!0||J.isSkinnedMesh&&Fe.skinning===!1||!J.isSkinnedMesh&&Fe.skinning===!0||J.isInstancedMesh&&Fe.instancingColor===!0&&J.instanceColor===null||J.isInstancedMesh&&Fe.instancingColor===!1&&J.instanceColor!==null||J.isInstancedMesh&&Fe.instancingMorph===!0&&J.morphTexture===null||J.isInstancedMesh&&Fe.instancingMorph===!1&&J.morphTexture!==null||Fe.envMap!==Ve||Z.fog===!0&&Fe.fog!==Ae||Fe.numClippingPlanes!==void 0&&(Fe.numClippingPlanes!==re.numPlanes||Fe.numIntersection!==re.numIntersection)||Fe.vertexAlphas!==rt||Fe.vertexTangents!==gt||Fe.morphTargets!==ze||Fe.morphNormals!==vt||Fe.morphColors!==on||Fe.morphTargetsCount!==En||Fe.numLightProbeGrids!==mn(E.state.lightProbeGridArray)?xt=!0:(Fe.outputColorSpace!==Ce||Fe.toneMapping!==kt)&&(Ls=!0):(xt=!0,Fe.__version=Z.version);let _n=Fe.currentProgram;(xt===!0||Ls===!0)&&(_n=Ls===!0?gi(Z,B,J,Ce,kt):us(Z,B,J),z&&Z.isNodeMaterial&&z.onUpdateProgram(Z,_n,Fe));let mo=!1,fs=!1,Ns=!1,dt=_n.getUniforms(),cn=Fe.uniforms;if(Te.useProgram(_n.program)&&(mo=!0,fs=!0,Ns=!0),Z.id!==K&&(K=Z.id,fs=!0),mo||ee!==M){Te.buffers.depth.getReversed()&&M.reversedDepth!==!0&&(M._reversedDepth=!0,M.updateProjectionMatrix()),dt.setValue(F,"projectionMatrix",M.projectionMatrix),dt.setValue(F,"viewMatrix",M.matrixWorldInverse);let xn=dt.map.cameraPosition;xn!==void 0&&xn.setValue(F,Nn.setFromMatrixPosition(M.matrixWorld)),ct.logarithmicDepthBuffer&&dt.setValue(F,"logDepthBufFC",2/(Math.log(M.far+1)/Math.LN2)),(Z.isMeshPhongMaterial||Z.isMeshToonMaterial||Z.isMeshLambertMaterial||Z.isMeshBasicMaterial||Z.isMeshStandardMaterial||Z.isShaderMaterial)&&dt.setValue(F,"isOrthographic",M.isOrthographicCamera===!0),ee!==M&&(ee=M,fs=!0,Ns=!0)}if(Fe.needsLights&&(yn.state.sunShadowMap.length>0&&dt.setValue(F,"sunShadowMap",yn.state.sunShadowMap,Ze),yn.state.directionalShadowMap.length>0&&dt.setValue(F,"directionalShadowMap",yn.state.directionalShadowMap,Ze),yn.state.spotShadowMap.length>0&&dt.setValue(F,"spotShadowMap",yn.state.spotShadowMap,Ze),yn.state.pointShadowMap.length>0&&dt.setValue(F,"pointShadowMap",yn.state.pointShadowMap,Ze)),J.isSkinnedMesh){dt.setOptional(F,J,"bindMatrix"),dt.setOptional(F,J,"bindMatrixInverse");let zt=J.skeleton;zt&&(zt.boneTexture===null&&zt.computeBoneTexture(),dt.setValue(F,"boneTexture",zt.boneTexture,Ze))}J.isBatchedMesh&&(dt.setOptional(F,J,"batchingTexture"),dt.setValue(F,"batchingTexture",J._matricesTexture,Ze),dt.setOptional(F,J,"batchingIdTexture"),dt.setValue(F,"batchingIdTexture",J._indirectTexture,Ze),dt.setOptional(F,J,"batchingColorTexture"),J._colorsTexture!==null&&dt.setValue(F,"batchingColorTexture",J._colorsTexture,Ze));let Qn=Q.morphAttributes;if((Qn.position!==void 0||Qn.normal!==void 0||Qn.color!==void 0)&&oe.update(J,Q,_n),(fs||Fe.receiveShadow!==J.receiveShadow)&&(Fe.receiveShadow=J.receiveShadow,dt.setValue(F,"receiveShadow",J.receiveShadow)),(Z.isMeshStandardMaterial||Z.isMeshLambertMaterial||Z.isMeshPhongMaterial)&&Z.envMap===null&&B.environment!==null&&(cn.envMapIntensity.value=B.environmentIntensity),cn.dfgLUT!==void 0&&(cn.dfgLUT.value=mC()),fs){if(dt.setValue(F,"toneMappingExposure",N.toneMappingExposure),Fe.needsLights&&fo(cn,Ns),Ae&&Z.fog===!0&&_e.refreshFogUniforms(cn,Ae),_e.refreshMaterialUniforms(cn,Z,xe,Me,E.state.transmissionRenderTarget[M.id]),Fe.needsLights&&Fe.numLightProbeGrids>0){let zt=w,xn=0;for(let $n of E.state.lightProbeGridArray)$n.texture!==null&&(zt.textures[xn]=$n.texture,zt.min[xn]=$n.boundingBox.min,zt.max[xn]=$n.boundingBox.max,zt.resolution[xn]=$n.resolution,xn++);for(let $n in zt)zt[$n].length=xn;cn.probesSH.value=zt.textures,cn.probesMin.value=zt.min,cn.probesMax.value=zt.max,cn.probesResolution.value=zt.resolution}pa.upload(F,or(Fe),cn,Ze)}if(Z.isShaderMaterial&&Z.uniformsNeedUpdate===!0&&(pa.upload(F,or(Fe),cn,Ze),Z.uniformsNeedUpdate=!1),Z.isSpriteMaterial&&dt.setValue(F,"center",J.center),dt.setValue(F,"modelViewMatrix",J.modelViewMatrix),dt.setValue(F,"normalMatrix",J.normalMatrix),dt.setValue(F,"modelMatrix",J.matrixWorld),Z.uniformsGroups!==void 0){let zt=Z.uniformsGroups;for(let xn=0,$n=zt.length;xn<$n;xn++){let gc=zt[xn];Xe.update(gc,_n),Xe.bind(gc,_n)}}return _n}function fo(M,B){M.ambientLightColor.needsUpdate=B,M.lightProbe.needsUpdate=B,M.sunLights.needsUpdate=B,M.sunLightShadows.needsUpdate=B,M.directionalLights.needsUpdate=B,M.directionalLightShadows.needsUpdate=B,M.pointLights.needsUpdate=B,M.pointLightShadows.needsUpdate=B,M.spotLights.needsUpdate=B,M.spotLightShadows.needsUpdate=B,M.rectAreaLights.needsUpdate=B,M.hemisphereLights.needsUpdate=B}function ar(M){return M.isMeshLambertMaterial||M.isMeshToonMaterial||M.isMeshPhongMaterial||M.isMeshStandardMaterial||M.isShadowMaterial||M.isShaderMaterial&&M.lights===!0}this.getActiveCubeFace=function(){return $},this.getActiveMipmapLevel=function(){return V},this.getRenderTarget=function(){return ce},this.setRenderTargetTextures=function(M,B,Q){let Z=Ge.get(M);Z.__autoAllocateDepthBuffer=M.resolveDepthBuffer===!1,Z.__autoAllocateDepthBuffer===!1&&(Z.__useRenderToTexture=!1),Ge.get(M.texture).__webglTexture=B,Ge.get(M.depthTexture).__webglTexture=Z.__autoAllocateDepthBuffer?void 0:Q,Z.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(M,B){let Q=Ge.get(M);Q.__webglFramebuffer=B,Q.__useDefaultFramebuffer=B===void 0},this.setRenderTarget=function(M,B=0,Q=0){ce=M,$=B,V=Q;let Z=null,J=!1,Ae=!1;if(M){let Ce=Ge.get(M);if(Ce.__useDefaultFramebuffer!==void 0){Te.bindFramebuffer(F.FRAMEBUFFER,Ce.__webglFramebuffer),se.copy(M.viewport),de.copy(M.scissor),he=M.scissorTest,Te.viewport(se),Te.scissor(de),Te.setScissorTest(he),K=-1;return}else if(Ce.__webglFramebuffer===void 0)Ze.setupRenderTarget(M);else if(Ce.__hasExternalTextures)Ze.rebindTextures(M,Ge.get(M.texture).__webglTexture,Ge.get(M.depthTexture).__webglTexture);else if(M.depthBuffer){let rt=M.depthTexture;if(Ce.__boundDepthTexture!==rt){if(rt!==null&&Ge.has(rt)&&(M.width!==rt.image.width||M.height!==rt.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");Ze.setupDepthRenderbuffer(M)}}let De=M.texture;(De.isData3DTexture||De.isDataArrayTexture||De.isCompressedArrayTexture)&&(Ae=!0);let Ve=Ge.get(M).__webglFramebuffer;M.isWebGLCubeRenderTarget?(Array.isArray(Ve[B])?Z=Ve[B][Q]:Z=Ve[B],J=!0):M.samples>0&&Ze.useMultisampledRTT(M)===!1?Z=Ge.get(M).__webglMultisampledFramebuffer:Array.isArray(Ve)?Z=Ve[Q]:Z=Ve,se.copy(M.viewport),de.copy(M.scissor),he=M.scissorTest}else se.copy(He).multiplyScalar(xe).floor(),de.copy(ut).multiplyScalar(xe).floor(),he=ht;if(Q!==0&&(Z=W),Te.bindFramebuffer(F.FRAMEBUFFER,Z)&&Te.drawBuffers(M,Z),Te.viewport(se),Te.scissor(de),Te.setScissorTest(he),J){let Ce=Ge.get(M.texture);F.framebufferTexture2D(F.FRAMEBUFFER,F.COLOR_ATTACHMENT0,F.TEXTURE_CUBE_MAP_POSITIVE_X+B,Ce.__webglTexture,Q)}else if(Ae){let Ce=B;for(let De=0;De<M.textures.length;De++){let Ve=Ge.get(M.textures[De]);F.framebufferTextureLayer(F.FRAMEBUFFER,F.COLOR_ATTACHMENT0+De,Ve.__webglTexture,Q,Ce)}}else if(M!==null&&Q!==0){let Ce=Ge.get(M.texture);F.framebufferTexture2D(F.FRAMEBUFFER,F.COLOR_ATTACHMENT0,F.TEXTURE_2D,Ce.__webglTexture,Q)}K=-1};function po(M){let B=Ge.get(M);return(B.__readFormat!==M.format||B.__readType!==M.type)&&(B.__readFormat=M.format,B.__readType=M.type,B.__formatReadable=ct.textureFormatReadable(M.format),B.__typeReadable=ct.textureTypeReadable(M.type)),B}this.readRenderTargetPixels=function(M,B,Q,Z,J,Ae,Ie,Ce=0){if(!(M&&M.isWebGLRenderTarget)){st("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let De=Ge.get(M).__webglFramebuffer;if(M.isWebGLCubeRenderTarget&&Ie!==void 0&&(De=De[Ie],Array.isArray(De)&&(De=De[0])),De){Te.bindFramebuffer(F.FRAMEBUFFER,De);try{let Ve=M.textures[Ce],rt=Ve.format,gt=Ve.type;M.textures.length>1&&F.readBuffer(F.COLOR_ATTACHMENT0+Ce);let ze=po(Ve);if(ze.__formatReadable===!1){st("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(ze.__typeReadable===!1){st("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}B>=0&&B<=M.width-Z&&Q>=0&&Q<=M.height-J&&F.readPixels(B,Q,Z,J,ye.convert(rt),ye.convert(gt),Ae)}finally{let Ve=ce!==null?Ge.get(ce).__webglFramebuffer:null;Te.bindFramebuffer(F.FRAMEBUFFER,Ve)}}},this.readRenderTargetPixelsAsync=async function(M,B,Q,Z,J,Ae,Ie,Ce=0){if(!(M&&M.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let De=Ge.get(M).__webglFramebuffer;if(M.isWebGLCubeRenderTarget&&Ie!==void 0&&(De=De[Ie],Array.isArray(De)&&(De=De[0])),De)if(B>=0&&B<=M.width-Z&&Q>=0&&Q<=M.height-J){Te.bindFramebuffer(F.FRAMEBUFFER,De);let Ve=M.textures[Ce],rt=Ve.format,gt=Ve.type;M.textures.length>1&&F.readBuffer(F.COLOR_ATTACHMENT0+Ce);let ze=po(Ve);if(ze.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(ze.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let vt=F.createBuffer();F.bindBuffer(F.PIXEL_PACK_BUFFER,vt),F.bufferData(F.PIXEL_PACK_BUFFER,Ae.byteLength,F.STREAM_READ),F.readPixels(B,Q,Z,J,ye.convert(rt),ye.convert(gt),0),F.bindBuffer(F.PIXEL_PACK_BUFFER,null);let on=ce!==null?Ge.get(ce).__webglFramebuffer:null;Te.bindFramebuffer(F.FRAMEBUFFER,on);let kt=F.fenceSync(F.SYNC_GPU_COMMANDS_COMPLETE,0);return F.flush(),await ly(F,kt,4),F.bindBuffer(F.PIXEL_PACK_BUFFER,vt),F.getBufferSubData(F.PIXEL_PACK_BUFFER,0,Ae),F.bindBuffer(F.PIXEL_PACK_BUFFER,null),F.deleteBuffer(vt),F.deleteSync(kt),Ae}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(M,B=null,Q=0){let Z=Math.pow(2,-Q),J=Math.floor(M.image.width*Z),Ae=Math.floor(M.image.height*Z),Ie=B!==null?B.x:0,Ce=B!==null?B.y:0;Ze.setTexture2D(M,0),F.copyTexSubImage2D(F.TEXTURE_2D,Q,0,0,Ie,Ce,J,Ae),Te.unbindTexture()},this.copyTextureToTexture=function(M,B,Q=null,Z=null,J=0,Ae=0){let Ie,Ce,De,Ve,rt,gt,ze,vt,on,kt=M.isCompressedTexture?M.mipmaps[Ae]:M.image;if(Q!==null)Ie=Q.max.x-Q.min.x,Ce=Q.max.y-Q.min.y,De=Q.isBox3?Q.max.z-Q.min.z:1,Ve=Q.min.x,rt=Q.min.y,gt=Q.isBox3?Q.min.z:0;else{let dt=Math.pow(2,-J);Ie=Math.floor(kt.width*dt),Ce=Math.floor(kt.height*dt),M.isDataArrayTexture?De=kt.depth:M.isData3DTexture?De=Math.floor(kt.depth*dt):De=1,Ve=0,rt=0,gt=0}Z!==null?(ze=Z.x,vt=Z.y,on=Z.z):(ze=0,vt=0,on=0);let Bt=ye.convert(B.format),En=ye.convert(B.type),Fe;B.isData3DTexture?(Ze.setTexture3D(B,0),Fe=F.TEXTURE_3D):B.isDataArrayTexture||B.isCompressedArrayTexture?(Ze.setTexture2DArray(B,0),Fe=F.TEXTURE_2D_ARRAY):(Ze.setTexture2D(B,0),Fe=F.TEXTURE_2D),Te.activeTexture(F.TEXTURE0),Te.pixelStorei(F.UNPACK_FLIP_Y_WEBGL,B.flipY),Te.pixelStorei(F.UNPACK_PREMULTIPLY_ALPHA_WEBGL,B.premultiplyAlpha),Te.pixelStorei(F.UNPACK_ALIGNMENT,B.unpackAlignment);let yn=Te.getParameter(F.UNPACK_ROW_LENGTH),xt=Te.getParameter(F.UNPACK_IMAGE_HEIGHT),Ls=Te.getParameter(F.UNPACK_SKIP_PIXELS),_n=Te.getParameter(F.UNPACK_SKIP_ROWS),mo=Te.getParameter(F.UNPACK_SKIP_IMAGES);Te.pixelStorei(F.UNPACK_ROW_LENGTH,kt.width),Te.pixelStorei(F.UNPACK_IMAGE_HEIGHT,kt.height),Te.pixelStorei(F.UNPACK_SKIP_PIXELS,Ve),Te.pixelStorei(F.UNPACK_SKIP_ROWS,rt),Te.pixelStorei(F.UNPACK_SKIP_IMAGES,gt);let fs=M.isDataArrayTexture||M.isData3DTexture,Ns=B.isDataArrayTexture||B.isData3DTexture;if(M.isDepthTexture){let dt=Ge.get(M),cn=Ge.get(B),Qn=Ge.get(dt.__renderTarget),zt=Ge.get(cn.__renderTarget);Te.bindFramebuffer(F.READ_FRAMEBUFFER,Qn.__webglFramebuffer),Te.bindFramebuffer(F.DRAW_FRAMEBUFFER,zt.__webglFramebuffer);for(let xn=0;xn<De;xn++)fs&&(F.framebufferTextureLayer(F.READ_FRAMEBUFFER,F.COLOR_ATTACHMENT0,Ge.get(M).__webglTexture,J,gt+xn),F.framebufferTextureLayer(F.DRAW_FRAMEBUFFER,F.COLOR_ATTACHMENT0,Ge.get(B).__webglTexture,Ae,on+xn)),F.blitFramebuffer(Ve,rt,Ve+Ie,rt+Ce,ze,vt,ze+Ie,vt+Ce,F.DEPTH_BUFFER_BIT,F.NEAREST);Te.bindFramebuffer(F.READ_FRAMEBUFFER,null),Te.bindFramebuffer(F.DRAW_FRAMEBUFFER,null)}else if(J!==0||M.isRenderTargetTexture||Ge.has(M)){let dt=Ge.get(M),cn=Ge.get(B);Te.bindFramebuffer(F.READ_FRAMEBUFFER,L),Te.bindFramebuffer(F.DRAW_FRAMEBUFFER,X);for(let Qn=0;Qn<De;Qn++)fs?F.framebufferTextureLayer(F.READ_FRAMEBUFFER,F.COLOR_ATTACHMENT0,dt.__webglTexture,J,gt+Qn):F.framebufferTexture2D(F.READ_FRAMEBUFFER,F.COLOR_ATTACHMENT0,F.TEXTURE_2D,dt.__webglTexture,J),Ns?F.framebufferTextureLayer(F.DRAW_FRAMEBUFFER,F.COLOR_ATTACHMENT0,cn.__webglTexture,Ae,on+Qn):F.framebufferTexture2D(F.DRAW_FRAMEBUFFER,F.COLOR_ATTACHMENT0,F.TEXTURE_2D,cn.__webglTexture,Ae),J!==0?F.blitFramebuffer(Ve,rt,Ve+Ie,rt+Ce,ze,vt,ze+Ie,vt+Ce,F.COLOR_BUFFER_BIT,F.NEAREST):Ns?F.copyTexSubImage3D(Fe,Ae,ze,vt,on+Qn,Ve,rt,Ie,Ce):F.copyTexSubImage2D(Fe,Ae,ze,vt,Ve,rt,Ie,Ce);Te.bindFramebuffer(F.READ_FRAMEBUFFER,null),Te.bindFramebuffer(F.DRAW_FRAMEBUFFER,null)}else Ns?M.isDataTexture||M.isData3DTexture?F.texSubImage3D(Fe,Ae,ze,vt,on,Ie,Ce,De,Bt,En,kt.data):B.isCompressedArrayTexture?F.compressedTexSubImage3D(Fe,Ae,ze,vt,on,Ie,Ce,De,Bt,kt.data):F.texSubImage3D(Fe,Ae,ze,vt,on,Ie,Ce,De,Bt,En,kt):M.isDataTexture?F.texSubImage2D(F.TEXTURE_2D,Ae,ze,vt,Ie,Ce,Bt,En,kt.data):M.isCompressedTexture?F.compressedTexSubImage2D(F.TEXTURE_2D,Ae,ze,vt,kt.width,kt.height,Bt,kt.data):F.texSubImage2D(F.TEXTURE_2D,Ae,ze,vt,Ie,Ce,Bt,En,kt);Te.pixelStorei(F.UNPACK_ROW_LENGTH,yn),Te.pixelStorei(F.UNPACK_IMAGE_HEIGHT,xt),Te.pixelStorei(F.UNPACK_SKIP_PIXELS,Ls),Te.pixelStorei(F.UNPACK_SKIP_ROWS,_n),Te.pixelStorei(F.UNPACK_SKIP_IMAGES,mo),Ae===0&&B.generateMipmaps===!0&&B.mipmapsAutoUpdate===!0&&F.generateMipmap(Fe),Te.unbindTexture()},this.initRenderTarget=function(M){Ge.get(M).__webglFramebuffer===void 0&&Ze.setupRenderTarget(M)},this.initTexture=function(M){M.isCubeTexture?Ze.setTextureCube(M,0):M.isData3DTexture?Ze.setTexture3D(M,0):M.isDataArrayTexture||M.isCompressedArrayTexture?Ze.setTexture2DArray(M,0):Ze.setTexture2D(M,0),Te.unbindTexture()},this.resetState=function(){$=0,V=0,ce=null,Te.reset(),we.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return Vi}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(e){this._outputColorSpace=e;let t=this.getContext();t.drawingBufferColorSpace=bt._getDrawingBufferColorSpace(e),t.unpackColorSpace=bt._getUnpackColorSpace()}};var Yy=12,$y=8,ga=48;function ef({centre:n,radius:e}){return{centre:n,axes:[e,0,0,0,e,0,0,0,e]}}function Qp({centre:n,axes:e},t,i){let s=[];for(let[o,a]of gC())for(let l of[o,a])for(let c=0;c<3;c++){let h=n[c]??0;for(let u=0;u<3;u++)h+=(e[3*c+u]??0)*(l[u]??0);s.push(h)}let r=new $t;return r.setAttribute("position",new fn(Float32Array.from(s),3)),new ws(r,new es({color:t,opacity:i,transparent:!0,depthWrite:!1}))}function Zy({centre:n,axes:e},t){let[i,s]=t,r=(c,h)=>[0,1,2].reduce((u,f)=>u+(e[3*c+f]??0)*(e[3*h+f]??0),0),o=Math.sqrt(r(i,i)),a=o>0?r(i,s)/o:0,l=Math.sqrt(Math.max(0,r(s,s)-a*a));return Array.from({length:2*ga+1},(c,h)=>{let[u,f]=[Math.cos(Math.PI*h/ga),Math.sin(Math.PI*h/ga)];return[(n[i]??0)+o*u,(n[s]??0)+a*u+l*f]})}function*gC(){let n=(t,i)=>[Math.cos(t)*Math.cos(i),Math.cos(t)*Math.sin(i),Math.sin(t)],e=2*Math.PI/ga;for(let t=0;t<Yy/2;t++){let i=2*Math.PI*t/Yy;for(let s=0;s<ga;s++)yield[n(e*s,i),n(e*(s+1),i)]}for(let t=1;t<$y;t++){let i=-Math.PI/2+Math.PI*t/$y;for(let s=0;s<ga;s++)yield[n(i,e*s),n(i,e*(s+1))]}}var em={left:32,right:6,top:5,bottom:16},vC=4,yC=10,_C=`${Math.round(.92*Number.parseFloat(getComputedStyle(document.body).fontSize))}px system-ui, 'DejaVu Sans', sans-serif`,tf=class{constructor(e,t,i,s,r,o){this.panel=e;this.plane=t;this.frames=i;this.data=s;this.maker=r;this.store=o;let[a,l]=t;this.canvas=q("canvas",{role:"img","aria-label":`Plane ${"xyz"[a]??""}-${"xyz"[l]??""} of the force or moment space`}),e.append(this.canvas),this.encircle(),new ResizeObserver(()=>i.later(this)).observe(e)}panel;plane;frames;data;maker;store;canvas;points=document.createElement("canvas");key="";last=null;path=[];update(){this.frames.later(this)}place(e,t){return this.placing(e)(t,0)}placing(e){let[t,i]=this.plane,{left:s,right:r,top:o,bottom:a}=em,[l,c]=[this.panel.clientWidth-s-r,this.panel.clientHeight-o-a],h=Math.min(l,c)/(2*e.half),u=s+l/2-(e.centre[t]??0)*h,f=o+c/2+(e.centre[i]??0)*h;return(d,g)=>[u+(d[g+t]??Number.NaN)*h,f-(d[g+i]??Number.NaN)*h]}sampleOnScreen(e,t){let i=this.maker.of(this.store.state),s=i.clouds[e];if(!s)return null;let r=this.canvas.getBoundingClientRect(),[o,a]=this.place(i,this.data.vector(s.series,t,this.store.state.quantity));return{x:r.left+o,y:r.top+a}}draw(){let[e,t]=[this.panel.clientWidth,this.panel.clientHeight];if(e===0||t===0)return;let{state:i}=this.store,s=this.maker.of(i),r=JSON.stringify([e,t,devicePixelRatio,[...i.hidden],i.wireframes,i.selected]);(r!==this.key||s!==this.last)&&(this.key=r,this.last=s,this.drawPoints(s,Ky(this.points,e,t)));let o=Ky(this.canvas,e,t);if(o.drawImage(this.points,0,0,e,t),this.path.length>1){o.strokeStyle=Yt,o.beginPath();for(let[a,l]of this.path)o.lineTo(a,l);o.stroke()}for(let a of this.visible(s)){let[l,c]=this.place(s,this.data.vector(a.series,i.sample,i.quantity));for(let[h,u]of[[6.5,Xn],[5,a.colour],[1.8,Xn]])o.fillStyle=u,o.beginPath(),o.arc(l,c,h,0,2*Math.PI),Number.isFinite(l+c)&&o.fill()}}visible(e){return e.clouds.filter(t=>!this.store.state.hidden.has(t.series.name))}drawPoints(e,t){this.drawAxes(e,t);let{left:i,right:s,top:r,bottom:o}=em;t.save(),t.beginPath(),t.rect(i,r,this.panel.clientWidth-i-s,this.panel.clientHeight-r-o),t.clip();let{selected:a}=this.store.state,l=Uint8Array.from(e.samples,h=>xC(a,this.data.time[h]??0)?1:0),c=this.placing(e);for(let h of this.visible(e)){let u=si(h.colour,.12);for(let d=0;d+2<h.points.length;d+=3){let[g,_]=c(h.points,d);t.fillStyle=a.length===0||l[d/3]?h.colour:u,Number.isFinite(g+_)&&t.fillRect(g-.8,_-.8,1.6,1.6)}if(!this.store.state.wireframes)continue;let f=[[h.sphere&&ef(h.sphere),vs],[h.ellipsoid,h.colour]];for(let[d,g]of f)if(d){t.strokeStyle=g,t.beginPath();for(let[_,m]of Zy(d,this.plane)){let p=[0,0,0];p[this.plane[0]]=_,p[this.plane[1]]=m,t.lineTo(...this.place(e,p))}t.stroke()}}t.restore()}drawAxes(e,t){let[i,s]=this.plane,{left:r,right:o,top:a,bottom:l}=em,[c,h]=[this.panel.clientWidth,this.panel.clientHeight],[u,f]=[e.centre[i]??0,e.centre[s]??0],d=Math.min(c-r-o,h-a-l)/(2*e.half),g=[(c-r-o)/2/d,(h-a-l)/2/d];t.font=_C,t.fillStyle=vs,t.strokeStyle=Br,t.textAlign="center";for(let p of qa(u-g[0],u+g[0],c/45)){let x=this.place(e,i===0?[p,f,f]:[f,p,f])[0];Jy(t,x,a,x,h-l),x>r+8&&x<c-o-8&&t.fillText(jy(p),x,h-l+11)}t.textAlign="right";for(let p of qa(f-g[1],f+g[1],h/30)){let x=this.place(e,s===2?[u,u,p]:[u,p,u])[1];Jy(t,r,x,c-o,x),x>a+4&&t.fillText(jy(p),r-4,x+4)}t.strokeStyle=kr,t.strokeRect(r+.5,a+.5,c-r-o,h-a-l);let _=this.store.state.quantity==="force"?"f":"t",m=bi[this.store.state.quantity];t.fillStyle=Yt,t.textAlign="left",t.fillText(`${_}${"xyz"[s]??""} [${m}]`,r+4,a+12),t.textAlign="right",t.fillText(`${_}${"xyz"[i]??""} [${m}]`,c-o-4,h-l-5)}encircle(){let e=null,t=i=>{let s=this.canvas.getBoundingClientRect();return[i.clientX-s.left,i.clientY-s.top]};this.canvas.addEventListener("pointerdown",i=>{i.button===0&&(e=[t(i)],this.canvas.setPointerCapture(i.pointerId))}),this.canvas.addEventListener("pointermove",i=>{e!==null&&(e.push(t(i)),this.path=e,this.frames.later(this))}),this.canvas.addEventListener("pointerup",i=>{let s=e??[];[e,this.path]=[null,[]];let[r,o]=s[0]??[0,0];s.every(([a,l])=>Math.hypot(a-r,l-o)<=vC)?this.jump(i):this.store.set({selected:this.within(s)}),this.frames.later(this)}),this.canvas.addEventListener("pointercancel",()=>{[e,this.path]=[null,[]],this.frames.later(this)})}within(e){let t=this.maker.of(this.store.state),i=this.visible(t);return W0(this.data,t,s=>i.some(({points:r})=>G0(e,...this.place(t,r.subarray(3*s,3*s+3)))))}jump(e){if($c(this.data,this.store))return;let t=this.maker.of(this.store.state),i=this.canvas.getBoundingClientRect(),s={sample:-1,distance:yC};for(let r of this.visible(t))t.samples.forEach((o,a)=>{let[l,c]=this.place(t,r.points.subarray(3*a,3*a+3)),h=Math.hypot(l-e.clientX+i.left,c-e.clientY+i.top);h<s.distance&&(s={sample:o,distance:h})});s.sample>=0&&this.store.set({sample:s.sample,playing:!1})}};function xC(n,e){return n.some(({start_s:t,end_s:i})=>t<=e&&e<i)}function Ky(n,e,t){n.width=Math.round(e*devicePixelRatio),n.height=Math.round(t*devicePixelRatio);let i=n.getContext("2d");if(!i)throw new Error("this browser draws nothing on a canvas");return i.setTransform(devicePixelRatio,0,0,devicePixelRatio,0,0),i.fillStyle=Xn,i.fillRect(0,0,e,t),i}function Jy(n,e,t,i,s){n.beginPath(),n.moveTo(e,t),n.lineTo(i,s),n.stroke()}function jy(n){return String(Number(n.toPrecision(6))).replace("-","\u2212")}var SC="uplot",bC="u-hz",MC="u-vt",wC="u-title",TC="u-wrap",EC="u-under",AC="u-over",CC="u-axis",ao="u-off",RC="u-select",PC="u-cursor-x",IC="u-cursor-y",DC="u-cursor-pt",LC="u-legend",NC="u-live",UC="u-inline",FC="u-series",OC="u-marker",Qy="u-label",kC="u-value",sc="width",rc="height";var e_="bottom",va="left",tm="right",ym="#000",t_=ym+"0",nm="mousemove",n_="mousedown",im="mouseup",i_="mouseenter",s_="mouseleave",r_="dblclick",BC="resize",zC="scroll",o_="change",af="dppxchange",_m="--",wa=typeof window<"u",lm=wa?document:null,_a=wa?window:null,VC=wa?navigator:null,Lt,nf;function cm(){let n=devicePixelRatio;Lt!=n&&(Lt=n,nf&&um(o_,nf,cm),nf=matchMedia(`(min-resolution: ${Lt-.001}dppx) and (max-resolution: ${Lt+.001}dppx)`),lo(o_,nf,cm),_a.dispatchEvent(new CustomEvent(af)))}function Ii(n,e){if(e!=null){let t=n.classList;!t.contains(e)&&t.add(e)}}function hm(n,e){let t=n.classList;t.contains(e)&&t.remove(e)}function tn(n,e,t){n.style[e]=t+"px"}function rs(n,e,t,i){let s=lm.createElement(n);return e!=null&&Ii(s,e),t?.insertBefore(s,i),s}function Gi(n,e){return rs("div",n,e)}var a_=new WeakMap;function Rs(n,e,t,i,s){let r="translate("+e+"px,"+t+"px)",o=a_.get(n);r!=o&&(n.style.transform=r,a_.set(n,r),e<0||t<0||e>i||t>s?Ii(n,ao):hm(n,ao))}var l_=new WeakMap;function c_(n,e,t){let i=e+t,s=l_.get(n);i!=s&&(l_.set(n,i),n.style.background=e,n.style.borderColor=t)}var h_=new WeakMap;function u_(n,e,t,i){let s=e+""+t,r=h_.get(n);s!=r&&(h_.set(n,s),n.style.height=t+"px",n.style.width=e+"px",n.style.marginLeft=i?-e/2+"px":0,n.style.marginTop=i?-t/2+"px":0)}var xm={passive:!0},HC={...xm,capture:!0};function lo(n,e,t,i){e.addEventListener(n,t,i?HC:xm)}function um(n,e,t,i){e.removeEventListener(n,t,xm)}wa&&cm();function os(n,e,t,i){let s;t=t||0,i=i||e.length-1;let r=i<=2147483647;for(;i-t>1;)s=r?t+i>>1:Di((t+i)/2),e[s]<n?t=s:i=s;return n-e[t]<=e[i]-n?t:i}function B_(n){return(t,i,s)=>{let r=-1,o=-1;for(let a=i;a<=s;a++)if(n(t[a])){r=a;break}for(let a=s;a>=i;a--)if(n(t[a])){o=a;break}return[r,o]}}var z_=n=>n!=null,V_=n=>n!=null&&n>0,hf=B_(z_),GC=B_(V_);function WC(n,e,t,i=0,s=!1){let r=s?GC:hf,o=s?V_:z_;[e,t]=r(n,e,t);let a=n[e],l=n[e];if(e>-1)if(i==1)a=n[e],l=n[t];else if(i==-1)a=n[t],l=n[e];else for(let c=e;c<=t;c++){let h=n[c];o(h)&&(h<a?a=h:h>l&&(l=h))}return[a??Wt,l??-Wt]}function uf(n,e,t,i){let s=p_(n),r=p_(e);n==e&&(s==-1?(n*=t,e/=t):(n/=t,e*=t));let o=t==10?ir:H_,a=s==1?Di:Wi,l=r==1?Wi:Di,c=a(o(Dn(n))),h=l(o(Dn(e))),u=xa(t,c),f=xa(t,h);return t==10&&(c<0&&(u=Xt(u,-c)),h<0&&(f=Xt(f,-h))),i||t==2?(n=u*s,e=f*r):(n=q_(n,u),e=ff(e,f)),[n,e]}function Sm(n,e,t,i){let s=uf(n,e,t,i);return n==0&&(s[0]=0),e==0&&(s[1]=0),s}var bm=.1,f_={mode:3,pad:bm},ac={pad:0,soft:null,mode:0},XC={min:ac,max:ac};function lf(n,e,t,i){return df(t)?d_(n,e,t):(ac.pad=t,ac.soft=i?0:null,ac.mode=i?3:0,d_(n,e,XC))}function At(n,e){return n??e}function qC(n,e,t){for(e=At(e,0),t=At(t,n.length-1);e<=t;){if(n[e]!=null)return!0;e++}return!1}function d_(n,e,t){let i=t.min,s=t.max,r=At(i.pad,0),o=At(s.pad,0),a=At(i.hard,-Wt),l=At(s.hard,Wt),c=At(i.soft,Wt),h=At(s.soft,-Wt),u=At(i.mode,0),f=At(s.mode,0),d=e-n,g=ir(d),_=fi(Dn(n),Dn(e)),m=ir(_),p=Dn(m-g);(d<1e-24||p>10)&&(d=0,(n==0||e==0)&&(d=1e-24,u==2&&c!=Wt&&(r=0),f==2&&h!=-Wt&&(o=0)));let x=d||_||1e3,A=ir(x),w=xa(10,Di(A)),P=x*(d==0?n==0?.1:1:r),E=Xt(q_(n-P,w/10),24),y=n>=c&&(u==1||u==3&&E<=c||u==2&&E>=c)?c:Wt,T=fi(a,E<y&&n>=y?y:as(y,E)),k=x*(d==0?e==0?.1:1:o),N=Xt(ff(e+k,w/10),24),I=e<=h&&(f==1||f==3&&N>=h||f==2&&N<=h)?h:-Wt,z=as(l,N>I&&e<=I?I:fi(I,N));return T==z&&T==0&&(z=100),[T,z]}var YC=new Intl.NumberFormat(wa?VC.language:"en-US"),Mm=n=>YC.format(n),Li=Math,of=Li.PI,Dn=Li.abs,Di=Li.floor,In=Li.round,Wi=Li.ceil,as=Li.min,fi=Li.max,xa=Li.pow,p_=Li.sign,ir=Li.log10,H_=Li.log2,$C=(n,e=1)=>Li.sinh(n)*e,sm=(n,e=1)=>Li.asinh(n/e),Wt=1/0;function m_(n){return(ir((n^n>>31)-(n>>31))|0)+1}function fm(n,e,t){return as(fi(n,e),t)}function G_(n){return typeof n=="function"}function Mt(n){return G_(n)?n:()=>n}var ZC=()=>{},W_=n=>n,X_=(n,e)=>e,KC=n=>null,g_=n=>!0,v_=(n,e)=>n==e,JC=/\.\d*?(?=9{6,}|0{6,})/gm,co=n=>{if($_(n)||Nr.has(n))return n;let e=`${n}`,t=e.match(JC);if(t==null)return n;let i=t[0].length-1;if(e.indexOf("e-")!=-1){let[s,r]=e.split("e");return+`${co(s)}e${r}`}return Xt(n,i)};function ro(n,e){return co(Xt(co(n/e))*e)}function ff(n,e){return co(Wi(co(n/e))*e)}function q_(n,e){return co(Di(co(n/e))*e)}function Xt(n,e=0){if($_(n))return n;let t=10**e,i=n*t*(1+Number.EPSILON);return In(i)/t}var Nr=new Map;function Y_(n){return((""+n).split(".")[1]||"").length}function cc(n,e,t,i){let s=[],r=i.map(Y_);for(let o=e;o<t;o++){let a=Dn(o),l=Xt(xa(n,o),a);for(let c=0;c<i.length;c++){let h=n==10?+`${i[c]}e${o}`:i[c]*l,u=(o>=0?0:a)+(o>=r[c]?0:r[c]),f=n==10?h:Xt(h,u);s.push(f),Nr.set(f,u)}}return s}var lc={},wm=[],Sa=[null,null],Lr=Array.isArray,$_=Number.isInteger,jC=n=>n===void 0;function y_(n){return typeof n=="string"}function df(n){let e=!1;if(n!=null){let t=n.constructor;e=t==null||t==Object}return e}function QC(n){return n!=null&&typeof n=="object"}var eR=Object.getPrototypeOf(Uint8Array),Z_="__proto__";function ba(n,e=df){let t;if(Lr(n)){let i=n.find(s=>s!=null);if(Lr(i)||e(i)){t=Array(n.length);for(let s=0;s<n.length;s++)t[s]=ba(n[s],e)}else t=n.slice()}else if(n instanceof eR)t=n.slice();else if(e(n)){t={};for(let i in n)i!=Z_&&(t[i]=ba(n[i],e))}else t=n;return t}function wn(n){let e=arguments;for(let t=1;t<e.length;t++){let i=e[t];for(let s in i)s!=Z_&&(df(n[s])?wn(n[s],ba(i[s])):n[s]=ba(i[s]))}return n}var tR=0,nR=1,iR=2;function sR(n,e,t){for(let i=0,s,r=-1;i<e.length;i++){let o=e[i];if(o>r){for(s=o-1;s>=0&&n[s]==null;)n[s--]=null;for(s=o+1;s<t&&n[s]==null;)n[r=s++]=null}}}function rR(n,e){if(lR(n)){let o=n[0].slice();for(let a=1;a<n.length;a++)o.push(...n[a].slice(1));return cR(o[0])||(o=aR(o)),o}let t=new Set;for(let o=0;o<n.length;o++){let l=n[o][0],c=l.length;for(let h=0;h<c;h++)t.add(l[h])}let i=[Array.from(t).sort((o,a)=>o-a)],s=i[0].length,r=new Map;for(let o=0;o<s;o++)r.set(i[0][o],o);for(let o=0;o<n.length;o++){let a=n[o],l=a[0];for(let c=1;c<a.length;c++){let h=a[c],u=Array(s).fill(void 0),f=e?e[o][c]:nR,d=[];for(let g=0;g<h.length;g++){let _=h[g],m=r.get(l[g]);_===null?f!=tR&&(u[m]=_,f==iR&&d.push(m)):u[m]=_}sR(u,d,s),i.push(u)}}return i}var oR=typeof queueMicrotask>"u"?n=>Promise.resolve().then(n):queueMicrotask;function aR(n){let e=n[0],t=e.length,i=Array(t);for(let r=0;r<i.length;r++)i[r]=r;i.sort((r,o)=>e[r]-e[o]);let s=[];for(let r=0;r<n.length;r++){let o=n[r],a=Array(t);for(let l=0;l<t;l++)a[l]=o[i[l]];s.push(a)}return s}function lR(n){let e=n[0][0],t=e.length;for(let i=1;i<n.length;i++){let s=n[i][0];if(s.length!=t)return!1;if(s!=e){for(let r=0;r<t;r++)if(s[r]!=e[r])return!1}}return!0}function cR(n,e=100){let t=n.length;if(t<=1)return!0;let i=0,s=t-1;for(;i<=s&&n[i]==null;)i++;for(;s>=i&&n[s]==null;)s--;if(s<=i)return!0;let r=fi(1,Di((s-i+1)/e));for(let o=n[i],a=i+r;a<=s;a+=r){let l=n[a];if(l!=null){if(l<=o)return!1;o=l}}return!0}var K_=["January","February","March","April","May","June","July","August","September","October","November","December"],J_=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function j_(n){return n.slice(0,3)}var hR=J_.map(j_),uR=K_.map(j_),fR={MMMM:K_,MMM:uR,WWWW:J_,WWW:hR};function ic(n){return(n<10?"0":"")+n}function dR(n){return(n<10?"00":n<100?"0":"")+n}var pR={YYYY:n=>n.getFullYear(),YY:n=>(n.getFullYear()+"").slice(2),MMMM:(n,e)=>e.MMMM[n.getMonth()],MMM:(n,e)=>e.MMM[n.getMonth()],MM:n=>ic(n.getMonth()+1),M:n=>n.getMonth()+1,DD:n=>ic(n.getDate()),D:n=>n.getDate(),WWWW:(n,e)=>e.WWWW[n.getDay()],WWW:(n,e)=>e.WWW[n.getDay()],HH:n=>ic(n.getHours()),H:n=>n.getHours(),h:n=>{let e=n.getHours();return e==0?12:e>12?e-12:e},AA:n=>n.getHours()>=12?"PM":"AM",aa:n=>n.getHours()>=12?"pm":"am",a:n=>n.getHours()>=12?"p":"a",mm:n=>ic(n.getMinutes()),m:n=>n.getMinutes(),ss:n=>ic(n.getSeconds()),s:n=>n.getSeconds(),fff:n=>dR(n.getMilliseconds())};function Tm(n,e){e=e||fR;let t=[],i=/\{([a-z]+)\}|[^{]+/gi,s;for(;s=i.exec(n);)t.push(s[0][0]=="{"?pR[s[1]]:s[0]);return r=>{let o="";for(let a=0;a<t.length;a++)o+=typeof t[a]=="string"?t[a]:t[a](r,e);return o}}var mR=new Intl.DateTimeFormat().resolvedOptions().timeZone;function gR(n,e){let t;return e=="UTC"||e=="Etc/UTC"?t=new Date(+n+n.getTimezoneOffset()*6e4):e==mR?t=n:(t=new Date(n.toLocaleString("en-US",{timeZone:e})),t.setMilliseconds(n.getMilliseconds())),t}var Q_=n=>n%1==0,cf=[1,2,2.5,5],vR=cc(10,-32,0,cf),ex=cc(10,0,32,cf),yR=ex.filter(Q_),oo=vR.concat(ex),Em=`
`,tx="{YYYY}",__=Em+tx,nx="{M}/{D}",oc=Em+nx,sf=oc+"/{YY}",ix="{aa}",_R="{h}:{mm}",ya=_R+ix,x_=Em+ya,S_=":{ss}",Ot=null;function sx(n){let e=n*1e3,t=e*60,i=t*60,s=i*24,r=s*30,o=s*365,l=(n==1?cc(10,0,3,cf).filter(Q_):cc(10,-3,0,cf)).concat([e,e*5,e*10,e*15,e*30,t,t*5,t*10,t*15,t*30,i,i*2,i*3,i*4,i*6,i*8,i*12,s,s*2,s*3,s*4,s*5,s*6,s*7,s*8,s*9,s*10,s*15,r,r*2,r*3,r*4,r*6,o,o*2,o*5,o*10,o*25,o*50,o*100]),c=[[o,tx,Ot,Ot,Ot,Ot,Ot,Ot,1],[s*28,"{MMM}",__,Ot,Ot,Ot,Ot,Ot,1],[s,nx,__,Ot,Ot,Ot,Ot,Ot,1],[i,"{h}"+ix,sf,Ot,oc,Ot,Ot,Ot,1],[t,ya,sf,Ot,oc,Ot,Ot,Ot,1],[e,S_,sf+" "+ya,Ot,oc+" "+ya,Ot,x_,Ot,1],[n,S_+".{fff}",sf+" "+ya,Ot,oc+" "+ya,Ot,x_,Ot,1]];function h(u){return(f,d,g,_,m,p)=>{let x=[],A=m>=o,w=m>=r&&m<o,P=u(g),E=Xt(P*n,3),y=rm(P.getFullYear(),A?0:P.getMonth(),w||A?1:P.getDate()),T=Xt(y*n,3);if(w||A){let k=w?m/r:0,N=A?m/o:0,I=E==T?E:Xt(rm(y.getFullYear()+N,y.getMonth()+k,1)*n,3),z=new Date(In(I/n)),W=z.getFullYear(),L=z.getMonth();for(let X=0;I<=_;X++){let $=rm(W+N*X,L+k*X,1),V=$-u(Xt($*n,3));I=Xt((+$+V)*n,3),I<=_&&x.push(I)}}else{let k=m>=s?s:m,N=Di(g)-Di(E),I=T+N+ff(E-T,k);x.push(I);let z=u(I),W=z.getHours()+z.getMinutes()/t+z.getSeconds()/i,L=m/i,X=f.axes[d]._space,$=p/X;for(;I=Xt(I+m,n==1?0:3),!(I>_);)if(L>1){let V=Di(Xt(W+L,6))%24,ee=u(I).getHours()-V;ee>1&&(ee=-1),I-=ee*i,W=(W+L)%24;let se=x[x.length-1];Xt((I-se)/m,3)*$>=.7&&x.push(I)}else x.push(I)}return x}}return[l,c,h]}var[xR,SR,bR]=sx(1),[MR,wR,TR]=sx(.001);cc(2,-53,53,[1]);function b_(n,e){return n.map(t=>t.map((i,s)=>s==0||s==8||i==null?i:e(s==1||t[8]==0?i:t[1]+i)))}function M_(n,e){return(t,i,s,r,o)=>{let a=e.find(g=>o>=g[0])||e[e.length-1],l,c,h,u,f,d;return i.map(g=>{let _=n(g),m=_.getFullYear(),p=_.getMonth(),x=_.getDate(),A=_.getHours(),w=_.getMinutes(),P=_.getSeconds(),E=m!=l&&a[2]||p!=c&&a[3]||x!=h&&a[4]||A!=u&&a[5]||w!=f&&a[6]||P!=d&&a[7]||a[1];return l=m,c=p,h=x,u=A,f=w,d=P,E(_)})}}function ER(n,e){let t=Tm(e);return(i,s,r,o,a)=>s.map(l=>t(n(l)))}function rm(n,e,t){return new Date(n,e,t)}function w_(n,e){return e(n)}var AR="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function T_(n,e){return(t,i,s,r)=>r==null?_m:e(n(i))}function CR(n,e){let t=n.series[e];return t.width?t.stroke(n,e):t.points.width?t.points.stroke(n,e):null}function RR(n,e){return n.series[e].fill(n,e)}var PR={show:!0,live:!0,isolate:!1,mount:ZC,markers:{show:!0,width:2,stroke:CR,fill:RR,dash:"solid"},idx:null,idxs:null,values:[]};function IR(n,e){let t=n.cursor.points,i=Gi(),s=t.size(n,e);tn(i,sc,s),tn(i,rc,s);let r=s/-2;tn(i,"marginLeft",r),tn(i,"marginTop",r);let o=t.width(n,e,s);return o&&tn(i,"borderWidth",o),i}function DR(n,e){let t=n.series[e].points;return t._fill||t._stroke}function LR(n,e){let t=n.series[e].points;return t._stroke||t._fill}function NR(n,e){return n.series[e].points.size}var om=[0,0];function UR(n,e,t){return om[0]=e,om[1]=t,om}function rf(n,e,t,i=!0){return s=>{s.button==0&&(!i||s.target==e)&&t(s)}}function am(n,e,t,i=!0){return s=>{(!i||s.target==e)&&t(s)}}var FR={show:!0,x:!0,y:!0,lock:!1,move:UR,points:{one:!1,show:IR,size:NR,width:0,stroke:LR,fill:DR},bind:{mousedown:rf,mouseup:rf,click:rf,dblclick:rf,mousemove:am,mouseleave:am,mouseenter:am},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(n,e)=>{e.stopPropagation(),e.stopImmediatePropagation()},_x:!1,_y:!1},focus:{dist:(n,e,t,i,s)=>i-s,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},rx={show:!0,stroke:"rgba(0,0,0,0.07)",width:2},Am=wn({},rx,{filter:X_}),ox=wn({},Am,{size:10}),ax=wn({},rx,{show:!1}),Cm='12px system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',lx="bold "+Cm,cx=1.5,E_={show:!0,scale:"x",stroke:ym,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:lx,side:2,grid:Am,ticks:ox,border:ax,font:Cm,lineGap:cx,rotate:0},OR="Value",kR="Time",A_={show:!0,scale:"x",auto:!1,sorted:1,min:Wt,max:-Wt,idxs:[]};function BR(n,e,t,i,s){return e.map(r=>r==null?"":Mm(r))}function zR(n,e,t,i,s,r,o){let a=[],l=Nr.get(s)||0;t=o?t:Xt(ff(t,s),l);for(let c=t;c<=i;c=Xt(c+s,l))a.push(Object.is(c,-0)?0:c);return a}function dm(n,e,t,i,s,r,o){let a=[],l=n.scales[n.axes[e].scale].log,c=l==10?ir:H_,h=Di(c(t));s=xa(l,h),l==10&&(s=oo[os(s,oo)]);let u=t,f=s*l;l==10&&(f=oo[os(f,oo)]);do a.push(u),u=u+s,l==10&&!Nr.has(u)&&(u=Xt(u,Nr.get(s))),u>=f&&(s=u,f=s*l,l==10&&(f=oo[os(f,oo)]));while(u<=i);return a}function VR(n,e,t,i,s,r,o){let l=n.scales[n.axes[e].scale].asinh,c=i>l?dm(n,e,fi(l,t),i,s):[l],h=i>=0&&t<=0?[0]:[];return(t<-l?dm(n,e,fi(l,-i),-t,s):[l]).reverse().map(f=>-f).concat(h,c)}var hx=/./,HR=/[12357]/,GR=/[125]/,C_=/1/,pm=(n,e,t,i)=>n.map((s,r)=>e==4&&s==0||r%i==0&&t.test(s.toExponential()[s<0?1:0])?s:null);function WR(n,e,t,i,s){let r=n.axes[t],o=r.scale,a=n.scales[o],l=n.valToPos,c=r._space,h=l(10,o),u=l(9,o)-h>=c?hx:l(7,o)-h>=c?HR:l(5,o)-h>=c?GR:C_;if(u==C_){let f=Dn(l(1,o)-h);if(f<c)return pm(e.slice().reverse(),a.distr,u,Wi(c/f)).reverse()}return pm(e,a.distr,u,1)}function XR(n,e,t,i,s){let r=n.axes[t],o=r.scale,a=r._space,l=n.valToPos,c=Dn(l(1,o)-l(2,o));return c<a?pm(e.slice().reverse(),3,hx,Wi(a/c)).reverse():e}function qR(n,e,t,i){return i==null?_m:e==null?"":Mm(e)}var R_={show:!0,scale:"y",stroke:ym,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:lx,side:3,grid:Am,ticks:ox,border:ax,font:Cm,lineGap:cx,rotate:0};function YR(n,e){let t=3+(n||1)*2;return Xt(t*e,3)}function $R(n,e){let{scale:t,idxs:i}=n.series[0],s=n._data[0],r=n.valToPos(s[i[0]],t,!0),o=n.valToPos(s[i[1]],t,!0),a=Dn(o-r),l=n.series[e],c=a/(l.points.space*Lt);return i[1]-i[0]<=c}var P_={scale:null,auto:!0,sorted:0,min:Wt,max:-Wt},ux=(n,e,t,i,s)=>s,I_={show:!0,auto:!0,sorted:0,gaps:ux,alpha:1,facets:[wn({},P_,{scale:"x"}),wn({},P_,{scale:"y"})]},D_={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,gaps:ux,alpha:1,points:{show:$R,filter:null},values:null,min:Wt,max:-Wt,idxs:[],path:null,clip:null};function ZR(n,e,t,i,s){return t/10}var fx={time:!0,auto:!0,distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},KR=wn({},fx,{time:!1,ori:1}),L_={};function dx(n,e){let t=L_[n];return t||(t={key:n,plots:[],sub(i){t.plots.push(i)},unsub(i){t.plots=t.plots.filter(s=>s!=i)},pub(i,s,r,o,a,l,c){for(let h=0;h<t.plots.length;h++)t.plots[h]!=s&&t.plots[h].pub(i,s,r,o,a,l,c)}},n!=null&&(L_[n]=t)),t}var Ma=1,mm=2;function ho(n,e,t){let i=n.mode,s=n.series[e],r=i==2?n._data[e]:n._data,o=n.scales,a=n.bbox,l=r[0],c=i==2?r[1]:r[e],h=i==2?o[s.facets[0].scale]:o[n.series[0].scale],u=i==2?o[s.facets[1].scale]:o[s.scale],f=a.left,d=a.top,g=a.width,_=a.height,m=n.valToPosH,p=n.valToPosV;return h.ori==0?t(s,l,c,h,u,m,p,f,d,g,_,mf,Ta,vf,mx,vx):t(s,l,c,h,u,p,m,d,f,_,g,gf,Ea,Im,gx,yx)}function Rm(n,e){let t=0,i=0,s=At(n.bands,wm);for(let r=0;r<s.length;r++){let o=s[r];o.series[0]==e?t=o.dir:o.series[1]==e&&(o.dir==1?i|=1:i|=2)}return[t,i==1?-1:i==2?1:i==3?2:0]}function JR(n,e,t,i,s){let r=n.mode,o=n.series[e],a=r==2?o.facets[1].scale:o.scale,l=n.scales[a];return s==-1?l.min:s==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function sr(n,e,t,i,s,r){return ho(n,e,(o,a,l,c,h,u,f,d,g,_,m)=>{let p=o.pxRound,x=c.dir*(c.ori==0?1:-1),A=c.ori==0?Ta:Ea,w,P;x==1?(w=t,P=i):(w=i,P=t);let E=p(u(a[w],c,_,d)),y=p(f(l[w],h,m,g)),T=p(u(a[P],c,_,d)),k=p(f(r==1?h.max:h.min,h,m,g)),N=new Path2D(s);return A(N,T,k),A(N,E,k),A(N,E,y),N})}function pf(n,e,t,i,s,r){let o=null;if(n.length>0){o=new Path2D;let a=e==0?vf:Im,l=t;for(let u=0;u<n.length;u++){let f=n[u];if(f[1]>f[0]){let d=f[0]-l;d>0&&a(o,l,i,d,i+r),l=f[1]}}let c=t+s-l,h=10;c>0&&a(o,l,i-h/2,c,i+r+h)}return o}function jR(n,e,t){let i=n[n.length-1];i&&i[0]==e?i[1]=t:n.push([e,t])}function Pm(n,e,t,i,s,r,o){let a=[],l=n.length;for(let c=s==1?t:i;c>=t&&c<=i;c+=s)if(e[c]===null){let u=c,f=c;if(s==1)for(;++c<=i&&e[c]===null;)f=c;else for(;--c>=t&&e[c]===null;)f=c;let d=r(n[u]),g=f==u?d:r(n[f]),_=u-s;d=o<=0&&_>=0&&_<l?r(n[_]):d;let p=f+s;g=o>=0&&p>=0&&p<l?r(n[p]):g,g>=d&&a.push([d,g])}return a}function N_(n){return n==0?W_:n==1?In:e=>ro(e,n)}function px(n){let e=n==0?mf:gf,t=n==0?(s,r,o,a,l,c)=>{s.arcTo(r,o,a,l,c)}:(s,r,o,a,l,c)=>{s.arcTo(o,r,l,a,c)},i=n==0?(s,r,o,a,l)=>{s.rect(r,o,a,l)}:(s,r,o,a,l)=>{s.rect(o,r,l,a)};return(s,r,o,a,l,c=0,h=0)=>{c==0&&h==0?i(s,r,o,a,l):(c=as(c,a/2,l/2),h=as(h,a/2,l/2),e(s,r+c,o),t(s,r+a,o,r+a,o+l,c),t(s,r+a,o+l,r,o+l,h),t(s,r,o+l,r,o,h),t(s,r,o,r+a,o,c),s.closePath())}}var mf=(n,e,t)=>{n.moveTo(e,t)},gf=(n,e,t)=>{n.moveTo(t,e)},Ta=(n,e,t)=>{n.lineTo(e,t)},Ea=(n,e,t)=>{n.lineTo(t,e)},vf=px(0),Im=px(1),mx=(n,e,t,i,s,r)=>{n.arc(e,t,i,s,r)},gx=(n,e,t,i,s,r)=>{n.arc(t,e,i,s,r)},vx=(n,e,t,i,s,r,o)=>{n.bezierCurveTo(e,t,i,s,r,o)},yx=(n,e,t,i,s,r,o)=>{n.bezierCurveTo(t,e,s,i,o,r)};function _x(n){return(e,t,i,s,r)=>ho(e,t,(o,a,l,c,h,u,f,d,g,_,m)=>{let{pxRound:p,points:x}=o,A,w;c.ori==0?(A=mf,w=mx):(A=gf,w=gx);let P=Xt(x.width*Lt,3),E=(x.size-x.width)/2*Lt,y=Xt(E*2,3),T=new Path2D,k=new Path2D,{left:N,top:I,width:z,height:W}=e.bbox;vf(k,N-y,I-y,z+y*2,W+y*2);let L=X=>{if(l[X]!=null){let $=p(u(a[X],c,_,d)),V=p(f(l[X],h,m,g));A(T,$+E,V),w(T,$,V,E,0,of*2)}};if(r)r.forEach(L);else for(let X=i;X<=s;X++)L(X);return{stroke:P>0?T:null,fill:T,clip:k,flags:Ma|mm}})}function xx(n){return(e,t,i,s,r,o)=>{i!=s&&(r!=i&&o!=i&&n(e,t,i),r!=s&&o!=s&&n(e,t,s),n(e,t,o))}}var QR=xx(Ta),eP=xx(Ea);function Sx(n){let e=At(n?.alignGaps,0);return(t,i,s,r)=>ho(t,i,(o,a,l,c,h,u,f,d,g,_,m)=>{[s,r]=hf(l,s,r);let p=o.pxRound,x=W=>p(u(W,c,_,d)),A=W=>p(f(W,h,m,g)),w,P;c.ori==0?(w=Ta,P=QR):(w=Ea,P=eP);let E=c.dir*(c.ori==0?1:-1),y={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:Ma},T=y.stroke,k=!1;if(r-s>=_*4){let W=he=>t.posToVal(he,c.key,!0),L=null,X=null,$,V,ce,K=x(a[E==1?s:r]),ee=x(a[s]),se=x(a[r]),de=W(E==1?ee+1:se-1);for(let he=E==1?s:r;he>=s&&he<=r;he+=E){let te=a[he],ve=(E==1?te<de:te>de)?K:x(te),Me=l[he];ve==K?Me!=null?(V=Me,L==null?(w(T,ve,A(V)),$=L=X=V):V<L?L=V:V>X&&(X=V)):Me===null&&(k=!0):(L!=null&&P(T,K,A(L),A(X),A($),A(V)),Me!=null?(V=Me,w(T,ve,A(V)),L=X=$=V):(L=X=null,Me===null&&(k=!0)),K=ve,de=W(K+E))}L!=null&&L!=X&&ce!=K&&P(T,K,A(L),A(X),A($),A(V))}else for(let W=E==1?s:r;W>=s&&W<=r;W+=E){let L=l[W];L===null?k=!0:L!=null&&w(T,x(a[W]),A(L))}let[I,z]=Rm(t,i);if(o.fill!=null||I!=0){let W=y.fill=new Path2D(T),L=o.fillTo(t,i,o.min,o.max,I),X=A(L),$=x(a[s]),V=x(a[r]);E==-1&&([V,$]=[$,V]),w(W,V,X),w(W,$,X)}if(!o.spanGaps){let W=[];k&&W.push(...Pm(a,l,s,r,E,x,e)),y.gaps=W=o.gaps(t,i,s,r,W),y.clip=pf(W,c.ori,d,g,_,m)}return z!=0&&(y.band=z==2?[sr(t,i,s,r,T,-1),sr(t,i,s,r,T,1)]:sr(t,i,s,r,T,z)),y})}function tP(n){let e=At(n.align,1),t=At(n.ascDesc,!1),i=At(n.alignGaps,0),s=At(n.extend,!1);return(r,o,a,l)=>ho(r,o,(c,h,u,f,d,g,_,m,p,x,A)=>{[a,l]=hf(u,a,l);let w=c.pxRound,{left:P,width:E}=r.bbox,y=ee=>w(g(ee,f,x,m)),T=ee=>w(_(ee,d,A,p)),k=f.ori==0?Ta:Ea,N={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:Ma},I=N.stroke,z=f.dir*(f.ori==0?1:-1),W=T(u[z==1?a:l]),L=y(h[z==1?a:l]),X=L,$=L;s&&e==-1&&($=P,k(I,$,W)),k(I,L,W);for(let ee=z==1?a:l;ee>=a&&ee<=l;ee+=z){let se=u[ee];if(se==null)continue;let de=y(h[ee]),he=T(se);e==1?k(I,de,W):k(I,X,he),k(I,de,he),W=he,X=de}let V=X;s&&e==1&&(V=P+E,k(I,V,W));let[ce,K]=Rm(r,o);if(c.fill!=null||ce!=0){let ee=N.fill=new Path2D(I),se=c.fillTo(r,o,c.min,c.max,ce),de=T(se);k(ee,V,de),k(ee,$,de)}if(!c.spanGaps){let ee=[];ee.push(...Pm(h,u,a,l,z,y,i));let se=c.width*Lt/2,de=t||e==1?se:-se,he=t||e==-1?-se:se;ee.forEach(te=>{te[0]+=de,te[1]+=he}),N.gaps=ee=c.gaps(r,o,a,l,ee),N.clip=pf(ee,f.ori,m,p,x,A)}return K!=0&&(N.band=K==2?[sr(r,o,a,l,I,-1),sr(r,o,a,l,I,1)]:sr(r,o,a,l,I,K)),N})}function U_(n,e,t,i,s,r,o=Wt){if(n.length>1){let a=null;for(let l=0,c=1/0;l<n.length;l++)if(e[l]!==void 0){if(a!=null){let h=Dn(n[l]-n[a]);h<c&&(c=h,o=Dn(t(n[l],i,s,r)-t(n[a],i,s,r)))}a=l}}return o}function nP(n){n=n||lc;let e=At(n.size,[.6,Wt,1]),t=n.align||0,i=n.gap||0,s=n.radius;s=s==null?[0,0]:typeof s=="number"?[s,0]:s;let r=Mt(s),o=1-e[0],a=At(e[1],Wt),l=At(e[2],1),c=At(n.disp,lc),h=At(n.each,d=>{}),{fill:u,stroke:f}=c;return(d,g,_,m)=>ho(d,g,(p,x,A,w,P,E,y,T,k,N,I)=>{let z=p.pxRound,W=t,L=i*Lt,X=a*Lt,$=l*Lt,V,ce;w.ori==0?[V,ce]=r(d,g):[ce,V]=r(d,g);let K=w.dir*(w.ori==0?1:-1),ee=w.ori==0?vf:Im,se=w.ori==0?h:(Pe,je,ct,Te,Gt,Ge,Ze)=>{h(Pe,je,ct,Gt,Te,Ze,Ge)},de=At(d.bands,wm).find(Pe=>Pe.series[0]==g),he=de!=null?de.dir:0,te=p.fillTo(d,g,p.min,p.max,he),me=z(y(te,P,I,k)),ve,Me,xe,We=N,ot=z(p.width*Lt),He=!1,ut=null,ht=null,at=null,nn=null;u!=null&&(ot==0||f!=null)&&(He=!0,ut=u.values(d,g,_,m),ht=new Map,new Set(ut).forEach(Pe=>{Pe!=null&&ht.set(Pe,new Path2D)}),ot>0&&(at=f.values(d,g,_,m),nn=new Map,new Set(at).forEach(Pe=>{Pe!=null&&nn.set(Pe,new Path2D)})));let{x0:qt,size:gn}=c;if(qt!=null&&gn!=null){W=1,x=qt.values(d,g,_,m),qt.unit==2&&(x=x.map(ct=>d.posToVal(T+ct*N,w.key,!0)));let Pe=gn.values(d,g,_,m);gn.unit==2?Me=Pe[0]*N:Me=E(Pe[0],w,N,T)-E(0,w,N,T),We=U_(x,A,E,w,N,T,We),xe=We-Me+L}else We=U_(x,A,E,w,N,T,We),xe=We*o+L,Me=We-xe;xe<1&&(xe=0),ot>=Me/2&&(ot=0),xe<5&&(z=W_);let Vt=xe>0,Nn=We-xe-(Vt?ot:0);Me=z(fm(Nn,$,X)),ve=(W==0?Me/2:W==K?0:Me)-W*K*((W==0?L/2:0)+(Vt?ot/2:0));let wt={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},Tn=He?null:new Path2D,an=null;if(de!=null)an=d.data[de.series[1]];else{let{y0:Pe,y1:je}=c;Pe!=null&&je!=null&&(A=je.values(d,g,_,m),an=Pe.values(d,g,_,m))}let vn=V*Me,F=ce*Me;for(let Pe=K==1?_:m;Pe>=_&&Pe<=m;Pe+=K){let je=A[Pe];if(je==null)continue;if(an!=null){let Y=an[Pe]??0;if(je-Y==0)continue;me=y(Y,P,I,k)}let ct=w.distr!=2||c!=null?x[Pe]:Pe,Te=E(ct,w,N,T),Gt=y(At(je,te),P,I,k),Ge=z(Te-ve),Ze=z(fi(Gt,me)),C=z(as(Gt,me)),S=Ze-C;if(je!=null){let Y=je<0?F:vn,fe=je<0?vn:F;He?(ot>0&&at[Pe]!=null&&ee(nn.get(at[Pe]),Ge,C+Di(ot/2),Me,fi(0,S-ot),Y,fe),ut[Pe]!=null&&ee(ht.get(ut[Pe]),Ge,C+Di(ot/2),Me,fi(0,S-ot),Y,fe)):ee(Tn,Ge,C+Di(ot/2),Me,fi(0,S-ot),Y,fe),se(d,g,Pe,Ge-ot/2,C,Me+ot,S)}}return ot>0?wt.stroke=He?nn:Tn:He||(wt._fill=p.width==0?p._fill:p._stroke??p._fill,wt.width=0),wt.fill=He?ht:Tn,wt})}function iP(n,e){let t=At(e?.alignGaps,0);return(i,s,r,o)=>ho(i,s,(a,l,c,h,u,f,d,g,_,m,p)=>{[r,o]=hf(c,r,o);let x=a.pxRound,A=V=>x(f(V,h,m,g)),w=V=>x(d(V,u,p,_)),P,E,y;h.ori==0?(P=mf,y=Ta,E=vx):(P=gf,y=Ea,E=yx);let T=h.dir*(h.ori==0?1:-1),k=A(l[T==1?r:o]),N=k,I=[],z=[];for(let V=T==1?r:o;V>=r&&V<=o;V+=T)if(c[V]!=null){let K=l[V],ee=A(K);I.push(N=ee),z.push(w(c[V]))}let W={stroke:n(I,z,P,y,E,x),fill:null,clip:null,band:null,gaps:null,flags:Ma},L=W.stroke,[X,$]=Rm(i,s);if(a.fill!=null||X!=0){let V=W.fill=new Path2D(L),ce=a.fillTo(i,s,a.min,a.max,X),K=w(ce);y(V,N,K),y(V,k,K)}if(!a.spanGaps){let V=[];V.push(...Pm(l,c,r,o,T,A,t)),W.gaps=V=a.gaps(i,s,r,o,V),W.clip=pf(V,h.ori,g,_,m,p)}return $!=0&&(W.band=$==2?[sr(i,s,r,o,L,-1),sr(i,s,r,o,L,1)]:sr(i,s,r,o,L,$)),W})}function sP(n){return iP(rP,n)}function rP(n,e,t,i,s,r){let o=n.length;if(o<2)return null;let a=new Path2D;if(t(a,n[0],e[0]),o==2)i(a,n[1],e[1]);else{let l=Array(o),c=Array(o-1),h=Array(o-1),u=Array(o-1);for(let f=0;f<o-1;f++)h[f]=e[f+1]-e[f],u[f]=n[f+1]-n[f],c[f]=h[f]/u[f];l[0]=c[0];for(let f=1;f<o-1;f++)c[f]===0||c[f-1]===0||c[f-1]>0!=c[f]>0?l[f]=0:(l[f]=3*(u[f-1]+u[f])/((2*u[f]+u[f-1])/c[f-1]+(u[f]+2*u[f-1])/c[f]),isFinite(l[f])||(l[f]=0));l[o-1]=c[o-2];for(let f=0;f<o-1;f++)s(a,n[f]+u[f]/3,e[f]+l[f]*u[f]/3,n[f+1]-u[f]/3,e[f+1]-l[f+1]*u[f]/3,n[f+1],e[f+1])}return a}var gm=new Set;function F_(){for(let n of gm)n.syncRect(!0)}wa&&(lo(BC,_a,F_),lo(zC,_a,F_,!0),lo(af,_a,()=>{Yn.pxRatio=Lt}));var oP=Sx(),aP=_x();function O_(n,e,t,i){return(i?[n[0],n[1]].concat(n.slice(2)):[n[0]].concat(n.slice(1))).map((r,o)=>vm(r,o,e,t))}function lP(n,e){return n.map((t,i)=>i==0?{}:wn({},e,t))}function vm(n,e,t,i){return wn({},e==0?t:i,n)}function bx(n,e,t){return e==null?Sa:[e,t]}var cP=bx;function hP(n,e,t){return e==null?Sa:lf(e,t,bm,!0)}function Mx(n,e,t,i){return e==null?Sa:uf(e,t,n.scales[i].log,!1)}var uP=Mx;function wx(n,e,t,i){return e==null?Sa:Sm(e,t,n.scales[i].log,!1)}var fP=wx;function dP(n,e,t,i,s){let r=fi(m_(n),m_(e)),o=e-n,a=os(s/i*o,t);do{let l=t[a],c=i*l/o;if(c>=s&&r+(l<5?Nr.get(l):0)<=17)return[l,c]}while(++a<t.length);return[0,0]}function k_(n){let e,t;return n=n.replace(/(\d+)px/,(i,s)=>(e=In((t=+s)*Lt))+"px"),[n,e,t]}function pP(n){n.show&&[n.font,n.labelFont].forEach(e=>{let t=Xt(e[2]*Lt,1);e[0]=e[0].replace(/[0-9.]+px/,t+"px"),e[1]=t})}function Yn(n,e,t){let i={mode:At(n.mode,1)},s=i.mode;function r(v,b,R,D){let G=b.valToPct(v);return D+R*(b.dir==-1?1-G:G)}function o(v,b,R,D){let G=b.valToPct(v);return D+R*(b.dir==-1?G:1-G)}function a(v,b,R,D){return b.ori==0?r(v,b,R,D):o(v,b,R,D)}i.valToPosH=r,i.valToPosV=o;let l=!1;i.status=0;let c=i.root=Gi(SC);if(n.id!=null&&(c.id=n.id),Ii(c,n.class),n.title){let v=Gi(wC,c);v.textContent=n.title}let h=rs("canvas"),u=i.ctx=h.getContext("2d"),f=Gi(TC,c);lo("click",f,v=>{v.target===g&&(Kt!=yo||sn!=_o)&&Wn.click(i,v)},!0);let d=i.under=Gi(EC,f);f.appendChild(h);let g=i.over=Gi(AC,f);n=ba(n);let _=+At(n.pxAlign,1),m=N_(_);(n.plugins||[]).forEach(v=>{v.opts&&(n=v.opts(i,n)||n)});let p=n.ms||.001,x=i.series=s==1?O_(n.series||[],A_,D_,!1):lP(n.series||[null],I_),A=i.axes=O_(n.axes||[],E_,R_,!0),w=i.scales={},P=i.bands=n.bands||[];P.forEach(v=>{v.fill=Mt(v.fill||null),v.dir=At(v.dir,-1)});let E=s==2?x[1].facets[0].scale:x[0].scale,y={axes:Ns,series:vt},T=(n.drawOrder||["axes","series"]).map(v=>y[v]);function k(v){let b=v.distr==3?R=>ir(R>0?R:v.clamp(i,R,v.min,v.max,v.key)):v.distr==4?R=>sm(R,v.asinh):v.distr==100?R=>v.fwd(R):R=>R;return R=>{let D=b(R),{_min:G,_max:j}=v,le=j-G;return(D-G)/le}}function N(v){let b=w[v];if(b==null){let R=(n.scales||lc)[v]||lc;if(R.from!=null){N(R.from);let D=wn({},w[R.from],R,{key:v});D.valToPct=k(D),w[v]=D}else{b=w[v]=wn({},v==E?fx:KR,R),b.key=v;let D=b.time,G=b.range,j=Lr(G);if((v!=E||s==2&&!D)&&(j&&(G[0]==null||G[1]==null)&&(G={min:G[0]==null?f_:{mode:1,hard:G[0],soft:G[0]},max:G[1]==null?f_:{mode:1,hard:G[1],soft:G[1]}},j=!1),!j&&df(G))){let le=G;G=(pe,be,Ne)=>be==null?Sa:lf(be,Ne,le)}b.range=Mt(G||(D?cP:v==E?b.distr==3?uP:b.distr==4?fP:bx:b.distr==3?Mx:b.distr==4?wx:hP)),b.auto=Mt(j?!1:b.auto),b.clamp=Mt(b.clamp||ZR),b._min=b._max=null,b.valToPct=k(b)}}}N("x"),N("y"),s==1&&x.forEach(v=>{N(v.scale)}),A.forEach(v=>{N(v.scale)});for(let v in n.scales)N(v);let I=w[E],z=I.distr,W,L;I.ori==0?(Ii(c,bC),W=r,L=o):(Ii(c,MC),W=o,L=r);let X={};for(let v in w){let b=w[v];(b.min!=null||b.max!=null)&&(X[v]={min:b.min,max:b.max},b.min=b.max=null)}let $=n.tzDate||(v=>new Date(In(v/p))),V=n.fmtDate||Tm,ce=p==1?bR($):TR($),K=M_($,b_(p==1?SR:wR,V)),ee=T_($,w_(AR,V)),se=[],de=i.legend=wn({},PR,n.legend),he=i.cursor=wn({},FR,{drag:{y:s==2}},n.cursor),te=de.show,me=he.show,ve=de.markers;de.idxs=se,ve.width=Mt(ve.width),ve.dash=Mt(ve.dash),ve.stroke=Mt(ve.stroke),ve.fill=Mt(ve.fill);let Me,xe,We,ot=[],He=[],ut,ht=!1,at={};if(de.live){let v=x[1]?x[1].values:null;ht=v!=null,ut=ht?v(i,1,0):{_:0};for(let b in ut)at[b]=_m}if(te)if(Me=rs("table",LC,c),We=rs("tbody",null,Me),de.mount(i,Me),ht){xe=rs("thead",null,Me,We);let v=rs("tr",null,xe);rs("th",null,v);for(var nn in ut)rs("th",Qy,v).textContent=nn}else Ii(Me,UC),de.live&&Ii(Me,NC);let qt={show:!0},gn={show:!1};function Vt(v,b){if(b==0&&(ht||!de.live||s==2))return Sa;let R=[],D=rs("tr",FC,We,We.childNodes[b]);Ii(D,v.class),v.show||Ii(D,ao);let G=rs("th",null,D);if(ve.show){let pe=Gi(OC,G);if(b>0){let be=ve.width(i,b);be&&(pe.style.border=be+"px "+ve.dash(i,b)+" "+ve.stroke(i,b)),pe.style.background=ve.fill(i,b)}}let j=Gi(Qy,G);v.label instanceof HTMLElement?j.appendChild(v.label):j.textContent=v.label,b>0&&(ve.show||(j.style.color=v.width>0?ve.stroke(i,b):ve.fill(i,b)),wt("click",G,pe=>{if(he._lock)return;tt(pe);let be=x.indexOf(v);if((pe.ctrlKey||pe.metaKey)!=de.isolate){let Ne=x.some((Ue,ke)=>ke>0&&ke!=be&&Ue.show);x.forEach((Ue,ke)=>{ke>0&&ds(ke,Ne?ke==be?qt:gn:qt,!0,Sn.setSeries)})}else ds(be,{show:!v.show},!0,Sn.setSeries)},!1),nt&&wt(i_,G,pe=>{he._lock||(tt(pe),ds(x.indexOf(v),So,!0,Sn.setSeries))},!1));for(var le in ut){let pe=rs("td",kC,D);pe.textContent="--",R.push(pe)}return[D,R]}let Nn=new Map;function wt(v,b,R,D=!0){let G=Nn.get(b)||{},j=he.bind[v](i,b,R,D);j&&(lo(v,b,G[v]=j),Nn.set(b,G))}function Tn(v,b,R){let D=Nn.get(b)||{};for(let G in D)(v==null||G==v)&&(um(G,b,D[G]),delete D[G]);v==null&&Nn.delete(b)}let an=0,vn=0,F=0,Pe=0,je=0,ct=0,Te=je,Gt=ct,Ge=F,Ze=Pe,C=0,S=0,Y=0,fe=0;i.bbox={};let ae=!1,_e=!1,Se=!1,ne=!1,re=!1,ge=!1;function U(v,b,R){(R||v!=i.width||b!=i.height)&&oe(v,b),dt(!1),Se=!0,_e=!0,$n()}function oe(v,b){i.width=an=F=v,i.height=vn=Pe=b,je=ct=0,we(),Xe();let R=i.bbox;C=R.left=ro(je*Lt,.5),S=R.top=ro(ct*Lt,.5),Y=R.width=ro(F*Lt,.5),fe=R.height=ro(Pe*Lt,.5)}let ie=3;function Ee(){let v=!1,b=0;for(;!v;){b++;let R=mo(b),D=fs(b);v=b==ie||R&&D,v||(oe(i.width,i.height),_e=!0)}}function ye({width:v,height:b}){U(v,b)}i.setSize=ye;function we(){let v=!1,b=!1,R=!1,D=!1;A.forEach((G,j)=>{if(G.show&&G._show){let{side:le,_size:pe}=G,be=le%2,Ne=G.label!=null?G.labelSize:0,Ue=pe+Ne;Ue>0&&(be?(F-=Ue,le==3?(je+=Ue,D=!0):R=!0):(Pe-=Ue,le==0?(ct+=Ue,v=!0):b=!0))}}),hs[0]=v,hs[1]=R,hs[2]=b,hs[3]=D,F-=Xi[1]+Xi[3],je+=Xi[3],Pe-=Xi[2]+Xi[0],ct+=Xi[0]}function Xe(){let v=je+F,b=ct+Pe,R=je,D=ct;function G(j,le){switch(j){case 1:return v+=le,v-le;case 2:return b+=le,b-le;case 3:return R-=le,R+le;case 0:return D-=le,D+le}}A.forEach((j,le)=>{if(j.show&&j._show){let pe=j.side;j._pos=G(pe,j._size),j.label!=null&&(j._lpos=G(pe,j.labelSize))}})}if(he.dataIdx==null){let v=he.hover,b=v.skip=new Set(v.skip??[]);b.add(void 0);let R=v.prox=Mt(v.prox),D=v.bias??=0;he.dataIdx=(G,j,le,pe)=>{if(j==0)return le;let be=le,Ne=R(G,j,le,pe)??Wt,Ue=Ne>=0&&Ne<Wt,ke=I.ori==0?F:Pe,lt=he.left,Ct=e[0],Et=e[j];if(b.has(Et[le])){be=null;let _t=null,et=null,qe;if(D==0||D==-1)for(qe=le;_t==null&&qe-- >0;)b.has(Et[qe])||(_t=qe);if(D==0||D==1)for(qe=le;et==null&&qe++<Et.length;)b.has(Et[qe])||(et=qe);if(_t!=null||et!=null)if(Ue){let jt=_t==null?-1/0:W(Ct[_t],I,ke,0),hn=et==null?1/0:W(Ct[et],I,ke,0),kn=lt-jt,Ht=hn-lt;kn<=Ht?kn<=Ne&&(be=_t):Ht<=Ne&&(be=et)}else be=et==null?_t:_t==null?et:le-_t<=et-le?_t:et}else Ue&&Dn(lt-W(Ct[le],I,ke,0))>Ne&&(be=null);return be}}let tt=v=>{he.event=v};he.idxs=se,he._lock=!1;let ue=he.points;ue.show=Mt(ue.show),ue.size=Mt(ue.size),ue.stroke=Mt(ue.stroke),ue.width=Mt(ue.width),ue.fill=Mt(ue.fill);let Be=i.focus=wn({},n.focus||{alpha:.3},he.focus),nt=Be.prox>=0,Re=nt&&ue.one,ft=[],Zt=[],jn=[];function Ia(v,b){let R=ue.show(i,b);if(R instanceof HTMLElement)return Ii(R,DC),Ii(R,v.class),Rs(R,-10,-10,F,Pe),g.insertBefore(R,ft[b]),R}function uo(v,b){if(s==1||b>0){let R=s==1&&w[v.scale].time,D=v.value;v.value=R?y_(D)?T_($,w_(D,V)):D||ee:D||qR,v.label=v.label||(R?kR:OR)}if(Re||b>0){v.width=v.width==null?1:v.width,v.paths=v.paths||oP||KC,v.fillTo=Mt(v.fillTo||JR),v.pxAlign=+At(v.pxAlign,_),v.pxRound=N_(v.pxAlign),v.stroke=Mt(v.stroke||null),v.fill=Mt(v.fill||null),v._stroke=v._fill=v._paths=v._focus=null;let R=YR(fi(1,v.width),1),D=v.points=wn({},{size:R,width:fi(1,R*.2),stroke:v.stroke,space:R*2,paths:aP,_stroke:null,_fill:null},v.points);D.show=Mt(D.show),D.filter=Mt(D.filter),D.fill=Mt(D.fill),D.stroke=Mt(D.stroke),D.paths=Mt(D.paths),D.pxAlign=v.pxAlign}if(te){let R=Vt(v,b);ot.splice(b,0,R[0]),He.splice(b,0,R[1]),de.values.push(null)}if(me){se.splice(b,0,null);let R=null;Re?b==0&&(R=Ia(v,b)):b>0&&(R=Ia(v,b)),ft.splice(b,0,R),Zt.splice(b,0,0),jn.splice(b,0,0)}On("addSeries",b)}function Bf(v,b){b=b??x.length,v=s==1?vm(v,b,A_,D_):vm(v,b,{},I_),x.splice(b,0,v),uo(x[b],b)}i.addSeries=Bf;function mc(v){if(x.splice(v,1),te){de.values.splice(v,1),He.splice(v,1);let b=ot.splice(v,1)[0];Tn(null,b.firstChild),b.remove()}me&&(se.splice(v,1),ft.splice(v,1)[0].remove(),Zt.splice(v,1),jn.splice(v,1)),On("delSeries",v)}i.delSeries=mc;let hs=[!1,!1,!1,!1];function Is(v,b){if(v._show=v.show,v.show){let R=v.side%2,D=w[v.scale];D==null&&(v.scale=R?x[1].scale:E,D=w[v.scale]);let G=D.time;v.size=Mt(v.size),v.space=Mt(v.space),v.rotate=Mt(v.rotate),Lr(v.incrs)&&v.incrs.forEach(le=>{!Nr.has(le)&&Nr.set(le,Y_(le))}),v.incrs=Mt(v.incrs||(D.distr==2?yR:G?p==1?xR:MR:oo)),v.splits=Mt(v.splits||(G&&D.distr==1?ce:D.distr==3?dm:D.distr==4?VR:zR)),v.stroke=Mt(v.stroke),v.grid.stroke=Mt(v.grid.stroke),v.ticks.stroke=Mt(v.ticks.stroke),v.border.stroke=Mt(v.border.stroke);let j=v.values;v.values=Lr(j)&&!Lr(j[0])?Mt(j):G?Lr(j)?M_($,b_(j,V)):y_(j)?ER($,j):j||K:j||BR,v.filter=Mt(v.filter||(D.distr>=3&&D.log==10?WR:D.distr==3&&D.log==2?XR:X_)),v.font=k_(v.font),v.labelFont=k_(v.labelFont),v._size=v.size(i,null,b,0),v._space=v._rotate=v._incrs=v._found=v._splits=v._values=null,v._size>0&&(hs[b]=!0,v._el=Gi(CC,f))}}function Ds(v,b,R,D){let[G,j,le,pe]=R,be=b%2,Ne=0;return be==0&&(pe||j)&&(Ne=b==0&&!G||b==2&&!le?In(E_.size/3):0),be==1&&(G||le)&&(Ne=b==1&&!j||b==3&&!pe?In(R_.size/2):0),Ne}let Da=i.padding=(n.padding||[Ds,Ds,Ds,Ds]).map(v=>Mt(At(v,Ds))),Xi=i._padding=Da.map((v,b)=>v(i,b,hs,0)),ln,pn=null,mn=null,us=s==1?x[0].idxs:null,gi=null,or=!1;function La(v,b){if(e=v??[],i.data=i._data=e,s==2){ln=0;for(let R=1;R<x.length;R++)ln+=e[R][0].length}else{e.length==0&&(i.data=i._data=e=[[]]),gi=e[0],ln=gi.length;let R=e;if(z==2){R=e.slice();let D=R[0]=Array(ln);for(let G=0;G<ln;G++)D[G]=G}i._data=e=R}if(dt(!0),On("setData"),z==2&&(Se=!0),b!==!1){let R=I;R.auto(i,or)?Na():cr(E,R.min,R.max),ne=ne||he.left>=0,ge=!0,$n()}}i.setData=La;function Na(){or=!0;let v,b;s==1&&(ln>0?(pn=us[0]=0,mn=us[1]=ln-1,v=e[0][pn],b=e[0][mn],z==2?(v=pn,b=mn):v==b&&(z==3?[v,b]=uf(v,v,I.log,!1):z==4?[v,b]=Sm(v,v,I.log,!1):I.time?b=v+In(86400/p):[v,b]=lf(v,b,bm,!0))):(pn=us[0]=v=null,mn=us[1]=b=null)),cr(E,v,b)}let fo,ar,po,M,B,Q,Z,J,Ae,Ie;function Ce(v,b,R,D,G,j){v??=t_,R??=wm,D??="butt",G??=t_,j??="round",v!=fo&&(u.strokeStyle=fo=v),G!=ar&&(u.fillStyle=ar=G),b!=po&&(u.lineWidth=po=b),j!=B&&(u.lineJoin=B=j),D!=Q&&(u.lineCap=Q=D),R!=M&&u.setLineDash(M=R)}function De(v,b,R,D){b!=ar&&(u.fillStyle=ar=b),v!=Z&&(u.font=Z=v),R!=J&&(u.textAlign=J=R),D!=Ae&&(u.textBaseline=Ae=D)}function Ve(v,b,R,D,G=0){if(D.length>0&&v.auto(i,or)&&(b==null||b.min==null)){let j=At(pn,0),le=At(mn,D.length-1),pe=R.min==null?WC(D,j,le,G,v.distr==3):[R.min,R.max];v.min=as(v.min,R.min=pe[0]),v.max=fi(v.max,R.max=pe[1])}}let rt={min:null,max:null};function gt(){for(let D in w){let G=w[D];X[D]==null&&(G.min==null||X[E]!=null&&G.auto(i,or))&&(X[D]=rt)}for(let D in w){let G=w[D];X[D]==null&&G.from!=null&&X[G.from]!=null&&(X[D]=rt)}X[E]!=null&&dt(!0);let v={};for(let D in X){let G=X[D];if(G!=null){let j=v[D]=ba(w[D],QC);if(G.min!=null)wn(j,G);else if(D!=E||s==2)if(ln==0&&j.from==null){let le=j.range(i,null,null,D);j.min=le[0],j.max=le[1]}else j.min=Wt,j.max=-Wt}}if(ln>0){x.forEach((D,G)=>{if(s==1){let j=D.scale,le=X[j];if(le==null)return;let pe=v[j];if(G==0){let be=pe.range(i,pe.min,pe.max,j);pe.min=be[0],pe.max=be[1],pn=os(pe.min,e[0]),mn=os(pe.max,e[0]),mn-pn>1&&(e[0][pn]<pe.min&&pn++,e[0][mn]>pe.max&&mn--),D.min=gi[pn],D.max=gi[mn]}else D.show&&D.auto&&Ve(pe,le,D,e[G],D.sorted);D.idxs[0]=pn,D.idxs[1]=mn}else if(G>0&&D.show&&D.auto){let[j,le]=D.facets,pe=j.scale,be=le.scale,[Ne,Ue]=e[G],ke=v[pe],lt=v[be];ke!=null&&Ve(ke,X[pe],j,Ne,j.sorted),lt!=null&&Ve(lt,X[be],le,Ue,le.sorted),D.min=le.min,D.max=le.max}});for(let D in v){let G=v[D],j=X[D];if(G.from==null&&(j==null||j.min==null)){let le=G.range(i,G.min==Wt?null:G.min,G.max==-Wt?null:G.max,D);G.min=le[0],G.max=le[1]}}}for(let D in v){let G=v[D];if(G.from!=null){let j=v[G.from];if(j.min==null)G.min=G.max=null;else{let le=G.range(i,j.min,j.max,D);G.min=le[0],G.max=le[1]}}}let b={},R=!1;for(let D in v){let G=v[D],j=w[D];if(j.min!=G.min||j.max!=G.max){j.min=G.min,j.max=G.max;let le=j.distr;j._min=le==3?ir(j.min):le==4?sm(j.min,j.asinh):le==100?j.fwd(j.min):j.min,j._max=le==3?ir(j.max):le==4?sm(j.max,j.asinh):le==100?j.fwd(j.max):j.max,b[D]=R=!0}}if(R){x.forEach((D,G)=>{s==2?G>0&&b.y&&(D._paths=null):b[D.scale]&&(D._paths=null)});for(let D in b)Se=!0,On("setScale",D);me&&he.left>=0&&(ne=ge=!0)}for(let D in X)X[D]=null}function ze(v){let b=fm(pn-1,0,ln-1),R=fm(mn+1,0,ln-1);for(;v[b]==null&&b>0;)b--;for(;v[R]==null&&R<ln-1;)R++;return[b,R]}function vt(){if(ln>0){let v=x.some(b=>b._focus)&&Ie!=Be.alpha;v&&(u.globalAlpha=Ie=Be.alpha),x.forEach((b,R)=>{if(R>0&&b.show&&(on(R,!1),on(R,!0),b._paths==null)){let D=Ie;Ie!=b.alpha&&(u.globalAlpha=Ie=b.alpha);let G=s==2?[0,e[R][0].length-1]:ze(e[R]);b._paths=b.paths(i,R,G[0],G[1]),Ie!=D&&(u.globalAlpha=Ie=D)}}),x.forEach((b,R)=>{if(R>0&&b.show){let D=Ie;Ie!=b.alpha&&(u.globalAlpha=Ie=b.alpha),b._paths!=null&&kt(R,!1);{let G=b._paths!=null?b._paths.gaps:null,j=b.points.show(i,R,pn,mn,G),le=b.points.filter(i,R,j,G);(j||le)&&(b.points._paths=b.points.paths(i,R,pn,mn,le),kt(R,!0))}Ie!=D&&(u.globalAlpha=Ie=D),On("drawSeries",R)}}),v&&(u.globalAlpha=Ie=1)}}function on(v,b){let R=b?x[v].points:x[v];R._stroke=R.stroke(i,v),R._fill=R.fill(i,v)}function kt(v,b){let R=b?x[v].points:x[v],{stroke:D,fill:G,clip:j,flags:le,_stroke:pe=R._stroke,_fill:be=R._fill,_width:Ne=R.width}=R._paths;Ne=Xt(Ne*Lt,3);let Ue=null,ke=Ne%2/2;b&&be==null&&(be=Ne>0?"#fff":pe);let lt=R.pxAlign==1&&ke>0;if(lt&&u.translate(ke,ke),!b){let Ct=C-Ne/2,Et=S-Ne/2,_t=Y+Ne,et=fe+Ne;Ue=new Path2D,Ue.rect(Ct,Et,_t,et)}b?Fe(pe,Ne,R.dash,R.cap,be,D,G,le,j):Bt(v,pe,Ne,R.dash,R.cap,be,D,G,le,Ue,j),lt&&u.translate(-ke,-ke)}function Bt(v,b,R,D,G,j,le,pe,be,Ne,Ue){let ke=!1;be!=0&&P.forEach((lt,Ct)=>{if(lt.series[0]==v){let Et=x[lt.series[1]],_t=e[lt.series[1]],et=(Et._paths||lc).band;Lr(et)&&(et=lt.dir==1?et[0]:et[1]);let qe,jt=null;Et.show&&et&&qC(_t,pn,mn)?(jt=lt.fill(i,Ct)||j,qe=Et._paths.clip):et=null,Fe(b,R,D,G,jt,le,pe,be,Ne,Ue,qe,et),ke=!0}}),ke||Fe(b,R,D,G,j,le,pe,be,Ne,Ue)}let En=Ma|mm;function Fe(v,b,R,D,G,j,le,pe,be,Ne,Ue,ke){Ce(v,b,R,D,G),(be||Ne||ke)&&(u.save(),be&&u.clip(be),Ne&&u.clip(Ne)),ke?(pe&En)==En?(u.clip(ke),Ue&&u.clip(Ue),xt(G,le),yn(v,j,b)):pe&mm?(xt(G,le),u.clip(ke),yn(v,j,b)):pe&Ma&&(u.save(),u.clip(ke),Ue&&u.clip(Ue),xt(G,le),u.restore(),yn(v,j,b)):(xt(G,le),yn(v,j,b)),(be||Ne||ke)&&u.restore()}function yn(v,b,R){R>0&&(b instanceof Map?b.forEach((D,G)=>{u.strokeStyle=fo=G,u.stroke(D)}):b!=null&&v&&u.stroke(b))}function xt(v,b){b instanceof Map?b.forEach((R,D)=>{u.fillStyle=ar=D,u.fill(R)}):b!=null&&v&&u.fill(b)}function Ls(v,b,R,D){let G=A[v],j;if(D<=0)j=[0,0];else{let le=G._space=G.space(i,v,b,R,D),pe=G._incrs=G.incrs(i,v,b,R,D,le);j=dP(b,R,pe,D,le)}return G._found=j}function _n(v,b,R,D,G,j,le,pe,be,Ne){let Ue=le%2/2;_==1&&u.translate(Ue,Ue),Ce(pe,le,be,Ne,pe),u.beginPath();let ke,lt,Ct,Et,_t=G+(D==0||D==3?-j:j);R==0?(lt=G,Et=_t):(ke=G,Ct=_t);for(let et=0;et<v.length;et++)b[et]!=null&&(R==0?ke=Ct=v[et]:lt=Et=v[et],u.moveTo(ke,lt),u.lineTo(Ct,Et));u.stroke(),_==1&&u.translate(-Ue,-Ue)}function mo(v){let b=!0;return A.forEach((R,D)=>{if(!R.show)return;let G=w[R.scale];if(G.min==null){R._show&&(b=!1,R._show=!1,dt(!1));return}else R._show||(b=!1,R._show=!0,dt(!1));let j=R.side,le=j%2,{min:pe,max:be}=G,[Ne,Ue]=Ls(D,pe,be,le==0?F:Pe);if(Ue==0)return;let ke=G.distr==2,lt=R._splits=R.splits(i,D,pe,be,Ne,Ue,ke),Ct=G.distr==2?lt.map(qe=>gi[qe]):lt,Et=G.distr==2?gi[lt[1]]-gi[lt[0]]:Ne,_t=R._values=R.values(i,R.filter(i,Ct,D,Ue,Et),D,Ue,Et);R._rotate=j==2?R.rotate(i,_t,D,Ue):0;let et=R._size;R._size=Wi(R.size(i,_t,D,v)),et!=null&&R._size!=et&&(b=!1)}),b}function fs(v){let b=!0;return Da.forEach((R,D)=>{let G=R(i,D,hs,v);G!=Xi[D]&&(b=!1),Xi[D]=G}),b}function Ns(){for(let v=0;v<A.length;v++){let b=A[v];if(!b.show||!b._show)continue;let R=b.side,D=R%2,G,j,le=b.stroke(i,v),pe=R==0||R==3?-1:1,[be,Ne]=b._found;if(b.label!=null){let ti=b.labelGap*pe,_i=In((b._lpos+ti)*Lt);De(b.labelFont[0],le,"center",R==2?"top":e_),u.save(),D==1?(G=j=0,u.translate(_i,In(S+fe/2)),u.rotate((R==3?-of:of)/2)):(G=In(C+Y/2),j=_i);let Or=G_(b.label)?b.label(i,v,be,Ne):b.label;u.fillText(Or,G,j),u.restore()}if(Ne==0)continue;let Ue=w[b.scale],ke=D==0?Y:fe,lt=D==0?C:S,Ct=b._splits,Et=Ue.distr==2?Ct.map(ti=>gi[ti]):Ct,_t=Ue.distr==2?gi[Ct[1]]-gi[Ct[0]]:be,et=b.ticks,qe=b.border,jt=et.show?et.size:0,hn=In(jt*Lt),kn=In((b.alignTo==2?b._size-jt-b.gap:b.gap)*Lt),Ht=b._rotate*-of/180,un=m(b._pos*Lt),vi=(hn+kn)*pe,ei=un+vi;j=D==0?ei:0,G=D==1?ei:0;let Ui=b.font[0],qi=b.align==1?va:b.align==2?tm:Ht>0?va:Ht<0?tm:D==0?"center":R==3?tm:va,ms=Ht||D==1?"middle":R==2?"top":e_;De(Ui,le,qi,ms);let yi=b.font[1]*b.lineGap,Fi=Ct.map(ti=>m(a(ti,Ue,ke,lt))),Yi=b._values;for(let ti=0;ti<Yi.length;ti++){let _i=Yi[ti];if(_i!=null){D==0?G=Fi[ti]:j=Fi[ti],_i=""+_i;let Or=_i.indexOf(`
`)==-1?[_i]:_i.split(/\n/gm);for(let ni=0;ni<Or.length;ni++){let og=Or[ni];Ht?(u.save(),u.translate(G,j+ni*yi),u.rotate(Ht),u.fillText(og,0,0),u.restore()):u.fillText(og,G,j+ni*yi)}}}et.show&&_n(Fi,et.filter(i,Et,v,Ne,_t),D,R,un,hn,Xt(et.width*Lt,3),et.stroke(i,v),et.dash,et.cap);let gs=b.grid;gs.show&&_n(Fi,gs.filter(i,Et,v,Ne,_t),D,D==0?2:1,D==0?S:C,D==0?fe:Y,Xt(gs.width*Lt,3),gs.stroke(i,v),gs.dash,gs.cap),qe.show&&_n([un],[1],D==0?1:0,D==0?1:2,D==1?S:C,D==1?fe:Y,Xt(qe.width*Lt,3),qe.stroke(i,v),qe.dash,qe.cap)}On("drawAxes")}function dt(v){x.forEach((b,R)=>{R>0&&(b._paths=null,v&&(s==1?(b.min=null,b.max=null):b.facets.forEach(D=>{D.min=null,D.max=null})))})}let cn=!1,Qn=!1,zt=[];function xn(){Qn=!1;for(let v=0;v<zt.length;v++)On(...zt[v]);zt.length=0}function $n(){cn||(oR(Hm),cn=!0)}function gc(v,b=!1){cn=!0,Qn=b,v(i),Hm(),b&&zt.length>0&&queueMicrotask(xn)}i.batch=gc;function Hm(){if(ae&&(gt(),ae=!1),Se&&(Ee(),Se=!1),_e){if(tn(d,va,je),tn(d,"top",ct),tn(d,sc,F),tn(d,rc,Pe),tn(g,va,je),tn(g,"top",ct),tn(g,sc,F),tn(g,rc,Pe),tn(f,sc,an),tn(f,rc,vn),h.width=In(an*Lt),h.height=In(vn*Lt),A.forEach(({_el:v,_show:b,_size:R,_pos:D,side:G})=>{if(v!=null)if(b){let j=G===3||G===0?R:0,le=G%2==1;tn(v,le?"left":"top",D-j),tn(v,le?"width":"height",R),tn(v,le?"top":"left",le?ct:je),tn(v,le?"height":"width",le?Pe:F),hm(v,ao)}else Ii(v,ao)}),fo=ar=po=B=Q=Z=J=Ae=M=null,Ie=1,Oa(!0),je!=Te||ct!=Gt||F!=Ge||Pe!=Ze){dt(!1);let v=F/Ge,b=Pe/Ze;if(me&&!ne&&he.left>=0){he.left*=v,he.top*=b,go&&Rs(go,In(he.left),0,F,Pe),vo&&Rs(vo,0,In(he.top),F,Pe);for(let R=0;R<ft.length;R++){let D=ft[R];D!=null&&(Zt[R]*=v,jn[R]*=b,Rs(D,Wi(Zt[R]),Wi(jn[R]),F,Pe))}}if(Jt.show&&!re&&Jt.left>=0&&Jt.width>0){Jt.left*=v,Jt.width*=v,Jt.top*=b,Jt.height*=b;for(let R in Xf)tn(xo,R,Jt[R])}Te=je,Gt=ct,Ge=F,Ze=Pe}On("setSize"),_e=!1}an>0&&vn>0&&(u.clearRect(0,0,h.width,h.height),On("drawClear"),T.forEach(v=>v()),On("draw")),Jt.show&&re&&(vc(Jt),re=!1),me&&ne&&(Fr(null,!0,!1),ne=!1),de.show&&de.live&&ge&&(Gf(),ge=!1),l||(l=!0,i.status=1,On("ready")),or=!1,cn=!1}i.redraw=(v,b)=>{Se=b||!1,v!==!1?cr(E,I.min,I.max):$n()};function zf(v,b){let R=w[v];if(R.from==null){if(ln==0){let D=R.range(i,b.min,b.max,v);b.min=D[0],b.max=D[1]}if(b.min>b.max){let D=b.min;b.min=b.max,b.max=D}if(ln>1&&b.min!=null&&b.max!=null&&b.max-b.min<1e-16)return;v==E&&R.distr==2&&ln>0&&(b.min=os(b.min,e[0]),b.max=os(b.max,e[0]),b.min==b.max&&b.max++),X[v]=b,ae=!0,$n()}}i.setScale=zf;let Vf,Hf,go,vo,Gm,Wm,yo,_o,Xm,qm,Kt,sn,lr=!1,Wn=he.drag,Un=Wn.x,Fn=Wn.y;me&&(he.x&&(Vf=Gi(PC,g)),he.y&&(Hf=Gi(IC,g)),I.ori==0?(go=Vf,vo=Hf):(go=Hf,vo=Vf),Kt=he.left,sn=he.top);let Jt=i.select=wn({show:!0,over:!0,left:0,width:0,top:0,height:0},n.select),xo=Jt.show?Gi(RC,Jt.over?g:d):null;function vc(v,b){if(Jt.show){for(let R in v)Jt[R]=v[R],R in Xf&&tn(xo,R,v[R]);b!==!1&&On("setSelect")}}i.setSelect=vc;function $x(v){if(x[v].show)te&&hm(ot[v],ao);else if(te&&Ii(ot[v],ao),me){let R=Re?ft[0]:ft[v];R!=null&&Rs(R,-10,-10,F,Pe)}}function cr(v,b,R){zf(v,{min:b,max:R})}function ds(v,b,R,D){b.focus!=null&&Qx(v),b.show!=null&&x.forEach((G,j)=>{j>0&&(v==j||v==null)&&(G.show=b.show,$x(j),s==2?(cr(G.facets[0].scale,null,null),cr(G.facets[1].scale,null,null)):cr(G.scale,null,null),$n())}),R!==!1&&On("setSeries",v,b),D&&ka("setSeries",i,v,b)}i.setSeries=ds;function Zx(v,b){wn(P[v],b)}function Kx(v,b){v.fill=Mt(v.fill||null),v.dir=At(v.dir,-1),b=b??P.length,P.splice(b,0,v)}function Jx(v){v==null?P.length=0:P.splice(v,1)}i.addBand=Kx,i.setBand=Zx,i.delBand=Jx;function jx(v,b){x[v].alpha=b,me&&ft[v]!=null&&(ft[v].style.opacity=b),te&&ot[v]&&(ot[v].style.opacity=b)}let Us,hr,Ur,So={focus:!0};function Qx(v){if(v!=Ur){let b=v==null,R=Be.alpha!=1;x.forEach((D,G)=>{if(s==1||G>0){let j=b||G==0||G==v;D._focus=b?null:j,R&&jx(G,j?1:Be.alpha)}}),Ur=v,R&&$n()}}te&&nt&&wt(s_,Me,v=>{he._lock||(tt(v),Ur!=null&&ds(null,So,!0,Sn.setSeries))});function ps(v,b,R){let D=w[b];R&&(v=v/Lt-(D.ori==1?ct:je));let G=F;D.ori==1&&(G=Pe,v=G-v),D.dir==-1&&(v=G-v);let j=D._min,le=D._max,pe=v/G,be=j+(le-j)*pe,Ne=D.distr;return Ne==3?xa(10,be):Ne==4?$C(be,D.asinh):Ne==100?D.bwd(be):be}function eS(v,b){let R=ps(v,E,b);return os(R,e[0],pn,mn)}i.valToIdx=v=>os(v,e[0]),i.posToIdx=eS,i.posToVal=ps,i.valToPos=(v,b,R)=>w[b].ori==0?r(v,w[b],R?Y:F,R?C:0):o(v,w[b],R?fe:Pe,R?S:0),i.setCursor=(v,b,R)=>{Kt=v.left,sn=v.top,Fr(null,b,R)};function Ym(v,b){tn(xo,va,Jt.left=v),tn(xo,sc,Jt.width=b)}function $m(v,b){tn(xo,"top",Jt.top=v),tn(xo,rc,Jt.height=b)}let Ua=I.ori==0?Ym:$m,Fa=I.ori==1?Ym:$m;function tS(){if(te&&de.live)for(let v=s==2?1:0;v<x.length;v++){if(v==0&&ht)continue;let b=de.values[v],R=0;for(let D in b)He[v][R++].firstChild.nodeValue=b[D]}}function Gf(v,b){if(v!=null&&(v.idxs?v.idxs.forEach((R,D)=>{se[D]=R}):jC(v.idx)||se.fill(v.idx),de.idx=se[0]),te&&de.live){for(let R=0;R<x.length;R++)(R>0||s==1&&!ht)&&nS(R,se[R]);tS()}ge=!1,b!==!1&&On("setLegend")}i.setLegend=Gf;function nS(v,b){let R=x[v],D=v==0&&z==2?gi:e[v],G;ht?G=R.values(i,v,b)??at:(G=R.value(i,b==null?null:D[b],v,b),G=G==null?at:{_:G}),de.values[v]=G}function Fr(v,b,R){Xm=Kt,qm=sn,[Kt,sn]=he.move(i,Kt,sn),he.left=Kt,he.top=sn,me&&(go&&Rs(go,In(Kt),0,F,Pe),vo&&Rs(vo,0,In(sn),F,Pe));let D,G=pn>mn;Us=Wt,hr=null;let j=I.ori==0?F:Pe,le=I.ori==1?F:Pe;if(Kt<0||ln==0||G){D=he.idx=null;for(let pe=0;pe<x.length;pe++){let be=ft[pe];be!=null&&Rs(be,-10,-10,F,Pe)}nt&&ds(null,So,!0,v==null&&Sn.setSeries),de.live&&(se.fill(D),ge=!0)}else{let pe,be,Ne;s==1&&(pe=I.ori==0?Kt:sn,be=ps(pe,E),D=he.idx=os(be,e[0],pn,mn),Ne=W(e[0][D],I,j,0));let Ue=-10,ke=-10,lt=0,Ct=0,Et=!0,_t="",et="";for(let qe=s==2?1:0;qe<x.length;qe++){let jt=x[qe],hn=se[qe],kn=hn==null?null:s==1?e[qe][hn]:e[qe][1][hn],Ht=he.dataIdx(i,qe,D,be),un=Ht==null?null:s==1?e[qe][Ht]:e[qe][1][Ht];if(ge=ge||un!=kn||Ht!=hn,se[qe]=Ht,qe>0&&jt.show){let vi=Ht==null?-10:Ht==D?Ne:W(s==1?e[0][Ht]:e[qe][0][Ht],I,j,0),ei=un==null?-10:L(un,s==1?w[jt.scale]:w[jt.facets[1].scale],le,0);if(nt&&un!=null){let Ui=I.ori==1?Kt:sn,qi=Dn(Be.dist(i,qe,Ht,ei,Ui));if(qi<Us){let ms=Be.bias;if(ms!=0){let yi=ps(Ui,jt.scale),Fi=un>=0?1:-1,Yi=yi>=0?1:-1;Yi==Fi&&(Yi==1?ms==1?un>=yi:un<=yi:ms==1?un<=yi:un>=yi)&&(Us=qi,hr=qe)}else Us=qi,hr=qe}}if(ge||Re){let Ui,qi;I.ori==0?(Ui=vi,qi=ei):(Ui=ei,qi=vi);let ms,yi,Fi,Yi,gs,ti,_i=!0,Or=ue.bbox;if(Or!=null){_i=!1;let ni=Or(i,qe);Fi=ni.left,Yi=ni.top,ms=ni.width,yi=ni.height}else Fi=Ui,Yi=qi,ms=yi=ue.size(i,qe);if(ti=ue.fill(i,qe),gs=ue.stroke(i,qe),Re)qe==hr&&Us<=Be.prox&&(Ue=Fi,ke=Yi,lt=ms,Ct=yi,Et=_i,_t=ti,et=gs);else{let ni=ft[qe];ni!=null&&(Zt[qe]=Fi,jn[qe]=Yi,u_(ni,ms,yi,_i),c_(ni,ti,gs),Rs(ni,Wi(Fi),Wi(Yi),F,Pe))}}}}if(Re){let qe=Be.prox,jt=Ur==null?Us<=qe:Us>qe||hr!=Ur;if(ge||jt){let hn=ft[0];hn!=null&&(Zt[0]=Ue,jn[0]=ke,u_(hn,lt,Ct,Et),c_(hn,_t,et),Rs(hn,Wi(Ue),Wi(ke),F,Pe))}}}if(Jt.show&&lr)if(v!=null){let[pe,be]=Sn.scales,[Ne,Ue]=Sn.match,[ke,lt]=v.cursor.sync.scales,Ct=v.cursor.drag;if(Un=Ct._x,Fn=Ct._y,Un||Fn){let{left:Et,top:_t,width:et,height:qe}=v.select,jt=v.scales[ke].ori,hn=v.posToVal,kn,Ht,un,vi,ei,Ui=pe!=null&&Ne(pe,ke),qi=be!=null&&Ue(be,lt);Ui&&Un?(jt==0?(kn=Et,Ht=et):(kn=_t,Ht=qe),un=w[pe],vi=W(hn(kn,ke),un,j,0),ei=W(hn(kn+Ht,ke),un,j,0),Ua(as(vi,ei),Dn(ei-vi))):Ua(0,j),qi&&Fn?(jt==1?(kn=Et,Ht=et):(kn=_t,Ht=qe),un=w[be],vi=L(hn(kn,lt),un,le,0),ei=L(hn(kn+Ht,lt),un,le,0),Fa(as(vi,ei),Dn(ei-vi))):Fa(0,le)}else qf()}else{let pe=Dn(Xm-Gm),be=Dn(qm-Wm);if(I.ori==1){let lt=pe;pe=be,be=lt}Un=Wn.x&&pe>=Wn.dist,Fn=Wn.y&&be>=Wn.dist;let Ne=Wn.uni;Ne!=null?Un&&Fn&&(Un=pe>=Ne,Fn=be>=Ne,!Un&&!Fn&&(be>pe?Fn=!0:Un=!0)):Wn.x&&Wn.y&&(Un||Fn)&&(Un=Fn=!0);let Ue,ke;Un&&(I.ori==0?(Ue=yo,ke=Kt):(Ue=_o,ke=sn),Ua(as(Ue,ke),Dn(ke-Ue)),Fn||Fa(0,le)),Fn&&(I.ori==1?(Ue=yo,ke=Kt):(Ue=_o,ke=sn),Fa(as(Ue,ke),Dn(ke-Ue)),Un||Ua(0,j)),!Un&&!Fn&&(Ua(0,0),Fa(0,0))}if(Wn._x=Un,Wn._y=Fn,v==null){if(R){if(rg!=null){let[pe,be]=Sn.scales;Sn.values[0]=pe!=null?ps(I.ori==0?Kt:sn,pe):null,Sn.values[1]=be!=null?ps(I.ori==1?Kt:sn,be):null}ka(nm,i,Kt,sn,F,Pe,D)}if(nt){let pe=R&&Sn.setSeries,be=Be.prox;Ur==null?Us<=be&&ds(hr,So,!0,pe):Us>be?ds(null,So,!0,pe):hr!=Ur&&ds(hr,So,!0,pe)}}ge&&(de.idx=D,Gf()),b!==!1&&On("setCursor")}let ur=null;Object.defineProperty(i,"rect",{get(){return ur==null&&Oa(!1),ur}});function Oa(v=!1){v?ur=null:(ur=g.getBoundingClientRect(),On("syncRect",ur))}function Zm(v,b,R,D,G,j,le){he._lock||lr&&v!=null&&v.movementX==0&&v.movementY==0||(Wf(v,b,R,D,G,j,le,!1,v!=null),v!=null?Fr(null,!0,!0):Fr(b,!0,!1))}function Wf(v,b,R,D,G,j,le,pe,be){if(ur==null&&Oa(!1),tt(v),v!=null)R=v.clientX-ur.left,D=v.clientY-ur.top;else{if(R<0||D<0){Kt=-10,sn=-10;return}let[Ne,Ue]=Sn.scales,ke=b.cursor.sync,[lt,Ct]=ke.values,[Et,_t]=ke.scales,[et,qe]=Sn.match,jt=b.axes[0].side%2==1,hn=I.ori==0?F:Pe,kn=I.ori==1?F:Pe,Ht=jt?j:G,un=jt?G:j,vi=jt?D:R,ei=jt?R:D;if(Et!=null?R=et(Ne,Et)?a(lt,w[Ne],hn,0):-10:R=hn*(vi/Ht),_t!=null?D=qe(Ue,_t)?a(Ct,w[Ue],kn,0):-10:D=kn*(ei/un),I.ori==1){let Ui=R;R=D,D=Ui}}be&&(b==null||b.cursor.event.type==nm)&&((R<=1||R>=F-1)&&(R=ro(R,F)),(D<=1||D>=Pe-1)&&(D=ro(D,Pe))),pe?(Gm=R,Wm=D,[yo,_o]=he.move(i,R,D)):(Kt=R,sn=D)}let Xf={width:0,height:0,left:0,top:0};function qf(){vc(Xf,!1)}let Km,Jm,jm,Qm;function eg(v,b,R,D,G,j,le){lr=!0,Un=Fn=Wn._x=Wn._y=!1,Wf(v,b,R,D,G,j,le,!0,!1),v!=null&&(wt(im,lm,tg,!1),ka(n_,i,yo,_o,F,Pe,null));let{left:pe,top:be,width:Ne,height:Ue}=Jt;Km=pe,Jm=be,jm=Ne,Qm=Ue}function tg(v,b,R,D,G,j,le){lr=Wn._x=Wn._y=!1,Wf(v,b,R,D,G,j,le,!1,!0);let{left:pe,top:be,width:Ne,height:Ue}=Jt,ke=Ne>0||Ue>0,lt=Km!=pe||Jm!=be||jm!=Ne||Qm!=Ue;if(ke&&lt&&vc(Jt),Wn.setScale&&ke&&lt){let Ct=pe,Et=Ne,_t=be,et=Ue;if(I.ori==1&&(Ct=be,Et=Ue,_t=pe,et=Ne),Un&&cr(E,ps(Ct,E),ps(Ct+Et,E)),Fn)for(let qe in w){let jt=w[qe];qe!=E&&jt.from==null&&jt.min!=Wt&&cr(qe,ps(_t+et,qe),ps(_t,qe))}qf()}else he.lock&&(he._lock=!he._lock,Fr(b,!0,v!=null));v!=null&&(Tn(im,lm),ka(im,i,Kt,sn,F,Pe,null))}function iS(v,b,R,D,G,j,le){if(he._lock)return;tt(v);let pe=lr;if(lr){let be=!0,Ne=!0,Ue=10,ke,lt;I.ori==0?(ke=Un,lt=Fn):(ke=Fn,lt=Un),ke&&lt&&(be=Kt<=Ue||Kt>=F-Ue,Ne=sn<=Ue||sn>=Pe-Ue),ke&&be&&(Kt=Kt<yo?0:F),lt&&Ne&&(sn=sn<_o?0:Pe),Fr(null,!0,!0),lr=!1}Kt=-10,sn=-10,se.fill(null),Fr(null,!0,!0),pe&&(lr=pe)}function ng(v,b,R,D,G,j,le){he._lock||(tt(v),Na(),qf(),v!=null&&ka(r_,i,Kt,sn,F,Pe,null))}function ig(){A.forEach(pP),U(i.width,i.height,!0)}lo(af,_a,ig);let bo={};bo.mousedown=eg,bo.mousemove=Zm,bo.mouseup=tg,bo.dblclick=ng,bo.setSeries=(v,b,R,D)=>{let G=Sn.match[2];R=G(i,b,R),R!=-1&&ds(R,D,!0,!1)},me&&(wt(n_,g,eg),wt(nm,g,Zm),wt(i_,g,v=>{tt(v),Oa(!1)}),wt(s_,g,iS),wt(r_,g,ng),gm.add(i),i.syncRect=Oa);let yc=i.hooks=n.hooks||{};function On(v,b,R){Qn?zt.push([v,b,R]):v in yc&&yc[v].forEach(D=>{D.call(null,i,b,R)})}(n.plugins||[]).forEach(v=>{for(let b in v.hooks)yc[b]=(yc[b]||[]).concat(v.hooks[b])});let sg=(v,b,R)=>R,Sn=wn({key:null,setSeries:!1,filters:{pub:g_,sub:g_},scales:[E,x[1]?x[1].scale:null],match:[v_,v_,sg],values:[null,null]},he.sync);Sn.match.length==2&&Sn.match.push(sg),he.sync=Sn;let rg=Sn.key,Yf=dx(rg);function ka(v,b,R,D,G,j,le){Sn.filters.pub(v,b,R,D,G,j,le)&&Yf.pub(v,b,R,D,G,j,le)}Yf.sub(i);function sS(v,b,R,D,G,j,le){Sn.filters.sub(v,b,R,D,G,j,le)&&bo[v](null,b,R,D,G,j,le)}i.pub=sS;function rS(){Yf.unsub(i),gm.delete(i),Nn.clear(),um(af,_a,ig),c.remove(),Me?.remove(),On("destroy")}i.destroy=rS;function $f(){On("init",n,e),La(e||n.data,!1),X[E]?zf(E,X[E]):Na(),re=Jt.show&&(Jt.width>0||Jt.height>0),ne=ge=!0,U(n.width,n.height)}return x.forEach(uo),A.forEach(Is),t?t instanceof HTMLElement?(t.appendChild(c),$f()):t(i,$f):$f(),i}Yn.assign=wn;Yn.fmtNum=Mm;Yn.rangeNum=lf;Yn.rangeLog=uf;Yn.rangeAsinh=Sm;Yn.orient=ho;Yn.pxRatio=Lt;Yn.join=rR;Yn.fmtDate=Tm,Yn.tzDate=gR;Yn.sync=dx;{Yn.addGap=jR,Yn.clipGaps=pf;let n=Yn.paths={points:_x};n.linear=Sx,n.stepped=tP,n.bars=nP,n.spline=sP}var pi=58,Ps=10,mP=13,gP=4,vP=.0015,yf=`${Math.round(.92*Number.parseFloat(getComputedStyle(document.body).fontSize))}px system-ui, 'DejaVu Sans', sans-serif`,_f=class{constructor(e,t,i,s,r){this.panel=e;this.shown=t;this.data=s;this.store=r;e.append(this.readout),new ResizeObserver(()=>i.later(this)).observe(e);let o=["sensor","quantity","hidden","window","marks","selected","large","scaleByCalibrations"];r.on(o,()=>i.later(this)),r.on(["sample","hover"],()=>this.moveCursor())}panel;shown;data;store;plot=null;cursor=q("div",{class:"plot-cursor"});pointer=q("div",{class:"plot-pointer"});readout=q("div",{class:"readout"});bounds=[-1,1];form="";content="";draw(){let{state:e}=this.store,[t,i]=[this.panel.clientWidth,this.panel.clientHeight];if(t<=pi||i===0||this.data.samples===0)return;let s=[...Si(this.data,e.marks),...e.selected].map(c=>[c.start_s,c.end_s]),r=JSON.stringify([t,i,devicePixelRatio,e.sensor,[...e.hidden]]),o=JSON.stringify([r,e.window,s,e.scaleByCalibrations]);if(o===this.content)return;this.content=o;let a=this.drawn(),l=this.lines(a,t);r===this.form&&this.plot?this.plot.setData(l):(this.form=r,this.plot?.destroy(),this.plot=new Yn(this.options(t,i,a),l,this.panel),this.plot.over.append(this.pointer,this.cursor),this.followPointer(this.plot))}range(){if(!this.plot||this.panel.clientHeight===0)return null;let{kind:e,quantity:t,component:i}=this.shown;return{kind:e,quantity:t,component:i,x:[...this.store.state.window],y:[...this.bounds]}}moveCursor(){let{sample:e,hover:t,window:i}=this.store.state;for(let[r,o]of[[this.cursor,e],[this.pointer,t]]){let a=o===null?Number.NaN:this.data.time[o]??0;r.hidden=!this.plot||!(a>=i[0]&&a<=i[1]),this.plot&&!r.hidden&&(r.style.transform=`translateX(${Math.round(this.plot.valToPos(a,"x"))}px)`)}if(!this.plot)return;let s=this.sensor();this.readout.replaceChildren(...this.drawn().map(({series:r,column:o})=>{let a=o.at(t??e),l=this.shown.quantity==="force"?2:3,c=q("span",{class:"chip"});return s&&(c.style.background=ii(s,r)),q("span",{},c,Number.isFinite(a)?a.toFixed(l):"\u2013")}))}sensor(){return this.data.sensor(this.store.state.sensor)}drawn(){let{kind:e,quantity:t,component:i}=this.shown,{columns:s}=this.data,r=this.sensor();return(r?.wrenches.filter(a=>!this.store.state.hidden.has(a.name))??[]).flatMap(a=>{let l=e==="measured"?s.measured(a,t,i):r&&s.error(r,a,t,i);return l?[{series:a,column:l,band:e==="error"||i!==3?s.band(a,t,i):null}]:[]})}lines(e,t){let{window:i,scaleByCalibrations:s}=this.store.state,r=this.data.sampleAt(i[0]),o=Math.min(this.data.samples,this.data.sampleAt(i[1])+2),a=e.flatMap(({column:d,band:g})=>g?yP(d,g,this.shown):[]),l=[...e.map(({column:d})=>d),...a],c=Cg(this.data.time,l,r,o,t-pi-Ps),h=e.map(({series:d},g)=>d.calibrated?g:-1).filter(d=>d>=0),f=this.shown.kind==="error"&&s&&h.length>0?[...h,...a.map((d,g)=>e.length+g)]:l.map((d,g)=>g);return this.bounds=_P(f.map(d=>c.y[d]??[]),this.shown),[c.x,...c.y]}options(e,t,i){let{quantity:s,component:r,last:o}=this.shown,a=this.sensor(),l=s==="force"?"f":"t",c=u=>a?ii(a,u):Yt,h=i.filter(({band:u})=>u!==null);return{width:e,height:t,padding:[5,Ps,o?0:4,0],legend:{show:!1},cursor:{show:!1},scales:{x:{time:!1,range:()=>[...this.store.state.window]},y:{range:()=>this.bounds}},axes:[{show:!0,size:o?20:0,font:yf,stroke:Yt,grid:{stroke:Br},ticks:{size:o?4:0},label:o?"time [s]":"",labelSize:o?mP:0,labelGap:0,gap:2,labelFont:yf,values:o?(u,f)=>f.map(String):()=>[]},{size:pi-14,font:yf,stroke:Yt,grid:{stroke:Br},ticks:{size:4},gap:2,space:15,label:`${r===3?`|${l}|`:`${l}${"xyz"[r]}`} [${bi[s]}]`,labelSize:14,labelGap:0,labelFont:yf}],series:[{},...i.map(({series:u})=>({label:u.name,stroke:c(u),width:u.role==="expected"?2:1,dash:a?fg(a,u).map(f=>f*devicePixelRatio):[],points:{show:!1}})),...h.flatMap(()=>[0,1].map(()=>({width:0,points:{show:!1}})))],bands:h.map(({series:u},f)=>({series:[i.length+2*f+2,i.length+2*f+1],fill:si(c(u),.2)})),hooks:{drawClear:[u=>this.drawBackground(u)],draw:[()=>this.moveCursor()]}}}drawBackground(e){let{left:t,top:i,width:s,height:r}=e.bbox,o=(h,u,f)=>{let d=Math.max(t,e.valToPos(h,"x",!0)),g=Math.min(t+s,e.valToPos(u,"x",!0));e.ctx.fillStyle=f,g>d&&e.ctx.fillRect(d,i,g-d,r)},{marks:a,selected:l}=this.store.state;for(let{start_s:h,end_s:u,use:f}of[...this.data.scene.intervals,...Si(this.data,a)])o(h,u,si(zr[f],f==="ignore"?.3:.12));for(let{start_s:h,end_s:u}of l)o(h,u,si(vs,.35));if(this.shown.kind==="measured")return;let c=Math.round(e.valToPos(0,"y",!0));e.ctx.fillStyle=vs,c>=i&&c<=i+r&&e.ctx.fillRect(t,c,s,1)}followPointer(e){let{over:t}=e,i=o=>o.clientX-t.getBoundingClientRect().left,s=o=>e.posToVal(o,"x"),r=null;t.addEventListener("pointerdown",o=>{o.button===0&&(r={x:i(o),window:this.store.state.window,spans:o.shiftKey,moved:!1},t.setPointerCapture(o.pointerId))}),t.addEventListener("pointermove",o=>{let a=i(o);if(r===null){this.store.set({hover:this.data.nearestSample(s(a))});return}if(r.moved||=Math.abs(a-r.x)>gP,!!r.moved)if(r.spans){let[l,c]=[Math.min(r.x,a),Math.max(r.x,a)];e.setSelect({left:l,width:c-l,top:0,height:t.clientHeight},!1)}else{let l=(r.x-a)/t.clientWidth*(r.window[1]-r.window[0]);this.store.set({window:No(r.window,l,this.data.span)})}}),t.addEventListener("pointerup",o=>{let a=r;if(r=null,a!==null){if(!a.moved)this.store.set({sample:this.data.nearestSample(s(i(o))),playing:!1});else if(a.spans){let[l=0,c=0]=[s(a.x),s(i(o))].sort((f,d)=>f-d);e.setSelect({left:0,width:0,top:0,height:0},!1);let{span:h,samples:u}=this.data;this.store.set({window:Yr([l,c],1,(l+c)/2,h,u)})}}}),t.addEventListener("pointercancel",()=>{r=null}),t.addEventListener("pointerleave",()=>this.store.set({hover:null})),t.addEventListener("dblclick",()=>this.store.set({window:this.data.span})),t.addEventListener("wheel",o=>{o.preventDefault();let{window:a}=this.store.state,{span:l,samples:c}=this.data,h=(o.shiftKey?o.deltaY:o.deltaX)/t.clientWidth*(a[1]-a[0]),u=o.shiftKey||Math.abs(o.deltaX)>Math.abs(o.deltaY)?No(a,h,l):Yr(a,Math.exp(vP*o.deltaY),s(i(o)),l,c);this.store.set({window:u})},{passive:!1})}};function yP(n,e,{kind:t,component:i}){let s=i===3;return[-1,1].map(r=>{let o=r<0?"lower":"upper";if(t==="error"){let a=r<0&&s?0:r;return e.beside(o+(s?" of the norm":""),l=>a*l,(l,c)=>({...c,...Tx(a*c.low,a*c.high)}))}return n.beside(o,(a,l,c)=>a+r*c,(a,l,c)=>({...l,...Tx(l.low+r*c.high,l.high+r*c.high)}),e)})}function Tx(n,e){return{low:Math.min(n,e),high:Math.max(n,e)}}function _P(n,{kind:e,component:t}){let i=e==="error"?0:1/0,s=e==="error"?0:-1/0;for(let o of n)for(let a of o)a!==null&&(a<i&&(i=a),a>s&&(s=a));if(!(i<=s))return[-1,1];let r=s>i?.06*(s-i):Math.max(1,.1*Math.abs(s));return[e==="error"&&t===3?i:i-r,s+r]}var hc=64;function rr(n,e,t,i=!1){let s=document.createElement("canvas"),r=`600 ${.75*hc}px system-ui, "DejaVu Sans", sans-serif`,o=s.getContext("2d");if(!o)throw new Error("this browser draws no text on a canvas");o.font=r,s.width=Math.ceil(o.measureText(n).width)+12,s.height=hc,o=s.getContext("2d"),o&&(o.font=r,o.textAlign="center",o.textBaseline="middle",o.lineWidth=6,o.lineJoin="round",o.strokeStyle=si(Xn,.85),o.strokeText(n,s.width/2,hc/2),o.fillStyle=e,o.fillText(n,s.width/2,hc/2));let a=new Il(s);a.colorSpace="srgb";let l=new Js(new ra({map:a,depthTest:!i,depthWrite:!1}));return l.scale.set(t*s.width/hc,t,1),l.renderOrder=i?30:5,l}var xP=new O(0,1,0),SP=new wr(1,1,1,10).translate(0,.5,0),bP=new Nl(1,1,14).translate(0,-.5,0);function Ni(n){return new Dt().fromArray(n).transpose()}var ls=class extends Ut{constructor(t,i,s){super();this.width=i;let r=new js({color:t,depthTest:!1,depthWrite:!1,transparent:!0});this.shaft=new Gn(SP,r),this.heads=Array.from({length:s==="force"?1:2},()=>new Gn(bP,r)),this.add(this.shaft,...this.heads);for(let o of this.children)o.renderOrder=20;this.visible=!1}width;shaft;heads;point(t,i){let s=i.length();if(this.visible=Number.isFinite(s)&&s>1e-9,!this.visible)return;this.position.copy(t),this.quaternion.copy(new li().setFromUnitVectors(xP,i.clone().divideScalar(s)));let r=Math.min(4.5*this.width,.5*s);this.shaft.scale.set(this.width,Math.max(s-r,1e-9),this.width),this.heads.forEach((o,a)=>{o.scale.set(.45*r,r,.45*r),o.position.y=s-.7*a*r})}};function Ex(n,e,t){let i=new Ut;return[new O(1,0,0),new O(0,1,0),new O(0,0,1)].forEach((r,o)=>{let a=xc[o]??Yt,l=new ls(a,e,"force");if(l.point(new O,r.clone().multiplyScalar(n)),i.add(l),t){let c=rr("xyz"[o]??"",a,.45*n,!0);c.position.copy(r).multiplyScalar(1.25*n),i.add(c)}}),i.matrixAutoUpdate=!1,i}function uc(n){n.traverse(e=>{if(e===n)return;if(e instanceof Js){e.material.map?.dispose(),e.material.dispose();return}let{geometry:t,material:i}=e;t?.dispose(),i?.dispose()}),n.clear()}var MP=.25,wP=.85,TP=.1,xf=class extends Ut{constructor(t,i,s){super();this.data=t;this.model=i;this.size=s;let r=.0075*s;this.arrows={force:new ls(za,r,"force"),moment:new ls(za,.7*r,"moment")},this.add(this.arrows.force,this.arrows.moment)}data;model;size;metresPer=null;arrows;fullColour=null;key="";update(t,i){let s=this.data.sensor(t.sensor);this.fit(t);let r=s&&t.errorOnRobot&&this.metresPer!==null?this.vector(t,s):null;for(let l of Object.values(this.arrows))l.visible=!1;if(this.model.tint(new Set,0),!s||!r||this.metresPer===null||this.fullColour===null)return;let o=Ni(Ao(i.get(s.link)??$a,s.link_H_sensor)),a=r.length();r.applyMatrix3(new Qe().setFromMatrix4(o)).multiplyScalar(this.metresPer),this.arrows[t.quantity].point(new O().setFromMatrixPosition(o),r),Number.isFinite(a)&&this.model.tint(EP(this.data,s),wP*Math.min(1,a/this.fullColour))}vector(t,i){let s=Ha(i,t.hidden);if(!s)return null;let r=o=>this.data.columns.error(i,s,t.quantity,o)?.at(t.sample)??Number.NaN;return new O(r(0),r(1),r(2))}fit(t){let i=JSON.stringify([t.sensor,t.quantity,[...t.hidden]]);if(i===this.key)return;this.key=i;let s=this.data.sensor(t.sensor),r=Ha(s,t.hidden),o=Lo(this.data,{...t,window:this.data.span}),a=s&&r&&this.data.columns.error(s,r,t.quantity,3),l=a&&o!==null?a.at(o):0,h=Oi(s)?.peak[t.quantity==="force"?0:1]??0;this.metresPer=l>0?MP*this.size/l:null,this.fullColour=h>0?TP*h:null}};function EP({scene:n},e){let t=({acting:o,acted_on:a})=>n.robot.joints.find(({parent:l,child:c})=>l===o&&c===a||l===a&&c===o)?.child,i=t(e),s=new Set(n.sensors.filter(o=>o!==e).map(t)),r=new Set(i===void 0?[]:[i]);for(let{parent:o,child:a}of n.robot.joints)r.has(o)&&!s.has(a)&&r.add(a);return r}var AP=[0,1,-1,2,-2,3,-3,4,-4];function CP(n){let e=[];return n.map(t=>{let i=r=>({...t,y:t.y+r*t.height}),s=AP.find(r=>e.every(o=>!Ax(i(r),o)))??0;return e.push(i(s)),s})}function Ax(n,e){return 2*Math.abs(n.x-e.x)<n.width+e.width&&2*Math.abs(n.y-e.y)<n.height+e.height}function Cx(n,e){let t=Dm(n,e);CP(t).forEach((i,s)=>t[s]?.text.center.set(.5,.5-i))}function Rx(n,e){for(let s of n)s.visible=!0;let t=[],i=new Map(Dm(n,e).map(s=>[s.text,s]));for(let s of n){let r=i.get(s);s.visible=r!==void 0&&t.every(o=>!Ax(r,o)),r&&s.visible&&t.push(r)}}function Sf(n,e,{clientWidth:t,clientHeight:i}){return RP(n,e).map(({x:s,y:r,width:o,height:a})=>({left:.5*t*(1+s-.5*o),right:.5*t*(1+s+.5*o),top:.5*i*(1-r-.5*a),bottom:.5*i*(1-r+.5*a)}))}function RP(n,e){return Dm(n,e).map(({text:t,x:i,y:s,width:r,height:o})=>({x:i,y:s+(.5-t.center.y)*o,width:r,height:o}))}function Dm(n,e){e.updateMatrixWorld();let t=Math.tan(e.fov*Math.PI/360);return n.filter(Px).map(i=>{let s=new O().setFromMatrixPosition(i.matrixWorld),r=-s.clone().applyMatrix4(e.matrixWorldInverse).z,{x:o,y:a}=s.project(e),l=i.scale.y/(t*r);return{text:i,depth:r,x:o,y:a,width:i.scale.x/(t*r*e.aspect),height:l}}).filter(({depth:i})=>i>0).sort((i,s)=>i.depth-s.depth)}function Px(n){return n.visible&&(n.parent===null||Px(n.parent))}var PP=new Ke(za),bf=class extends Ut{constructor(t){super();this.data=t;let{shapes:i}=t.scene.robot;for(let s of t.scene.robot.links){let r=new Ut;r.matrixAutoUpdate=!1,this.links.set(s,r),this.add(r)}for(let s of i)this.links.get(s.link)?.add(this.solid(s));this.bones=i.length===0?new ws(new $t,new es({color:Yt})):null,this.bones&&(this.bones.frustumCulled=!1,this.add(this.bones))}data;links=new Map;bones;surfaces=[];place(t){for(let[i,s]of this.links){let r=t.get(i);s.visible=r!==void 0,r&&s.matrix.copy(Ni(r))}this.bones?.geometry.setFromPoints(this.data.scene.robot.joints.flatMap(i=>[Mf(t,i.parent),Mf(t,i.child)]))}tint(t,i){for(let{link:s,material:r,own:o}of this.surfaces)r.color.copy(o).lerp(PP,t.has(s)?i:0)}solid(t){let[i=.7,s=.7,r=.7,o=1]=t.colour,a=new Fl({color:IP(new Ke().setRGB(i,s,r,"srgb")),opacity:o,transparent:o<1,flatShading:!0,side:ui});this.surfaces.push({link:t.link,material:a,own:a.color.clone()});let l=new Gn(this.surface(t),a);if(l.matrixAutoUpdate=!1,l.matrix.copy(Ni(t.link_H_shape)),t.kind==="mesh"){let[c=1,h=1,u=1]=t.size;l.matrix.scale(new O(c,h,u))}return l}surface(t){let[i=0,s=0,r=0]=t.size;if(t.kind==="box")return new Mr(i,s,r);if(t.kind==="sphere")return new Qr(i,24,16);if(t.kind==="cylinder")return new wr(i,i,s,32).rotateX(Math.PI/2);let o=this.data.scene.robot.meshes[t.mesh??-1],a=new $t;return o&&(a.setAttribute("position",new fn(this.data.floats(o.vertices),3)),a.setIndex(new fn(this.data.integers(o.faces),1))),a}};function IP({r:n,g:e,b:t}){return new Ke().setScalar(.25+.6*(.2126*n+.7152*e+.0722*t))}function Mf(n,e){let t=n.get(e);return new O(t?.[3]??0,t?.[7]??0,t?.[11]??0)}var DP=.2,wf=Mo.map(n=>new Ke(n)),LP=new Qr(1,20,14),Tf=class extends Ut{constructor(t,i,s){super();this.colour=t;this.size=i;this.matrixAutoUpdate=!1,this.words=s===null?null:new Ut,this.words&&s!==null&&(this.words.add(rr(s,t,.03*i,!0)),this.add(this.words))}colour;size;arrows=[];balls=[];words;tips=[];point(t,i){for(;this.arrows.length<t.length;)this.addOne();this.tips=[],this.arrows.forEach((r,o)=>{let a=this.balls[o],l=t[o];if(a&&(a.visible=!1),r.visible=!1,!l)return;let c=new O().fromArray([...l.place]),h=new O().fromArray([...l.force]).multiplyScalar(i);r.point(c,h),this.tips.push(c.clone().add(h).toArray()),a&&l.spread&&this.stretch(a,c.add(h),l.spread,i)});let[s]=t;this.words&&(this.words.visible=s!==void 0,s&&this.words.position.fromArray([...s.place]))}inWorld(){return this.visible?this.tips.map(t=>new O().fromArray(t).applyMatrix4(this.matrix).toArray()):[]}get ellipsoids(){return this.visible?this.balls.filter(t=>t.visible).length:0}stretch(t,i,s,r){let[o=0,a=0,l=0,c=0,h=0,u=0,f=0,d=0,g=0]=s.map(_=>_*r);t.matrix.set(o,a,l,i.x,c,h,u,i.y,f,d,g,i.z,0,0,0,1),t.visible=!0}addOne(){let t=new ls(this.colour,.0038*this.size,"force"),i=new Gn(LP,new js({color:this.colour,opacity:.35,transparent:!0,depthTest:!1,depthWrite:!1,side:ui}));i.matrixAutoUpdate=!1,i.visible=!1,i.renderOrder=21,this.arrows.push(t),this.balls.push(i),this.add(t,i)}},Lm=class extends Gn{constructor(t,i){let s=new js({vertexColors:!0,side:ui,polygonOffset:!0});[s.polygonOffsetFactor,s.polygonOffsetUnits]=[-4,-4];super(new $t,s);this.data=t;this.patch=i;let r=i.vertices.shape[0]??0;this.colours=new fn(new Float32Array(3*r),3),this.geometry.setAttribute("position",new fn(t.floats(i.vertices),3)),this.geometry.setAttribute("color",this.colours),this.geometry.setIndex(new fn(t.integers(i.faces),1)),this.matrixAutoUpdate=!1}data;patch;pressed=0;colours;colour(t){let i=this.colours.count,s=t===null?null:this.data.floats(this.patch.pressure).subarray(t*i);this.pressed=0;for(let r=0;r<i;r++){let o=s?.[r]??0;o>0&&this.pressed++;let{r:a,g:l,b:c}=Nm(o/(this.patch.largest_Pa||1));this.colours.setXYZ(r,a,l,c)}this.colours.needsUpdate=!0}},Ef=class extends Ut{constructor(t,i){super();this.data=t;let{skin:s,skin_events:r}=t.scene;this.metresPer=Ix(t,s.map(a=>a.contacts),i);let o=Ix(t,r.map(a=>a.contacts),i);this.patches=s.map(a=>({patch:a,surface:new Lm(t,a),arrows:new Tf(bc,i,null)})),this.events=r.map(a=>({series:a,arrows:new Tf(wo,i,"heuristic"),metresPer:o}));for(let{surface:a,arrows:l}of this.patches)this.add(a,l);for(let{arrows:a}of this.events)this.add(a)}data;metresPer;patches;events;update(t,i){let s=this.data.time[t.sample]??Number.NaN;for(let{patch:r,surface:o,arrows:a}of this.patches){let l=i.get(r.link);if(o.visible=a.visible=t.skin&&l!==void 0,!o.visible||!l)continue;let c=rl(this.data,r.contacts,s);o.matrix.copy(Ni(l)),o.colour(c),this.turn(a,r.contacts,c,l,this.metresPer)}for(let{series:r,arrows:o,metresPer:a}of this.events){let l=i.get(r.link);o.visible=t.skinEvents&&l!==void 0,l&&this.turn(o,r.contacts,rl(this.data,r.contacts,s),l,a)}}shown(){let t=[...this.patches.map(({patch:i,arrows:s})=>[i.name,s]),...this.events.map(({series:i,arrows:s})=>[i.name,s])];return{pressed:Object.fromEntries(this.patches.map(({patch:i,surface:s})=>[i.name,s.visible?s.pressed:0])),contacts:Object.fromEntries(t.map(([i,s])=>[i,s.inWorld()])),ellipsoids:t.reduce((i,[,s])=>i+s.ellipsoids,0)}}turn(t,i,s,r,o){t.matrix.copy(Ni(r)),t.point(Xc(this.data,i,s),o)}};function Nm(n){let e=Math.min(1,Math.max(0,n))*(wf.length-1),t=Math.min(Math.floor(e),wf.length-2);return new Ke().lerpColors(wf[t]??new Ke,wf[t+1]??new Ke,e-t)}function Ix(n,e,t){let i=Math.max(0,...e.map(s=>qc(n,s)));return i>0?DP*t/i:1}var Dx={type:"change"},Fm={type:"start"},Nx={type:"end"},Af=new Sr,Lx=new Ci,NP=Math.cos(70*kp.DEG2RAD),Ln=new O,mi=2*Math.PI,Nt={NONE:-1,ROTATE:0,DOLLY:1,PAN:2,TOUCH_ROTATE:3,TOUCH_PAN:4,TOUCH_DOLLY_PAN:5,TOUCH_DOLLY_ROTATE:6},Um=1e-6,Cf=class extends Wl{constructor(e,t=null){super(e,t),this.state=Nt.NONE,this.target=new O,this.cursor=new O,this.minDistance=0,this.maxDistance=1/0,this.minZoom=0,this.maxZoom=1/0,this.minTargetRadius=0,this.maxTargetRadius=1/0,this.minPolarAngle=0,this.maxPolarAngle=Math.PI,this.minAzimuthAngle=-1/0,this.maxAzimuthAngle=1/0,this.enableDamping=!1,this.dampingFactor=.05,this.enableZoom=!0,this.zoomSpeed=1,this.enableRotate=!0,this.rotateSpeed=1,this.keyRotateSpeed=1,this.enablePan=!0,this.panSpeed=1,this.screenSpacePanning=!0,this.keyPanSpeed=7,this.zoomToCursor=!1,this.autoRotate=!1,this.autoRotateSpeed=2,this.keys={LEFT:"ArrowLeft",UP:"ArrowUp",RIGHT:"ArrowRight",BOTTOM:"ArrowDown"},this.mouseButtons={LEFT:Cr.ROTATE,MIDDLE:Cr.DOLLY,RIGHT:Cr.PAN},this.touches={ONE:Rr.ROTATE,TWO:Rr.DOLLY_PAN},this.target0=this.target.clone(),this.position0=this.object.position.clone(),this.zoom0=this.object.zoom,this._cursorStyle="auto",this._domElementKeyEvents=null,this._lastPosition=new O,this._lastQuaternion=new li,this._lastTargetPosition=new O,this._quat=new li().setFromUnitVectors(e.up,new O(0,1,0)),this._quatInverse=this._quat.clone().invert(),this._spherical=new ca,this._sphericalDelta=new ca,this._scale=1,this._panOffset=new O,this._rotateStart=new $e,this._rotateEnd=new $e,this._rotateDelta=new $e,this._panStart=new $e,this._panEnd=new $e,this._panDelta=new $e,this._dollyStart=new $e,this._dollyEnd=new $e,this._dollyDelta=new $e,this._dollyDirection=new O,this._mouse=new $e,this._performCursorZoom=!1,this._pointers=[],this._pointerPositions={},this._controlActive=!1,this._onPointerMove=FP.bind(this),this._onPointerDown=UP.bind(this),this._onPointerUp=OP.bind(this),this._onContextMenu=WP.bind(this),this._onMouseWheel=zP.bind(this),this._onKeyDown=VP.bind(this),this._onTouchStart=HP.bind(this),this._onTouchMove=GP.bind(this),this._onMouseDown=kP.bind(this),this._onMouseMove=BP.bind(this),this._interceptControlDown=XP.bind(this),this._interceptControlUp=qP.bind(this),this.domElement!==null&&this.connect(this.domElement),this.update()}set cursorStyle(e){this._cursorStyle=e,e==="grab"?this.domElement.style.cursor="grab":this.domElement.style.cursor="auto"}get cursorStyle(){return this._cursorStyle}connect(e){super.connect(e),this.domElement.addEventListener("pointerdown",this._onPointerDown),this.domElement.addEventListener("pointercancel",this._onPointerUp),this.domElement.addEventListener("contextmenu",this._onContextMenu),this.domElement.addEventListener("wheel",this._onMouseWheel,{passive:!1}),this.domElement.ownerDocument.addEventListener("keydown",this._interceptControlDown,{passive:!0,capture:!0}),this.domElement.style.touchAction="none"}disconnect(){this.state=Nt.NONE,this.domElement.removeEventListener("pointerdown",this._onPointerDown),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.domElement.removeEventListener("pointercancel",this._onPointerUp),this.domElement.removeEventListener("wheel",this._onMouseWheel),this.domElement.removeEventListener("contextmenu",this._onContextMenu),this.stopListenToKeyEvents(),this.domElement.ownerDocument.removeEventListener("keydown",this._interceptControlDown,{capture:!0}),this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{capture:!0}),this._controlActive=!1,this._pointers.length=0,this._pointerPositions={},this.domElement.style.touchAction="",this.domElement.style.cursor="auto"}dispose(){this.disconnect()}getPolarAngle(){return this._spherical.phi}getAzimuthalAngle(){return this._spherical.theta}getDistance(){return this.object.position.distanceTo(this.target)}listenToKeyEvents(e){e.addEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=e}stopListenToKeyEvents(){this._domElementKeyEvents!==null&&(this._domElementKeyEvents.removeEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=null)}saveState(){this.target0.copy(this.target),this.position0.copy(this.object.position),this.zoom0=this.object.zoom}reset(){this.target.copy(this.target0),this.object.position.copy(this.position0),this.object.zoom=this.zoom0,this.object.updateProjectionMatrix(),this.dispatchEvent(Dx),this.update(),this.state=Nt.NONE}pan(e,t){this._pan(e,t),this.update()}dollyIn(e){this._dollyIn(e),this.update()}dollyOut(e){this._dollyOut(e),this.update()}rotateLeft(e){this._rotateLeft(e),this.update()}rotateUp(e){this._rotateUp(e),this.update()}update(e=null){let t=this.object.position;Ln.copy(t).sub(this.target),Ln.applyQuaternion(this._quat),this._spherical.setFromVector3(Ln),this.autoRotate&&this.state===Nt.NONE&&this._rotateLeft(this._getAutoRotationAngle(e)),this.enableDamping?(this._spherical.theta+=this._sphericalDelta.theta*this.dampingFactor,this._spherical.phi+=this._sphericalDelta.phi*this.dampingFactor):(this._spherical.theta+=this._sphericalDelta.theta,this._spherical.phi+=this._sphericalDelta.phi);let i=this.minAzimuthAngle,s=this.maxAzimuthAngle;isFinite(i)&&isFinite(s)&&(i<-Math.PI?i+=mi:i>Math.PI&&(i-=mi),s<-Math.PI?s+=mi:s>Math.PI&&(s-=mi),i<=s?this._spherical.theta=Math.max(i,Math.min(s,this._spherical.theta)):this._spherical.theta=this._spherical.theta>(i+s)/2?Math.max(i,this._spherical.theta):Math.min(s,this._spherical.theta)),this._spherical.phi=Math.max(this.minPolarAngle,Math.min(this.maxPolarAngle,this._spherical.phi)),this._spherical.makeSafe(),this.enableDamping===!0?this.target.addScaledVector(this._panOffset,this.dampingFactor):this.target.add(this._panOffset),this.target.sub(this.cursor),this.target.clampLength(this.minTargetRadius,this.maxTargetRadius),this.target.add(this.cursor);let r=!1;if(this.zoomToCursor&&this._performCursorZoom||this.object.isOrthographicCamera)this._spherical.radius=this._clampDistance(this._spherical.radius);else{let o=this._spherical.radius;this._spherical.radius=this._clampDistance(this._spherical.radius*this._scale),r=o!=this._spherical.radius}if(Ln.setFromSpherical(this._spherical),Ln.applyQuaternion(this._quatInverse),t.copy(this.target).add(Ln),this.object.lookAt(this.target),this.enableDamping===!0?(this._sphericalDelta.theta*=1-this.dampingFactor,this._sphericalDelta.phi*=1-this.dampingFactor,this._panOffset.multiplyScalar(1-this.dampingFactor)):(this._sphericalDelta.set(0,0,0),this._panOffset.set(0,0,0)),this.zoomToCursor&&this._performCursorZoom){let o=null;if(this.object.isPerspectiveCamera){let a=Ln.length();o=this._clampDistance(a*this._scale);let l=a-o;this.object.position.addScaledVector(this._dollyDirection,l),this.object.updateMatrixWorld(),r=!!l}else if(this.object.isOrthographicCamera){let a=new O(this._mouse.x,this._mouse.y,0);a.unproject(this.object);let l=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),this.object.updateProjectionMatrix(),r=l!==this.object.zoom;let c=new O(this._mouse.x,this._mouse.y,0);c.unproject(this.object),this.object.position.sub(c).add(a),this.object.updateMatrixWorld(),o=Ln.length()}else console.warn("WARNING: OrbitControls.js encountered an unknown camera type - zoom to cursor disabled."),this.zoomToCursor=!1;o!==null&&(this.screenSpacePanning?this.target.set(0,0,-1).transformDirection(this.object.matrix).multiplyScalar(o).add(this.object.position):(Af.origin.copy(this.object.position),Af.direction.set(0,0,-1).transformDirection(this.object.matrix),Math.abs(this.object.up.dot(Af.direction))<NP?this.object.lookAt(this.target):(Lx.setFromNormalAndCoplanarPoint(this.object.up,this.target),Af.intersectPlane(Lx,this.target))))}else if(this.object.isOrthographicCamera){let o=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),o!==this.object.zoom&&(this.object.updateProjectionMatrix(),r=!0)}return this._scale=1,this._performCursorZoom=!1,r||this._lastPosition.distanceToSquared(this.object.position)>Um||8*(1-this._lastQuaternion.dot(this.object.quaternion))>Um||this._lastTargetPosition.distanceToSquared(this.target)>Um?(this.dispatchEvent(Dx),this._lastPosition.copy(this.object.position),this._lastQuaternion.copy(this.object.quaternion),this._lastTargetPosition.copy(this.target),!0):!1}_getAutoRotationAngle(e){return e!==null?mi/60*this.autoRotateSpeed*e:mi/60/60*this.autoRotateSpeed}_getZoomScale(e){let t=Math.abs(e*.01);return Math.pow(.95,this.zoomSpeed*t)}_rotateLeft(e){this._sphericalDelta.theta-=e}_rotateUp(e){this._sphericalDelta.phi-=e}_panLeft(e,t){Ln.setFromMatrixColumn(t,0),Ln.multiplyScalar(-e),this._panOffset.add(Ln)}_panUp(e,t){this.screenSpacePanning===!0?Ln.setFromMatrixColumn(t,1):(Ln.setFromMatrixColumn(t,0),Ln.crossVectors(this.object.up,Ln)),Ln.multiplyScalar(e),this._panOffset.add(Ln)}_pan(e,t){let i=this.domElement;if(this.object.isPerspectiveCamera){let s=this.object.position;Ln.copy(s).sub(this.target);let r=Ln.length();r*=Math.tan(this.object.fov/2*Math.PI/180),this._panLeft(2*e*r/i.clientHeight,this.object.matrix),this._panUp(2*t*r/i.clientHeight,this.object.matrix)}else this.object.isOrthographicCamera?(this._panLeft(e*(this.object.right-this.object.left)/this.object.zoom/i.clientWidth,this.object.matrix),this._panUp(t*(this.object.top-this.object.bottom)/this.object.zoom/i.clientHeight,this.object.matrix)):(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - pan disabled."),this.enablePan=!1)}_dollyOut(e){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale/=e:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_dollyIn(e){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale*=e:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_updateZoomParameters(e,t){if(!this.zoomToCursor)return;this._performCursorZoom=!0;let i=this.domElement.getBoundingClientRect(),s=e-i.left,r=t-i.top,o=i.width,a=i.height;this._mouse.x=s/o*2-1,this._mouse.y=-(r/a)*2+1,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()}_clampDistance(e){return Math.max(this.minDistance,Math.min(this.maxDistance,e))}_handleMouseDownRotate(e){this._rotateStart.set(e.clientX,e.clientY)}_handleMouseDownDolly(e){this._updateZoomParameters(e.clientX,e.clientY),this._dollyStart.set(e.clientX,e.clientY)}_handleMouseDownPan(e){this._panStart.set(e.clientX,e.clientY)}_handleMouseMoveRotate(e){this._rotateEnd.set(e.clientX,e.clientY),this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let t=this.domElement;this._rotateLeft(mi*this._rotateDelta.x/t.clientHeight),this._rotateUp(mi*this._rotateDelta.y/t.clientHeight),this._rotateStart.copy(this._rotateEnd),this.update()}_handleMouseMoveDolly(e){this._dollyEnd.set(e.clientX,e.clientY),this._dollyDelta.subVectors(this._dollyEnd,this._dollyStart),this._dollyDelta.y>0?this._dollyOut(this._getZoomScale(this._dollyDelta.y)):this._dollyDelta.y<0&&this._dollyIn(this._getZoomScale(this._dollyDelta.y)),this._dollyStart.copy(this._dollyEnd),this.zoomToCursor&&(this._performCursorZoom=!0,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()),this.update()}_handleMouseMovePan(e){this._panEnd.set(e.clientX,e.clientY),this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd),this.update()}_handleMouseWheel(e){this._updateZoomParameters(e.clientX,e.clientY),e.deltaY<0?this._dollyIn(this._getZoomScale(e.deltaY)):e.deltaY>0&&this._dollyOut(this._getZoomScale(e.deltaY)),this.update()}_handleKeyDown(e){let t=!1;switch(e.code){case this.keys.UP:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateUp(mi*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,this.keyPanSpeed),t=!0;break;case this.keys.BOTTOM:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateUp(-mi*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,-this.keyPanSpeed),t=!0;break;case this.keys.LEFT:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateLeft(mi*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(this.keyPanSpeed,0),t=!0;break;case this.keys.RIGHT:e.ctrlKey||e.metaKey||e.shiftKey?this.enableRotate&&this._rotateLeft(-mi*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(-this.keyPanSpeed,0),t=!0;break}t&&(e.preventDefault(),this.update())}_handleTouchStartRotate(e){if(this._pointers.length===1)this._rotateStart.set(e.pageX,e.pageY);else{let t=this._getSecondPointerPosition(e),i=.5*(e.pageX+t.x),s=.5*(e.pageY+t.y);this._rotateStart.set(i,s)}}_handleTouchStartPan(e){if(this._pointers.length===1)this._panStart.set(e.pageX,e.pageY);else{let t=this._getSecondPointerPosition(e),i=.5*(e.pageX+t.x),s=.5*(e.pageY+t.y);this._panStart.set(i,s)}}_handleTouchStartDolly(e){let t=this._getSecondPointerPosition(e),i=e.pageX-t.x,s=e.pageY-t.y,r=Math.sqrt(i*i+s*s);this._dollyStart.set(0,r)}_handleTouchStartDollyPan(e){this.enableZoom&&this._handleTouchStartDolly(e),this.enablePan&&this._handleTouchStartPan(e)}_handleTouchStartDollyRotate(e){this.enableZoom&&this._handleTouchStartDolly(e),this.enableRotate&&this._handleTouchStartRotate(e)}_handleTouchMoveRotate(e){if(this._pointers.length==1)this._rotateEnd.set(e.pageX,e.pageY);else{let i=this._getSecondPointerPosition(e),s=.5*(e.pageX+i.x),r=.5*(e.pageY+i.y);this._rotateEnd.set(s,r)}this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let t=this.domElement;this._rotateLeft(mi*this._rotateDelta.x/t.clientHeight),this._rotateUp(mi*this._rotateDelta.y/t.clientHeight),this._rotateStart.copy(this._rotateEnd)}_handleTouchMovePan(e){if(this._pointers.length===1)this._panEnd.set(e.pageX,e.pageY);else{let t=this._getSecondPointerPosition(e),i=.5*(e.pageX+t.x),s=.5*(e.pageY+t.y);this._panEnd.set(i,s)}this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd)}_handleTouchMoveDolly(e){let t=this._getSecondPointerPosition(e),i=e.pageX-t.x,s=e.pageY-t.y,r=Math.sqrt(i*i+s*s);this._dollyEnd.set(0,r),this._dollyDelta.set(0,Math.pow(this._dollyEnd.y/this._dollyStart.y,this.zoomSpeed)),this._dollyOut(this._dollyDelta.y),this._dollyStart.copy(this._dollyEnd);let o=(e.pageX+t.x)*.5,a=(e.pageY+t.y)*.5;this._updateZoomParameters(o,a)}_handleTouchMoveDollyPan(e){this.enableZoom&&this._handleTouchMoveDolly(e),this.enablePan&&this._handleTouchMovePan(e)}_handleTouchMoveDollyRotate(e){this.enableZoom&&this._handleTouchMoveDolly(e),this.enableRotate&&this._handleTouchMoveRotate(e)}_addPointer(e){this._pointers.push(e.pointerId)}_removePointer(e){delete this._pointerPositions[e.pointerId];for(let t=0;t<this._pointers.length;t++)if(this._pointers[t]==e.pointerId){this._pointers.splice(t,1);return}}_isTrackingPointer(e){for(let t=0;t<this._pointers.length;t++)if(this._pointers[t]==e.pointerId)return!0;return!1}_trackPointer(e){let t=this._pointerPositions[e.pointerId];t===void 0&&(t=new $e,this._pointerPositions[e.pointerId]=t),t.set(e.pageX,e.pageY)}_getSecondPointerPosition(e){let t=e.pointerId===this._pointers[0]?this._pointers[1]:this._pointers[0];return this._pointerPositions[t]}_customWheelEvent(e){let t=e.deltaMode,i={clientX:e.clientX,clientY:e.clientY,deltaY:e.deltaY};switch(t){case 1:i.deltaY*=16;break;case 2:i.deltaY*=100;break}return e.ctrlKey&&!this._controlActive&&(i.deltaY*=10),i}};function UP(n){this.enabled!==!1&&(this._pointers.length===0&&(this.domElement.setPointerCapture(n.pointerId),this.domElement.ownerDocument.addEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.addEventListener("pointerup",this._onPointerUp)),!this._isTrackingPointer(n)&&(this._addPointer(n),n.pointerType==="touch"?this._onTouchStart(n):this._onMouseDown(n),this._cursorStyle==="grab"&&(this.domElement.style.cursor="grabbing")))}function FP(n){this.enabled!==!1&&(n.pointerType==="touch"?this._onTouchMove(n):this._onMouseMove(n))}function OP(n){switch(this._removePointer(n),this._pointers.length){case 0:this.domElement.releasePointerCapture(n.pointerId),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.dispatchEvent(Nx),this.state=Nt.NONE,this._cursorStyle==="grab"&&(this.domElement.style.cursor="grab");break;case 1:let e=this._pointers[0],t=this._pointerPositions[e];this._onTouchStart({pointerId:e,pageX:t.x,pageY:t.y});break}}function kP(n){let e;switch(n.button){case 0:e=this.mouseButtons.LEFT;break;case 1:e=this.mouseButtons.MIDDLE;break;case 2:e=this.mouseButtons.RIGHT;break;default:e=-1}switch(e){case Cr.DOLLY:if(this.enableZoom===!1)return;this._handleMouseDownDolly(n),this.state=Nt.DOLLY;break;case Cr.ROTATE:if(n.ctrlKey||n.metaKey||n.shiftKey){if(this.enablePan===!1)return;this._handleMouseDownPan(n),this.state=Nt.PAN}else{if(this.enableRotate===!1)return;this._handleMouseDownRotate(n),this.state=Nt.ROTATE}break;case Cr.PAN:if(n.ctrlKey||n.metaKey||n.shiftKey){if(this.enableRotate===!1)return;this._handleMouseDownRotate(n),this.state=Nt.ROTATE}else{if(this.enablePan===!1)return;this._handleMouseDownPan(n),this.state=Nt.PAN}break;default:this.state=Nt.NONE}this.state!==Nt.NONE&&this.dispatchEvent(Fm)}function BP(n){switch(this.state){case Nt.ROTATE:if(this.enableRotate===!1)return;this._handleMouseMoveRotate(n);break;case Nt.DOLLY:if(this.enableZoom===!1)return;this._handleMouseMoveDolly(n);break;case Nt.PAN:if(this.enablePan===!1)return;this._handleMouseMovePan(n);break}}function zP(n){this.enabled===!1||this.enableZoom===!1||this.state!==Nt.NONE||(n.preventDefault(),this.dispatchEvent(Fm),this._handleMouseWheel(this._customWheelEvent(n)),this.dispatchEvent(Nx))}function VP(n){this.enabled!==!1&&this._handleKeyDown(n)}function HP(n){switch(this._trackPointer(n),this._pointers.length){case 1:switch(this.touches.ONE){case Rr.ROTATE:if(this.enableRotate===!1){this.state=Nt.NONE;break}this._handleTouchStartRotate(n),this.state=Nt.TOUCH_ROTATE;break;case Rr.PAN:if(this.enablePan===!1){this.state=Nt.NONE;break}this._handleTouchStartPan(n),this.state=Nt.TOUCH_PAN;break;default:this.state=Nt.NONE}break;case 2:switch(this.touches.TWO){case Rr.DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchStartDollyPan(n),this.state=Nt.TOUCH_DOLLY_PAN;break;case Rr.DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchStartDollyRotate(n),this.state=Nt.TOUCH_DOLLY_ROTATE;break;default:this.state=Nt.NONE}break;default:this.state=Nt.NONE}this.state!==Nt.NONE&&this.dispatchEvent(Fm)}function GP(n){switch(this._trackPointer(n),this.state){case Nt.TOUCH_ROTATE:if(this.enableRotate===!1)return;this._handleTouchMoveRotate(n),this.update();break;case Nt.TOUCH_PAN:if(this.enablePan===!1)return;this._handleTouchMovePan(n),this.update();break;case Nt.TOUCH_DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchMoveDollyPan(n),this.update();break;case Nt.TOUCH_DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchMoveDollyRotate(n),this.update();break;default:this.state=Nt.NONE}}function WP(n){this.enabled!==!1&&n.preventDefault()}function XP(n){n.key==="Control"&&(this._controlActive=!0,this.domElement.ownerDocument.addEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}function qP(n){n.key==="Control"&&(this._controlActive=!1,this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}var Rf=Math.PI/24,Ux=1.15,YP=2,Aa=class{constructor(e,t,i){this.panel=e;this.frames=i;this.renderer=$P(),this.canvas=this.renderer?.domElement??document.createElement("canvas"),this.canvas.tabIndex=0,this.canvas.setAttribute("role","img"),this.canvas.setAttribute("aria-label",t),e.append(this.canvas),this.renderer||e.append(q("p",{class:"overlay absent"},"This browser draws nothing in 3-D: it has no WebGL 2.")),this.scene.background=new Ke(Xn),this.camera.up.set(0,0,1),this.controls=new Cf(this.camera,this.canvas),this.controls.addEventListener("change",()=>i.later(this)),this.canvas.addEventListener("keydown",s=>this.turnByKey(s)),this.fit(),new ResizeObserver(()=>this.fit()).observe(e)}panel;frames;canvas;scene=new El;camera=new oi(35,1,.01,100);renderer;controls;home={from:new O(3,-3,2),at:new O};fixed=!1;size="";lookFrom(e,t){this.home={from:e.clone(),at:t.clone()};let i=e.distanceTo(t);this.camera.near=i/100,this.camera.far=i*20,this.reset()}reset(){this.camera.position.copy(this.home.from),this.controls.target.copy(this.home.at),this.camera.updateProjectionMatrix(),this.controls.update(),this.frames.later(this)}draw(){this.renderer?.render(this.scene,this.camera)}hold(e,t){this.fixed=!0,this.resize(e,t,1,!1)}release(){this.fixed=!1,this.size="",this.fit()}onCanvas(e){let t=e.clone().project(this.camera);return t.z>1?null:{x:(.5+.5*t.x)*this.canvas.clientWidth,y:(.5-.5*t.y)*this.canvas.clientHeight}}fit(){let{clientWidth:e,clientHeight:t}=this.panel,i=Math.min(devicePixelRatio,YP),s=`${e} ${t} ${i}`;this.fixed||e===0||t===0||s===this.size||(this.size=s,this.resize(e,t,i,!0),this.frames.later(this))}resize(e,t,i,s){this.renderer?.setPixelRatio(i),this.renderer?.setSize(e,t,s),this.camera.aspect=e/t,this.camera.updateProjectionMatrix(),this.camera.updateMatrixWorld()}turnByKey(e){let t=this.camera.position.clone().sub(this.controls.target),i=new O().crossVectors(this.camera.up,t).normalize(),s={ArrowLeft:()=>t.applyAxisAngle(this.camera.up,-Rf),ArrowRight:()=>t.applyAxisAngle(this.camera.up,Rf),ArrowUp:()=>t.applyAxisAngle(i,-Rf),ArrowDown:()=>t.applyAxisAngle(i,Rf)},r={"+":()=>t.divideScalar(Ux),"-":()=>t.multiplyScalar(Ux),0:()=>t.copy(this.home.from).sub(this.controls.target)},o=e.altKey?s[e.key]:r[e.key];o&&(e.preventDefault(),e.stopPropagation(),o(),this.camera.position.copy(this.controls.target).add(t),this.controls.update(),this.frames.later(this))}};function $P(){try{return new Ju({antialias:!0,preserveDrawingBuffer:!0})}catch{return null}}var ZP=["force","moment"],KP=.3,Pf=class extends Ut{constructor(t,i){super();this.data=t;this.size=i;let{sensors:s,contacts:r}=t.scene;this.places=[...s.map((o,a)=>this.place(a,o.name,o.link,o.link_H_sensor,o.wrenches)),...r.map(o=>this.place(null,o.name,o.link,o.link_H_contact,[o]))]}data;size;texts=[];places;get metresPer(){return{force:this.unit("force"),moment:this.unit("moment")}}update(t,i){let{metresPer:s}=this;for(let r of this.places){let o=Ao(i.get(r.link)??$a,r.link_H_frame),a=r.sensor===null?t.contacts:t.allSensors||r.sensor===t.sensor;r.frame.matrix.copy(Ni(o)),r.frame.visible=a;for(let{series:l,arrows:c}of r.drawn){let h=a&&!("role"in l&&t.hidden.has(l.name));for(let u of ZP){let f=h&&(u==="force"?t.forceArrows:t.momentArrows),d=new O(...this.data.vector(l,t.sample,u)).multiplyScalar(s[u]);JP(c[u],d,f?o:null)}}}}place(t,i,s,r,o){let a=new Ut;a.matrixAutoUpdate=!1,a.matrix=new Dt;let l=Ex(.07*this.size,.002*this.size,t!==null);if(a.add(l),this.texts.push(...l.children.filter(h=>h instanceof Js)),t!==null||!this.data.scene.sensors.some(h=>h.name===i&&h.link===s)){let h=rr(i,t===null?Sc:Yt,.032*this.size,!0);h.position.set(0,0,-.035*this.size),a.add(h),this.texts.push(h)}this.add(a);let c=o.map(h=>{let u="role"in h?this.colour(t,h):Sc,f=("role"in h&&h.role==="expected"?.0065:.0042)*this.size,d={force:new ls(u,f,"force"),moment:new ls(u,.7*f,"moment")};return this.add(d.force,d.moment),{series:h,arrows:d}});return{sensor:t,link:s,link_H_frame:r,frame:a,drawn:c}}colour(t,i){let s=t===null?void 0:this.data.sensor(t);return s?ii(s,i):Sc}unit(t){let i=this.data.scene.sensors.flatMap(({wrenches:r})=>{let o=r.filter(({role:a})=>a==="expected");return(o.length>0?o:r).map(a=>this.data.peak(a,t))}),s=Math.max(0,...i);return s>0?KP*this.size/s:1}};function JP(n,e,t){if(t===null){n.visible=!1;return}let i=Ni(t);n.point(new O().setFromMatrixPosition(i),e.applyMatrix3(new Qe().setFromMatrix4(i)))}var Fx=24,jP=.1,If=class extends Aa{constructor(t,i,s){super(t,"Robot in its posture at the current sample",i);this.data=s;let r=new Hl(Jf,1.9);r.position.set(2,-3,5),this.scene.add(new Bl(Jf,lg,2.2),r),this.model=new bf(s),this.scene.add(this.model),this.scene.add(this.ground);let o=this.aim();this.wrenches=new Pf(s,o),this.scene.add(this.wrenches),this.skin=new Ef(s,o),this.error=new xf(s,this.model,o),this.scene.add(this.skin,this.error)}data;wrenches;skin;error;model;ground=new Ut;aim(){let t=this.reach(),i=t.getSize(new O).length(),s=i>.001?i:jP;this.floor(t,s);let r=t.getCenter(new O),{sensors:o,coordinates:a}=this.data.scene,l=(o.length===0?1.25:a.length===0?1.6:1)*s;return this.lookFrom(r.clone().add(new O(.82,-.95,.45).multiplyScalar(l)),r),s}update(t){let i=Za(this.data,t.sample);this.model.place(i),this.wrenches.update(t,i),this.skin.update(t,i),this.error.update(t,i),this.frames.later(this)}draw(){this.scene.updateMatrixWorld(),Cx(this.wrenches.texts,this.camera),super.draw()}labels(){return Sf(this.wrenches.texts,this.camera,this.canvas)}reach(){let t=Math.min(Fx,Math.max(1,this.data.samples)),i=Array.from({length:t},(o,a)=>this.data.keySample(Math.floor(a*this.data.samples/t),Fx)),s=new Hi,r=new Map;for(let o of new Set(i)){r=Za(this.data,o);for(let a of r.keys())s.expandByPoint(Mf(r,a))}this.model.place(r),this.model.updateMatrixWorld(!0);for(let{link:o,vertices:a}of this.data.scene.skin){let l=r.get(o);if(!l)continue;let c=new Hi().setFromArray(this.data.floats(a));s.union(c.applyMatrix4(Ni(l)))}return s.union(new Hi().setFromObject(this.model))}floor(t,i){let s=new Gl(2*i,20,kr,Br);s.rotateX(Math.PI/2);let r=t.getCenter(new O);s.position.set(r.x,r.y,t.min.z),uc(this.ground),this.ground.add(s)}};var QP=[["errorOnRobot","Error as an arrow and as the colour of the limb"],["scaleByCalibrations","Scale of errors by calibrations alone"],["forceArrows","Force arrows"],["momentArrows","Moment arrows (two heads)"],["allSensors","Arrows of all sensors"],["contacts","Contact wrenches (world on robot)"],["skin","Pressure and contacts on skin"],["skinEvents","Contacts of the skinManager (heuristic, not newtons)"],["wireframes","Ellipsoids and reference sphere"],["hideIgnored","Hide ignored intervals in the clouds"]];function Om(n,e){let t=q("div",{role:"group","aria-label":"Series"});return e.on(["sensor","hidden"],()=>{let i=n.sensor(e.state.sensor),s=t.contains(document.activeElement)?document.activeElement?.getAttribute("aria-label"):null;t.replaceChildren();for(let r of i?.wrenches??[]){let o=q("span",{class:"chip"});o.style.background=i?ii(i,r):"";let{row:a,box:l}=nd([o,r.name],!e.state.hidden.has(r.name),c=>{let h=new Set(e.state.hidden);c?h.delete(r.name):h.add(r.name),e.set({hidden:h})},r.name);t.append(a),r.name===s&&l.focus()}i?.wrenches.length||t.append(q("p",{class:"absent"},"No wrenches of this sensor."))}),t}function km(n,e){let t=q("div",{role:"group","aria-label":"Shown"});for(let[i,s]of QP){if(e2(n,i))continue;let{row:r,box:o}=nd([s],e.state[i],a=>e.set({[i]:a}));e.on([i],()=>{o.checked=e.state[i]}),t.append(r)}return t}function e2({scene:n},e){if(n.sensors.length===0&&!n.live&&!e.startsWith("skin")||!n.sensors.some(Oi)&&["errorOnRobot","scaleByCalibrations"].includes(e)||n.live&&["errorOnRobot","scaleByCalibrations","wireframes","hideIgnored"].includes(e))return!0;let t={contacts:n.contacts,skin:n.skin,skinEvents:n.skin_events};return e in t&&t[e].length===0}function Bx(n,e,t,i){let{skin:s,skin_events:r}=n.scene;if(s.length+r.length===0)return[];let o=s.map(({name:f,largest_Pa:d})=>{let g=q("span",{class:"pressures",role:"img","aria-label":`Colours from 0 to ${kx(d)} kPa`});return g.style.background=`linear-gradient(to right, ${Mo.join(", ")})`,q("p",{class:"pressure-legend"},`${f}: 0 `,g,` ${kx(d)} kPa`)}),a=Number((.1/i).toPrecision(2)),l=s.length?[q("p",{},`0.1 m of arrow on skin: ${a} N, ellipsoid: one standard deviation`)]:[],c=[...Ox(n,s,"N"),...Ox(n,r,"of the heuristic")],h=c.length?[q("p",{},`Time axis: strongest colour at ${c.join(" and ")}`)]:[],u=new Bm(n,e,t);return[q("section",{"aria-label":"Skin"},q("h2",{},"Skin"),...o,...l,...h,u.root)]}function Ox(n,e,t){let i=Math.max(0,...e.map(({contacts:s})=>qc(n,s)));return i>0?[`${i.toPrecision(3)} ${t}`]:[]}var Bm=class{constructor(e,t,i){this.data=e;this.store=t;t.on(["sample"],()=>i.later(this))}data;store;root=q("div",{class:"values"});draw(){let{skin:e,skin_events:t}=this.data.scene,i=[...e.flatMap(({name:r,contacts:o})=>this.rows(r,o,bc,"N")),...t.flatMap(({name:r,contacts:o})=>this.rows(r,o,wo,"heuristic"))],s=q("p",{class:"absent"},"No contact on skin at this sample.");this.root.replaceChildren(i.length?q("table",{},q("tbody",{},...i)):s)}rows(e,t,i,s){let r=this.data.time[this.store.state.sample]??Number.NaN;return Xc(this.data,t,rl(this.data,t,r)).map(a=>{let l=q("span",{class:"chip"});l.style.background=i;let c=n0(a),h=Math.hypot(...a.force).toFixed(2)+(Number.isFinite(c)?` \xB1 ${c.toFixed(2)}`:"");return q("tr",{},q("th",{scope:"row"},l,`${e}: contact ${a.identity}`),q("td",{},`${h} ${s}`))})}};function kx(n){return(.001*n).toFixed(1)}var Ca=class{constructor(e,t){this.panel=e;this.store=t}panel;store;get ends(){return[pi,this.panel.clientWidth-Ps]}pixel(e){let[t,i]=this.store.state.window,[s,r]=this.ends;return s+(e-t)/(i-t||1)*(r-s)}instant(e){let[t,i]=this.store.state.window,[s,r]=this.ends;return t+(e-s)/(r-s)*(i-t)}};function Df(n,e,t){let i=n.getContext("2d");return!i||e<=pi+Ps?null:(n.width=Math.round(e*devicePixelRatio),n.height=Math.round(t*devicePixelRatio),i.setTransform(devicePixelRatio,0,0,devicePixelRatio,0,0),i.font="10px system-ui, 'DejaVu Sans', sans-serif",i)}var Ra=14,zm=64,zx=.15,Lf=class{constructor(e,t,i,s){this.panel=e;this.frames=t;this.data=i;this.store=s;this.axis=new Ca(e,s);let{skin:r,skin_events:o}=i.scene,a=Hx(c=>Nm(c).getStyle());this.rows=[...Vx(i,r,a,Ba?Mo[0]:Xn,"N"),...Vx(i,o,Hx(c=>si(wo,c)),Xn,"heuristic")];let l=this.rows.map(({name:c})=>c).join(", ");this.canvas.setAttribute("aria-label",`Contacts on skin over time: ${l}; the next one by the key c`),this.canvas.style.height=`${this.height}px`,e.append(this.canvas),new ResizeObserver(()=>t.later(this)).observe(e),this.canvas.addEventListener("click",c=>{let h=this.axis.instant(c.clientX-this.canvas.getBoundingClientRect().left);s.set({sample:i.nearestSample(h),playing:!1})}),this.canvas.addEventListener("mousemove",c=>{let h=this.canvas.getBoundingClientRect();this.canvas.title=this.describe(c.clientX-h.left,Math.floor((c.clientY-h.top)/Ra))})}panel;frames;data;store;canvas=q("canvas",{role:"img"});axis;rows;get height(){return Ra*this.rows.length+2}update(){this.frames.later(this)}draw(){let e=Df(this.canvas,this.panel.clientWidth,this.height);if(!e)return;let[t,i]=this.axis.ends;this.rows.forEach((r,o)=>{let a=Ra*o+1;e.fillStyle=r.bed,e.fillRect(t,a,i-t,Ra-2),this.columns(r).forEach((l,c)=>{l>0&&(e.fillStyle=r.shades[Math.round((zm-1)*Math.min(1,l/r.full))]??Yt,e.fillRect(t+c,a,1,Ra-2))}),e.strokeStyle=si(vs,.35),e.strokeRect(t+.5,a+.5,i-t-1,Ra-3),e.fillStyle=Yt,e.fillText(t2(e,r.name,t-8),4,a+9)});let s=this.axis.pixel(this.data.time[this.store.state.sample]??Number.NaN);if(s>=t&&s<=i)for(let[r,o]of[[Xn,2],[Yt,1]])e.fillStyle=r,e.fillRect(s-o,0,2*o,this.height)}columns({frames:e,forces:t}){let[i,s]=this.axis.ends,r=new Float32Array(Math.max(0,Math.ceil(s-i))),o=this.data.doubles(e.time_s);return t.forEach((a,l)=>{if(!(a>0))return;let c=o[l]??Number.NaN,h=Math.min(c+e.hold_s,o[l+1]??Number.POSITIVE_INFINITY);if(!(this.axis.pixel(h)>i))return;let u=Math.max(0,Math.floor(this.axis.pixel(c)-i)),f=Math.min(r.length-1,Math.floor(this.axis.pixel(h)-i-1e-6));for(let d=u;d<=Math.max(u,f)&&d<r.length;d++)r[d]=Math.max(r[d]??0,a)}),r}describe(e,t){let i=this.rows[t];if(!i)return"";let[s]=this.axis.ends,r=this.columns(i)[Math.floor(e-s)]??0;return r>0?`${i.name}: ${r.toFixed(2)} ${i.unit} at most`:`${i.name}: no contact`}};function Vx(n,e,t,i,s){let r=e.map(({name:a,contacts:l})=>({name:a,frames:l,forces:i0(n,l)})),o=r.reduce((a,{forces:l})=>l.reduce((c,h)=>Math.max(c,h),a),0)||1;return r.map(a=>({...a,shades:t,bed:i,full:o,unit:s}))}function Hx(n){return Array.from({length:zm},(e,t)=>n(zx+(1-zx)*t/(zm-1)))}function t2(n,e,t){if(n.measureText(e).width<=t)return e;let i=e.length;for(;i>1&&n.measureText(`${e.slice(0,i)}\u2026`).width>t;)i--;return`${e.slice(0,i)}\u2026`}var cs=32,fc=null;function Vm(){if(fc)return fc;let n=new Uint8Array(4*cs*cs).fill(255);for(let e=0;e<cs*cs;e++){let[t,i]=[e%cs-cs/2+.5,Math.floor(e/cs)-cs/2+.5];n[4*e+3]=Math.hypot(t,i)<cs/2?255:0}return fc=new oa(n,cs,cs),fc.needsUpdate=!0,fc}var n2={force:"f",moment:"t"},Gx=.17;function Xx(n,e){let t=new Ut,i=a=>new O(a&1?1:-1,a&2?1:-1,a&4?1:-1),s=[0,1,2,3,4,5,6,7].flatMap(a=>[1,2,4].filter(l=>!(a&l)).flatMap(l=>[i(a),i(a|l)]));t.add(qx(s,kr));let r=[0,1,2].map(a=>i2(n,e,a)),o=[...r.map(({title:a})=>a),...r.flatMap(({numbers:a})=>a)];return t.add(...r.map(({axis:a})=>a),...o),{group:t,texts:o}}function dc(n,e){let[t,i,s]=[0,1,2].map(r=>((e[r]??Number.NaN)-(n.centre[r]??0))/n.half);return new O(t,i,s)}function i2(n,e,t){let i=xc[t]??kr,s=n.centre[t]??0,r=(u,f)=>{let d=t===2?new O(-1,1,0):new O(-1,-1,-1);d.setComponent(t,(u-s)/n.half);let g=t===0?new O(0,-1,0):new O(-1,0,0);return d.addScaledVector(g,f)},o=qa(s-n.half,s+n.half,4),a=o.flatMap(u=>[r(u,0),r(u,.04)]),l=[r(s-n.half,0),r(s+n.half,0)],c=o.map(u=>Wx(rr(String(u),vs,Gx),r(u,.2))),h=rr(`${n2[e]}${"xyz"[t]??""} [${bi[e]}]`,i,1.15*Gx,!0);return Wx(h,r(s+1.2*n.half,0)),{axis:qx([...a,...l],i),title:h,numbers:c}}function Wx(n,e){return n.position.copy(e),n}function qx(n,e){return new ws(new $t().setFromPoints(n),new es({color:e}))}var s2=12,r2=4,Nf=class extends Aa{constructor(t,i,s,r,o){super(t,"Force or moment space with the current sample",i);this.data=s;this.maker=r;this.store=o;this.scene.add(this.fixedParts,this.markers),this.lookFrom(new O(2.75,-4.6,2.2),new O(0,-.1,-.05)),this.jumpOnClick()}data;maker;store;fixedParts=new Ut;markers=new Ut;clouds=null;drawn="";texts=[];update(t){let i=this.maker.of(t),s=JSON.stringify([[...t.hidden],t.wireframes]);(i!==this.clouds||s!==this.drawn)&&this.rebuild(i,t),this.clouds=i,this.drawn=s,this.mark(i,t),this.frames.later(this)}draw(){this.scene.updateMatrixWorld(),Rx(this.texts,this.camera),super.draw()}labels(){return Sf(this.texts,this.camera,this.canvas)}sampleOnCanvas(t,i){let s=this.clouds?.clouds[t];return!this.clouds||!s?null:this.onCanvas(dc(this.clouds,this.data.vector(s.series,i,this.store.state.quantity)))}samples(){return this.clouds?.samples??new Uint32Array}rebuild(t,i){uc(this.fixedParts);let{group:s,texts:r}=Xx(t,i.quantity);this.texts=r,this.fixedParts.add(s);for(let o of this.visible(t,i)){if(this.fixedParts.add(o2(t,o)),!i.wireframes)continue;let a=new Ut;o.sphere&&a.add(Qp(ef(o.sphere),hg,.22)),o.ellipsoid&&a.add(Qp(o.ellipsoid,o.colour,.45)),a.scale.setScalar(1/t.half),a.position.copy(dc(t,[0,0,0])),this.fixedParts.add(a)}}mark(t,i){uc(this.markers);for(let s of this.visible(t,i)){let r=dc(t,this.data.vector(s.series,i.sample,i.quantity));if(!Number.isFinite(r.x+r.y+r.z))continue;let o=new $t().setFromPoints([r]);for(let[a,l]of[[17,Xn],[14,s.colour],[5,Xn]]){let c=new aa(o,new jr({color:l,size:a,sizeAttenuation:!1,map:Vm(),transparent:!0,depthTest:!1,alphaTest:.5}));c.renderOrder=20,this.markers.add(c)}}}visible(t,i){return t.clouds.filter(s=>!i.hidden.has(s.series.name))}jumpOnClick(){let t=[0,0];this.canvas.addEventListener("pointerdown",i=>{t=[i.clientX,i.clientY]}),this.canvas.addEventListener("click",i=>{if(Math.hypot(i.clientX-t[0],i.clientY-t[1])>r2||$c(this.data,this.store))return;let s=this.canvas.getBoundingClientRect(),r=this.closest(i.clientX-s.left,i.clientY-s.top);r!==null&&this.store.set({sample:r,playing:!1})})}closest(t,i){if(!this.clouds)return null;let s=null;for(let r of this.visible(this.clouds,this.store.state))this.clouds.samples.forEach((o,a)=>{let l=this.clouds&&this.onCanvas(dc(this.clouds,r.points.subarray(3*a,3*a+3)));if(!l||Number.isNaN(l.x))return;let c=Math.hypot(l.x-t,l.y-i);c<(s?.distance??s2)&&(s={sample:o,distance:c})});return s?.sample??null}};function o2(n,e){let t=new Float32Array(e.points.length),i=new O(...n.centre),s=0,r=new O;for(let a=0;a+2<e.points.length;a+=3)r.fromArray(e.points,a).sub(i).divideScalar(n.half),Number.isFinite(r.x+r.y+r.z)&&r.toArray(t,s++*3);let o=new $t;return o.setAttribute("position",new fn(t.subarray(0,3*s),3)),new aa(o,new jr({color:e.colour,size:3,sizeAttenuation:!1,map:Vm(),alphaTest:.5}))}var Uf=class{constructor(e,t,i){this.data=e;this.store=t;t.on(["window","sensor","quantity","hidden"],()=>i.later(this))}data;store;root=q("div",{class:"values"});draw(){let{sensor:e,hidden:t}=this.store.state,i=this.data.sensor(e),s=(i?.wrenches??[]).filter(o=>o.role==="measured"&&!t.has(o.name)).flatMap(o=>i?this.table(i,o):[]),r=q("p",{class:"absent"},"No error in this window: no wrench is expected, or its samples are ignored.");this.root.replaceChildren(...s.length>0?s:[r])}table(e,t){let{quantity:i,window:s}=this.store.state,[r,o]=[this.data.firstAt(s[0]),this.data.sampleAt(s[1])+1],a=Tc.flatMap(_=>this.data.columns.error(e,t,i,_)??[]),l=a[0]?.summary(r,o).count??0;if(l===0)return[];let c=i==="force"?"f":"t",h=q("span",{class:"chip"});h.style.background=ii(e,t);let u=a.map((_,m)=>{let p=m===3?`|${c}|`:`${c}${"xyz"[m]??""}`;return q("tr",{},q("th",{scope:"row"},p),...this.cells(_,r,o))}),f=a[3],d=["calibration","validation"].flatMap(_=>{let m=f&&this.data.columns.partOf(f,_);return m&&m.summary(r,o).count>0?[{use:_,part:m}]:[]});if(d.length>1)for(let{use:_,part:m}of d)u.push(q("tr",{},q("th",{scope:"row"},`|${c}| ${_}`),...this.cells(m,r,o)));let g=["rms","mean","largest"].map(_=>q("th",{scope:"col"},_));return[q("table",{class:"statistics"},q("caption",{},h,` ${t.name} [${bi[i]}], n = ${l}`),q("thead",{},q("tr",{},q("th",{scope:"col"},Ya("component")),...g)),q("tbody",{},...u))]}cells(e,t,i){let{sum:s,squares:r,count:o}=e.summary(t,i),a=e.farthest(t,i)??t,l=Pt(this.shown(e.at(a)),()=>this.store.set({sample:a,playing:!1}),{class:"link",title:`at ${(this.data.time[a]??0).toFixed(3)} s`});return[...[Math.sqrt(r/o),s/o].map(h=>q("td",{},this.shown(h))),q("td",{},l)]}shown(e){return e.toFixed(this.store.state.quantity==="force"?2:3)}};var Pa={top:1,height:14},pc={top:17,height:9},Ff=class{constructor(e,t,i,s){this.panel=e;this.frames=t;this.data=i;this.store=s;this.canvas=q("canvas",{role:"img"}),this.axis=new Ca(e,s),e.append(this.canvas),new ResizeObserver(()=>t.later(this)).observe(e),this.canvas.addEventListener("click",r=>{let o=this.axis.instant(r.clientX-this.canvas.getBoundingClientRect().left);s.set({sample:i.nearestSample(o),playing:!1})}),this.canvas.addEventListener("mousemove",r=>{this.canvas.title=this.describe(this.axis.instant(r.clientX-this.canvas.getBoundingClientRect().left))})}panel;frames;data;store;canvas;axis;update(){this.frames.later(this)}draw(){let[e,t]=[this.panel.clientWidth,this.panel.clientHeight],i=Df(this.canvas,e,t);if(!i)return;let s=[...this.data.scene.intervals,...Si(this.data,this.store.state.marks)],r=this.data.scene.findings;this.canvas.setAttribute("aria-label",`Time axis with ${s.length} intervals and ${r.length} findings; both are listed beside the plots`);for(let{label:o,start_s:a,end_s:l,use:c}of s)this.bar(i,a,l,c,o);for(let{start_s:o,end_s:a}of r)this.finding(i,o,a);for(let{start_s:o,end_s:a}of this.store.state.selected){let[l,c]=[Math.max(pi,this.axis.pixel(o)),Math.min(e-Ps,this.axis.pixel(a))];i.fillStyle=si(Yt,.45),c>=l&&i.fillRect(l,0,Math.max(1,c-l),t)}for(let o of this.store.state.marks)this.flag(i,o.time_s,o.mark);i.fillStyle=Yt,i.fillText("intervals",4,Pa.top+11),i.fillStyle=_c,i.fillText("findings",4,pc.top+8)}bar(e,t,i,s,r){let o=Math.max(pi,this.axis.pixel(t)),a=Math.min(this.panel.clientWidth-Ps,this.axis.pixel(i));if(a<=o)return;e.fillStyle=si(zr[s],.4),e.fillRect(o,Pa.top,a-o,Pa.height),e.strokeStyle=zr[s],e.strokeRect(o+.5,Pa.top+.5,Math.max(0,a-o-1),Pa.height-1),e.fillStyle=Yt;let l=s==="ignore"?`${r} (ignored)`:r;e.measureText(l).width<a-o-6&&e.fillText(l,o+4,Pa.top+11)}finding(e,t,i){if(t===null)return;let s=this.panel.clientWidth-Ps,[r,o]=[this.axis.pixel(t),this.axis.pixel(i??t)];if(!(o<pi||r>s)){e.fillStyle=si(_c,.25),e.fillRect(Math.max(pi,r),pc.top,Math.min(s,o)-Math.max(pi,r),pc.height),e.fillStyle=_c;for(let a of[r,o])a>=pi&&a<=s&&e.fillRect(a-.75,pc.top,1.5,pc.height)}}flag(e,t,i){let s=this.axis.pixel(t);if(s<pi||s>this.panel.clientWidth-Ps)return;let r=i==="begin"?6:i==="end"?-6:0;if(e.fillStyle=cg,e.fillRect(s-.75,0,1.5,this.panel.clientHeight),e.beginPath(),r===0)e.arc(s,4,3.5,0,2*Math.PI);else for(let[o,a]of[[s,0],[s+r,4],[s,8]])e.lineTo(o,a);e.fill()}describe(e){let t=3*Math.abs(this.axis.instant(1)-this.axis.instant(0)),{intervals:i,findings:s}=this.data.scene;return[...i.filter(r=>r.start_s<=e&&e<r.end_s).map(r=>`${r.label} (${r.use})`),...s.filter(r=>r.start_s!==null&&r.start_s-t<=e&&e<=(r.end_s??r.start_s)+t).map(r=>`${r.stream}: ${r.kind}: ${r.message}`)].slice(0,12).join(`
`)}};var a2=180/Math.PI,Of=class{constructor(e,t,i){this.data=e;this.store=t;t.on(["sample","sensor","quantity","hidden"],()=>i.later(this))}data;store;root=q("div",{class:"values"});draw(){let{sample:e,sensor:t,quantity:i,hidden:s}=this.store.state,r=this.data.sensor(t),o=i==="force"?"f":"t",a=[`${o}x`,`${o}y`,`${o}z`,`|${o}|`],l=(r?.wrenches??[]).filter(c=>!s.has(c.name)).map(c=>{let h=this.data.vector(c,e,i),u=[...h,Math.hypot(...h)].map(d=>q("td",{},c2(d,i))),f=q("span",{class:"chip"});return f.style.background=r?ii(r,c):"",q("tr",{},q("th",{scope:"row",title:c.name},f,Ya(c.name)),...u)});this.root.replaceChildren(q("table",{},q("caption",{},`${i==="force"?"Force":"Torque"} [${bi[i]}]${l2(r)}`),q("thead",{},q("tr",{},q("th",{scope:"col"},Ya("series")),...a.map(c=>q("th",{scope:"col"},c)))),q("tbody",{},...l)))}},kf=class{constructor(e,t,i){this.data=e;this.store=t;let s=q("table",{},this.body);this.root=q("details",{},q("summary",{},`Joint configuration (${e.scene.coordinates.length})`),s),this.root.addEventListener("toggle",()=>i.later(this)),t.on(["sample"],()=>i.later(this))}data;store;root;body=q("tbody");draw(){if(!this.root.open)return;let{sample:e}=this.store.state;this.body.replaceChildren(...this.data.scene.coordinates.map((t,i)=>{let s=this.data.position(e,i),r=this.data.isLength(i),o=Number.isNaN(s)?"absent":r?`${s.toFixed(4)} m`:`${(s*a2).toFixed(2)}\xB0`;return q("tr",{},q("th",{scope:"row"},t),q("td",{},o))}))}};function l2(n){return n?n.acting===null?` unexplained on ${n.acted_on}`:` of ${n.acting} on ${n.acted_on}`:""}function c2(n,e){return Number.isFinite(n)?n.toFixed(e==="force"?2:3):"\u2013"}function Yx(n,e){let t=(u,f,d,g)=>q("input",{type:"number","aria-label":u,value:f,min:d,step:g}),[i,s]=[t("Video start in seconds",0,0,.1),t("Video end in seconds",0,0,.1)],[r,o]=[t("Video frames per second",20,1,1),t("Video speed",1,.1,.1)],a=pr("Video codec",[["h264","H.264: plays everywhere"],["vp9","VP9: same file every time"]],"h264",()=>{}),l=q("progress",{max:1,value:0,"aria-label":"Video progress"});l.hidden=!0,n.store.on(["window"],()=>{i.value=n.store.state.window[0].toFixed(3),s.value=n.store.state.window[1].toFixed(3)});let c=Pt("Record video",()=>{h()},{});async function h(){c.disabled=!0,l.hidden=!1;try{let[u,f,d,g]=[i,s,r,o].map(A=>A.valueAsNumber),[_,m]=[u??0,f??0].map(A=>n.data.nearestSample(A)),p={start:_??0,end:m??0,fps:d??20,speed:g??1,codec:a.value},x=await Wc(n,p,A=>{l.value=A});Rc(Pc(n.data.scene.title,".mp4"),x,"video/mp4"),e("The video is made.")}catch(u){e(String(u))}finally{c.disabled=!1,l.hidden=!0}}return q("details",{},q("summary",{},"Video"),q("div",{class:"row video"},q("label",{},"from",i),q("label",{},"to",s),q("label",{},"frames/s",r),q("label",{},"speed",o)),q("div",{class:"row"},a,c,l))}window.ft={ready:h2()};async function h2(){document.readyState==="loading"&&await new Promise(t=>document.addEventListener("DOMContentLoaded",t,{once:!0}));let n=q("progress",{"aria-label":"Loading the data"}),e=q("div",{class:"waiting",role:"status"},"Loading the data ",n);document.body.append(e);try{let t=N0();document.title||=t.title;let i=await U0(t,(s,r)=>{r>0&&([n.max,n.value]=[r,s])});return performance.mark("read"),u2(t.live?new Vs(t,i):new Eo(t,i)),performance.mark("drawn"),e.remove(),document.documentElement.dataset.ready="true",F0(i),!0}catch(t){throw e.replaceChildren(`This page cannot be shown. ${t instanceof Error?t.message:String(t)}`),e.setAttribute("role","alert"),t}}function u2(n){let e={sensor:0,quantity:"force",hidden:new Set,window:n.span},t=new Jc({...e,sample:Lo(n,e)??r0(n)??0,forceArrows:!0,momentArrows:!0,allSensors:!0,contacts:!0,skin:!0,skinEvents:!0,wireframes:!0,hideIgnored:!1,marks:[],markKind:"point",hover:null,selected:[],errorOnRobot:!0,scaleByCalibrations:!1,large:null,playing:n instanceof Vs,speed:1,...n instanceof Vs?{}:Id(n,location.hash)}),i=new Ic,s=_=>{o.status.textContent=_};window.addEventListener("error",({error:_})=>{_ instanceof Error&&s(_.message)});let r=n instanceof Vs?A0(n,t):null,o=M0(n,t,()=>r?.bar??u0(n,t,s));(document.getElementById("viewer")??document.body).append(o.app);let a=new Ac(n),l=new If(o.robot,i,n),c=new Nf(o.space,i,n,a,t);o.robotTitle.prepend(Pt("\u27F2",()=>l.reset(),{"aria-label":"Reset the robot's view",title:"Reset the view"})),o.spaceTitle.prepend(Pt("\u27F2",()=>c.reset(),{"aria-label":"Reset the space's view",title:"Reset the view"}));let h=["forceArrows","momentArrows","allSensors","contacts","errorOnRobot"];t.on(["sample","sensor","quantity","hidden",...h,"skin","skinEvents"],()=>l.update(t.state)),t.on(["sample","sensor","quantity","hidden","wireframes","hideIgnored","marks","window"],()=>c.update(t.state));let u=o.plots.map(({panel:_,shown:m})=>new _f(_,m,i,n,t)),f=f2(o,i,n,a,t),d={data:n,store:t,robot:l,space:c,flush:()=>i.flush()},g=d2(o,i,d,s);if(p2(o,d,l),_0(n,t,s),S0(),Object.assign(window.ft,t0(d,c,f,u)),n instanceof Vs){let _=!1,m=E0(n,t,p=>{!_&&n.samples>0&&(_=!0,l.aim()),r?.show(p),g?.show(p)});window.ft.live=()=>({...m,samples:n.samples,span:n.span})}else f0(n,t),$0(n,t);i.flush()}function f2(n,e,t,i,s){for(let r of n.strips){let o=new Ff(r,e,t,s);s.on(["window","marks","selected"],()=>o.update())}for(let r of n.rasters){let o=new Lf(r,e,t,s);s.on(["window","sample"],()=>o.update())}return n.planes.map((r,o)=>{let a=new tf(r,[[0,1],[1,2],[0,2]][o]??[0,1],e,t,i,s),l=["sensor","quantity","hidden","wireframes","hideIgnored","marks","window","selected"];return s.on(["sample",...l],()=>a.update()),a})}function d2(n,e,t,i){let{data:s,store:r}=t,o=(u,...f)=>q("section",{"aria-label":u},q("h2",{},u),...f),a=new Of(s,r,e),l=new kf(s,r,e);if(s instanceof Vs){let u=C0(s),f=o("Series",Om(s,r),a.root);return n.side.append(...sd(s),o("Sensors",u.panel),f,o("Shown",km(s,r)),l.root),u}let c=new Uf(s,r,e),h=q("details",{},q("summary",{},"Origin of the data"),q("ul",{class:"entries",tabindex:"0"},...s.scene.provenance.map(u=>q("li",{},u))));return n.side.append(...sd(s),...s.scene.sensors.length>0?[o("Series",Om(s,r),a.root)]:[],...s.scene.sensors.some(Oi)?[o("Error in view",c.root)]:[],o("Shown",km(s,r)),...Bx(s,r,e,t.robot.skin.metresPer),o("Saved samples",q0(s,r,i),n.status),...s.scene.coordinates.length>0?[l.root]:[],Dg(s,r),Ig(s,r),Yx(t,i),h),null}function p2(n,{data:e,store:t,space:i},s){let r=o=>String(Number((.1/o).toPrecision(2)));t.on(["sensor","quantity","hidden","errorOnRobot","window"],()=>{let{quantity:o,errorOnRobot:a}=t.state,{force:l,moment:c}=s.wrenches.metresPer,{metresPer:h,fullColour:u}=s.error,f=a&&h!==null&&u!==null,d=f?Number(u.toPrecision(2)):0,g=f?`; of error: ${r(h)} ${bi[o]}; limb red at ${d} ${bi[o]}`:"";n.scale.textContent=`0.1 m of arrow: ${r(l)} N, ${r(c)} N m${g}`}),t.on(["sample","sensor","quantity"],()=>{let{sample:o,sensor:a,quantity:l}=t.state,c=`sample ${o}, ${(e.time[o]??0).toFixed(3)} s`;s.canvas.setAttribute("aria-label",`Robot ${e.scene.robot.name} in its posture at ${c}`);let h=e.sensor(a)?.name??"no sensor";i.canvas.setAttribute("aria-label",`${l==="force"?"Force":"Torque"} space of ${h} at ${c}`)})}})();
