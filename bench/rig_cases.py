#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes with known answers from a rig: rig_cases.py FOLDER_OF_THE_DATA_SET OUT
Of each expression below: the scan of subject A moved as the rig moves (NAME_truth.ply, same vertices),
a ramp of one second of its 68 landmarks (NAME_mm.csv), scenes with seven and with all points, and
OUT/cases.txt for muscle_bench. Needs Debian's python3-scipy."""
import csv, json, os, struct, sys
import numpy as np
from scipy.spatial import cKDTree

DATA = os.path.abspath(sys.argv[1])
OUT = os.path.abspath(sys.argv[2])
os.makedirs(OUT, exist_ok=True)
D = DATA + '/ict/'
b=open(D+'subject_A_rig.glb','rb').read()
n=struct.unpack('<I',b[12:16])[0]; J=json.loads(b[20:20+n]); bin_=b[20+n+8:]
def acc(i):
    a=J['accessors'][i]; bv=J['bufferViews'][a['bufferView']]
    off=bv.get('byteOffset',0)+a.get('byteOffset',0)
    ct={5126:np.float32,5125:np.uint32,5123:np.uint16}[a['componentType']]
    k={'SCALAR':1,'VEC3':3,'VEC2':2}[a['type']]
    st=bv.get('byteStride',0)
    if a.get('sparse'):
        out=np.zeros((a['count'],k),ct)
        s=a['sparse']
        bi=J['bufferViews'][s['indices']['bufferView']]; o=bi.get('byteOffset',0)+s['indices'].get('byteOffset',0)
        it={5125:np.uint32,5123:np.uint16}[s['indices']['componentType']]
        idx=np.frombuffer(bin_,it,s['count'],o)
        bvv=J['bufferViews'][s['values']['bufferView']]; o=bvv.get('byteOffset',0)+s['values'].get('byteOffset',0)
        out[idx]=np.frombuffer(bin_,ct,s['count']*k,o).reshape(-1,k)
        return out
    assert st in (0,k*np.dtype(ct).itemsize)
    return np.frombuffer(bin_,ct,a['count']*k,off).reshape(-1,k)
m=J['meshes'][0]; P=m['primitives']
V=acc(P[0]['attributes']['POSITION']).astype(float)*1e3
names=m['extras']['targetNames']
tri=[]
mat=[J['materials'][p['material']]['name'] for p in P]
for p,mm in zip(P,mat):
    if p['attributes']['POSITION']!=P[0]['attributes']['POSITION']: print('separate',mm)
    if mm in('face','head_neck','mouth_socket','eye_socket') or True: tri.append((mm,acc(p['indices']).reshape(-1,3)))
T=[acc(t['POSITION']).astype(float)*1e3 for t in P[0]['targets']]
print(len(V),len(names),len(T),mat)
lm=m['extras']['landmarks68']
F=np.vstack([t for mm,t in tri if mm in('face','head_neck','mouth_socket')]).astype(int)
def ply(f):
    d=open(f,'rb').read(); h=d.index(b'end_header\n')+11; hd=d[:h].decode()
    nv=int([l for l in hd.split('\n') if l.startswith('element vertex')][0].split()[2])
    nf=int([l for l in hd.split('\n') if l.startswith('element face')][0].split()[2])
    props=[l.split() for l in hd.split('\n') if l.startswith('property') and 'list' not in l]
    v=np.frombuffer(d,[(p[2],{'float':'<f4','uchar':'u1'}[p[1]]) for p in props],nv,h)
    return np.stack([v['x'],v['y'],v['z']],1).astype(float), d[:h], d[h+v.nbytes:]
S,_,_=ply(D+'subject_A_neutral_scan.ply')
# barycentric places
tree=cKDTree(V[np.unique(F)]); uq=np.unique(F)
inc=[[] for _ in range(len(V))]
for i,f in enumerate(F):
    for k in f: inc[k].append(i)
def closest(p,a,b,c):
    ab=b-a;ac=c-a;ap=p-a
    M=np.array([[ab@ab,ab@ac],[ab@ac,ac@ac]]); r=np.array([ab@ap,ac@ap])
    try: s=np.linalg.solve(M,r)
    except np.linalg.LinAlgError: s=np.array([0,0])
    w=np.array([1-s.sum(),s[0],s[1]])
    if w.min()<0:
        best=None
        for i,j,x,y in((0,1,a,b),(1,2,b,c),(0,2,a,c)):
            e=y-x; t=np.clip((p-x)@e/max(e@e,1e-12),0,1); d=np.linalg.norm(x+t*e-p)
            if best is None or d<best[0]:
                w=np.zeros(3); w[i]=1-t; w[j]=t; best=(d,w)
        w=best[1]
    q=w[0]*a+w[1]*b+w[2]*c
    return np.linalg.norm(q-p),w
# all candidate triangles of 4 nearest vertices
O,_h,_t=ply(D+'subject_A_mouth_open_truth.ply')
DJ=.75*T[names.index('jawOpen')]
_,nn=tree.query(S,8); ti=np.zeros(len(S),int); W=np.zeros((len(S),3)); far=0
for v in range(len(S)):
    best=(9e9,)
    for t in set(sum((inc[uq[k]] for k in nn[v]),[])):
        d,w=closest(S[v],*V[F[t]]); d+=np.linalg.norm(S[v]+w@DJ[F[t]]-O[v])
        if d<best[0]: best=(d,t,w)
    ti[v]=best[1]; W[v]=best[2]; far=max(far,best[0])
print('farthest',far)
def moved(weights):
    d=np.zeros_like(V)
    for k,w in weights.items():
        for s in ([k] if k in names else [k+'_L',k+'_R']): d+=w*T[names.index(s)]
    return d
def carry(d): return (W[:,:,None]*d[F[ti]]).sum(1)
# check with given truth
O,head,tail=ply(D+'subject_A_mouth_open_truth.ply')
e=np.linalg.norm(S+carry(moved({'jawOpen':.75}))-O,axis=1); print('check jawOpen 0.75: mean',e.mean(),'max',e.max())
X={
'oneSmile':{'mouthSmile_L':.9},'smileCheeks':{'mouthSmile':.8,'cheekSquint':.6,'cheekRaiser':.6},
'pucker':{'mouthPucker':.8},'frown':{'mouthFrown':.8,'browDown':.8},'upperUp':{'mouthUpperUp':.7,'jawOpen':.2},
'jawSmile':{'jawOpen':.4,'mouthSmile':.7},'jawOpen':{'jawOpen':.75},'jawLeft':{'jawLeft':.8,'jawOpen':.3},
'oneSmileR':{'mouthSmile_R':.9},'sneer':{'noseSneer_L':.8,'noseSneer_':.8,'mouthUpperUp':.3},'surprise':{'browInnerUp':.9,'browOuterUp':.9,'eyeWide':.7,'jawOpen':.35},
'funnel':{'mouthFunnel':.8},'puff':{'cheekPuff':.7},'stretch':{'mouthStretch':.8},'lowerDown':{'mouthLowerDown':.8},'dimple':{'mouthDimple':.8},
'mouthLeft':{'mouthLeft':.8},'press':{'mouthPress':.8},'shrug':{'mouthShrugLower':.8,'mouthShrugUpper':.4},'snarlL':{'noseSneer_L':.9,'mouthUpperUp_L':.7},'blink':{'eyeBlink':.9,'eyeSquint':.4}}
if 'noseSneer_R' in names:
    X['sneer']={'noseSneer':.8,'mouthUpperUp':.3}
# talk frame 46
r=list(csv.reader(open(DATA+'/rgbd/subject_A_talk/truth_weights.csv'))); h=r[0]
row=min(r[1:],key=lambda q:abs(float(q[0])-1.533333)); tw={}
for k,v in zip(h[1:],row[1:]):
    if k in names and float(v): tw[k]=float(v)
X['talk46']=tw; print('talk',tw)
for t in (0.8,2.3,3.1):
    row=min(r[1:],key=lambda q:abs(float(q[0])-t)); X['talk%d'%round(t*30)]={k:float(v) for k,v in zip(h[1:],row[1:]) if k in names and float(v)}
heads=[]
for x,y in ((-45,60),(45,60),(0,75),(-60,20),(60,20),(0,60)):
    c=V[lm[27]]+np.array([x,y-30,0]); cand=uq; f=cand[V[cand][:,2]>V[lm[27]][2]-80]
    heads.append(f[np.argmin(np.linalg.norm(V[f][:,:2]-c[:2],axis=1)-0*V[f][:,2])])
out=OUT+'/'
lines=['real %s/real/spacetime/smile_%s.toml %s/real/spacetime/smile.ply %s'%(DATA,k,DATA,k) for k in ('7','all')]
lines.append('markers %s/real/animface/cheeks_7.toml - markers'%DATA)
for name,w in X.items():
    d=moved(w); cs=carry(d); truth=(S+cs)
    nv=np.zeros(len(S),[('x','<f4'),('y','<f4'),('z','<f4')]); nv['x'],nv['y'],nv['z']=truth.T
    open(out+name+'_truth.ply','wb').write(head+nv.tobytes()+tail)
    with open(out+name+'_mm.csv','w') as f:
        cols=['time_s']+['ibug68_%d_%s_mm'%(k,a) for k in range(68) for a in 'xyz']+['head_%d_%s_mm'%(k+1,a) for k in range(6) for a in 'xyz']
        f.write(','.join(cols)+'\n')
        N=30
        for i in range(N+1):
            t=i/N; pts=np.vstack([V[lm]+t*d[lm],V[heads]])
            f.write(','.join(['%.6f'%t]+['%.5f'%q for q in pts.ravel()])+'\n')
    lines+=['%s %s%s_%s.toml %s%s_truth.ply %s'%(name,out,name,k,out,name,k) for k in ('7','all')]
    for kind,dr in (('7',''),('all','drive = { points = [%s] }\n'%','.join('"ibug68_%d"'%k for k in range(68)))):
        open(out+name+'_%s.toml'%kind,'w').write('title = "%s"\nscan = { file = "%s", unit = "mm", landmarks = "%s" }\nmotion = { file = "%s_mm.csv", rigid_points = ["head_1","head_2","head_3","head_4","head_5","head_6"] }\n%stime = { end_s = 1.2 }\noutput = { peak_time_s = 1.2, vtu = false, glb = false, report = false }\n'%(name,D+'subject_A_neutral_scan.ply',D+'subject_A_landmarks.json',name,dr))
    print('%-12s mean %.2f max %.2f  corner L %.1f R %.1f'%(name,np.linalg.norm(cs,axis=1).mean(),np.linalg.norm(cs,axis=1).max(),np.linalg.norm(d[lm[54]]),np.linalg.norm(d[lm[48]])))
open(out+'cases.txt','w').write('\n'.join(lines)+'\n')
