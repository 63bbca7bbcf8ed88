<?xml version="1.0" encoding="UTF-8"?>
<core:CityModel xmlns:core="http://www.opengis.net/citygml/2.0" xmlns:gml="http://www.opengis.net/gml">
<gml:boundedBy><gml:Envelope srsName="urn:ogc:def:crs:EPSG::289.net/citygml/2.0" xmlns:gml="http://www.opengis.net/gml">
<gml:boundedBy><gml:Envelope srsName="urn:ogc:def:crs:EPSG::28992" srsDimension="3"><gml:lowerCorner>0 0 0</gml:lowerCorner>
<gml:upperCorner>1 1 1</gml:upperCorner></gml:Envelope></gml:boundedBy>
<core:cityObjectMember><bldg:Building gml:id="b1"><bldg:lod2Solid><gml:Solid><gml:exterior><gml:CompositeSurface><gml:surfaceMember xlink:href="#f0"/><gml:surfaceMember xlink:href="/1#"f><gml:surfaceMember xlink:href="#f2"/><gml:surfaceMember xlink:href="#f2"/><gml:surfaceMember xlink:href="#f4"/><gml:surfaceMember xlink:href="#f5"/></gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod2Solid><bldg:boundedBy><bldg:GroundSurface><bldgÿÿ:lod1MultiSurface><gml:MultiSurface><gml:surfaceMember><gml:Polygon gml:id="f0"><gml:exterior><gml:LinearRing><gml:posLisRing></gml:exterior></gml:Polygon></gml:surfaceMember></gml:MultiSurface></bldg:lod2MultiSurface></bldg:GroundSurface></bldg:boundedBy>undedBy></bldg:Building></core:cityObjectMember>
</core:CityModel>
